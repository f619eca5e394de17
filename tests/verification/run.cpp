#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "framework/analysis/natural_modes/natural_modes.h"
#include "meshes/mesh.h"
#include "tests/verification/page.h"

namespace verification {

using namespace pintle;

Scene scene(const std::string& name, const Overrides& overrides) {
  return read_scene(paper::source / "examples" / (name + ".yaml"), overrides);
}

ElasticBody body(const Scene& s, const std::string& name) { return elastic_body(s, elastic_of(s, name)); }

ScenePlate& plate(Scene& s) { return std::get<ScenePlate>(s.bodies.front().elastic->shape); }

void take(Scene& s, const std::string& element) {
  ScenePlate& p = plate(s);
  p.element = element;
  auto* file = std::get_if<SceneFile>(&p.shape);
  if (!file || !file->path.ends_with(".inp")) return;
  static const std::map<char, int> index{{'3', 3}, {'4', 4}, {'6', 6}, {'8', 8}};
  const char nodes = element[element.find_first_of("346789")];
  file->path.replace(file->path.size() - 5, 1, 1, nodes);
  if (!index.contains(nodes)) throw std::runtime_error("no mesh of " + element);
}

std::string shown_mesh(const ElasticBody& e) {
  std::string out;
  for (const Cells& c : e.mesh.cells) out += (out.empty() ? "" : " + ") + std::to_string(c.size()) + " " + name_of(c.shape);
  return out;
}

Values frequencies(const Scene& s, int count, const std::string& name) {
  const ElasticBody e = body(s, name);
  const ModesReport r = modes_of(s, e, count);
  Values hertz;
  for (const double omega : r.natural.modes.omega) hertz.push_back(omega / (2 * std::numbers::pi));
  return hertz;
}

Rest rest(const Scene& s) {
  Rest r{body(s, s.statics->body), {}};
  r.report = solve_case(s, r.body);
  return r;
}

Eigen::Vector3d Rest::moved(const std::string& point) const {
  for (const PortDisplacement& p : report.ports)
    if (p.name == point) return p.u;
  throw std::runtime_error("no point " + point);
}

Eigen::Vector4d Rest::stress_at(const Eigen::Vector2d& place) const {
  const double size = (body.mesh.x.rowwise().maxCoeff() - body.mesh.x.rowwise().minCoeff()).norm();
  return report.stress.nodal.col(nearest_node(body.mesh, place, 1e-3 * size));
}

}  // namespace verification
