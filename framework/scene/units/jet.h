#pragma once

#include "framework/common/time_law.h"
#include "framework/scene/units/formula.h"

namespace pintle {

/// One operand; the chain rule to second order. Cannot fail: outside its domain a function gives NaN, as in <cmath>. At the kink of abs the
/// right-hand derivative is used.
Jet apply(Op, const Jet&);

/// Two operands. Comparisons give 1 or 0 with zero rates; min and max take the derivatives of the
/// operand they choose.
Jet apply(Op, const Jet&, const Jet&);

}  // namespace pintle
