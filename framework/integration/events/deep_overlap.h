#pragma once

#include <span>
#include <string>

#include "framework/integration/events/event.h"
#include "framework/integration/step.h"

namespace pintle {

/// Why the end of a step is impossible for rigid bodies. Empty: it is not. At a closed contact they overlap by more than a hundredth of the
/// smaller piece, and by more than they approach in a step h of time-stepping; or at an open one they have passed this depth in the step.
/// Drivers cause this, and bodies that are wedged.
/// @param from, to  guards of the contacts at the step's two ends
/// @param h         length of the fixed steps; 0: contacts are events [s]
std::string deep_overlap(const System&, const Step&, std::span<const Guard> from, std::span<const Guard> to, double h);

}  // namespace pintle
