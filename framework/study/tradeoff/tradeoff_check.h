#pragma once

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// Reads the scene as each value of each axis makes it. What the scene's reader refuses alone is tried beside the values of
/// the other axes (partitioning belongs to an explicit scheme); what it refuses beside all of them is wrong.
/// @throws SceneError  naming the study's file, line and key; the same for the overrides of the reference
void validate_settings(const StudyFile&, const TradePlan&);

}  // namespace pintle
