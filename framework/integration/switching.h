#pragma once

#include <string>

#include "framework/common/members.h"
#include "framework/integration/stepper.h"

namespace pintle {

/// Decides when another method takes over permanently, and why.
class Switching {
 public:
  /// Whether the scheme's fallback takes over: stages of a pair of high order deviate far from the motion, too far near branching points.
  bool falls_back(const Stepper&, const Scheme&, double t);
  /// Whether an implicit method takes over: the accepted steps of an explicit pair are repeatedly at its stability limit. If switching is
  /// not allowed, such steps are only counted.
  bool held_by_stability(const Stepper&, const Scheme&, const Step&);
  /// A saved run continues with its method.
  void goes_on_with(const std::string& method);

  const std::string& why() const { return why_; }  ///< when and why it happened; otherwise empty
  /// The share of the examined explicit steps that stability limited; 0 if too few.
  double held_share() const { return looked_at_ < few ? 0 : static_cast<double>(at_limit_) / static_cast<double>(looked_at_); }

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(fallen_back_, held_, steps_, looked_at_, at_limit_, why_));
  }

 private:
  static constexpr long few = 64;

  bool fallen_back_ = false;
  int held_ = 0;                                   ///< number of steps limited by stability minus those that were not
  long steps_ = 0, looked_at_ = 0, at_limit_ = 0;  ///< explicit steps; examined; limited
  std::string why_;
};

}  // namespace pintle
