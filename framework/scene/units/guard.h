#pragma once

#include <vector>

#include "framework/scene/units/formula.h"

namespace pintle {

/// A condition, one comparison or several joined by &&, as functions all of which are above zero where it holds: of each comparison
/// what is greater less what is less.
/// @throws ExpressionError  it is no such condition
std::vector<Program> comparisons(const Program&);

}  // namespace pintle
