#pragma once

#include <vector>

namespace pintle {

/// A derivative and its error estimate.
struct Derivative {
  double value = 0, error = 0;  ///< NaN if there are no differences
};

/// From central differences with the steps h, h/2, h/4, …, by Richardson extrapolation: of all entries the one with the smallest error
/// estimate, which is twice the difference to its neighbours in the table (Ridders 1982) plus the rounding of the values. This also detects
/// noise in the values, which small steps amplify.
/// @param plus, minus  values at x + h/2ᵏ and x − h/2ᵏ; levels from the first NaN on are ignored
Derivative derivative(double step, const std::vector<double>& plus, const std::vector<double>& minus);

}  // namespace pintle
