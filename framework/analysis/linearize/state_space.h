#pragma once

#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"

namespace pintle {

/// Along the line between its two points, which it needs to be apart.
bool acts_along_a_line(const Force&);
/// Rows of C that drivers impose.
std::vector<int> driven_rows(const System&);

/// The state space of a small motion. Inputs: of each load that its law gives, the change of its force or torque; of
/// each driver, an offset of its law with its rate and acceleration. Outputs: place and angle of each body, place and
/// velocity of each recorded point, length and force of springs, angle and torque of torsion springs, eccentricity in
/// each clearance, and, where joint forces are unique, the effort of each driver.
/// @param system  the model's, the recorded points its last markers
StateSpace state_space(const Model&, const System& system, const MotionAt&, const FreeMotion&, const SmallMotion&,
                       const std::vector<std::string>& coordinates);

}  // namespace pintle
