#pragma once

#include <optional>
#include <string>

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// Refines the accuracy settings in an override of a scene: the last keys of its path and of the paths within its value. Counts of
/// elements, pieces and modes and limits of frequency are doubled, sizes halved.
/// @returns nothing if there are none
std::optional<std::string> refined(const std::string& path, const std::string& text);

/// The overrides with all accuracy settings refined; nothing if there are none.
std::optional<Overrides> refined(const Overrides&);

/// Overrides of all finest values, in the order of the axes; without those of `run` if `model_only`.
Overrides finest(const TradePlan&, bool model_only);

/// Overrides of one setting. @param at  value of each axis
Overrides setting(const TradePlan&, const std::vector<std::size_t>& at);

/// The tolerance of a setting.
double tolerance_of(const TradePlan&, const Overrides&);
Overrides with_tolerance(Overrides, double);

/// The k-th member of an ensemble of runs with nearly the tolerance of `set`; k = 0 is the setting itself. If a motion is chaotic, changing
/// the tolerance by two per cent gives another motion with the same statistics.
Overrides member(const TradePlan&, const Overrides& set, int k);

}  // namespace pintle
