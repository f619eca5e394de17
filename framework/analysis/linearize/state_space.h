#pragma once

#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"

namespace pintle {

/// It acts along the line between its two points, which must not coincide.
bool acts_along_a_line(const Force&);
/// Rows of C that drivers impose.
std::vector<int> driven_rows(const System&);

/// The state space of a small motion. Inputs: for each load with a given law, the change of its force or torque; for each driver, an offset
/// of its law with its rate and acceleration. Outputs: position and angle of each body, position and velocity of each recorded point,
/// length and force of springs, angle and torque of torsion springs, eccentricity in each clearance, and, where joint forces are unique,
/// the effort of each driver.
/// @param system  the model's system with the recorded points as its last markers
StateSpace state_space(const Model&, const System& system, const MotionAt&, const FreeMotion&, const SmallMotion&,
                       const std::vector<std::string>& coordinates);

}  // namespace pintle
