#include "framework/configuration/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/equations/laws.h"
#include "framework/dynamics/newton/kkt.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

namespace {

using Eigen::VectorXd;
using Index = Eigen::Index;

/// Drivers held where their laws are at t.
void hold_drivers(const System& from, double t, System& held) {
  for (std::size_t k = 0; k < from.joints.size(); ++k)
    if (const TimeLaw* law = driver_law(from.joints[k]))
      *driver_law(held.joints[k]) = [x = (*law)(t).value](double) { return Jet{x, 0, 0}; };
}

bool has_potential(const System& system) {
  return std::none_of(system.forces.begin(), system.forces.end(),
                      [](const Force& f) { return turns_with_b(f) || std::holds_alternative<SizedForce>(f); });
}

/// What is asked of a mechanism at rest in a pose: the forces out of balance, the potential energy.
class Rest {
 public:
  Rest(const System& system, double t)
      : held(system), eq(held), tangent(held), kkt(held, eq, tangent), values(tangent.places().size()), t_(t) {
    hold_drivers(system, t, held);
    double span = 0;
    std::vector<double> reach(system.bodies.size(), 0.0);
    for (const Marker& m : system.markers)
      if (m.body != ground) reach[at(m.body)] = std::max(reach[at(m.body)], m.x_BP.norm());
    for (double r : reach) span += 2 * r;
    span_ = std::max(span / system.length, 1.0);
  }

  /// Brings the pose onto the joints and evaluates everything there.
  /// @returns false if it cannot be, or only by a leap
  bool settle(State& state, double farthest) {
    const VectorXd before = state.y.head(held.n());
    state.t = t_;
    stop(state);
    state.impact_rate.resize(held.contacts.size());
    if (!project(held, t_, state.y, eq) || !(size(state.y.head(held.n()) - before) <= farthest)) return false;
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

  /// Largest coordinate of a displacement, over the mechanism's extent, angles as they are.
  double size(const VectorXd& d) const {
    double out = 0;
    for (Index i = 0; i < d.size(); ++i) {
      const bool place = i < held.n_rigid() && i % 3 < 2;
      out = std::max(out, std::abs(d[i]) / (held.scale[i] * (place ? span_ : 1)));
    }
    return out;
  }
  /// Greatest force or couple left over the greatest at work.
  double residual() const {
    const double worst = out_of_balance.cwiseProduct(held.scale).lpNorm<Eigen::Infinity>(), most = at_work();
    return worst == 0 ? 0 : worst / std::max(most, 1e-300);
  }
  /// The same at the metric of M⁻¹: what the flow lowers.
  double unrest() const { return std::sqrt(std::max(out_of_balance.dot(eq.a), 0.0)); }
  double rounding() const { return 1e-14 * magnitude_; }  ///< of the potential energy

  System held;  ///< the mechanism with its drivers held
  Equations eq;
  Tangent tangent;
  Kkt kkt;
  std::vector<double> values;
  VectorXd out_of_balance;
  double potential = 0;

 private:
  void stop(State& state) const { state.y.segment(held.n(), held.switch_begin() - held.n()).setZero(); }
  double potential_of(const State& state, double& magnitude) const {
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
  double at_work() const {
    double most = 0;
    for (const Body& b : held.bodies) most = std::max(most, b.m * held.gravity.norm() * held.length);
    const auto see = [&](const Wrench& w) { most = std::max({most, w.head<2>().norm() * held.length, std::abs(w[2])}); };
    for (const ForceEffect& f : eq.force) see(f.on_b);
    for (const ContactEffect& c : eq.contact) see(c.on_a);
    if (eq.lambda.size() > 0) most = std::max(most, eq.lambda.cwiseQuotient(held.row_scale).lpNorm<Eigen::Infinity>());
    return most;
  }

  double t_, span_ = 1, magnitude_ = 0;
};

/// Step by step from the start to the equilibrium, or to where it ends.
class Search {
 public:
  Search(Rest& rest, State start) : rest_(rest), state_(std::move(start)), start_(state_.y.head(rest.held.n())) {}

  bool descend() { return go(true, 3000); }  ///< along the potential
  bool flow() { return go(false, 6000); }    ///< where there is none, or it does not help
  bool damped() const { return damped_; }
  int iterations() const { return iterations_; }
  bool runs_away() const { return runs_away_; }
  State& state() { return state_; }
  void push(const VectorXd& direction) {
    State pushed = state_;
    pushed.y.head(direction.size()) += direction;
    if (rest_.settle(pushed, 1)) state_ = pushed;
  }

 private:
  static constexpr double balanced = 1e-12, nearly = 1e-7;

  bool go(bool by_potential, int most) {
    double best = 1e300, sigma = by_potential ? 0 : gentle();
    State calmest = state_;
    int idle = 0;
    trust_ = 0.3;
    for (int i = 0; i < most; ++i, ++iterations_) {
      const double residual = rest_.residual();
      if (residual <= balanced) return true;
      idle = residual < 0.5 * best ? 0 : idle + 1;
      if (residual < best) best = residual, calmest = state_;
      if (best <= nearly && idle > 12) {  // rounding lets it fall no further
        state_ = calmest;
        rest_.settle(state_, 1);
        return true;
      }
      if (far_away()) return false;
      const double unrest = rest_.unrest();
      if (!step(by_potential, sigma)) {
        sigma = std::max(10 * sigma, gentle());
        if (sigma > 1e18 * (1 + gentle())) return residual <= nearly;
        continue;
      }
      if (sigma > 0) damped_ = true;
      sigma = by_potential ? sigma / 10 : sigma * std::clamp(rest_.unrest() / unrest, 0.1, 2.0);
      if (sigma < 1e-9 * gentle()) sigma = 0;
    }
    return rest_.residual() <= nearly;
  }

  /// σ with which the accelerations of rest move the mechanism by a tenth of its size.
  double gentle() const { return std::max(rest_.size(rest_.eq.a) / 0.1, 1e-12); }

  // d of [K + σM, Cqᵀ; Cq, 0] [d; ·] = [forces out of balance; 0], shortened until it does what it should.
  bool step(bool by_potential, double sigma) {
    const System& held = rest_.held;
    rest_.tangent.evaluate(held, state_, rest_.eq, VectorXd::Zero(held.n()), rest_.eq.lambda,
                           {.q = 1, .s = 0, .a = sigma, .x = internal_at_rest}, rest_.values);
    if (!rest_.kkt.factor(held, rest_.eq, rest_.values)) return false;
    VectorXd d = rest_.out_of_balance, y = VectorXd::Zero(held.n_rows());
    const double before = rest_.potential, unrest = rest_.unrest(), rounding = rest_.rounding();
    rest_.kkt.solve(d, y);
    if (!d.allFinite()) return false;
    if (by_potential && rest_.out_of_balance.dot(d) < 0) return false;
    if (const double reach = rest_.size(d); reach > trust_) d *= trust_ / reach;
    const double fall = rest_.out_of_balance.dot(d);
    double share = 1;
    for (int tries = 0; tries < 4; ++tries, share /= 4) {
      State trial = state_;
      trial.y.head(held.n()) += share * d;
      if (!rest_.settle(trial, 0.5 * share * rest_.size(d) + 1e-9)) continue;
      const bool lower = rest_.potential <= before - 1e-4 * share * fall + rounding;
      const bool calmer = rest_.unrest() <= (by_potential ? 0.9 : 1.5) * unrest;
      if (by_potential ? lower || (calmer && rest_.potential <= before + 10 * rounding) : calmer) {
        state_ = trial;
        trust_ = share == 1 ? std::min(2 * trust_, 1.0) : std::max(trust_ * share, 1e-6);
        return true;
      }
    }
    trust_ = std::max(trust_ / 2, 1e-6);
    State back = state_;
    rest_.settle(back, 1);
    return false;
  }

  bool far_away() {
    const VectorXd moved = state_.y.head(rest_.held.n()) - start_;
    const double farthest = 1e3 * rest_.held.length * static_cast<double>(rest_.held.bodies.size()), most_turned = 40 * std::numbers::pi;
    for (Index i = 0; i < rest_.held.n_rigid(); ++i) runs_away_ = runs_away_ || std::abs(moved[i]) > (i % 3 == 2 ? most_turned : farthest);
    return runs_away_;
  }

  Rest& rest_;
  State state_;
  VectorXd start_;
  double trust_ = 0.3;
  int iterations_ = 0;
  bool damped_ = false, runs_away_ = false;
};

// From the pose at t = 0 along the drivers to t, in steps small enough to stay on the branch.
bool lead(const System& system, double to, State& state, double& reached) {
  System held = system;
  Equations eq(system);
  double step = to / 64;
  for (reached = 0; std::abs(reached) < std::abs(to);) {
    const double next = std::abs(to - reached) <= std::abs(step) ? to : reached + step;
    hold_drivers(system, next, held);
    VectorXd y = state.y;
    const bool closed = project(held, next, y, eq);
    if (closed && ((y - state.y).head(held.n()).cwiseQuotient(held.scale)).lpNorm<Eigen::Infinity>() <= 0.1) {
      state.y = y;
      reached = next;
      step *= 1.5;
      continue;
    }
    step /= 2;
    if (std::abs(step) < 1e-7 * std::abs(to)) return false;
  }
  return true;
}

std::string names(const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& s : all) out += (out.empty() ? "\"" : ", \"") + s + "\"";
  return out;
}

/// Bodies that still accelerate, the most first.
std::vector<std::string> restless(const System& system, const VectorXd& a) {
  std::vector<std::pair<double, std::string>> found;
  const VectorXd scaled = a.cwiseQuotient(system.scale);
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    found.emplace_back(-scaled.segment<3>(static_cast<Index>(3 * b)).norm(), system.bodies[b].name);
  std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::string> out;
  for (const auto& [size, name] : found)
    if (out.size() < 3 && size < 0.1 * found.front().first) out.push_back(name);
  return out;
}

void warn(const Model& model, const Equations& eq, Equilibrium& out) {
  const System& system = model.system;
  std::string last;
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (is_held(system.contacts[c])) {
      if (const double N = clearance_effect(system, eq, c).normal.force; N < 0)
        out.warnings.push_back("\"" + system.contact_names[c] + "\": its massless link pushes by " + number_text(-N) +
                               " N, as no wall could pull; the joint would be open there");
      continue;
    }
    const double depth = eq.contact[c].gap.depth;
    if (!(depth > 0)) continue;
    if (const double size = contact_size(system.contacts[c], system.length); depth > too_deep * size)
      out.warnings.push_back("\"" + system.contact_names[c] +
                             "\": " + (system.contacts[c].profiles ? "the surfaces overlap by " : "the journal rests ") +
                             number_text(depth) + (system.contacts[c].profiles ? " m" : " m in the wall") +
                             ", more than a tenth of its radius; no contact law holds there");
    else if (const std::string range = range_warning(system.contacts[c].normal, depth); !range.empty())
      out.warnings.push_back("\"" + system.contact_names[c] + "\": " + range);
    if (system.contacts[c].friction && std::exchange(last, system.contact_names[c]) != system.contact_names[c])
      out.warnings.push_back("\"" + system.contact_names[c] +
                             "\": what friction would hold depends on how the mechanism came to rest, so it holds nothing here");
  }
  for (const JointFriction& f : system.frictions)
    out.warnings.push_back("\"" + system.joint_names[at(f.joint)] +
                           "\": what its friction would hold depends on how the mechanism came to rest, so it holds nothing here");
  for (const BendingProbe& p : model.bending) {
    const auto eta = out.state.y.segment(system.eta_begin[at(p.index)], p.displacement.cols());
    const VectorXd u = p.displacement * eta;
    double deflection = 0;
    for (Index i = 0; i + 1 < u.size(); i += 2) deflection = std::max(deflection, u.segment<2>(i).norm() / p.size);
    const double slope = p.slope.rows() > 0 ? (p.slope * eta).lpNorm<Eigen::Infinity>() : 0;
    if (const std::string warning = deflection_warning(p.body, deflection, slope, "bends"); !warning.empty())
      out.warnings.push_back(warning);
  }
}

// A saddle that the search arrived at is left along its unstable direction, towards lower energy.
void search(Rest& rest, Search& way, Equilibrium& out) {
  const bool conservative = has_potential(rest.held);
  const bool rests_at_once = rest.residual() <= 1e-12;
  for (int saddles = 0; saddles < 5; ++saddles) {
    out.found = (conservative && way.descend()) || (!way.runs_away() && way.flow());
    if (!out.found) return;
    VectorXd direction;
    out.stability = stability_of(rest.held, way.state(), rest.eq, rest.eq.lambda, &direction);
    if (rests_at_once || !conservative || out.stability.unstable == 0) return;
    way.push(0.01 * direction);
  }
}

}  // namespace

Equilibrium find_equilibrium(const Scene& scene, const Model& model, const Assembly& assembly, double time) {
  const System& system = model.system;
  refuse_rigid_contacts(scene, system, "an equilibrium");
  Equilibrium out;
  out.warnings = model.warnings;
  for (const std::string& warning : warnings_of(model, assembly)) out.warnings.push_back(warning);
  out.table = trajectory_table(model);
  out.state = assembly.start;
  double reached = 0;
  if (time != 0 && !lead(system, time, out.state, reached)) {
    std::vector<std::string> drivers;
    for (std::size_t k = 0; k < system.joints.size(); ++k)
      if (is_driver(system.joints[k])) drivers.push_back(system.joint_names[k]);
    out.reason = "the mechanism cannot be led beyond t = " + number_text(reached) + " s: the law of " + names(drivers) +
                 " asks for what the links cannot reach there, or passes a singular pose; name an earlier time with --at";
    return out;
  }
  Rest rest(system, time);
  if (!rest.settle(out.state, 1)) {
    out.reason = "the pose to start from is singular, or its forces are beyond what a double holds (check stiffnesses, lengths and loads)";
    return out;
  }
  if (const std::vector<int> restless = restless_states(system, rest.eq, time); !restless.empty()) {
    std::vector<std::string> states;
    for (const int i : restless) states.push_back(system.states[at(i)].name);
    out.reason = "the state " + names(states) +
                 " has no rest of its own: its rate does not depend on it, as that of an integral, so that any value of it would do; leave "
                 "it out of the forces here, or let its rate fall with it";
    return out;
  }
  Search way(rest, out.state);
  search(rest, way, out);
  State last = way.state();
  rest.settle(last, 1);
  out.iterations = way.iterations();
  out.residual = rest.residual();
  out.method = !has_potential(rest.held)
                   ? "overdamped flow into Newton's method, for loads that follow, or that signals size, have no potential"
               : way.damped() ? "Newton's method, damped towards the overdamped flow"
                              : "Newton's method";
  constexpr double told = 1e-6;  // looked at again: next to a singular pose the smallest change of pose upsets the joints' forces
  const bool was_found = out.found;
  out.found = out.found && out.residual <= told;
  if (was_found && !out.found)
    out.reason = "a rest was found next to a singular pose, where the forces of joints have no bound: they cannot be told, " +
                 number_text(out.residual) + " of the greatest is out of balance; start elsewhere, or leave out a driver or a joint";
  else if (!out.found && way.runs_away())
    out.reason =
        "nothing stops " + names(restless(rest.held, rest.eq.a)) +
        " from moving on without end under gravity and loads; join or support what falls, or balance a torque that keeps turning it";
  else if (!out.found)
    out.reason = "no equilibrium was found: after " + std::to_string(out.iterations) + " iterations " + number_text(out.residual) +
                 " of the greatest force is still out of balance, most at " + names(restless(rest.held, rest.eq.a)) +
                 "; start nearer to it (`start`, `pose`), or check the stiffnesses";
  out.lambda = rest.eq.lambda;
  out.state = last;
  rest.eq.a.setZero();
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const double depth = is_held(system.contacts[c]) ? 0 : rest.eq.contact[c].gap.depth;
    out.state.impact_rate[c] = depth > 0 ? latched_at(system, system.contacts[c], depth) : 0;
  }
  warn(model, rest.eq, out);
  record(model, out.state, rest.eq, out.table);
  return out;
}

}  // namespace pintle
