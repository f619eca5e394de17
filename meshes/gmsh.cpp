#include "meshes/gmsh.h"

#include <cmath>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/files.h"
#include "files/trust.h"
#include "meshes/geo_words.h"
#include "meshes/limits.h"
#include "meshes/link_lattice.h"
#include "meshes/mesher.h"
#include "meshes/msh_text.h"
#include "meshes/reject.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;
constexpr std::size_t most_script_bytes = std::size_t{100} << 20;  // of a script
constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30;

void validate(const std::string& name, const MeshOptions& o, double scale) {
  if (corners_of(o.shape) == 2)
    reject(name, ": cells of shape ", name_of(o.shape), "; a plane body is made of triangles or quadrilaterals");
  const auto not_negative = [&](const char* what, double value) {
    if (!(value >= 0) || !std::isfinite(value)) reject(name, ": ", what, " = ", value, " m, must be positive, or 0 to have it chosen");
  };
  not_negative("size", o.size);
  not_negative("hole_size", o.hole_size);
  if (!(scale > 0) || !std::isfinite(scale)) reject(name, ": scale = ", scale, ", must be positive: m per unit of the file");
  for (const Vector2d& p : o.points)
    if (!p.allFinite()) reject(name, ": the point (", p.x(), ", ", p.y(), ") is not finite");
}

// Checks the beginning of a file of each kind. Gmsh decides by the content: it would run a file named as a mesh but without its keywords as
// a script.
void validate_head(const std::string& name, const std::string& kind, const std::string& text) {
  const auto fail = [&](const char* what) { reject(name, ": is no ", kind, " file: ", what, "; write it again, or correct its ending"); };
  const std::string_view head = text;
  if (kind == ".msh" && !head.starts_with("$MeshFormat")) fail("it does not begin with $MeshFormat");
  if (kind == ".brep" && head.find("CASCADE Topology") == head.npos) fail("it does not begin with CASCADE Topology");
  if ((kind == ".step" || kind == ".stp") && head.find("ISO-10303-21") == head.npos) fail("it does not begin with ISO-10303-21");
  // Gmsh silently ignores the last line of a script if it is not terminated.
  if (kind == ".geo" && !text.empty() && text.back() != '\n')
    reject(name, ": the last line has no newline, so Gmsh would ignore it; end the file with a newline");
}

// Gmsh runs the contents of FILE.opt whenever it reads FILE.
void validate_options(const std::string& name) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(name + ".opt", error)))
    reject(name, ": next to it is ", fs::path(name + ".opt").filename().string(),
           ", a script that Gmsh would run; move what is needed from it into a .geo, and remove it");
}

// Records the files that a script may include or merge, which the mesher reads in a process of its own: those that exist under a name in
// quotation marks.
void note_named_files(const fs::path& script, const std::string& text, const fs::path& folder, std::set<fs::path>& seen) {
  static const std::regex quoted("\"([^\"\n]+)\"");
  for (std::sregex_iterator name(text.begin(), text.end(), quoted), none; name != none; ++name) {
    std::error_code error;
    if (!fs::is_regular_file(script.parent_path() / (*name)[1].str(), error)) continue;
    try {
      const fs::path file = contained_file((*name)[1].str(), script.parent_path(), folder);
      if (!seen.insert(file).second) continue;
      if (file.extension() == ".geo") note_named_files(file, read_file(file, most_script_bytes), folder, seen);
    } catch (const FileRejected&) {  // the mesher reports it
    }
  }
}

std::vector<std::string> strings(const std::vector<fs::path>& paths) {
  std::vector<std::string> out;
  for (const fs::path& p : paths) out.push_back(p.string());
  return out;
}

MesherTask task_for(const MeshOptions& o) {
  MesherTask task;
  task.options = o;
  std::error_code error;
  task.at = fs::current_path(error).string();
  task.most_bytes = static_cast<double>(mesher_limits().bytes);
  return task;
}

}  // namespace

Mesh mesh_link(const Link& link, const MeshOptions& o) {
  validate(link);
  validate("link", o, 1);
  if (std::optional<Mesh> mesh = lattice_link(link, o)) return *std::move(mesh);
  MesherTask task = task_for(o);
  task.link = link;
  return mesh_elsewhere(task);
}

Mesh read_geometry(const fs::path& path, const MeshOptions& o, double scale, const fs::path& folder) {
  const std::string name = path.string(), kind = path.extension().string();
  validate(name, o, scale);
  if (kind != ".geo" && kind != ".step" && kind != ".stp" && kind != ".brep" && kind != ".msh")
    reject(name, ": \"", kind, "\" is not a known kind of drawing; use .geo, .step, .stp, .brep or .msh");
  std::string text;
  try {
    const bool all = kind == ".geo" || kind == ".msh";
    text = all ? read_file(path, kind == ".geo" ? most_script_bytes : most_mesh_bytes) : read_head(path, 4096);
    validate_head(name, kind, text);
    if (kind == ".msh") validate_msh(name, text);
  } catch (const FileRejected& e) {
    throw std::runtime_error(name + ": " + e.what());
  }
  validate_options(name);
  MesherTask task = task_for(o);
  task.file = name, task.scale = scale;
  const fs::path read_from = folder.empty() ? path.parent_path() : folder;
  task.folders = strings(readable_folders(read_from));
  task.unconfined = trust().geo;
  if (kind != ".geo") return mesh_elsewhere(task);
  std::set<fs::path> seen;
  note_named_files(path, text, read_from, seen);
  try {
    return mesh_elsewhere(task);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(with_line_of_script(path, text, e.what(), read_from));
  }
}

}  // namespace pintle
