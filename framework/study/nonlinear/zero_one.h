#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

inline constexpr std::size_t least_of_zero_one = 200;  ///< returns, below which the test says nothing

/// Gottwald and Melbourne's 0–1 test for chaos (2009): 0 where x is regular, 1 where it is chaotic; NaN of fewer than least_of_zero_one.
/// Of long lists the last 2000 count.
/// @param same  differences of x below it are none
double zero_one_test(const std::vector<double>& x, double same);

}  // namespace pintle
