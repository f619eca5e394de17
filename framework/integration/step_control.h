#pragma once

#include <algorithm>

#include "framework/common/members.h"

namespace pintle {

struct StepperTraits;

/// The step-size controller: proportional and integral in the logarithm of the error [HairerWanner1996, IV.2].
class StepControl {
 public:
  explicit StepControl(double max_step) : max_step_(max_step) {}

  /// The next step's length if nothing cuts it short; 0: to be chosen [s].
  double wish() const { return h_; }
  void wish_for(double h) { h_ = h; }
  double bounded(double h) const { return h < max_step_ ? h : max_step_; }
  /// The errors of steps before tell nothing of the next one's.
  void forget_errors() { error_before_ = 1; }

  struct Try {
    double h;
    bool last;  ///< ends at the bound, and may be shorter than accuracy asks for
  };
  /// A step of at most `left`, with no rest after it that is too short to be a step.
  Try next(double left) const;
  /// @param least_part  of h that the next try has at the least
  void failed(double h, double least_part) { h_ = h * std::max(0.25, least_part); }
  void rejected(double h, double error, int order, double least_part);
  void accepted(const Try&, double error, const StepperTraits&);

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(h_, error_before_, max_step_));
  }
  bool sound() const { return h_ >= 0 && error_before_ > 0; }

 private:
  double max_step_, h_ = 0, error_before_ = 1;
};

}  // namespace pintle
