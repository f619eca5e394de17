#include "framework/configuration/own_rest.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/stop_point.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/laws.h"
#include "framework/dynamics/model/signal_values.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int most_together = 1200;  // unknowns of a dense matrix; with more it takes minutes

bool is_place(const MotionSignal& signal) { return signal.kind != MotionSignal::state && !is_speed(signal.kind); }

bool sees_a_place(const System& system, int law) {
  return std::ranges::any_of(system.laws[at(law)].in, [&](int k) { return is_place(system.signals[at(k)]); });
}
bool sees_state(const System& system, int law, int state) {
  return std::ranges::any_of(system.laws[at(law)].in,
                             [&](int k) { return system.signals[at(k)].kind == MotionSignal::state && system.signals[at(k)].a == state; });
}
bool sizes_a_force(const System& system, int state) {
  return std::ranges::any_of(system.forces, [&](const Force& f) {
    const auto* force = std::get_if<SizedForce>(&f);
    return force &&
           ((force->size >= 0 && sees_state(system, force->size, state)) || (force->other >= 0 && sees_state(system, force->other, state)));
  });
}

std::string list_of_states(const System& system, const std::vector<int>& which) {
  std::vector<std::string> names;
  for (const int i : which) names.push_back(system.states[at(i)].name);
  return some_of(names);
}

std::string with_rate_unit(double rate, const OwnState& state) {
  const std::string unit = state.unit.empty() ? "1/s" : state.unit + "/s";
  return number_text(rate, 6) + " " + unit;
}

/// The equations f − Cqᵀλ = 0 along the free directions and g = 0, scaled, and their derivatives with respect to scaled unknowns.
class TogetherAtRest {
 public:
  TogetherAtRest(const System& system, Rest& rest, VectorXd& own, const RestingStates& states)
      : system_(system), rest_(rest), own_(own), sought_(states.sought), tangent_(system) {}

  void look(const State& state) {
    const System& held = rest_.held;
    open = open_directions(held, rest_.eq);
    const Index n = open.cols(), m = static_cast<Index>(sought_.size());
    rest_.tangent.evaluate(held, state, rest_.eq, VectorXd::Zero(held.n()), rest_.eq.lambda,
                           {.q = 1, .s = 0, .a = 0, .x = internal_at_rest}, rest_.values);
    const MatrixXd K = dense(held, rest_.tangent, rest_.values);
    const Tangent::Internal by = tangent_.internal(system_, state, rest_.eq);
    const MatrixXd moves = held.scale.asDiagonal() * open;
    slope.resize(n + m, n + m);
    left.resize(n + m);
    slope.topLeftCorner(n, n) = -moves.transpose() * K * moves;
    left.head(n) = moves.transpose() * rest_.out_of_balance;
    for (Index i = 0; i < m; ++i) {
      const int which = sought_[at(i)];
      const Index x = system_.own_x + which;
      slope.col(n + i).head(n) = system_.states[at(which)].scale * (moves.transpose() * by.f_x.col(x));
      slope.row(n + i).head(n) = by.g_q.row(x) * moves;
      for (Index j = 0; j < m; ++j)
        slope(n + i, n + j) = by.g_x(x, system_.own_x + sought_[at(j)]) * system_.states[at(sought_[at(j)])].scale;
      left[n + i] = law_at(system_, system_.laws[at(system_.states[at(which)].rate)], state.t, state.y);
    }
    set_weights(n, m);
  }

  /// Applies a step of the scaled unknowns. @returns false if the joints cannot be closed there
  bool go(const VectorXd& step, State& state) {
    const Index n = open.cols();
    state.y.head(rest_.held.n()) += rest_.held.scale.cwiseProduct(open * step.head(n));
    for (Index i = 0; i < step.size() - n; ++i) own_[sought_[at(i)]] += system_.states[at(sought_[at(i)])].scale * step[n + i];
    return rest_.project(state, 1);
  }

  double worst_rate() const { return left.tail(static_cast<Index>(sought_.size())).lpNorm<Eigen::Infinity>(); }
  int fastest() const {
    Index which = 0;
    left.tail(static_cast<Index>(sought_.size())).cwiseAbs().maxCoeff(&which);
    return sought_[at(which)];
  }

  MatrixXd open, slope;
  VectorXd left;

 private:
  // Forces are scaled by the largest acting force at the start, rates by their sensitivity to the unknowns there.
  void set_weights(Index n, Index m) {
    if (weight_.size() == 0) {
      weight_ = VectorXd::Ones(m);
      for (Index i = 0; i < m; ++i)
        if (const double size = slope.row(n + i).cwiseAbs().maxCoeff(); size > 0) weight_[i] = 1 / size;
      const double size = std::max(rest_.at_work(), slope.topLeftCorner(n, n).cwiseAbs().maxCoeff());
      force_ = size > 0 ? 1 / size : 1;
    }
    slope.topRows(n) *= force_, left.head(n) *= force_;
    slope.bottomRows(m) = weight_.asDiagonal() * slope.bottomRows(m);
    left.tail(m) = weight_.cwiseProduct(left.tail(m));
  }

  const System& system_;
  Rest& rest_;
  VectorXd& own_;
  const std::vector<int>& sought_;
  Tangent tangent_;
  VectorXd weight_;
  double force_ = 1;
};

// The least-squares solution x of slope x = −left, damped by `damping`.
VectorXd damped_step(const TogetherAtRest& now, double damping) {
  const Index n = now.left.size();
  MatrixXd A(2 * n, n);
  A << now.slope, std::sqrt(damping) * MatrixXd::Identity(n, n);
  VectorXd right = VectorXd::Zero(2 * n);
  right.head(n) = -now.left;
  return Eigen::ColPivHouseholderQR<MatrixXd>(A).solve(right);
}

// States changed by a direction along which the equations do not change.
std::vector<std::string> undetermined_states(const System& system, const TogetherAtRest& now, const std::vector<int>& sought) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(MatrixXd(now.slope.transpose() * now.slope));
  constexpr double zero = 1e-14, moves = 1e-3;  // of squared singular values; of a unit direction
  const Index n = now.open.cols();
  std::vector<std::string> out;
  for (std::size_t i = 0; i < sought.size(); ++i) {
    double moved = 0;
    for (Index k = 0; k < modes.eigenvalues().size(); ++k)
      if (modes.eigenvalues()[k] <= zero * modes.eigenvalues().maxCoeff())
        moved = std::max(moved, std::abs(modes.eigenvectors()(n + static_cast<Index>(i), k)));
    if (moved > moves) out.push_back(system.states[at(sought[i])].name);
  }
  return out;
}

}  // namespace

RestingStates resting_states(const System& system) {
  const int n = static_cast<int>(system.states.size());
  std::vector<bool> kept(at(n), false);
  const auto can_rest = [&](int i) {
    const int rate = system.states[at(i)].rate;
    bool sees = sees_a_place(system, rate), acts = sizes_a_force(system, i);
    for (int j = 0; j < n; ++j) {
      if (kept[at(j)]) continue;
      sees = sees || sees_state(system, rate, j);
      acts = acts || sees_state(system, system.states[at(j)].rate, i);
    }
    return sees && acts;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < n; ++i)
      if (!kept[at(i)] && !can_rest(i)) kept[at(i)] = changed = true;
  }
  RestingStates out;
  for (int i = 0; i < n; ++i) (kept[at(i)] ? out.kept : out.sought).push_back(i);
  return out;
}

std::optional<System> without_limits(const System& system, const RestingStates& states, Limits which) {
  std::vector<int> limited;
  for (const int i : states.sought) limited.push_back(system.states[at(i)].rate);
  if (which == Limits::all) limited.resize(system.laws.size()), std::iota(limited.begin(), limited.end(), 0);
  std::optional<System> out;
  for (const int k : limited) {
    const SignalLaw& law = system.laws[at(k)];
    std::vector<bool> fixed;
    for (const int in : law.in) {
      const MotionSignal& signal = system.signals[at(in)];
      fixed.push_back(signal.kind == MotionSignal::state && std::ranges::find(states.kept, signal.a) != states.kept.end());
    }
    const auto free = unlimited(law.of, fixed, which);
    if (!free) continue;
    if (!out) out = system;
    out->laws[at(k)].of = *free, out->laws[at(k)].sided = nullptr;
  }
  return out;
}

bool follow_the_pose(const System& system, const RestingStates& states, const Rest& rest, double t) {
  const auto m = static_cast<Index>(states.sought.size());
  if (m == 0) return true;
  MatrixXd slopes = MatrixXd::Zero(static_cast<Index>(system.laws.size()), static_cast<Index>(system.signals.size())), g_x(m, m);
  law_slopes(system, rest.eq, t, slopes);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) {
      g_x(i, j) = 0;
      for (std::size_t k = 0; k < system.signals.size(); ++k)
        if (system.signals[k].kind == MotionSignal::state && system.signals[k].a == states.sought[at(j)])
          g_x(i, j) += slopes(system.states[at(states.sought[at(i)])].rate, static_cast<Index>(k));
    }
  return Eigen::FullPivLU<MatrixXd>(g_x).rank() == m;
}

namespace {

JointRest newton_together(const System& system, Rest& rest, VectorXd& own, const RestingStates& states, State& state) {
  constexpr double balanced = 1e-13, nearly = 1e-7, still = 1e-9, most_damped = 1e12;
  constexpr int most = 500;
  JointRest out;
  TogetherAtRest now(system, rest, own, states);
  now.look(state);
  double damping = 1e-6;
  for (; out.iterations < most && damping < most_damped && now.left.lpNorm<Eigen::Infinity>() > balanced; ++out.iterations) {
    stop_point();
    State trial = state;
    const VectorXd own_before = own;
    TogetherAtRest then = now;
    if (now.go(damped_step(now, damping), trial)) {
      then.look(trial);
      if (then.left.allFinite() && then.left.norm() < now.left.norm()) {
        now.left = then.left, now.slope = then.slope, now.open = then.open;
        state = trial;
        damping = std::max(damping / 10, 1e-20);
        continue;
      }
    }
    own = own_before;
    damping *= 10;
  }
  rest.project(state, 1);
  constexpr double rounding = 1e-11;  // of the forces at the start, where none is left at rest that could be compared
  const bool in_balance = rest.residual() <= nearly || now.left.lpNorm<Eigen::Infinity>() <= rounding;
  out.found = in_balance && now.worst_rate() <= still;
  if (out.found) out.undetermined = undetermined_states(system, now, states.sought);
  if (!out.found && now.worst_rate() > still) {
    const OwnState& moving = system.states[at(now.fastest())];
    out.reason = "the state " + quoted(moving.name) + " does not come to rest: where the forces are best balanced, its rate is still " +
                 with_rate_unit(law_at(system, system.laws[at(moving.rate)], state.t, state.y), moving) +
                 ", and nothing that it acts on brings the rate to 0; a limit (saturate, if) may prevent it; otherwise start nearer to the "
                 "equilibrium";
  }
  return out;
}

/// Starts from the equilibrium without limits. @returns false if this finds none within the limits
bool from_rest_without_limits(const System& system, Rest& rest, VectorXd& own, const RestingStates& states, State& state, JointRest& out) {
  const std::optional<System> free = without_limits(system, states, Limits::all);
  if (!free) return false;
  KeptStates all{{}, std::make_shared<VectorXd>(own)};
  for (std::size_t i = 0; i < system.states.size(); ++i) all.which.push_back(static_cast<int>(i));
  Rest beyond(*free, state.t, all);
  if (!beyond.project(state, 1)) return false;
  const int before = out.iterations + newton_together(*free, beyond, *all.at, states, state).iterations;
  own = *all.at;
  if (!rest.project(state, 1)) return false;
  JointRest within = newton_together(system, rest, own, states, state);
  if (!within.found) return false;
  out = std::move(within);
  out.iterations += before;
  return true;
}

}  // namespace

JointRest find_joint_rest(const System& system, Rest& rest, VectorXd& own, const RestingStates& states, State& state) {
  JointRest out;
  if (system.n() + static_cast<int>(states.sought.size()) > most_together) {
    out.reason = "the states " + list_of_states(system, states.sought) +
                 " come to rest only together with the pose, which is possible for at most " + std::to_string(most_together) +
                 " coordinates; make the rate of each state decrease with the state, or use fewer modes";
    return out;
  }
  const State start = state;
  const VectorXd own_at_start = own;
  out = newton_together(system, rest, own, states, state);
  if (out.found) return out;
  const State end = std::exchange(state, start);
  const VectorXd own_at_end = std::exchange(own, own_at_start);
  if (!from_rest_without_limits(system, rest, own, states, state, out)) {
    own = own_at_end, state = end;
    rest.project(state, 1);
  }
  return out;
}

std::string beyond_its_limit(const System& system, const System& unlimited, const RestingStates& states, const State& state) {
  constexpr double still = 1e-9;  // relative to its scale, per second
  for (const int i : states.sought) {
    const OwnState& own = system.states[at(i)];
    const double rate = law_at(system, system.laws[at(own.rate)], state.t, state.y),
                 free = law_at(unlimited, unlimited.laws[at(own.rate)], state.t, state.y);
    if (!(std::abs(rate - free) <= still * own.scale))
      return "the state " + quoted(own.name) + " does not come to rest: its rate there is " + with_rate_unit(rate, own) +
             "; the limits of its rate must include 0";
  }
  return "";
}

std::string moving_state(const System& system, const RestingStates& states, const State& state, std::vector<std::string>& notes) {
  constexpr double still = 1e-9;  // relative to its scale, per second
  for (const int i : states.kept) {
    const OwnState& own = system.states[at(i)];
    const SignalLaw& law = system.laws[at(own.rate)];
    const double rate = law_at(system, law, state.t, state.y);
    if (!(std::abs(rate) <= still * own.scale))
      return "the state " + quoted(own.name) + " never rests: its rate there is " + with_rate_unit(rate, own) +
             ", and nothing that it acts on can bring the rate to 0; leave it out here, or make its rate decrease with the state";
    if (!law.in.empty())
      notes.push_back("the state " + quoted(own.name) + " keeps its start value, " + number_text(own.start, 6) +
                      (own.unit.empty() ? "" : " " + own.unit) + ": it is at rest there with any value");
  }
  return "";
}

}  // namespace pintle
