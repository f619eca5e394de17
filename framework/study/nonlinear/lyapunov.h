#pragma once

#include <functional>

#include "framework/mechanism/model.h"
#include "framework/study/nonlinear/orbit.h"

namespace pintle {

struct LyapunovRun {
  int count = 1;
  double interval = 0;     ///< [s]
  long transient = 0;      ///< intervals in which neighbours turn to where they grow, and nothing is counted
  long intervals = 1;      ///< that are counted
  double distance = 1e-6;  ///< of neighbours, in coordinates over their scales
};

/// The greatest Lyapunov exponents of the motion from the integrator's state on, by neighbours, which are brought back to the distance, and
/// apart from each other, after each interval (Benettin and others, 1980). The integrator goes on to the end.
/// @throws OrbitTrouble  it cannot go on, or the phase space has fewer dimensions
void lyapunov_exponents(const Model&, Integrator&, const LyapunovRun&, const std::function<bool()>& go_on, Orbit& out);

}  // namespace pintle
