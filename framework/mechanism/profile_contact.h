#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Contact of two profiles: where they touch or are nearest, for an open bearing the eccentricity; forces of all pairs, and the largest.
struct ProfileContact {
  Gap gap;
  Eigen::Vector2d at{0, 0};
  double normal = 0, friction = 0, pressed = 0;
  double teeth = 0, travel = 0;  ///< of flanks: force on the rim of a, counter-clockwise [N]; displacement within the backlash [m]
  Wrench on_a = Wrench::Zero(), on_b = Wrench::Zero();
};
/// @param first  index of its first pair
ProfileContact profile_contact(const System&, std::size_t first, const State&, const Equations&);
/// Where the surfaces of one pair of profiles touch or are nearest; the equations hold the gap only of a pair that is near.
Eigen::Vector2d contact_place(const System&, std::size_t pair, const State&, const Equations&);

}  // namespace pintle
