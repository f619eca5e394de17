#pragma once

#include <limits>
#include <vector>

#include "framework/common/time_law.h"

namespace pintle {

/// Where a law changes its course: the last moment of one course and the first of the next, a few roundings apart.
struct LawBreak {
  double before = 0, after = 0;  ///< [s]
  Jet left, right;               ///< the law there
};

/// The instants that a law of time has of its own.
struct LawScale {
  bool known = false;            ///< false: nothing is known of how the law is made, or it has too many
  std::vector<LawBreak> breaks;  ///< in order; ends of step(…) among them, though smooth
  std::vector<double> pieces;    ///< ends of the times in which it is as smooth as a polynomial of fifth degree, up to `until`
  double fastest = 0;            ///< greatest |rate| seen [1/s]
  double not_finite = std::numeric_limits<double>::quiet_NaN();  ///< the first moment seen at which the value is no number [s]
};

/// Of a formula found by its parts: roots of what its conditions, abs, min, max and step compare, and bounds of its rate over
/// whole intervals, so that no pulse is missed however short; of a table by its samples. Features below a thousandth of the
/// law's range about its mean slope do not count. Not known of a function of C++.
LawScale scale_of(const TimeLaw&, double until);

/// The value jumps, or the speed does. @param fastest  greatest |rate| of the law elsewhere
bool value_jumps(const LawBreak&);
bool speed_jumps(const LawBreak&, double fastest);

}  // namespace pintle
