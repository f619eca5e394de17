// Generalised-α between the nodes of a step: for rows of results, frames and samples.
#include "framework/dynamics/equations/internal.h"
#include "framework/integration/dense_output.h"
#include "framework/integration/implicit/alpha.h"

namespace pintle {

using Eigen::Index;

void Alpha::begin_beside(Alpha& other) {
  kkt_.forget();
  lent_ = other.factored_ ? &other.kkt_ : nullptr;
  factored_ = other.factored_, tired_ = other.tired_;
  kept_ = other.kept_;
  rate_ = 1;
  length_ = other.length_, speed_ = other.speed_;
}

void Alpha::evaluate_between(const System& system, const Step& step, const State& state, Equations& eq) {
  const double x = step.h > 0 ? (state.t - step.from.state.t) / step.h : 1;
  evaluate_at(system, state, step.to.dy, step.to.memory.lambda, eq);
  if (x >= 1 || step.from.memory.lambda.size() != eq.lambda.size()) return;
  eq.a += (1 - x) * (step.from.dy - step.to.dy).segment(system.n(), system.n());
  eq.lambda += (1 - x) * (step.from.memory.lambda - step.to.memory.lambda);
}

void Alpha::interpolate_between(const System& system, const Step& step, double t, State& out, Equations& eq) {
  begin_inside(step, t, out);
  interpolate_cubic(system, step, t, out.y);
  const double x = (t - step.from.state.t) / step.h;
  if (factored_ && x > 0 && x < 1) soften_bend(system, step, x, out, eq);
  if (system.n_x() > 0) interpolate_internal(system, step, x, out, eq);
}

// For a stiff coordinate the cubic's curvature is of size h s, which times ω² gives a spurious force: it is filtered through the iteration
// matrix, as steps are.
void Alpha::soften_bend(const System& system, const Step& step, double x, State& out, Equations& eq) {
  const Index n = system.n();
  work_ = (1 - x) * step.from.state.y.head(n) + x * step.to.state.y.head(n);
  dv_ = out.y.head(n) - work_;
  out.y.head(n) = work_;
  pose(system, out.t, out.y, eq);
  update_mass(system, out.y, eq);
  mu_.setZero();
  visit_jacobian(eq, [&](int row, int column, double value) { mu_[row] += value * dv_[column]; });
  dp_.setZero();
  add_mass_times(system, eq, dv_, dp_);
  solve(dp_, mu_);
  out.y.head(n) += dp_;
}

// If x were interpolated on its own, it would deviate from the motion by the interpolation error, which a stiff law turns into a force. So
// x is chosen such that its rate is the one interpolated between the nodes: where the law is stiff it follows the configuration, otherwise
// it stays as interpolated.
void Alpha::interpolate_internal(const System& system, const Step& step, double x, State& out, Equations& eq) {
  const Index n_x = system.n_x(), begin = system.x_begin();
  pose(system, out.t, out.y, eq);
  speed(system, out.t, out.y, eq);
  own_.tail(n_x) = out.y.segment(begin, n_x) - step.h * ((1 - x) * step.from.dy + x * step.dy_end()).segment(begin, n_x);
  follow_internal_states(system, eq, out, step.h, own_.data() + system.n(), out.y.data() + begin);
}

}  // namespace pintle
