#include "framework/integration/explicit/runge_kutta.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/archive.h"
#include "framework/integration/dense_output.h"

namespace pintle {

RungeKutta::RungeKutta(const System& system, const Tableau& tableau, Constraints constraints, double tolerance)
    : system_(system),
      traits_{.order = tableau.error_order + 1, .implicit = false, .follows_impacts = true, .ends_evaluated = true},
      tolerance_(tolerance),
      stages_(system, tableau, constraints) {}

// Does not skip the first period of any shape.
double RungeKutta::first_step(const Instant&, const ErrorNorm&, double) const {
  double h = std::numeric_limits<double>::infinity();
  for (const Body& b : system_.bodies)
    if (b.modes() > 0) h = std::min(h, 0.3 / b.flex->omega.maxCoeff());
  return h;
}

void RungeKutta::interpolate(const Step& step, double t, Eigen::VectorXd& y) const { interpolate_quintic(system_, step, t, y); }

bool RungeKutta::sample(const Step& step, double t, Equations& eq, State& out) {
  if (!reading_) {
    reading_ = std::make_unique<Reading>(Reading{Stages(system_, stages_.tableau(), stages_.constraints()), {}, {}});
    reading_->node.dy.setZero(system_.n_y());
  }
  auto& [stages, node, inner] = *reading_;
  stages.take_partition(stages_);
  const bool inside = t < step.to.state.t;
  bool found;
  if (inside && stages.tableau().order > 5) {
    if (inner.prepare(system_, step, stages, eq)) {
      inner.interpolate(step, t, node.state);
      found = stages.project(system_, node, eq);
    } else {
      found = stages.reach(system_, step.from, t - step.from.state.t, node, eq);
    }
  } else {
    if (inside) {
      begin_inside(step, t, node.state);
      interpolate_quintic(system_, step, t, node.state.y);
      stages_.refine_cubics(system_, step, node.state);
    } else {
      node.state = step.to.state;
    }
    found = stages.project(system_, node, eq);
  }
  if (found) out = node.state;
  return found;
}

namespace {
constexpr double few = 1e-9;  // a pivot at which accelerations have few accurate digits; pivots fall with the square of the distance
}

bool RungeKutta::near_singular(const Equations& eq) const {
  const Schur& S = eq.schur;
  return S.lost() > eq.permanent || (S.near_singular(eq.permanent) && S.kept() < few);
}

// At a distance u from a configuration where motions branch, accelerations are accurate to ω² ε/u³, where ε is the rounding of positions,
// and a step brings the part hω of this error into the motion. Returns the pivot, which falls as u², at which this meets the tolerance.
double RungeKutta::pivot_known(const Step& step) const {
  constexpr double rounding = 1e-16;
  const double turn = step.h * fastest_rate(system_, step.to.state.y);
  return std::max(few, std::pow(turn * turn * rounding / tolerance_, 2.0 / 3));
}

// If the step's end is about equally near, the cause is very different inertias, not the configuration.
bool RungeKutta::strayed_near_singular(const Step& step, const Equations& eq) const {
  constexpr double nearer = 0.1;
  return stages_.closest() < std::min(pivot_known(step), nearer * eq.schur.kept());
}

// The projection has removed the part of the error that the joints do not allow; near a singular configuration the stages give that part
// only a few accurate digits.
bool RungeKutta::attempt(double h, const ErrorNorm&, Step& step, Equations& eq) {
  constexpr double safety = 10;  // the estimate uses differences of stages
  if (!stages_.attempt(system_, h, step, eq)) return false;
  if (stages_.constraints() == Constraints::projection && stages_.closest() < safety * pivot_known(step))
    for (const int begin : {0, system_.n()}) keep_allowed(system_, eq, step.error.data() + begin);
  return step.error.allFinite();
}

StabilityLimits RungeKutta::stability_limits(const Step& step) const {
  constexpr double near = 0.9;
  constexpr double of_oscillation = 0.25;  // 0.2 to 0.5 of the limit on the real axis, and more with some damping
  const double reach = stages_.tableau().reach;
  const Stages::Stiffness now = stages_.stiffness(system_, step);
  return {.decay = now.decay > near * reach, .oscillation = now.oscillation > of_oscillation * reach};
}

void RungeKutta::save(Writer& out) const { out.whole(stages_); }
void RungeKutta::load(Reader& in) { in.whole(stages_); }

void RungeKutta::evaluate_end(const Step& step, Equations& eq) {
  Instant end = step.to;
  stages_.project(system_, end, eq);
}

}  // namespace pintle
