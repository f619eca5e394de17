#include "framework/configuration/ideal_pin.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/integration/integrator.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// Clearances without constraint rows; no force acts in them before they close.
System opened(const System& system) {
  System out = system;
  for (std::size_t k = out.joints.size(); k-- > 0;)
    if (is_link(system, static_cast<int>(k))) {
      forget_switch(out, Switch::joint, static_cast<int>(k));
      out.joints.erase(out.joints.begin() + static_cast<std::ptrdiff_t>(k));
      out.joint_names.erase(out.joint_names.begin() + static_cast<std::ptrdiff_t>(k));
    }
  for (ContactPair& c : out.contacts) c.link = -1;
  number(out);
  return out;
}

/// Clearances replaced by ideal pins, added after all other joints; profiles have no contact.
System pinned(const System& open) {
  System out = open;
  for (std::size_t c = 0; c < at(n_clearances(open)); ++c) {
    out.joints.emplace_back(Revolute{open.contacts[c].b, open.contacts[c].a});
    out.joint_names.push_back(open.contact_names[c]);
  }
  out.contacts.clear();
  out.contact_names.clear();
  std::erase_if(out.switches, [](const Switch& s) { return s.of == Switch::contact; });
  number(out);
  return out;
}

State state_of(const System& system, const VectorXd& y) {
  State state;
  state.y.setZero(system.n_y());
  state.y.head(2 * system.n()) = y.head(2 * system.n());
  begin_switches(system, state.y);
  relax_internal_states(system, 0, state.y);
  state.impact_rate.assign(system.contacts.size(), 0.0);
  return state;
}

/// Forces of each journal on its bearing, from the multipliers of the pins.
std::vector<Vector2d> pressing(const System& pins, const Equations& eq, std::size_t count) {
  std::vector<Vector2d> out;
  for (std::size_t c = 0; c < count; ++c) out.emplace_back(eq.lambda.segment<2>(pins.row_begin[pins.joints.size() - count + c]));
  return out;
}

/// The same in a state; zeros where the configuration is singular or the forces are rounding.
std::vector<Vector2d> pressing_at(const System& open, const VectorXd& y) {
  constexpr double rounding = 1e-12;
  const System pins = pinned(open);
  Equations eq(pins);
  VectorXd dy = VectorXd::Zero(pins.n_y());
  std::vector<Vector2d> out(at(n_clearances(open)), Vector2d::Zero());
  if (!evaluate(pins, state_of(pins, y), eq, dy)) return out;
  const double most = eq.f.lpNorm<Eigen::Infinity>() + eq.lambda.lpNorm<Eigen::Infinity>();
  const std::vector<Vector2d> found = pressing(pins, eq, out.size());
  for (std::size_t c = 0; c < out.size(); ++c)
    if (found[c].norm() > rounding * most) out[c] = found[c];
  return out;
}

/// Root mean square over a run with ideal joints; over a part of the run if it takes many steps.
std::vector<double> mean_forces(const Scene& scene, const System& open, const VectorXd& y) {
  constexpr long most_steps = 2000;
  const System pins = pinned(open);
  const std::size_t count = at(n_clearances(open));
  Scheme scheme;
  scheme.tableau = find_tableau("dopri5");
  scheme.tolerance = 1e-4;
  scheme.max_step = scene.run.until / 200;
  std::vector<double> sum(count, 0.0), before(count, 0.0);
  Integrator integrator(pins, scheme, state_of(pins, y));
  double t = 0;
  for (long i = 0; integrator.failure().empty(); ++i) {
    const std::vector<Vector2d> now = pressing(pins, integrator.equations(), count);
    const double h = integrator.state().t - t;
    for (std::size_t c = 0; c < count; ++c) {
      sum[c] += h / 2 * (before[c] + now[c].squaredNorm());
      before[c] = now[c].squaredNorm();
    }
    t += h;
    if (i == most_steps || t >= scene.run.until || !integrator.advance(scene.run.until)) break;
  }
  for (double& s : sum) s = t > 0 && std::isfinite(s) ? std::sqrt(s / t) : 0;
  return sum;
}

/// Acceleration of a marker due to the bodies' accelerations alone.
Vector2d moved(const System& system, const Equations& eq, int marker) {
  Vector2d out = Vector2d::Zero();
  visit_motion(system, eq, marker, [&](int column, const Eigen::Vector3d& dp) { out += eq.a[column] * dp.head<2>(); });
  return out;
}

/// Effective mass for a pair of forces along n on journal and bearing, in the configuration y at rest.
double mass_against(const System& open, const VectorXd& y, const ContactPair& pair, const Vector2d& n) {
  System probe = open;
  probe.gravity.setZero();
  probe.contacts.clear();
  probe.contact_names.clear();
  probe.forces.clear();
  std::erase_if(probe.switches, [](const Switch& s) { return s.of != Switch::joint; });
  const auto push = [&](int marker, const Vector2d& f) {
    const auto law = [](double value) { return [value](double) { return Jet{value, 0, 0}; }; };
    probe.forces.emplace_back(PointForce{marker, marker, law(f.x()), law(f.y())});
  };
  double apart[] = {0, 0};
  for (const double size : {0.0, 1.0}) {  // both contain the effect of drivers
    probe.forces.clear();
    push(pair.a, size * n);
    push(pair.b, -size * n);
    number(probe);
    State state = state_of(probe, y);
    state.y.segment(probe.n(), probe.switch_begin() - probe.n()).setZero();
    Equations eq(probe);
    VectorXd dy = VectorXd::Zero(probe.n_y());
    if (!evaluate(probe, state, eq, dy)) return 0;
    apart[size > 0] = n.dot(moved(probe, eq, pair.a) - moved(probe, eq, pair.b));
  }
  return 1 / (apart[1] - apart[0]);
}

}  // namespace

std::vector<Vector2d> pressed_directions(const Scene& scene, const System& system) {
  std::vector<Vector2d> out(at(n_clearances(system)), Vector2d::Zero());
  if (std::none_of(system.contacts.begin(), system.contacts.end(), [](const ContactPair& c) { return is_held(c); })) return out;
  const System open = opened(system);
  out = pressing_at(open, assemble(scene, open).start.y);
  const Vector2d other = system.gravity.isZero() ? Vector2d::UnitX() : Vector2d(system.gravity.normalized());
  for (Vector2d& n : out) n = n.isZero() ? other : Vector2d(n.normalized());
  return out;
}

std::vector<IdealPin> ideal_pins(const Scene& scene, const System& system) {
  const System open = opened(system);
  const VectorXd y = assemble(scene, open).start.y;
  const std::vector<Vector2d> at_start = pressing_at(open, y);
  const std::vector<double> mean = scene.has_run ? mean_forces(scene, open, y) : std::vector<double>(at_start.size(), 0.0);
  std::vector<IdealPin> out;
  for (std::size_t c = 0; c < at_start.size(); ++c) {
    const Vector2d n = at_start[c].isZero() ? Vector2d::UnitX() : Vector2d(at_start[c].normalized());
    const double mass = mass_against(open, y, open.contacts[c], n);
    out.push_back(
        {mean[c] > 0 ? mean[c] : at_start[c].norm(), mass > 0 && std::isfinite(mass) ? mass : 1 / lightness(open, open.contacts[c])});
  }
  return out;
}

}  // namespace pintle
