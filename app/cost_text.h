#pragma once

#include "framework/analysis/cost/cost_estimate.h"

namespace pintle::app {

/// Prints the cost estimate of a run and possible savings, for `pintle check`.
/// @param build_seconds  time spent on building the model
void print_cost(const CostEstimate&, double build_seconds);

}  // namespace pintle::app
