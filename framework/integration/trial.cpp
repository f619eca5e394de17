#include "framework/integration/trial.h"

#include "framework/common/worse.h"
#include "framework/integration/step_control.h"

namespace pintle {

double trial_pace(std::string_view method, const System& system, const Scheme& scheme, const ErrorNorm& norm, const Equations& present,
                  const Instant& from, double h, const std::function<double(const State&)>& ahead, long tries) {
  constexpr double least_part = 0.2;
  Equations eq(system);
  eq.permanent = present.permanent, eq.law_sides = present.law_sides;
  const std::unique_ptr<Stepper> stepper = make_stepper(method, system, scheme, eq);
  const StepperTraits& traits = stepper->traits();
  StepControl control(scheme.max_step);
  control.wish_for(control.bounded(h));
  Step step{.from = from, .to = from, .error = Eigen::VectorXd::Zero(system.n_y())};
  if (!stepper->project(step.from, eq)) return 0;
  double begin = from.state.t;
  long begin_cost = cost_of(eq, traits.implicit);
  for (long k = 0; k < tries; ++k) {
    if (k == tries / 2) begin = step.from.state.t, begin_cost = cost_of(eq, traits.implicit);
    const double left = ahead(step.from.state);
    if (!(left > 0)) break;
    const StepControl::Try now = control.next(left);
    if (!stepper->attempt(now.h, norm, step, eq)) {
      control.failed(now.h, least_part);
    } else if (const double error = worse(1e-10, norm.of(step, traits.follows_impacts)); !(error <= 1)) {
      control.rejected(now.h, error, traits.order, least_part);
    } else {
      control.accepted(now, error, traits);
      stepper->accept(eq);
      std::swap(step.from, step.to);
    }
  }
  const long cost = cost_of(eq, traits.implicit) - begin_cost;
  return cost > 0 ? (step.from.state.t - begin) / static_cast<double>(cost) : 0;
}

}  // namespace pintle
