#include <algorithm>
#include <functional>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/common/nearest.h"
#include "framework/component/fe/loads.h"

namespace pintle {

using Eigen::Vector2d;

std::vector<NamedSupport> supports_of(const Scene& scene, const ElasticBody& e) {
  std::vector<NamedSupport> all;
  for (const SceneSupport& s : e.scene->elastic->supports) {
    const Port* port = e.model.port(s.at);
    for (const ScenePoint& p : e.scene->points)
      if (!port && p.hole == s.at) port = e.model.port(p.name);
    if (port && s.rotation && !(s.x && s.y) && port->dof[2] < 0)
      throw SceneError(scene.file, s.place, "\"" + s.at + "\" is a point of a plate, which has no rotation; hold a hole or an edge");
    Supports& supports = all.emplace_back(NamedSupport{s.at, {}}).held;
    in_body(scene, *e.scene, [&] {
      if (port) return hold(supports, e.model, *port, s.x, s.y, s.rotation && port->dof[2] >= 0);
      std::vector<std::string> known = group_names(e.mesh);
      for (const Port& p : e.model.ports) known.push_back(p.name);
      const Group* group = e.mesh.group(s.at);
      if (!group)
        throw SceneError(scene.file, s.place, "there is neither a point nor a group \"" + s.at + "\"." + did_you_mean(s.at, known));
      for (const int node : group->nodes) hold(supports, e.model, node, s.x, s.y, s.rotation && !e.plate());
    });
  }
  return all;
}

Supports together(const std::vector<NamedSupport>& all) {
  Supports out;
  for (const NamedSupport& s : all) out.dofs.insert(out.dofs.end(), s.held.dofs.begin(), s.held.dofs.end());
  std::sort(out.dofs.begin(), out.dofs.end());
  out.dofs.erase(std::unique(out.dofs.begin(), out.dofs.end()), out.dofs.end());
  return out;
}

namespace {

/// M_e · field at each line element plus the share of a line load q, 6 × elements.
Eigen::MatrixXd beam_loads(const FeModel& model, const std::function<Vector2d(const Vector2d&)>& field, const Vector2d& q) {
  Eigen::MatrixXd out;
  std::visit(
      [&](const auto& block) {
        using E = std::decay_t<decltype(block.properties.front())>;
        if constexpr (is_line<E>) {
          constexpr int d = E::dofs_per_node;
          out = Eigen::MatrixXd::Zero(6, block.size());
          for (int i = 0; i < block.size(); ++i) {
            const Coords<E> x = block.coords(i, model.x);
            NodalVector<E> a = NodalVector<E>::Zero();
            for (int k = 0; k < 2; ++k) a.template segment<2>(k * d) = field(x.col(k));
            const NodalVector<E> p = mass(block.element(i), x) * a + line_load(block.element(i), x, q);
            for (int k = 0; k < 2; ++k) out.template block<d, 1>(3 * k, i) = p.template segment<d>(k * d);
          }
        }
      },
      model.blocks.front());
  return out;
}

}  // namespace

BodyLoad loads_of(const Scene& scene, const ElasticBody& e) {
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(e.model.N()), direct = Eigen::VectorXd::Zero(e.model.n());
  Eigen::MatrixXd on_beams = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(e.plate() ? 0 : e.mesh.cell_count()));
  const auto nowhere = [](const Vector2d&) -> Vector2d { return {0, 0}; };
  const auto felt = [&](Eigen::VectorXd load, const SceneStaticLoad& l) {
    if (load.norm() > 0 && independent_load(e.model, load).norm() < 1e-9 * load.norm())
      throw SceneError(scene.file, l.place,
                       "\"" + l.at +
                           "\" is the rim of a rigid coupling, which carries the whole load without deforming; write coupling: average at "
                           "its point, or leave the point out");
    return load;
  };
  using Kind = SceneStaticLoad::Kind;
  for (const SceneStaticLoad& l : scene.statics->loads) {
    const bool of_several = !scene.statics->contacts.empty();
    if ((of_several || !l.body.empty()) && scene.statics->loaded(l) != e.scene->name) continue;
    Vector2d v = vector(l.vector);
    const Port* port = l.at.empty() ? nullptr : e.model.port(l.at);
    if ((l.kind == Kind::force || l.kind == Kind::torque || (l.kind == Kind::spin && !l.at.empty())) && !port)
      point_of(scene, *e.scene, l.at, l.place);  // reports the existing ones
    const auto sides = [&] {
      if (!e.plate()) throw SceneError(scene.file, l.place, "a beam has no edge; use a line load, or a force at a point");
      return sides_of(e.mesh, group_of(scene, e.mesh, l.at, l.place, "name the curve in the drawing"));
    };
    switch (l.kind) {
      case Kind::force: add_force(direct, *port, v, 0); break;
      case Kind::torque:
        if (port->dof[2] < 0)
          throw SceneError(scene.file, l.place,
                           "\"" + l.at + "\" is a point of a plate and cannot take a torque; load a hole with a coupling");
        add_force(direct, *port, Vector2d::Zero(), l.value);
        break;
      case Kind::traction: nodal += felt(traction_load(e.model, sides(), v, e.thickness), l); break;
      case Kind::pressure: nodal += felt(pressure_load(e.model, sides(), l.value, e.thickness), l); break;
      case Kind::line:
        if (e.plate()) throw SceneError(scene.file, l.place, "a plate cannot have a line load; use traction or pressure on an edge");
        nodal += line_load(e.model, v);
        on_beams += beam_loads(e.model, nowhere, v);
        break;
      case Kind::acceleration:
        nodal += acceleration_load(e.model, e.M, v);
        if (!e.plate()) on_beams += beam_loads(e.model, [&](const Vector2d&) { return v; }, {0, 0});
        break;
      case Kind::spin: {
        const Vector2d about = port ? port->x : Vector2d(0, 0);
        nodal += spin_load(e.model, e.M, l.value, about);
        if (!e.plate())
          on_beams += beam_loads(e.model, [&](const Vector2d& x) -> Vector2d { return l.value * l.value * (x - about); }, {0, 0});
        break;
      }
    }
  }
  return {direct + independent_load(e.model, nodal), on_beams};
}

}  // namespace pintle
