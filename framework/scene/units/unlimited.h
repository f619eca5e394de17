#pragma once

#include <optional>
#include <vector>

#include "framework/common/signal_function.h"

namespace pintle {

/// Which limits of a formula: those of its value, or also those of its parts.
enum class Limits { of_value, all };

/// A formula of signals without limits: each `min` or `max` of something that moves and something fixed, and so each `saturate`, gives
/// what moves. @param fixed  which inputs do not move  @returns nothing where it has no limits
std::optional<SignalFunction> unlimited(const SignalFunction&, const std::vector<bool>& fixed, Limits);

}  // namespace pintle
