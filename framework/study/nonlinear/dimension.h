#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

inline constexpr std::size_t least_of_dimension = 500;  ///< points, below which nothing is said

/// Grassberger and Procaccia's correlation dimension (1983) of points in the order of time: how the share C of pairs nearer than r grows
/// with r, between those r at which it is 0.001 and 0.02. Pairs up to ten apart in time do not count (Theiler, 1986). Coordinates are
/// taken over their ranges, distances by the largest. NaN of fewer than least_of_dimension; of more than 2000 the last count.
/// @param same  next to the largest magnitude of each coordinate: what is nearer is the same. 0 is returned of points that come again.
double correlation_dimension(const std::vector<std::vector<double>>& points, double same);

}  // namespace pintle
