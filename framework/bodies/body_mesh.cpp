#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/files.h"
#include "framework/bodies/beam_mesh.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/bodies/in_body.h"
#include "meshes/generate.h"
#include "meshes/gmsh.h"
#include "meshes/inp.h"
#include "meshes/soundness.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;

CellShape shape_of(const std::string& element) {
  if (element.empty() || element == "triangle6") return CellShape::triangle6;
  if (element == "triangle3") return CellShape::triangle3;
  if (element.starts_with("quadrilateral4")) return CellShape::quadrilateral4;
  return element == "quadrilateral9" ? CellShape::quadrilateral9 : CellShape::quadrilateral8;
}

/// Reports errors in a drawing or mesh at the key that names it.
template <class Work>
Mesh in_file(const Scene& scene, const SceneBody& body, Work&& work) {
  SceneBody named;
  named.place = {body.place.line, body.place.key.empty() ? "" : body.place.key + ".plate.file", body.place.file};
  return in_body(scene, named, std::forward<Work>(work));
}

Mesh plate_mesh(const Scene& scene, const SceneBody& body, const ScenePlate& plate, std::vector<std::string>& warnings) {
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
  if (kind_of(path) != ".inp") return in_file(scene, body, [&] { return read_geometry(path, options, file.scale, folder); });
  InpClaims claims;
  Mesh mesh = in_file(scene, body, [&] { return read_inp(path, file.scale, folder, &claims); });
  validate_claims(claims, plate, warnings);
  warnings.insert(warnings.end(), claims.warnings.begin(), claims.warnings.end());
  return mesh;
}

void validate_connected(const Mesh& mesh) {
  if (mesh.cell_count() == 0) throw std::invalid_argument("its mesh is empty: no cell in the plane; check the surfaces of the drawing");
  std::vector<int> piece;
  if (const int n = pieces(mesh, piece); n > 1) {
    const auto other = std::find_if(piece.begin(), piece.end(), [](int p) { return p != 0; }) - piece.begin();
    const auto number = [&](Eigen::Index node) { return std::to_string(mesh.node_numbers[static_cast<std::size_t>(node)]); };
    std::string remedy = "; join them, or make them separate bodies";
    if (const auto pair = unjoined(mesh, piece))
      remedy = "; nodes " + number(pair->first) + " and " + number(pair->second) + " both lie at " + shown(mesh.x.col(pair->first)) +
               ": merge nodes at the same position, or make the pieces separate bodies";
    throw std::invalid_argument("its mesh consists of " + std::to_string(n) + " pieces that share no node; one holds node " +
                                number(other) + " at " + shown(mesh.x.col(other)) + remedy);
  }
}

}  // namespace

Mesh mesh_of(const Scene& scene, const SceneBody& body, std::vector<std::string>& warnings) {
  return in_body(scene, body, [&] {
    Mesh mesh;
    if (const SceneBeam* beam = beam_of(body)) {
      const BeamAxis axis = beam_axis(scene, body, *beam);
      for (std::string& warning : crossings(axis)) warnings.push_back(std::move(warning));
      mesh = beam_mesh(axis, *beam);
    } else {
      mesh = plate_mesh(scene, body, plate_of(body), warnings);
    }
    if (mesh.cell_count() > 0 && mesh.plane() == (beam_of(body) != nullptr))
      throw std::invalid_argument("its mesh is made of lines, not of plane cells; a beam is described by points, not by a file");
    if (mesh.plane()) orient(mesh);
    validate_connected(mesh);
    return mesh;
  });
}

}  // namespace pintle
