#pragma once

#include <optional>
#include <vector>

#include "framework/common/signal_function.h"

namespace pintle {

/// Which limits of a formula: those of its value, or also those of its parts.
enum class Limits { of_value, all };

/// A formula of signals without its limits: a `min` or `max` of a varying and a fixed operand, and thus a `saturate`, is replaced by the
/// varying operand. @param fixed  which inputs are fixed  @returns nothing if it has no limits
std::optional<SignalFunction> unlimited(const SignalFunction&, const std::vector<bool>& fixed, Limits);

}  // namespace pintle
