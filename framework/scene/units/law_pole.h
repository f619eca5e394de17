#pragma once

#include <optional>

#include "framework/common/time_law.h"

namespace pintle {

/// A moment from 0 to `until` at which a formula grows beyond all bounds, as tan(t) does at π/2. Found by bounds of its values
/// over whole intervals, so that none is missed between samples.
/// @param rate  its rate counts too, not only its value
/// @returns nothing of laws that are no formulas
std::optional<double> pole_of(const TimeLaw&, double until, bool rate);

}  // namespace pintle
