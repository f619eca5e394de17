#include "framework/configuration/rest.h"

#include <algorithm>
#include <cmath>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/equations/jacobian.h"
#include "framework/dynamics/model/reach.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Replaces the rates of kept states by ones that return them to the given values.
void keep(System& held, const KeptStates& kept) {
  for (const int i : kept.which) {
    held.signals.push_back({MotionSignal::state, i});
    held.laws.push_back({[at = kept.at, i](double, const double* in, double* slope) {
                           if (slope) slope[0] = -1;
                           return (*at)[i] - in[0];
                         },
                         {static_cast<int>(held.signals.size()) - 1}});
    held.states[at(i)].rate = static_cast<int>(held.laws.size()) - 1;
  }
}

System held_at(const System& system, double t, const KeptStates& kept) {
  System out = system;
  hold_drivers(system, t, out);
  keep(out, kept);
  return out;
}

}  // namespace

void hold_drivers(const System& from, double t, System& held) {
  for (std::size_t k = 0; k < from.joints.size(); ++k)
    if (const TimeLaw* law = driver_law(from.joints[k]))
      *driver_law(held.joints[k]) = [x = (*law)(t).value](double) { return Jet{x, 0, 0}; };
}

bool has_potential(const System& system) {
  return std::none_of(system.forces.begin(), system.forces.end(),
                      [](const Force& f) { return turns_with_b(f) || std::holds_alternative<SizedForce>(f); });
}

Rest::Rest(const System& system, double t, const KeptStates& kept)
    : held(held_at(system, t, kept)), eq(held), tangent(held), kkt(held, eq, tangent), values(tangent.places().size()), t_(t) {
  double span = 0;
  for (double r : reaches(system)) span += 2 * r;
  span_ = std::max(span / system.length, 1.0);
}

bool Rest::project(State& state, double farthest) {
  const VectorXd before = state.y.head(held.n());
  state.t = t_;
  stop(state);
  state.impact_rate.resize(held.contacts.size());
  if (!pintle::project(held, t_, state.y, eq) || !(size(state.y.head(held.n()) - before) <= farthest)) return false;
  stop(state);
  for (std::size_t c = 0; c < held.contacts.size(); ++c) {
    const ContactPair& pair = held.contacts[c];
    state.impact_rate[c] = !pair.profiles || onset_of(held, static_cast<int>(c), state).value > 0 ? pair.slowest_impact : 0;
  }
  speed(held, t_, state.y, eq);
  follow_internal_states(held, eq, state, internal_at_rest, nullptr, state.y.data() + held.x_begin());
  accelerate(held, state, eq);
  out_of_balance = eq.f;
  add_reaction(eq, -eq.lambda, out_of_balance);
  potential = potential_of(state, magnitude_);
  return eq.a.allFinite() && std::isfinite(potential);
}

double Rest::size(const VectorXd& d) const {
  double out = 0;
  for (Index i = 0; i < d.size(); ++i) {
    const bool place = i < held.n_rigid() && i % 3 < 2;
    out = std::max(out, std::abs(d[i]) / (held.scale[i] * (place ? span_ : 1)));
  }
  return out;
}

double Rest::residual() const {
  const double worst = out_of_balance.cwiseProduct(held.scale).lpNorm<Eigen::Infinity>(), most = at_work();
  return worst == 0 ? 0 : worst / std::max(most, 1e-300);
}

double Rest::unrest() const { return std::sqrt(std::max(out_of_balance.dot(eq.a), 0.0)); }

void Rest::stop(State& state) const { state.y.segment(held.n(), held.switch_begin() - held.n()).setZero(); }

double Rest::potential_of(const State& state, double& magnitude) const {
  const Energies e = energies(held, state, eq);
  double sum = e.gravity + e.springs + e.contacts + e.strain;
  magnitude = std::abs(e.gravity) + e.springs + e.contacts + e.strain;
  for (const Force& f : held.forces) {
    double work = 0;
    if (const auto* force = std::get_if<PointForce>(&f); force && !force->follows)
      work = eq.motion[at(force->b)].r.dot(Eigen::Vector2d(force->x(t_).value, force->y(t_).value));
    else if (const auto* torque = std::get_if<Torque>(&f))
      work = torque->law(t_).value * (eq.motion[at(torque->b)].angle - eq.motion[at(torque->a)].angle);
    sum -= work;
    magnitude += std::abs(work);
  }
  return sum;
}

double Rest::at_work() const {
  double most = 0;
  for (const Body& b : held.bodies) most = std::max(most, b.m * held.gravity.norm() * held.length);
  const auto see = [&](const Wrench& w) { most = std::max({most, w.head<2>().norm() * held.length, std::abs(w[2])}); };
  for (const ForceEffect& f : eq.force) see(f.on_b);
  for (const ContactEffect& c : eq.contact) see(c.on_a);
  if (eq.lambda.size() > 0) most = std::max(most, eq.lambda.cwiseQuotient(held.row_scale).lpNorm<Eigen::Infinity>());
  return most;
}

MatrixXd open_directions(const System& system, const Equations& eq) {
  if (system.n_rows() == 0) return MatrixXd::Identity(system.n(), system.n());
  const MatrixXd rows = system.row_scale.asDiagonal() * dense_jacobian(system, eq) * system.scale.asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(rows.transpose());
  qr.setThreshold(1e-9);
  const Index open = system.n() - qr.rank();
  MatrixXd Z = MatrixXd::Zero(system.n(), open);
  if (open == 0) return Z;
  Z.bottomRows(open).setIdentity();
  return qr.householderQ() * Z;
}

}  // namespace pintle
