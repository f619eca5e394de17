#pragma once

#include "framework/analysis/cost/cost_estimate.h"

namespace pintle::app {

/// What a run will cost and what would save how much of it, as `pintle check` prints it.
/// @param build_seconds  spent on building the model
void print_cost(const CostEstimate&, double build_seconds);

}  // namespace pintle::app
