#pragma once

#include <limits>

#include "framework/common/members.h"

namespace pintle {

/// One contact of a journal with its bearing's wall.
struct Impact {
  int contact;
  double begin;                                                  ///< [s]
  double end = std::numeric_limits<double>::quiet_NaN();         ///< [s]; NaN: still touching
  double approach;                                               ///< speed at begin, as latched [m/s]
  double separation = std::numeric_limits<double>::quiet_NaN();  ///< speed at end [m/s]
  double deepest = 0;                                            ///< [m]
  double peak_force = 0;                                         ///< normal; for a rigid contact while it is closed [N]
  double impulse = 0;                                            ///< of the impacts of a rigid contact [N s]
  double lost = 0;                                               ///< to hysteresis and friction [J]
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(contact, begin, end, approach, separation, deepest, peak_force, impulse, lost));
  }
};

}  // namespace pintle
