#pragma once

#include <vector>

namespace pintle {

/// A derivative, and how far it may be off.
struct Derivative {
  double value = 0, error = 0;  ///< NaN where there are no differences
};

/// From central differences with the steps h, h/2, h/4, …, by Richardson's extrapolation: of all that can be made of them that with
/// the least error: twice what its neighbours in the table show (Ridders 1982), and the rounding of the values. Noise in the values, which
/// grows as the step falls, is thus seen too.
/// @param plus, minus  values at x + h/2ᵏ and x − h/2ᵏ; levels after the first that is NaN are left out
Derivative derivative(double step, const std::vector<double>& plus, const std::vector<double>& minus);

}  // namespace pintle
