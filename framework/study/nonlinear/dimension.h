#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

inline constexpr std::size_t least_of_dimension = 500;  ///< points; fewer give NaN

/// Grassberger and Procaccia's correlation dimension (1983) of points in the order of time: how the share C of pairs nearer than r grows
/// with r, between those r at which it is 0.001 and 0.02. Pairs up to ten points apart in time do not count (Theiler, 1986). Coordinates
/// are divided by their ranges; the distance is the largest difference. NaN for fewer than least_of_dimension; at most the last 2000 points
/// are used.
/// @param same  relative to the largest magnitude of each coordinate: closer points are equal. Returns 0 if the points repeat.
double correlation_dimension(const std::vector<std::vector<double>>& points, double same);

}  // namespace pintle
