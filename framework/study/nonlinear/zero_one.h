#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

inline constexpr std::size_t least_of_zero_one = 200;  ///< returns; fewer give NaN

/// Gottwald and Melbourne's 0–1 test for chaos (2009): 0 if x is regular, 1 if it is chaotic; NaN for fewer than least_of_zero_one.
/// At most the last 2000 values are used.
/// @param same  smaller differences of x count as 0
double zero_one_test(const std::vector<double>& x, double same);

}  // namespace pintle
