#pragma once

#include <vector>

#include "framework/scene/units/formula.h"

namespace pintle {

/// One comparison as a function that is above zero where it holds: what is greater less what is less.
struct Comparison {
  Program difference;
  Program size;          ///< the sum of what is compared, in magnitude
  bool at_zero = false;  ///< holds where the difference is 0
};

/// A condition, one comparison or several joined by &&, as all of these.
/// @throws ExpressionError  it is no such condition
std::vector<Comparison> comparisons(const Program&);

/// What can be told of a condition whatever its signals are, in times from 0 to `until`: from bounds of each comparison, and from two
/// that ask one thing to be above and below.
enum class Known { open, never, always };
Known known_of(const std::vector<Comparison>&, double until);

}  // namespace pintle
