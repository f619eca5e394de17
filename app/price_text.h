#pragma once

#include "framework/analysis/cost/price.h"

namespace pintle::app {

/// What a run will cost and what would save how much of it, as `pintle check` prints it.
/// @param build_seconds  spent on building the model
void print_price(const Price&, double build_seconds);

}  // namespace pintle::app
