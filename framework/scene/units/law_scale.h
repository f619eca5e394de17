#pragma once

#include <limits>
#include <vector>

#include "framework/common/time_law.h"

namespace pintle {

/// Where a law changes its branch: the last time of one branch and the first of the next, a few roundings apart.
struct LawBreak {
  double before = 0, after = 0;  ///< [s]
  Jet left, right;               ///< the law there
};

/// Special times of a law of time.
struct LawScale {
  bool known = false;            ///< false: the definition of the law is unknown, or it has too many
  std::vector<LawBreak> breaks;  ///< in order; includes the ends of step(…), although it is smooth there
  std::vector<double> pieces;    ///< ends of intervals in which it is as smooth as a polynomial of fifth degree, up to `until`
  double fastest = 0;            ///< largest |rate| found [1/s]
  double not_finite = std::numeric_limits<double>::quiet_NaN();  ///< first time found at which the value is not finite [s]
};

/// For a formula, from its parts: roots of what its conditions, abs, min, max and step compare, and bounds of its rate over intervals, so
/// that no pulse is missed, however short; for a table from its samples. Features smaller than a thousandth of the law's range around its
/// mean slope are ignored. Unknown for a C++ function.
/// @param most  how many intervals are looked at
LawScale scale_of(const TimeLaw&, double until, int most = 40'000);

/// The value jumps, or the speed does. @param fastest  largest |rate| of the law elsewhere
bool value_jumps(const LawBreak&);
bool speed_jumps(const LawBreak&, double fastest);

}  // namespace pintle
