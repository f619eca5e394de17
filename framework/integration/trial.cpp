#include "framework/integration/trial.h"

#include <algorithm>
#include <vector>

#include "framework/common/worse.h"
#include "framework/integration/step_control.h"

namespace pintle {

double trial_pace(std::string_view method, const System& system, const Scheme& scheme, const ErrorNorm& norm, const Equations& present,
                  const Instant& from, double h, const std::function<double(const State&)>& ahead, long tries) {
  constexpr double least_part = 0.2;
  constexpr std::size_t few = 16;
  Equations eq(system);
  eq.permanent = present.permanent, eq.law_sides = present.law_sides;
  const std::unique_ptr<Stepper> stepper = make_stepper(method, system, scheme, eq);
  const StepperTraits& traits = stepper->traits();
  StepControl control(scheme.max_step);
  control.wish_for(control.bounded(h));
  Step step{.from = from, .to = from, .error = Eigen::VectorXd::Zero(system.n_y())};
  if (!stepper->project(step.from, eq)) return 0;
  struct Mark {
    double t;
    long cost;
  };
  std::vector<Mark> marks{{from.state.t, cost_of(eq, traits.implicit)}};
  for (long k = 0; k < tries; ++k) {
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
    marks.push_back({step.from.state.t, cost_of(eq, traits.implicit)});
  }
  if (marks.size() <= few) return 0;
  const Mark &begin = marks[marks.size() / 2], &end = marks.back();
  return (end.t - begin.t) / static_cast<double>(std::max(1L, end.cost - begin.cost));
}

}  // namespace pintle
