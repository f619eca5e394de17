#pragma once

#include <optional>

#include "framework/common/time_law.h"

namespace pintle {

/// A time from 0 to `until` at which a formula becomes infinite, as tan(t) does at π/2. Found from bounds of its values over intervals, so
/// that none is missed between samples.
/// @param rate  also checks its rate, not only its value
/// @returns nothing for laws that are not formulas
std::optional<double> pole_of(const TimeLaw&, double until, bool rate);

}  // namespace pintle
