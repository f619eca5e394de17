#pragma once

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// Reads the scene with each value of each axis. A value that the scene's reader rejects alone is tried with the values of the other axes
/// (partitioning needs an explicit scheme); one that it rejects with all of them is an error.
/// @throws SceneError  naming the study's file, line and key; likewise for the overrides of the reference
void validate_settings(const StudyFile&, const TradePlan&);

/// Columns of tradeoff.csv besides those of axes and measures, without units.
std::vector<std::string> own_columns();

}  // namespace pintle
