#pragma once

#include <limits>

#include "framework/common/members.h"

namespace pintle {

/// One stay of a journal at its bearing's wall.
struct Impact {
  int contact;
  double begin;                                                  ///< [s]
  double end = std::numeric_limits<double>::quiet_NaN();         ///< [s]; NaN: still touching
  double approach;                                               ///< speed at begin, as latched [m/s]
  double separation = std::numeric_limits<double>::quiet_NaN();  ///< speed at end [m/s]
  double deepest = 0;                                            ///< [m]
  double peak_force = 0;                                         ///< normal; of a rigid contact while it is closed [N]
  double impulse = 0;                                            ///< of a rigid contact's impacts [N s]
  double lost = 0;                                               ///< to hysteresis and friction [J]
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(contact, begin, end, approach, separation, deepest, peak_force, impulse, lost));
  }
};

}  // namespace pintle
