#pragma once

#include "framework/dynamics/model/system.h"
#include "framework/integration/scheme.h"

namespace pintle {

/// Where a step from t must end for the sake of the laws of time: at a change of one, or at the end of the next piece. A method that
/// sees laws at the ends of its steps alone takes six steps at least through each bend: a polynomial of fifth degree may vanish at five of
/// these seven places, but not at all.
double law_end(const Scheme&, double t, bool sees_ends_alone = false);
/// The change at which t stands, before it is passed; nullptr if it stands at none.
const LawChange* change_at(const Scheme&, double t);

/// How long a step may be where laws or events read places, or a cam has a curve: until the fastest body has turned by a tenth of a
/// radian. A motion may be so smooth that its error lets a step pass over whole turns, and over all that happens in them.
class TurnAhead {
 public:
  explicit TurnAhead(const System&);
  /// Infinite where nothing reads places, or nothing turns [s].
  double time(const System&, const State&) const;

 private:
  bool matters_ = false;
};

}  // namespace pintle
