#include "framework/study/nonlinear/dimension.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {

namespace {

constexpr std::size_t most_points = 2000, theiler_window = 10;
constexpr double least_share = 1e-3, greatest_share = 2e-2;

/// The last points, each coordinate divided by its range; constant ones are left out. `same` becomes its largest ratio to a range.
std::vector<std::vector<double>> over_ranges(const std::vector<std::vector<double>>& points, double& same) {
  const std::size_t count = std::min(points.size(), most_points), first = points.size() - count;
  std::vector<std::vector<double>> out(count);
  double floor = 0;
  for (std::size_t i = 0; i < points[first].size(); ++i) {
    double least = points[first][i], greatest = least;
    for (std::size_t k = first; k < points.size(); ++k) least = std::min(least, points[k][i]), greatest = std::max(greatest, points[k][i]);
    const double range = greatest - least, unseen = same * std::max(std::abs(least), std::abs(greatest));
    if (!(range > unseen)) continue;
    floor = std::max(floor, unseen / range);
    for (std::size_t k = 0; k < count; ++k) out[k].push_back((points[first + k][i] - least) / range);
  }
  same = floor;
  return out;
}

std::vector<double> distances(const std::vector<std::vector<double>>& points) {
  std::vector<double> out;
  out.reserve(points.size() * points.size() / 2);
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + theiler_window + 1; b < points.size(); ++b) {
      double r = 0;
      for (std::size_t i = 0; i < points[a].size(); ++i) r = std::max(r, std::abs(points[a][i] - points[b][i]));
      out.push_back(r);
    }
  return out;
}

/// The distance below which this share of all distances lies.
double radius(std::vector<double>& all, double share) {
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(all.size()));
  std::ranges::nth_element(all, at);
  return *at;
}

}  // namespace

double correlation_dimension(const std::vector<std::vector<double>>& points, double same) {
  if (points.size() < least_of_dimension) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<double>> scaled = over_ranges(points, same);
  if (scaled[0].empty()) return 0;
  std::vector<double> all = distances(scaled);
  const double small = radius(all, least_share), large = radius(all, greatest_share);
  if (small <= same || large <= small) return 0;
  return std::log(greatest_share / least_share) / std::log(large / small);
}

}  // namespace pintle
