#pragma once

#include "framework/dynamics/model/system.h"
#include "framework/integration/scheme.h"

namespace pintle {

/// Time at which a step from t must end because of the laws of time: a change of one, or the end of the next piece. A method that evaluates
/// laws only at the ends of its steps takes at least six steps through each bend: a polynomial of fifth degree may vanish at five of these
/// seven points, but not at all of them.
double law_end(const Scheme&, double t, bool sees_ends_alone = false);
/// The change at t, before it is passed; nullptr if there is none.
const LawChange* change_at(const Scheme&, double t);

/// Bound on the step if laws or events depend on positions, or a cam has a curve: until the fastest body has rotated by a tenth of a
/// radian. Otherwise error control may allow steps over whole revolutions of a smooth motion, past all events in them.
class TurnAhead {
 public:
  explicit TurnAhead(const System&);
  /// Infinite where nothing depends on positions, or nothing rotates [s].
  double time(const System&, const State&) const;

 private:
  bool matters_ = false;
};

}  // namespace pintle
