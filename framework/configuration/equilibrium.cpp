#include "framework/configuration/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/stop_point.h"
#include "framework/common/text.h"
#include "framework/common/work_done.h"
#include "framework/configuration/deflection_monitor.h"
#include "framework/configuration/own_rest.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/dynamics/equations/sticking_columns.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

namespace {

using Eigen::VectorXd;
using Index = Eigen::Index;

/// Iterates from the start to the equilibrium, or to where the search ends.
class Search {
 public:
  Search(Rest& rest, State start) : rest_(rest), state_(std::move(start)), start_(state_.y.head(rest.held.n())) {}

  bool descend() { return go(true, 3000); }  ///< by minimising the potential energy
  bool flow() { return go(false, 6000); }    ///< if there is no potential, or `descend` fails
  bool damped() const { return damped_; }
  int iterations() const { return iterations_; }
  bool runs_away() const { return runs_away_; }
  State& state() { return state_; }
  void push(const VectorXd& direction) {
    State pushed = state_;
    pushed.y.head(direction.size()) += direction;
    if (rest_.project(pushed, 1)) state_ = pushed;
  }

 private:
  static constexpr double balanced = 1e-12, nearly = 1e-7;

  bool go(bool by_potential, int most) {
    double best = 1e300, sigma = by_potential ? 0 : gentle();
    State calmest = state_;
    int idle = 0;
    trust_ = 0.3;
    for (int i = 0; i < most; ++i, ++iterations_) {
      stop_point();
      const double residual = rest_.residual();
      if (residual <= balanced) return true;
      idle = residual < 0.5 * best ? 0 : idle + 1;
      if (residual < best) best = residual, calmest = state_;
      if (best <= nearly && idle > 12) {  // rounding prevents a further decrease
        state_ = calmest;
        rest_.project(state_, 1);
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

  /// σ for which the accelerations from rest move the mechanism by a tenth of its size.
  double gentle() const { return std::max(rest_.size(rest_.eq.a) / 0.1, 1e-12); }

  // Solves [K + σM, Cqᵀ; Cq, 0] [d; ·] = [forces out of balance; 0] for d, and shortens d until it succeeds.
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
      if (!rest_.project(trial, 0.5 * share * rest_.size(d) + 1e-9)) continue;
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
    rest_.project(back, 1);
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

// Follows the drivers from the configuration at t = 0 to time t, in steps small enough to stay on the branch.
bool lead(const System& system, double to, State& state, double& reached) {
  System held = system;
  Equations eq(system);
  double step = to / 64;
  for (reached = 0; std::abs(reached) < std::abs(to);) {
    stop_point();
    const double next = std::abs(to - reached) <= std::abs(step) ? to : reached + step;
    hold_drivers(system, next, held);
    VectorXd y = state.y;
    const bool closed = project(held, next, y, eq);
    if (closed && ((y - state.y).head(held.n()).cwiseQuotient(held.scale)).lpNorm<Eigen::Infinity>() <= 0.1) {
      state.y = y;
      reached = next;
      work_done = reached / to;
      step *= 1.5;
      continue;
    }
    step /= 2;
    if (std::abs(step) < 1e-7 * std::abs(to)) return false;
  }
  work_done = -1;
  return true;
}

/// Bodies that still accelerate, in decreasing order.
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
        out.warnings.push_back("\"" + system.contact_names[c] + "\": its massless link is in compression with " + number_text(-N) +
                               " N, but a wall cannot pull; the joint would be open there");
      continue;
    }
    const double depth = eq.contact[c].gap.depth;
    if (!(depth > 0)) continue;
    if (const double size = contact_size(system.contacts[c], system.length); depth > deepest_valid * size)
      out.warnings.push_back("\"" + system.contact_names[c] +
                             "\": " + (system.contacts[c].profiles ? "the surfaces overlap by " : "the journal rests ") +
                             number_text(depth) + (system.contacts[c].profiles ? " m" : " m in the wall") +
                             ", more than a tenth of its radius; no contact law holds there");
    else if (const std::string range = range_warning(system.contacts[c].normal, depth); !range.empty())
      out.warnings.push_back("\"" + system.contact_names[c] + "\": " + range);
    if (system.contacts[c].friction && std::exchange(last, system.contact_names[c]) != system.contact_names[c])
      out.warnings.push_back("\"" + system.contact_names[c] +
                             "\": the friction force at rest depends on how the mechanism came to rest, so it is taken as 0");
  }
  for (const JointFriction& f : system.frictions)
    out.warnings.push_back("\"" + system.joint_names[at(f.joint)] +
                           "\": the friction force at rest depends on how the mechanism came to rest, so it is taken as 0");
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

// Leaves a saddle point along its unstable direction, towards lower energy, and searches again.
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

std::string why_no_pose(const Scene& scene, const Model& model, const State& start) {
  const std::string unsound = explain_signals(scene, model, start, start);
  return !unsound.empty() ? unsound
                          : "the start pose is singular, or its forces exceed the range of a double (check stiffnesses, lengths and loads)";
}

// Friction is taken as 0, but its normal loads are known.
void find_friction_loads(const System& system, const State& state, Equations& eq) {
  for (std::size_t k = 0; k < system.frictions.size(); ++k)
    if (!is_released(system, Switch::joint, system.frictions[k].joint, state.y))
      eq.friction[k].load = sticking_columns::load_of(system, eq, k, eq.lambda);
}

void finish(const Scene& scene, const Model& model, Rest& rest, const RestingStates& states, const State& last, Equilibrium& out) {
  const System& system = model.system;
  out.lambda = rest.eq.lambda;
  out.state = last;
  rest.eq.a.setZero();
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const double depth = is_held(system.contacts[c]) ? 0 : rest.eq.contact[c].gap.depth;
    out.state.impact_rate[c] = depth > 0 ? latched_at(system, system.contacts[c], depth) : 0;
  }
  if (const std::string moving = moving_state(system, states, last, out.warnings); !moving.empty() && out.found)
    out.found = false, out.reason = moving;
  if (const std::string limited = out.found ? beyond_its_limit(system, rest.held, states, last) : ""; !limited.empty())
    out.found = false, out.reason = limited;
  warn(model, rest.eq, out);
  find_friction_loads(system, last, rest.eq);
  record(model, out.state, rest.eq, out.table);
  warn_of_signals(scene, model, out.state, out.table, out.warnings);
  if (out.found) {
    DeflectionMonitor deflections(model);
    deflections.see(out.state, rest.eq);
    deflections.warn(out.warnings);
    return;
  }
  if (const std::string unsound = explain_signals(scene, model, last, last); !unsound.empty()) out.reason += "; " + unsound;
}

VectorXd own_states(const System& system, const State& state) {
  return state.y.segment(system.x_begin() + system.own_x, static_cast<Index>(system.states.size()));
}

/// Solves for the pose and the own states together, from out.state. @returns false if each pose determines the own states
bool rests_together(const Scene& scene, const Model& model, const System& system, const RestingStates& states, double time,
                    Equilibrium& out) {
  KeptStates all{{}, std::make_shared<VectorXd>(own_states(system, out.state))};
  for (std::size_t i = 0; i < system.states.size(); ++i) all.which.push_back(static_cast<int>(i));
  Rest rest(system, time, all);
  State state = out.state;
  if (!rest.project(state, 1)) {
    out.reason = why_no_pose(scene, model, state);
    return true;
  }
  if (follow_the_pose(system, states, rest, time)) return false;
  const JointRest joint = find_joint_rest(system, rest, *all.at, states, state);
  out.found = joint.found;
  out.iterations = joint.iterations;
  out.residual = rest.residual();
  out.method = "Newton's method for the pose and the scene's own states together";
  out.stability.why_not = "its stability also depends on the scene's own states: use pintle linearize --equilibrium";
  if (!joint.undetermined.empty())
    out.warnings.push_back(
        "of the states " + some_of(joint.undetermined) +
        " only some combinations are determined at equilibrium; of the possible values, those nearest to their starts were taken");
  if (!out.found)
    out.reason = !joint.reason.empty()
                     ? joint.reason
                     : "no equilibrium was found: after " + std::to_string(out.iterations) + " iterations " + number_text(out.residual) +
                           " of the greatest force is still unbalanced; start nearer to the equilibrium " +
                           "(`start`, `pose`, the states' `start`), or check the gains";
  finish(scene, model, rest, states, state, out);
  return true;
}

}  // namespace

Equilibrium find_equilibrium(const Scene& scene, const Model& model, const Assembly& assembly, double time) {
  refuse_rigid_contacts(scene, model.system, "an equilibrium");
  Equilibrium out;
  out.warnings = model.warnings;
  for (const std::string& warning : warnings_of(model, assembly)) out.warnings.push_back(warning);
  out.table = trajectory_table(model);
  out.state = assembly.start;
  double reached = 0;
  if (time != 0 && !lead(model.system, time, out.state, reached)) {
    std::vector<std::string> drivers;
    for (std::size_t k = 0; k < model.system.joints.size(); ++k)
      if (is_driver(model.system.joints[k])) drivers.push_back(model.system.joint_names[k]);
    out.reason =
        "the mechanism cannot be moved beyond t = " + number_text(reached) + " s: the law of " + some_of(drivers) +
        " prescribes a position that the links cannot reach there, or passes a singular configuration; name an earlier time with --at";
    return out;
  }
  const RestingStates states = resting_states(model.system);
  const std::optional<System> unlimited_rates = without_limits(model.system, states, Limits::of_value);
  const System& system = unlimited_rates ? *unlimited_rates : model.system;
  if (!states.sought.empty() && rests_together(scene, model, system, states, time, out)) return out;
  Rest rest(system, time, {states.kept, std::make_shared<VectorXd>(own_states(system, out.state))});
  if (!rest.project(out.state, 1)) {
    out.reason = why_no_pose(scene, model, out.state);
    return out;
  }
  Search way(rest, out.state);
  search(rest, way, out);
  State last = way.state();
  rest.project(last, 1);
  if (!states.sought.empty() && !follow_the_pose(system, states, rest, time)) {  // a limit is left, so an integral is free again
    out.state = last;
    if (rests_together(scene, model, system, states, time, out)) return out;
  }
  out.iterations = way.iterations();
  out.residual = rest.residual();
  out.method = !has_potential(rest.held)
                   ? "overdamped flow, then Newton's method (follower loads and loads controlled by signals have no potential)"
               : way.damped() ? "Newton's method, damped towards the overdamped flow"
                              : "Newton's method";
  constexpr double enough = 1e-6;  // checked again: near a singular configuration tiny displacements change the forces strongly
  const bool was_found = out.found;
  const std::vector<std::string> moving = restless(rest.held, rest.eq.a);
  out.found = out.found && out.residual <= enough;
  if (was_found && !out.found)
    out.reason =
        "an equilibrium was found next to a singular configuration, where joint forces grow without bound and cannot be determined: " +
        number_text(out.residual) + " of the greatest is unbalanced; start from another pose, or remove a driver or a joint";
  else if (!out.found && way.runs_away())
    out.reason =
        "nothing stops " + some_of(moving) +
        " from moving without limit under gravity and loads; join or support what falls, or balance the torque that keeps turning it";
  else if (!out.found)
    out.reason = "no equilibrium was found: after " + std::to_string(out.iterations) + " iterations " + number_text(out.residual) +
                 " of the greatest force is still unbalanced" + (moving.empty() ? "" : ", most of it at " + some_of(moving)) +
                 "; start nearer to the equilibrium (`start`, `pose`), or check the stiffnesses";
  finish(scene, model, rest, states, last, out);
  return out;
}

}  // namespace pintle
