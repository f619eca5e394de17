#include "meshes/gmsh.h"

#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "meshes/link_lattice.h"
#include "meshes/mesher.h"
#include "meshes/module.h"
#include "meshes/refuse.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;

const Mesher& mesher() {
  static const Mesher& loaded = module_table<Mesher>("mesher");
  return loaded;
}

void judge(const std::string& name, const MeshOptions& o, double scale) {
  if (corners_of(o.shape) == 2)
    refuse(name, ": cells of shape ", name_of(o.shape),
           "; a plane body is made of triangles or quadrilaterals");
  const auto not_negative = [&](const char* what, double value) {
    if (!(value >= 0) || !std::isfinite(value))
      refuse(name, ": ", what, " = ", value, " m, must be positive, or 0 to have it chosen");
  };
  not_negative("size", o.size);
  not_negative("hole_size", o.hole_size);
  if (!(scale > 0) || !std::isfinite(scale))
    refuse(name, ": scale = ", scale, ", must be positive: m per unit of the file");
  for (const Vector2d& p : o.points)
    if (!p.allFinite()) refuse(name, ": the point (", p.x(), ", ", p.y(), ") is not finite");
}

// Gmsh passes over the last line of a script without a word if it does not end.
void judge_last_line(const fs::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in || in.tellg() <= 0) return;
  in.seekg(-1, std::ios::end);
  if (in.get() != '\n')
    refuse(path.string(),
           ": the last line has no end, and Gmsh would leave it out; end the file with a new line");
}

}  // namespace

Mesh mesh_link(const Link& link, const MeshOptions& o) {
  judge(link);
  judge("link", o, 1);
  if (std::optional<Mesh> mesh = lattice_link(link, o)) return *std::move(mesh);
  return mesher().link(link, o);
}

Mesh read_geometry(const fs::path& path, const MeshOptions& o, double scale) {
  const std::string name = path.string(), kind = path.extension().string();
  judge(name, o, scale);
  if (kind != ".geo" && kind != ".step" && kind != ".stp" && kind != ".brep" && kind != ".msh")
    refuse(name, ": \"", kind,
           "\" is no kind of drawing known here; .geo, .step, .stp, .brep and .msh are");
  if (!fs::is_regular_file(path)) throw std::runtime_error(name + ": there is no such file");
  if (kind == ".geo") judge_last_line(path);
  return mesher().geometry(path, o, scale);
}

}  // namespace pintle
