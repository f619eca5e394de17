#include "app/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace pintle {

namespace {

using Triangle = std::array<int, 3>;

/// A cell as triangles that take in all of its nodes.
std::vector<Triangle> triangles(CellShape shape) {
  switch (shape) {
    case CellShape::triangle3: return {{0, 1, 2}};
    case CellShape::triangle6: return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    case CellShape::quadrilateral4: return {{0, 1, 2}, {0, 2, 3}};
    case CellShape::quadrilateral8: return {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6}, {4, 6, 7}};
    case CellShape::quadrilateral9: return {{0, 4, 8}, {0, 8, 7}, {4, 1, 5}, {4, 5, 8}, {8, 5, 2}, {8, 2, 6}, {7, 8, 6}, {7, 6, 3}};
    case CellShape::line2:
    case CellShape::line3: break;
  }
  return {};
}

/// Of each point, the first that lies where it does. A beam's elements share places, not points.
std::vector<int> first_at_same_place(const Eigen::Matrix2Xd& points) {
  const Vector2d low = points.rowwise().minCoeff();
  const double reach = 1e-7 * (points.rowwise().maxCoeff() - low).norm();
  std::map<std::pair<long, long>, int> known;  // by square of twice the reach
  std::vector<int> first(static_cast<std::size_t>(points.cols()));
  for (int i = 0; i < points.cols(); ++i) {
    const Vector2d at = (points.col(i) - low) / (2 * reach);
    const long x = std::lround(at.x()), y = std::lround(at.y());
    int found = i;
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy) {
        const auto other = known.find({x + dx, y + dy});
        if (other != known.end() && (points.col(other->second) - points.col(i)).norm() <= reach) found = other->second;
      }
    if (found == i) known.emplace(std::pair(x, y), i);
    first[static_cast<std::size_t>(i)] = found;
  }
  return first;
}

}  // namespace

Colour field_colour(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  Colour colour;
  vtkMath::HSVToRGB(0.66 * (1 - s), 0.75 + 0.1 * s, 0.85 + 0.05 * s, &colour[0], &colour[1], &colour[2]);
  return colour;
}

vtkIdType Canvas::corner(const Vector2d& at, const Colour& colour) {
  const Colour byte = 255 * colour;
  colours_->InsertNextTuple3(byte.x(), byte.y(), byte.z());
  return points_->InsertNextPoint(at.x(), at.y(), layer_);
}

void Canvas::fill(const std::vector<Vector2d>& outline, const Colour& colour) {
  shapes_->InsertNextCell(static_cast<int>(outline.size()));
  for (const Vector2d& r : outline) shapes_->InsertCellPoint(corner(r, colour));
}

void Canvas::fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>& cells, const std::vector<Colour>& colours) {
  const auto count = static_cast<std::size_t>(points.cols());
  std::vector<vtkIdType> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = corner(points.col(static_cast<Eigen::Index>(i)), colours[colours.size() == 1 ? 0 : i]);
  for (const Cells& block : cells)
    for (std::size_t c = 0; c < block.size(); ++c)
      for (const Triangle& t : triangles(block.shape)) {
        const int* node = &block.nodes[c * static_cast<std::size_t>(nodes_of(block.shape))];
        shapes_->InsertNextCell(3);
        for (const int k : t) shapes_->InsertCellPoint(ids[static_cast<std::size_t>(node[k])]);
      }
}

void Canvas::stroke_outline(const Eigen::Matrix2Xd& points, const std::vector<Cells>& cells, double width, const Colour& colour) {
  Mesh mesh{points, {}, cells, {}};
  const std::vector<int> first = first_at_same_place(points);
  for (Cells& block : mesh.cells)
    for (int& node : block.nodes) node = first[static_cast<std::size_t>(node)];
  for (const Cells& sides : pintle::outline(mesh)) {
    const int n = nodes_of(sides.shape);
    for (std::size_t c = 0; c < sides.size(); ++c) {
      const int* node = &sides.nodes[c * static_cast<std::size_t>(n)];
      std::vector<Vector2d> line{points.col(node[0])};
      if (n == 3) line.emplace_back(points.col(node[2]));
      line.emplace_back(points.col(node[1]));
      stroke(line, false, width, colour);
    }
  }
}

void Canvas::stroke(const std::vector<Vector2d>& line, bool closed, double width, const Colour& colour) {
  const std::size_t n = line.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Vector2d &a = line[i], &b = line[(i + 1) % n];
    const Vector2d along = (b - a).normalized() * width / 2, across{-along.y(), along.x()};
    if (a != b) fill({a - across, b - across, b + across, a + across}, colour);
  }
  for (const Vector2d& r : line) disc(r, width / 2, colour);
}

void Canvas::disc(const Vector2d& centre, double radius, const Colour& colour) {
  std::vector<Vector2d> outline;
  const int corners = 12 + static_cast<int>(radius);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    outline.push_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  fill(outline, colour);
}

void Canvas::arrow(const Vector2d& from, const Vector2d& to, double width, const Colour& colour) {
  const Vector2d way = to - from;
  if (way.norm() < 1) return;
  const Vector2d along = way.normalized(), across{-along.y(), along.x()};
  const double head = std::min(4 * width, way.norm());
  const Vector2d neck = to - head * along;
  stroke({from, neck}, false, width, colour);
  fill({to, neck + 0.42 * head * across, neck - 0.42 * head * across}, colour);
}

vtkSmartPointer<vtkActor> Canvas::actor() const {
  vtkNew<vtkPolyData> shapes;
  shapes->SetPoints(points_);
  shapes->SetPolys(shapes_);
  shapes->GetPointData()->SetScalars(colours_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shapes);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

}  // namespace pintle
