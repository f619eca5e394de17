#pragma once

#include <vector>

#include "framework/scene/units/formula.h"

namespace pintle {

/// One comparison as a function that is positive where it holds: greater side minus lesser side.
struct Comparison {
  Program difference;
  Program size;          ///< the sum of the magnitudes compared
  bool at_zero = false;  ///< true where the difference is 0
};

/// A condition, one comparison or several joined by &&, as a list of these.
/// @throws ExpressionError  it is not such a condition
std::vector<Comparison> comparisons(const Program&);

/// What is known of a condition for any values of signals and times from 0 to `until`: from bounds of each comparison, and from pairs that
/// require a quantity to be both above one value and below another.
enum class Known { open, never, always };
Known known_of(const std::vector<Comparison>&, double until);

}  // namespace pintle
