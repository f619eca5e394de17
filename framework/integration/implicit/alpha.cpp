#include "framework/integration/implicit/alpha.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/common/worse.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/equations/sticking.h"
#include "framework/dynamics/model/reach.h"

namespace pintle {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double well_below = 1e-3;  // Newton's error relative to the step's
constexpr double on_constraints = 1e-12, nearly = 1e-11, still_near = 1e-8;
constexpr int most_iterations = 12, many_iterations = 3;
constexpr double slow = 0.2;  // contraction rate that calls for a new factorization
}  // namespace

AlphaWeights::AlphaWeights(double rho)
    : m((2 * rho - 1) / (rho + 1)),
      f(rho / (rho + 1)),
      beta(0.25 * (1 + f - m) * (1 + f - m)),
      gamma(0.5 + f - m),
      shift(m - f),
      error(beta + shift / 2 - 1.0 / 6) {}

Alpha::Alpha(const System& system, const Equations& eq, double rho, double tolerance)
    : weights_(rho),
      tolerance_(tolerance),
      length_(system.length),
      unit_(VectorXd::Ones(system.n())),
      tangent_(system),
      kkt_(system, eq, tangent_),
      values_(tangent_.places().size()),
      q_base_(VectorXd::Zero(system.n())),
      s_base_(VectorXd::Zero(system.n_s())),
      p_(q_base_),
      start_(s_base_),
      own_(s_base_),
      dv_(q_base_),
      dp_(q_base_),
      mu_(VectorXd::Zero(system.n_rows())),
      work_(q_base_) {
  for (int i = 0; i < system.n_z(); ++i)
    if (system.integrals[at(i)].account == Account::scheme) loss_ = system.z_begin() + i;
  const std::vector<double> reach = reaches(system);
  for (Index b = 0; b < std::ssize(reach); ++b) {
    unit_[3 * b + 2] = 1 / (reach[at(b)] > 0 ? reach[at(b)] : system.length);
    unit_.segment(system.eta_begin[at(b)], system.bodies[at(b)].modes()).setConstant(std::sqrt(system.bodies[at(b)].m));
  }
}

void Alpha::move_to(const System& system, const State& state, Equations& eq) {
  pose(system, state.t, state.y, eq);
  update_mass(system, state.y, eq);
  speed(system, state.t, state.y, eq);
}

void Alpha::evaluate_at(const System& system, const State& state, const VectorXd& dy, const VectorXd& lambda, Equations& eq) {
  move_to(system, state, eq);
  balance(system, state, dy, lambda, eq);
}

void Alpha::balance(const System& system, const State& state, const VectorXd& dy, const VectorXd& lambda, Equations& eq) {
  apply_forces(system, state, eq);
  if (!state.friction.empty()) list_sticking(system, state, eq);
  eq.a = dy.segment(system.n(), system.n());
  eq.lambda = lambda;
  ++eq.evaluations;
}

bool Alpha::project(const System& system, Instant& node, Equations& eq) {
  if (!pintle::project(system, node.state.t, node.state.y, eq)) return false;
  remove_slip(system, node.state, eq);
  accelerate(system, node.state, eq);
  keep_friction(system, eq, node.state);
  fill_derivative(system, node.state.y, eq, node.dy);
  Memory& memory = node.memory;
  memory.h = 0;
  memory.a = node.dy.segment(system.n(), system.n_s());
  memory.lambda = memory.lambda_before = eq.lambda;
  memory.dy_before = node.dy;
  forces_of(system, eq, memory);
  tired_ = true;
  if (!system.switches.empty()) kkt_.forget(), factored_ = false;  // its pivots may belong to rows that are now released
  return node.dy.allFinite();
}

void Alpha::forces_of(const System& system, const Equations& eq, Memory& memory) {
  memory.P.setZero(system.n());
  add_mass_times(system, eq, eq.a, memory.P);
  work_.setZero();
  add_reaction(eq, eq.lambda, work_);
  memory.F = eq.f - work_;
}

// q_base, s_base, and a first guess of v̇₁, λ₁. At a start a₀ is v̇ extrapolated to `shift` steps after it, on the line through v̇₀ and
// v̇₁. This makes the step Newmark's with γ = ½ and β + shift/2: second order from the first step on.
Alpha::Weights Alpha::predict(double h, const Instant& from, Instant& to) {
  const Index n = unit_.size(), n_s = s_base_.size();
  const auto q0 = from.state.y.head(n), s0 = from.state.y.segment(n, n_s), v0 = from.dy.segment(n, n_s);
  auto guess = to.dy.segment(n, n_s);
  const Memory& memory = from.memory;
  const double m = weights_.m, f = weights_.f, beta = weights_.beta, gamma = weights_.gamma;
  Weights w;
  p_.setZero();
  if (memory.h == 0) {
    w = start_weights(h);
    q_base_ = q0 + h * s0.head(n) + (h * h / 2 - w.q) * start_.head(n);
    s_base_ = s0 + h / 2 * start_;
    guess = start_;
    to.memory.lambda = memory.lambda;
    return w;
  }
  w = {h * h * beta * (1 - f) / (1 - m), h * gamma * (1 - f) / (1 - m)};
  const double ratio = h / memory.h;
  own_ = v0 + ratio * (memory.a - v0);  // a₀, at `shift` times this step after the node
  q_base_ = q0 + h * s0.head(n) + h * h * ((0.5 - beta) * own_ + beta / (1 - m) * (f * v0 - m * own_)).head(n);
  s_base_ = s0 + h * ((1 - gamma) * own_ + gamma / (1 - m) * (f * v0 - m * own_));
  const double reach = std::min(ratio, 2.0);
  guess = v0 + reach * (v0 - memory.dy_before.segment(n, n_s));
  to.memory.lambda = memory.lambda + reach * (memory.lambda - memory.lambda_before);
  return w;
}

Alpha::Weights Alpha::start_weights(double h) const { return {h * h * (weights_.beta + weights_.shift / 2), h / 2}; }

// v̇ at a start, filtered for the step. If a spring that is stiff for the step is unbalanced, v̇₀ would act during the whole step and give
// hω times the speed that the spring could ever cause. With F v = (M + w.s D + w.q K)⁻¹M v, restricted to the constraints, v̇₀ − (1 −
// F)²v̇₀ equals v̇₀ to h² where nothing is stiff. Likewise for ẋ₀. With ρ = 1 the start uses the trapezoidal rule, which conserves energy.
bool Alpha::soften_start(const System& system, double h, const Instant& from, Equations& eq) {
  const Index n = system.n();
  start_ = from.dy.segment(n, system.n_s());
  if (weights_.shift == 0) return true;
  evaluate_at(system, from.state, from.dy, from.memory.lambda, eq);
  if (system.n_x() > 0) soften_internal(system, start_weights(h).s, from.state, eq);
  if (!refactor(system, start_weights(h), from, eq)) return blame(system, eq, "the iteration matrix is singular");
  border(system, eq);
  for (int i = 0; i < 2; ++i) {
    dp_.setZero();
    add_mass_times(system, eq, i == 0 ? start_ : work_, dp_);
    mu_.setZero();
    visit_jacobian(eq, [&](int row, int column, double value) { mu_[row] += value * (i == 0 ? start_ : work_)[column]; });
    kkt_.solve(dp_, mu_);
    if (border_.cols() > 0) keep_slip(system, eq, eq.sticking.J.transpose() * (i == 0 ? start_.head(n) : work_), dp_);
    if (i == 0) work_ = 2 * start_.head(n) - dp_;  // F(2 − F)
  }
  start_.head(n) = dp_;
  return true;
}

void Alpha::soften_internal(const System& system, double weight, const State& at_start, Equations& eq) {
  own_ = start_;
  double *x = start_.data() + system.n(), *once = own_.data() + system.n();
  filter_internal_states(system, at_start, eq, weight, once);
  for (int i = 0; i < system.n_x(); ++i) x[i] = 2 * x[i] - once[i];
  filter_internal_states(system, at_start, eq, weight, x);
}

bool Alpha::refactor(const System& system, const Weights& w, const Instant& node, Equations& eq) {
  tangent_.evaluate(system, node.state, eq, eq.a, eq.lambda, {.q = w.q, .s = w.s, .a = 1, .x = w.s}, values_);
  lent_ = nullptr;
  factored_ = kkt_.factor(system, eq, values_);
  ++eq.factorizations;
  kept_ = w;
  rate_ = 1;  // unknown: measured in the first step with it
  tired_ = false;
  return factored_;
}

// Largest entry of the last correction relative to the error that Newton may leave.
double Alpha::correction_size(const System& system, const Weights& w, const State& state) const {
  constexpr double rounding = 2e-15;
  const double enough = well_below * tolerance_;
  const Index n = unit_.size();
  double worst = 0;
  for (Index i = 0; i < unit_.size(); ++i) {
    const double place = rounding * (system.scale[i] + std::abs(state.y[i]));
    const double of_q = enough * length_ * unit_[i] + place;
    const double of_s = enough * speed_ * unit_[i] + rounding * (std::abs(state.y[n + i]) + speed_ * unit_[i]);
    worst = worse(worse(worst, std::abs(w.q * dv_[i] + dp_[i]) / of_q), std::abs(w.s * dv_[i]) / of_s);
  }
  return worst;
}

// Largest relative violation of the constraints, in position beyond rounding, in velocity and in sliding.
double Alpha::constraint_violation(const System& system, const State& state, const Equations& eq) const {
  const VectorXd& y = state.y;
  const double left = position_violation(system, eq) - std::min(8 * angle_rounding(system, y), still_near);
  const double now = fastest_rate(system, y), pace = std::max(now, largest(s_base_.head(system.n()).cwiseQuotient(system.scale)));
  const double drift = worse(velocity_violation(system, y, eq), slip_violation(system, state, eq)) * now / pace;  // also at rest
  return worse(left, drift);
}

// One correction of v̇₁, λ₁ and p with the factored matrix. @returns false if friction in joints has no solution
bool Alpha::correct(const System& system, const Weights& w, Instant& to, Equations& eq) {
  dv_ = eq.f;
  work_.setZero();
  add_mass_times(system, eq, eq.a, work_);
  add_reaction(eq, eq.lambda, work_);
  dv_ -= work_;
  mu_ = eq.Cdot * (-1 / w.s);
  solve(dv_, mu_);
  to.memory.lambda += mu_;
  if (!correct_friction(system, w.s, to.state, to.memory, eq)) return false;
  to.dy.segment(system.n(), system.n()) += dv_;
  dp_.setZero();
  if (system.n_rows() > 0) {
    mu_ = (w.q / w.s) * eq.Cdot - eq.C;  // without the effect of δv̇ on C
    solve(dp_, mu_);
    p_ += dp_;
  }
  return true;
}

// Newton's iteration for v̇₁, λ₁ and p. The unknowns are accelerations, so the matrix is M + w.s D + w.q K, whose non-stiff part does not
// change with the step size.
bool Alpha::iterate(const System& system, const Weights& w, Instant& to, Equations& eq) {
  const Index n = system.n();
  auto v = to.dy.segment(n, n);
  VectorXd& y = to.state.y;
  double before = 0;
  bool fresh = false, enough = false;
  for (int i = 0; i <= most_iterations; ++i) {
    y.head(n) = q_base_ + w.q * v + p_;
    y.segment(n, n) = s_base_.head(n) + w.s * v;
    move_to(system, to.state, eq);
    if (system.n_x() > 0) follow_internal_states(system, eq, to.state, w.s, s_base_.data() + n, y.data() + system.x_begin());
    balance(system, to.state, to.dy, to.memory.lambda, eq);
    if (enough) {
      if (constraint_violation(system, to.state, eq) <= (i > most_iterations / 2 ? nearly : on_constraints)) {
        tired_ = tired_ || i > many_iterations || rate_ > slow;
        return true;
      }
    }
    if (i == most_iterations) break;
    if (i == 0 && (tired_ || !factored_)) {
      if (!refactor(system, w, to, eq)) return blame(system, eq, "the iteration matrix is singular");
      fresh = true;
    }
    if (i == 0) border(system, eq);
    if (!correct(system, w, to, eq)) return blame(system, eq, "the friction force in the joints cannot be found");
    ++iterations_;
    const double size = correction_size(system, w, to.state);
    if (!std::isfinite(size)) return blame(system, eq, "Newton's iteration exceeds the range of a double");
    if (i > 0 && size > 1) {
      rate_ = size / before;
      if (i > 1 && rate_ > 0.5 && size * well_below < 0.1) {  // as near to the solution as rounding allows
        enough = true, rate_ = slow;
        continue;
      }
      if (rate_ > 0.9 || (i > 2 && size * std::pow(rate_, most_iterations - 1 - i) > 1))
        return fresh ? blame(system, eq, "Newton's iteration does not converge") : false;
    } else if (i > 0 && before > 1) {
      rate_ = std::max(size / before, 1e-3);
    } else if (i == 0) {
      rate_ = std::pow(std::max(rate_, 1e-6), 0.8);  // may have grown since it was measured
    }
    enough = size * std::min(1.0, rate_ / std::max(1e-3, 1 - rate_)) <= 1;
    before = size;
  }
  return fresh ? blame(system, eq, "Newton's iteration does not satisfy the constraints") : false;
}

bool Alpha::attempt(const System& system, double h, Step& step, Equations& eq) {
  const State& from = step.from.state;
  Instant& to = step.to;
  step.h = h;
  to.state.t = from.t + h;
  to.state.impact_rate = from.impact_rate;
  to.state.friction = from.friction;
  to.state.y.resize(system.n_y());
  const Index rest = system.n_y() - 2 * system.n();
  to.state.y.tail(rest) = from.y.tail(rest);
  trouble_.clear();
  if (step.from.memory.h == 0 && !soften_start(system, h, step.from, eq)) return false;
  Weights w = predict(h, step.from, to);
  if (w.q > 2 * kept_.q || w.q < 0.5 * kept_.q) rate_ = 1, tired_ = tired_ || lent_;  // a borrowed factor is valid only for similar steps
  if (!iterate(system, w, to, eq)) {
    if (!trouble_.empty() || !factored_) return false;
    tired_ = true;  // the factor was old: retry with a new one
    w = predict(h, step.from, to);
    if (!iterate(system, w, to, eq)) return false;
  }
  remember(system, h, step.from, to, eq);
  estimate(system, step, eq);
  if (loss_ >= 0) book_loss(system, eq, step);
  return to.state.y.allFinite() && to.dy.allFinite() && step.error.allFinite();
}

// The step does not determine how dependent rows share their forces: carried over from step to step, this part would grow without bound.
void Alpha::share_out(const System& system, Instant& to, Equations& eq) {
  factor(system, to.state.y, eq);
  if (!eq.regular) return;
  eq.schur.take_null_part(to.memory.lambda);
  eq.lambda = to.memory.lambda;
}

void Alpha::remember(const System& system, double h, const Instant& from, Instant& to, Equations& eq) {
  const Index n = system.n(), n_s = system.n_s();
  share_out_friction(system, to, eq);
  fill_derivative(system, to.state.y, eq, to.dy);
  const auto v1 = to.dy.segment(n, n_s);
  Memory& memory = to.memory;
  const double m = weights_.m, f = weights_.f;
  memory.dy_before = from.dy;
  if (from.memory.h == 0) memory.dy_before.segment(n, n_s) = start_;
  const auto v0 = memory.dy_before.segment(n, n_s);
  if (from.memory.h == 0)
    own_ = v0 + weights_.shift * (v1 - v0);
  else
    own_ = v0 + (h / from.memory.h) * (from.memory.a - v0);
  memory.a = ((1 - f) * v1 + f * v0 - m * own_) / (1 - m);
  memory.h = h;
  memory.lambda_before = from.memory.lambda;
  if (eq.permanent > 0) share_out(system, to, eq);
  forces_of(system, eq, memory);
  for (Index i = system.z_begin(); i < system.n_y(); ++i) to.state.y[i] = from.state.y[i] + h / 2 * (from.dy[i] + to.dy[i]);
}

// e ← the solution x of (M + w.s D + w.q K) x + Cqᵀμ = M e, Cq x = 0. For an oscillation with hω ≫ 1, one application keeps the displacement,
// which counts if it is above the tolerance. The scheme damps the speed of the oscillation, but one application leaves so much of it that
// the steps would always resolve the oscillation. Therefore speeds are filtered twice.
void Alpha::filter(const System& system, Eigen::Ref<VectorXd> e, int times, Equations& eq) {
  work_ = e;
  for (int i = 0; i < times; ++i) {
    dp_.setZero();
    add_mass_times(system, eq, work_, dp_);
    mu_.setZero();
    solve(dp_, mu_);
    if (border_.cols() > 0) keep_slip(system, eq, VectorXd::Zero(border_.cols()), dp_);
    work_ = dp_;
  }
  e = work_;
}

// Difference between the step and the integrals of the parabola through v̇ at three nodes. At a start, with two nodes, the parabola that
// begins at v̇₀ with zero slope: a straight line would not show the error of the trapezoidal rule.
void Alpha::estimate(const System& system, Step& step, Equations& eq) {
  const Index n = system.n();
  const double h = step.h, h0 = step.from.memory.h;
  const VectorXd &y0 = step.from.state.y, &y1 = step.to.state.y, &d0 = step.from.dy, &d1 = step.to.dy;
  const VectorXd& before = step.from.memory.dy_before;
  step.error.resize(system.n_y());
  for (Index i = n; i < system.n_y(); ++i) {
    const double bend = h0 > 0 ? ((d1[i] - d0[i]) / h - (d0[i] - before[i]) / h0) / (h + h0) : (d1[i] - d0[i]) / (h * h);
    step.error[i] = y1[i] - y0[i] - h / 2 * (d0[i] + d1[i]) + bend * h * h * h / 6;
    if (i < 2 * n) step.error[i - n] = y1[i - n] - y0[i - n] - h * y0[i] - h * h * (d0[i] / 3 + d1[i] / 6) + bend * h * h * h * h / 12;
  }
  filter(system, step.error.head(n), 1, eq);
  filter(system, step.error.segment(n, n), 2, eq);
  if (system.n_x() == 0) return;
  double* x = step.error.data() + system.x_begin();
  for (int i = 0; i < 2; ++i) filter_internal_states(system, step.to.state, eq, kept_.s, x);
}

// With the forces F and P = M v̇ at both ends and w = Δs − ½h(v̇₀ + v̇₁), the energy of a linear system changes by ½h(s₀ + s₁)·½(P₀ + P₁) −
// Δq·½(F₀ + F₁) + ½(s₀ + s₁)·M w more than the trapezoidal rule for its powers gives.
void Alpha::book_loss(const System& system, const Equations& eq, Step& step) {
  const Index n = system.n();
  const double h = step.h;
  const VectorXd &y0 = step.from.state.y, &y1 = step.to.state.y;
  double gain = 0;
  const Memory &m0 = step.from.memory, &m1 = step.to.memory;
  for (Index i = 0; i < n; ++i)
    gain += 0.25 * h * (m0.P[i] + m1.P[i]) * (y0[n + i] + y1[n + i]) - 0.5 * (m0.F[i] + m1.F[i]) * (y1[i] - y0[i]);
  work_ = y1.segment(n, n) - y0.segment(n, n) - h / 2 * (step.from.dy + step.to.dy).segment(n, n);
  dp_.setZero();
  add_mass_times(system, eq, work_, dp_);
  gain += 0.5 * (y0.segment(n, n) + y1.segment(n, n)).dot(dp_);
  step.to.state.y[loss_] = y0[loss_] - gain;
}

bool Alpha::blame(const System& system, const Equations& eq, const char* what) {
  trouble_ = what;
  Index worst = 0;
  if (system.n_rows() > 0 && eq.C.cwiseProduct(system.row_scale).cwiseAbs().maxCoeff(&worst) > nearly) {
    std::size_t joint = 0;
    while (system.row_begin[joint + 1] <= worst) ++joint;
    if (joint < system.joint_names.size()) trouble_ += "; worst at the joint \"" + system.joint_names[joint] + "\"";
    return false;
  }
  if (dv_.size() == 0) return false;
  dv_.cwiseQuotient(unit_).cwiseAbs().maxCoeff(&worst);
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    if (worst / 3 == static_cast<Index>(b) || (worst >= system.eta_begin[b] && worst < system.eta_begin[b + 1]))
      trouble_ += "; worst at the body \"" + system.bodies[b].name + "\"";
  return false;
}

}  // namespace pintle
