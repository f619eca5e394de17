#include "framework/integration/step_control.h"

#include <algorithm>
#include <cmath>

#include "framework/integration/stepper.h"

namespace pintle {

StepControl::Try StepControl::next(double left) const {
  const bool last = h_ >= left * (1 - short_part);  // so that no remainder too short to resolve accelerations is left
  return {last ? left : h_, last};
}

void StepControl::rejected(double h, double error, int order, double least_part) {
  h_ = h * (std::isnan(error) ? 0.2 : std::max(least_part, 0.9 * std::pow(error, -1.0 / order)));
}

void StepControl::accepted(const Try& made, double error, const StepperTraits& stepper) {
  const double order = stepper.order;
  const double grow = 0.9 * std::pow(error, -0.7 / order) * std::pow(error_before_, 0.4 / order);
  error_before_ = std::max(error, 1e-4);
  double next = made.h * std::clamp(grow, 0.2, 5.0);
  if (next > stepper.least_change * made.h && next < stepper.least_growth * made.h) next = made.h;
  if (!made.last || next < h_) h_ = next;
  h_ = std::min(h_, max_step_);
}

}  // namespace pintle
