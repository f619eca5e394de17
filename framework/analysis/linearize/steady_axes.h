#pragma once

#include <vector>

#include "framework/analysis/linearize/linearize.h"

namespace pintle {

/// Sizes of what is summed to M, D and K, as if nothing cancelled.
SmallMotion sizes(const FreeMotion&, const MotionAt&);

/// Chooses the axes in which the coefficients stay, and says in `out` how well they do.
FreeMotion in_steady_axes(const System&, const MotionAt& here, const std::vector<int>& offsets, Linearization& out);

}  // namespace pintle
