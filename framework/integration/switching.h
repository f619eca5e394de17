#pragma once

#include <string>

#include "framework/common/members.h"
#include "framework/integration/stepper.h"

namespace pintle {

/// When another method takes over for good, and why.
class Switching {
 public:
  /// Stages of a pair of high order stray far from the motion, too far where branches meet: the scheme's fallback takes over.
  bool falls_back(const Stepper&, const Scheme&, double t);
  /// An explicit pair whose accepted steps lie at the edge of its stability, one after another, is held by stability rather than
  /// accuracy: an implicit method takes over. Where none may, they are counted.
  bool held_by_stability(const Stepper&, const Scheme&, const Step&);
  /// A saved run goes on with the method that it had.
  void goes_on_with(const std::string& method);

  const std::string& why() const { return why_; }  ///< when and why it happened; else empty
  /// The part of the explicit steps that stability held, of those that were looked at; 0 of too few.
  double held_share() const { return looked_at_ < few ? 0 : static_cast<double>(at_limit_) / static_cast<double>(looked_at_); }

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(fallen_back_, held_, steps_, looked_at_, at_limit_, why_));
  }

 private:
  static constexpr long few = 64;

  bool fallen_back_ = false;
  int held_ = 0;                                   ///< steps, less those that were not
  long steps_ = 0, looked_at_ = 0, at_limit_ = 0;  ///< explicit, too long to switch by
  std::string why_;
};

}  // namespace pintle
