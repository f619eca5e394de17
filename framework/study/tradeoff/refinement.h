#pragma once

#include <optional>
#include <string>

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// What an override of a scene says about fidelity: the last keys of its path and of the paths within its value.
/// Counts of elements, pieces and modes and bounds of frequency are doubled, sizes halved.
/// @returns nothing where there is nothing of the kind
std::optional<std::string> refined(const std::string& path, const std::string& text);

/// The overrides with everything in them refined that can be; nothing if that is nothing.
std::optional<Overrides> refined(const Overrides&);

/// Overrides of all finest values, in the order of the axes; without those of `run` if `model_only`.
Overrides finest(const TradePlan&, bool model_only);

/// Overrides of one setting. @param at  value of each axis
Overrides setting(const TradePlan&, const std::vector<std::size_t>& at);

/// The tolerance that a setting has.
double tolerance_of(const TradePlan&, const Overrides&);
Overrides with_tolerance(Overrides, double);

/// Runs with nearly the tolerance of `set`: the k-th of an ensemble, k = 0 the setting itself. Where a motion is chaotic
/// two per cent of a tolerance make another motion with the same statistics.
Overrides member(const TradePlan&, const Overrides& set, int k);

}  // namespace pintle
