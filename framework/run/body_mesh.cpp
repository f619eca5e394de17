#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/files.h"
#include "framework/run/elastic_parts.h"
#include "framework/run/in_body.h"
#include "meshes/generate.h"
#include "meshes/gmsh.h"
#include "meshes/inp.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;

// How far along a piece from a to b the place p lies on it, 0 to 1; negative if it does not.
double along(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d d = b - a;
  const double t = d.dot(p - a) / d.squaredNorm();
  return t >= 0 && t <= 1 && (a + t * d - p).norm() <= 1e-9 * d.norm() ? t : -1;
}

/// The corners of a beam's axis: the points it runs through, and between them those that lie on it.
std::vector<Vector2d> axis(const Scene& scene, const SceneBody& body, const SceneBeam& beam) {
  std::vector<Vector2d> through;
  for (const std::string& name : beam.through)
    through.push_back(vector(point_of(scene, body, name, body.place).at));
  std::vector<Vector2d> corners{through.front()};
  for (std::size_t i = 0; i + 1 < through.size(); ++i) {
    const Vector2d &a = through[i], &b = through[i + 1];
    if ((b - a).norm() == 0) continue;  // line_mesh says what is wrong with it
    std::vector<double> on;
    for (const ScenePoint& p : body.points)
      if (const double t = along(a, b, vector(p.at)); t > 1e-9 && t < 1 - 1e-9) on.push_back(t);
    std::sort(on.begin(), on.end());
    on.erase(std::unique(on.begin(), on.end(), [](double s, double t) { return t - s < 1e-9; }), on.end());
    for (const double t : on) corners.push_back(a + t * (b - a));
    corners.push_back(b);
  }
  return corners;
}

Mesh beam_mesh(const Scene& scene, const SceneBody& body, const SceneBeam& beam) {
  const std::vector<Vector2d> corners = axis(scene, body, beam);
  double length = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) length += (corners[i + 1] - corners[i]).norm();
  const int wanted = beam.elements > 0 ? beam.elements : default_beam_elements;
  std::vector<int> cells;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    cells.push_back(std::max(1, static_cast<int>(std::lround(wanted * (corners[i + 1] - corners[i]).norm() / length))));
  return line_mesh(corners, cells);
}

CellShape shape_of(const std::string& element) {
  if (element.empty() || element == "triangle6") return CellShape::triangle6;
  if (element == "triangle3") return CellShape::triangle3;
  if (element.starts_with("quadrilateral4")) return CellShape::quadrilateral4;
  return element == "quadrilateral9" ? CellShape::quadrilateral9 : CellShape::quadrilateral8;
}

Mesh plate_mesh(const Scene& scene, const SceneBody& body, const ScenePlate& plate) {
  if (const auto* grid = std::get_if<SceneGrid>(&plate.shape)) {
    std::array<Vector2d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = vector(grid->corners[i]);
    return grid_mesh(corners, grid->nx, grid->ny, shape_of(plate.element));
  }
  MeshOptions options;
  options.shape = shape_of(plate.element);
  options.size = plate.size;
  options.hole_size = plate.hole_size;
  for (const ScenePoint& p : body.points)
    if (p.hole.empty()) options.points.push_back(vector(p.at));
  if (const auto* link = std::get_if<Link>(&plate.shape)) return mesh_link(*link, options);
  const SceneFile& file = std::get<SceneFile>(plate.shape);
  const fs::path folder = fs::path(scene.file).parent_path(), path = contained_file(file.path, folder);
  return kind_of(path) == ".inp" ? read_inp(path, file.scale, folder) : read_geometry(path, options, file.scale, folder);
}

void judge(const Mesh& mesh) {
  if (mesh.cell_count() == 0) throw std::invalid_argument("its mesh is empty: no cell in the plane; look at the drawing's surfaces");
  std::vector<int> piece;
  if (const int n = pieces(mesh, piece); n > 1) {
    const auto other = std::find_if(piece.begin(), piece.end(), [](int p) { return p != 0; }) - piece.begin();
    throw std::invalid_argument("its mesh falls into " + std::to_string(n) + " pieces that share no node; one holds node " +
                                std::to_string(mesh.node_numbers[static_cast<std::size_t>(other)]) + " at " + shown(mesh.x.col(other)) +
                                "; join them, or make them bodies of their own");
  }
}

}  // namespace

Mesh mesh_of(const Scene& scene, const SceneBody& body) {
  return in_body(scene, body, [&] {
    Mesh mesh = beam_of(body) ? beam_mesh(scene, body, *beam_of(body)) : plate_mesh(scene, body, plate_of(body));
    if (mesh.cell_count() > 0 && mesh.plane() == (beam_of(body) != nullptr))
      throw std::invalid_argument("its mesh is made of lines, not of plane cells; a beam is described by points, not by a file");
    if (mesh.plane()) orient(mesh);
    judge(mesh);
    return mesh;
  });
}

}  // namespace pintle
