#include "framework/bodies/elastic_parts.h"

#include <iomanip>
#include <sstream>

#include "framework/common/file_names.h"
#include "framework/common/nearest.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"

namespace pintle {

std::string shown(const Eigen::Vector2d& p) {
  std::ostringstream s;
  s << std::setprecision(6) << "(" << p.x() << ", " << p.y() << ") m";
  return s.str();
}

std::string kind_of(const std::filesystem::path& file) { return ending_of(file); }

bool is_finished_mesh(const ScenePlate& plate) {
  const auto* file = std::get_if<SceneFile>(&plate.shape);
  if (!file) return false;
  const std::string kind = kind_of(file->path);
  return kind == ".msh" || kind == ".inp";
}

const ScenePoint& point_of(const Scene& scene, const SceneBody& body, const std::string& name, const Place& place) {
  std::vector<std::string> known;
  for (const ScenePoint& p : body.points) {
    if (p.name == name) return p;
    known.push_back(p.name);
  }
  throw SceneError(scene.file, place, "\"" + body.name + "\" has no point \"" + name + "\"." + did_you_mean(name, known));
}

std::vector<std::string> group_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Group& g : mesh.groups) names.push_back(g.name);
  return names;
}

const Group& group_of(const Scene& scene, const Mesh& mesh, const std::string& name, const Place& place, const std::string& remedy) {
  if (const Group* group = mesh.group(name)) return *group;
  const auto names = group_names(mesh);
  throw SceneError(scene.file, place,
                   "the mesh has no group \"" + name + "\"" +
                       (names.empty() ? "; it has no groups: " + remedy : "." + did_you_mean(name, names) + " Otherwise " + remedy));
}

std::vector<Cells> sides_of(const Mesh& mesh, const Group& group) {
  return group.sides.empty() ? sides_within(mesh, group.nodes) : group.sides;
}

const SceneBody& elastic_of(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  const SceneBody* found = nullptr;
  for (const SceneBody& b : scene.bodies) {
    if (b.name == name && !b.elastic)
      throw SceneError(scene.file, b.place, "\"" + name + "\" is rigid: it has no mesh; give it beam or plate instead of rigid");
    if (!b.elastic) continue;
    names.push_back(b.name);
    if (name.empty() || b.name == name) found = &b;
  }
  if (names.empty()) throw SceneError(scene.file, {0, "bodies"}, "no body is made of elements; give one a beam or a plate");
  if (!name.empty() && !found)
    throw SceneError(scene.file, {0, "bodies"}, "no body of elements is called \"" + name + "\"." + did_you_mean(name, names));
  if (name.empty() && names.size() > 1)
    throw SceneError(scene.file, {0, "bodies"},
                     "several bodies are made of elements (" + some_of(names, false) + "); choose one with --body");
  return *found;
}

}  // namespace pintle
