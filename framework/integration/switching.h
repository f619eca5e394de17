#pragma once

#include <string>

#include "framework/common/members.h"
#include "framework/integration/stepper.h"

namespace pintle {

/// Decides when another method takes over, and why. Costs are those of `cost_of`, so the decisions do not depend on the machine.
class Switching {
 public:
  /// Whether the scheme's fallback takes over: stages of a pair of high order deviate far from the motion, too far near branching points.
  bool falls_back(const Stepper&, const Scheme&, double t);
  /// Whether an implicit method should be tried: the accepted steps of an explicit pair are repeatedly at its stability limit. After each
  /// answer, four times as many steps are awaited. If switching is not allowed, such steps are only counted.
  bool held_by_stability(const Stepper&, const Scheme&, const Step&, long cost);
  /// The time per cost of the steps that stability limited [s].
  double pace() const { return pace_; }
  /// The implicit method takes over from the pair. @param cheaper  by this factor
  void go_implicit(const Stepper& pair, const Step&, double cheaper, long cost);
  /// Whether that pair takes over again: over many steps, the implicit method has gained little on it.
  bool goes_back(const Stepper&, double t, long cost);
  const std::string& pair() const { return pair_; }
  double step_of_pair() const { return step_of_pair_; }  ///< when the implicit method took over [s]
  /// A saved run continues with its method.
  void goes_on_with(const std::string& method);

  const std::string& why() const { return why_; }        ///< when and why it happened; otherwise empty
  bool went_implicit() const { return !pair_.empty(); }  ///< at some time
  /// The share of the examined explicit steps that stability limited; 0 if too few.
  double held_share() const { return looked_at_ < few ? 0 : static_cast<double>(at_limit_) / static_cast<double>(looked_at_); }

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(fallen_back_, held_, steps_, looked_at_, at_limit_, why_, patience_, implicit_steps_, changes_, mark_t_, mark_cost_,
                     pace_, step_of_pair_, pair_));
  }

 private:
  static constexpr long few = 64;
  void add(const std::string& change);

  bool fallen_back_ = false;
  int held_ = 0;                                   ///< number of steps limited by stability minus those that were not
  long steps_ = 0, looked_at_ = 0, at_limit_ = 0;  ///< explicit steps; examined; limited
  std::string why_;
  int patience_ = 30, implicit_steps_ = 0, changes_ = 0;
  double mark_t_ = 0;                   ///< the pace is measured from here [s] …
  long mark_cost_ = 0;                  ///< … and from this cost
  double pace_ = 0, step_of_pair_ = 0;  ///< [s]
  std::string pair_;                    ///< name of the pair that the implicit method took over from
};

}  // namespace pintle
