#include "app/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtkCellData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace pintle {

void Canvas::fill(const std::vector<Vector2d>& outline, const Colour& colour) {
  shapes_->InsertNextCell(static_cast<int>(outline.size()));
  for (const Vector2d& r : outline) {
    shapes_->InsertCellPoint(points_->InsertNextPoint(r.x(), r.y(), layer_));
  }
  const Colour byte = 255 * colour;
  colours_->InsertNextTuple3(byte.x(), byte.y(), byte.z());
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
  shapes->GetCellData()->SetScalars(colours_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shapes);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

}  // namespace pintle
