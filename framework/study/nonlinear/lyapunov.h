#pragma once

#include <functional>
#include <string>

#include "framework/mechanism/model.h"
#include "framework/study/nonlinear/orbit.h"

namespace pintle {

struct LyapunovRun {
  int count = 1;
  double interval = 0;     ///< [s]
  long transient = 0;      ///< intervals before counting, in which neighbours align with the directions of growth
  long intervals = 1;      ///< counted
  double distance = 1e-6;  ///< of neighbours, in scaled coordinates
};

/// The largest Lyapunov exponents of the motion from the integrator's state on. After each interval the neighbours are orthogonalised and
/// brought back to the distance (Benettin and others, 1980). The integrator moves to the end.
/// @returns why they are in doubt; empty if they are not
/// @throws OrbitTrouble  it cannot continue, or the phase space has fewer dimensions
std::string lyapunov_exponents(const Model&, Integrator&, const LyapunovRun&, const std::function<bool()>& go_on, Orbit& out);

}  // namespace pintle
