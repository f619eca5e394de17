#pragma once

#include <algorithm>

#include "framework/common/members.h"

namespace pintle {

struct StepperTraits;

/// The step-size controller: proportional and integral in the logarithm of the error [HairerWanner1996, IV.2].
class StepControl {
 public:
  explicit StepControl(double max_step) : max_step_(max_step) {}

  /// The next step's length unless something shortens it; 0: not chosen yet [s].
  double wish() const { return h_; }
  void wish_for(double h) { h_ = h; }
  double bounded(double h) const { return h < max_step_ ? h : max_step_; }
  /// Discards the error history where it no longer applies.
  void forget_errors() { error_before_ = 1; }

  struct Try {
    double h;
    bool last;  ///< ends at the bound, and may be shorter than accuracy requires
  };
  /// A step of at most `left` that leaves no remainder too short to be a step.
  Try next(double left) const;
  /// @param least_part  least part of h for the next try
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
