#include "framework/bodies/attachments.h"

#include <Eigen/Geometry>

#include "framework/bodies/modal_basis.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

using Eigen::Index;

Wrench wrench(const System& system, const Equations& eq, const Attachment& g) {
  if (g.of == Attachment::contact) {
    const auto on = [&](const ContactEffect& now) -> const Wrench& { return g.end == 0 ? now.on_a : now.on_b; };
    const ContactPair& pair = system.contacts[g.k];
    if (!pair.profiles) return on(clearance_effect(system, eq, g.k));
    Wrench out = Wrench::Zero();
    for (int i = 0; i < pair.pairs; ++i) out += on(eq.contact[g.k + static_cast<std::size_t>(i)]);
    return out;
  }
  if (g.of == Attachment::force) return g.end == 0 ? eq.force[g.k].on_a : eq.force[g.k].on_b;
  return reaction(system, eq, g.k, g.end);
}

}  // namespace

std::vector<Attachment> attachments_of(const Scene& scene, const BuiltOrder& order, const std::vector<const ElasticBody*>& elements) {
  std::vector<Attachment> all;
  const auto add = [&](Attachment::Of of, int k, std::size_t end, const PointRef& ref) {
    for (std::size_t b = 0; b < elements.size(); ++b) {
      if (scene.bodies[b].name != ref.body || !elements[b]) continue;
      if (const int port = port_of(*elements[b], ref.point); port >= 0)
        all.push_back({of, static_cast<std::size_t>(k), end, b, inertia_loads + 3 * Index{port}});
    }
  };
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const SceneJoint& j = scene.joints[i];
    if (j.clearance) {
      const bool a_bears = j.clearance->bearing != j.b.body;
      add(Attachment::contact, order.joints[i], a_bears ? 1 : 0, j.a);
      add(Attachment::contact, order.joints[i], a_bears ? 0 : 1, j.b);
    } else {
      const Attachment::Of of = j.play ? Attachment::contact : Attachment::joint;
      std::size_t end = 0;
      for (const PointRef* point : points_of(j)) add(of, order.joints[i], end++, *point);
    }
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    add(Attachment::contact, order.contacts[i], 0, carrier_of(scene, scene.contacts[i].a));
    add(Attachment::contact, order.contacts[i], 1, carrier_of(scene, scene.contacts[i].b));
  }
  for (std::size_t i = 0; i < scene.drivers.size(); ++i) {
    add(Attachment::joint, order.drivers[i], 0, scene.drivers[i].a);
    add(Attachment::joint, order.drivers[i], 1, scene.drivers[i].b);
  }
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    std::visit(
        [&](const auto& what) {
          if constexpr (requires { what.at; }) {
            add(Attachment::force, order.loads[i], 1, what.at);
          } else if constexpr (requires { what.pulleys; }) {
            int span = order.loads[i];
            for (std::size_t k = 0; k < what.pulleys.size(); ++k, ++span) {
              add(Attachment::force, span, 0, what.pulleys[k]);
              add(Attachment::force, span, 1, what.pulleys[(k + 1) % what.pulleys.size()]);
            }
          } else {
            add(Attachment::force, order.loads[i], 0, what.a);
            add(Attachment::force, order.loads[i], 1, what.b);
          }
        },
        scene.loads[i].what);
  return all;
}

void loads_now(const System& system, const std::vector<Attachment>& attachments, const State& state, const Equations& eq, std::size_t b,
               Eigen::Ref<Eigen::VectorXd> out) {
  const Index i = 3 * static_cast<Index>(b);
  const Eigen::Rotation2Dd to_body(-state.y[i + 2]);
  const double spin = state.y[system.n() + i + 2];
  out.setZero();
  out.head<2>() = to_body * (system.gravity - eq.a.segment<2>(i));
  out[2] = -eq.a[i + 2];
  out[3] = spin * spin;
  for (const Attachment& g : attachments) {
    if (g.body != b) continue;
    const Wrench w = wrench(system, eq, g);
    out.segment<2>(g.row) += to_body * w.head<2>();
    out[g.row + 2] += w[2];
  }
}

}  // namespace pintle
