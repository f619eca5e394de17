#include <algorithm>

#include "framework/component/loads.h"
#include "framework/run/elastic_parts.h"
#include "framework/run/in_body.h"
#include "framework/scene/nearest.h"

namespace pintle {

using Eigen::Vector2d;

std::vector<NamedSupport> supports_of(const Scene& scene, const ElasticBody& e) {
  std::vector<NamedSupport> all;
  for (const SceneSupport& s : e.scene->elastic->supports) {
    const Port* port = e.model.port(s.at);
    for (const ScenePoint& p : e.scene->points)
      if (!port && p.hole == s.at) port = e.model.port(p.name);
    if (port && s.rotation && !(s.x && s.y) && port->freedom[2] < 0)
      throw SceneError(scene.file, s.place, "\"" + s.at + "\" is a point of a plate, which has no rotation of its own; hold a hole or an edge");
    Supports& supports = all.emplace_back(NamedSupport{s.at, {}}).held;
    in_body(scene, *e.scene, [&] {
      if (port) return hold(supports, e.model, *port, s.x, s.y, s.rotation && port->freedom[2] >= 0);
      std::vector<std::string> known = group_names(e.mesh);
      for (const Port& p : e.model.ports) known.push_back(p.name);
      const Group* group = e.mesh.group(s.at);
      if (!group) throw SceneError(scene.file, s.place, "there is neither a point nor a group \"" + s.at + "\"." + did_you_mean(s.at, known));
      for (const int node : group->nodes) hold(supports, e.model, node, s.x, s.y, s.rotation && !e.plate());
    });
  }
  return all;
}

Supports together(const std::vector<NamedSupport>& all) {
  Supports out;
  for (const NamedSupport& s : all) out.freedoms.insert(out.freedoms.end(), s.held.freedoms.begin(), s.held.freedoms.end());
  std::sort(out.freedoms.begin(), out.freedoms.end());
  out.freedoms.erase(std::unique(out.freedoms.begin(), out.freedoms.end()), out.freedoms.end());
  return out;
}

Eigen::VectorXd loads_of(const Scene& scene, const ElasticBody& e) {
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(e.model.N()), direct = Eigen::VectorXd::Zero(e.model.n());
  using Kind = SceneStaticLoad::Kind;
  for (const SceneStaticLoad& l : scene.statics->loads) {
    const Vector2d v = vector(l.vector);
    const Port* port = l.at.empty() ? nullptr : e.model.port(l.at);
    if ((l.kind == Kind::force || l.kind == Kind::torque || (l.kind == Kind::spin && !l.at.empty())) && !port)
      point_of(scene, *e.scene, l.at, l.place);  // says which there are
    const auto sides = [&] {
      if (!e.plate()) throw SceneError(scene.file, l.place, "a beam has no edge; use a line load, or a force at a point");
      return sides_of(e.mesh, group_of(scene, e.mesh, l.at, l.place, "name the curve in the drawing"));
    };
    switch (l.kind) {
      case Kind::force: add_force(direct, *port, v, 0); break;
      case Kind::torque:
        if (port->freedom[2] < 0) throw SceneError(scene.file, l.place, "\"" + l.at + "\" is a point of a plate and cannot take a torque; load a hole with a coupling");
        add_force(direct, *port, Vector2d::Zero(), l.value);
        break;
      case Kind::traction: nodal += traction_load(e.model, sides(), v, e.thickness); break;
      case Kind::pressure: nodal += pressure_load(e.model, sides(), l.value, e.thickness); break;
      case Kind::line:
        if (e.plate()) throw SceneError(scene.file, l.place, "a plate takes no line load; use traction or pressure on an edge");
        nodal += line_load(e.model, v);
        break;
      case Kind::acceleration: nodal += acceleration_load(e.model, e.M, v); break;
      case Kind::spin: nodal += spin_load(e.model, e.M, l.value, port ? port->x : Vector2d(0, 0)); break;
    }
  }
  return direct + independent_load(e.model, nodal);
}

}  // namespace pintle
