#pragma once

#include <cmath>
#include <numbers>

#include "tests/oracles/exact_beam.h"

namespace pintle_oracle {

constexpr double pi = std::numbers::pi;
// Relative to the greatest of the terms summed, over a whole solution.
constexpr double rounding = 1e-11;
// A slope between two refinements, digits above rounding.
constexpr double order = 0.1;

/// Of unit length and mass; shear and stretch count.
inline ExactBeam soft() { return {.length = 1, .EA = 400, .EI = 1, .GA = 150, .rhoA = 1, .rhoI = 2.5e-3}; }
/// At rest along x.
inline BeamStart flat() { return rigid_start(Place::Zero()); }
inline Place tip(const Places& p) { return p.rightCols<1>(); }
inline double slope(double coarse, double fine) { return std::log2(std::abs(coarse) / std::abs(fine)); }

}  // namespace pintle_oracle
