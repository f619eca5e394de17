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
  /// accuracy: an implicit method takes over.
  bool held_by_stability(const Stepper&, const Scheme&, const Step&);
  /// A saved run goes on with the method that it had.
  void goes_on_with(const std::string& method);

  const std::string& why() const { return why_; }  ///< when and why it happened; else empty

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(fallen_back_, held_, why_));
  }

 private:
  bool fallen_back_ = false;
  int held_ = 0;  ///< steps, less those that were not
  std::string why_;
};

}  // namespace pintle
