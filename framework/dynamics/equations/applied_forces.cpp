#include "framework/common/index.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/equations/laws.h"
#include "framework/dynamics/equations/meshing.h"
#include "framework/dynamics/equations/sticking.h"

namespace pintle {

using Eigen::Vector2d;
using Eigen::VectorXd;
using Index = Eigen::Index;

namespace {

// Rigid bodies only; flexible bodies are handled by add_forces.
void add_weight(const System& system, Equations& eq) {
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    if (eq.flexible_of[b] >= 0) continue;
    const auto i = static_cast<Index>(3 * b);
    eq.f[i] = system.bodies[b].m * system.gravity.x();
    eq.f[i + 1] = system.bodies[b].m * system.gravity.y();
  }
}

}  // namespace

void add_wrench(const System& system, const Equations& eq, int marker, const Wrench& w, VectorXd& v) {
  const int body = system.markers[at(marker)].body;
  if (body == ground) return;
  const Vector2d& d = eq.motion[at(marker)].d;
  v[3 * body] += w[0];
  v[3 * body + 1] += w[1];
  v[3 * body + 2] += w[2] + d.x() * w[1] - d.y() * w[0];
  const Eigen::Matrix2Xd& flex = eq.motion[at(marker)].flex;
  if (const Index n = flex.cols(); n > 0) {
    const Eigen::RowVectorXd& slope = system.markers[at(marker)].slope;
    v.segment(system.eta_begin[at(body)], n) += (w[0] * flex.row(0) + w[1] * flex.row(1) + w[2] * slope).transpose();
  }
}

void apply_forces(const System& system, const State& state, Equations& eq) {
  eq.f.setZero();
  if (has_gravity(system)) add_weight(system, eq);
  for (FlexibleInertia& body : eq.flexible) add_forces(system, state.y, body, eq.f);
  const double* x = state.y.data() + system.x_begin();
  if (!system.laws.empty()) evaluate_laws(system, state.t, x, eq);
  for (std::size_t i = 0; i < system.forces.size(); ++i) {
    if (is_released(system, Switch::force, static_cast<int>(i), state.y)) {
      eq.force[i] = {};
      continue;
    }
    const int ma = marker_a(system.forces[i]), mb = marker_b(system.forces[i]);
    eq.force[i] = evaluate(system.forces[i], eq.motion[at(ma)], eq.motion[at(mb)], state.t, x + system.force_x[i], eq.laws.data());
    add_wrench(system, eq, ma, eq.force[i].on_a, eq.f);
    add_wrench(system, eq, mb, eq.force[i].on_b, eq.f);
  }
  if (!eq.friction.empty()) add_joint_friction(system, state, eq);
  for (std::size_t i = 0; i < system.contacts.size(); ++i) {
    const ContactPair& pair = system.contacts[i];
    const MarkerMotion &a = eq.motion[at(pair.a)], &b = eq.motion[at(pair.b)];
    const DryFriction dry = state.friction.empty() ? DryFriction{} : state.friction[i];
    eq.contact[i] = pair.flank ? evaluate(pair, a, in_its_gap(system, pair, static_cast<int>(i), state.y, b), state.impact_rate[i], dry)
                               : evaluate(pair, a, b, state.impact_rate[i], dry, x + system.contact_x[i]);
    if (eq.contact[i].normal.force == 0 && eq.contact[i].friction == 0) continue;
    add_wrench(system, eq, pair.a, eq.contact[i].on_a, eq.f);
    add_wrench(system, eq, pair.b, eq.contact[i].on_b, eq.f);
  }
}

ContactEffect clearance_effect(const System& system, const Equations& eq, std::size_t c) {
  ContactEffect out = eq.contact[c];
  if (!is_held(system.contacts[c])) return out;
  const double N = eq.lambda[system.row_begin[at(system.contacts[c].link)]];
  out.normal.force = N;
  out.on_a << -N * out.gap.n, 0;
  out.on_b << N * out.gap.n, 0;
  return out;
}

}  // namespace pintle
