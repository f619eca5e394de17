#pragma once

#include <vector>

#include "framework/analysis/linearize/linearize.h"

namespace pintle {

/// Sizes of the terms summed for M, D and K, without cancellation.
SmallMotion sizes(const FreeMotion&, const MotionAt&);

/// Chooses the axes in which the coefficients are constant, and records in `out` how constant they are.
FreeMotion in_steady_axes(const System&, const MotionAt& here, const std::vector<int>& offsets, Linearization& out);

}  // namespace pintle
