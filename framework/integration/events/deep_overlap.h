#pragma once

#include <string>

#include "framework/dynamics/model/system.h"

namespace pintle {

/// Why the state is impossible for rigid bodies: at a closed contact they overlap by more than a hundredth of the smaller piece, and by
/// more than they approach in a step h of time-stepping. Empty: they do not. Drivers cause this, and bodies that are wedged.
/// @param h  length of the fixed steps; 0: contacts are events [s]
std::string deep_overlap(const System&, const State&, double h);

}  // namespace pintle
