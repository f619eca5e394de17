#include "framework/study/nonlinear/attractors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pintle {

namespace {

constexpr std::size_t most_returns = 500;  // of more, the last

/// The last returns, each signal divided by its range over all motions. A range of rounding counts as none.
std::vector<Returns> scaled(const std::vector<Returns>& motions) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), rounding = 1e-12;
  std::vector<double> least, most;
  for (const Returns& motion : motions)
    for (const std::vector<double>& one : motion) {
      least.resize(one.size(), infinity), most.resize(one.size(), -infinity);
      for (std::size_t i = 0; i < one.size(); ++i) least[i] = std::min(least[i], one[i]), most[i] = std::max(most[i], one[i]);
    }
  std::vector<Returns> out;
  for (const Returns& motion : motions) {
    Returns& last = out.emplace_back(motion.end() - static_cast<std::ptrdiff_t>(std::min(motion.size(), most_returns)), motion.end());
    for (std::vector<double>& one : last)
      for (std::size_t i = 0; i < one.size(); ++i) {
        const double range = most[i] - least[i], size = std::max(std::abs(most[i]), std::abs(least[i]));
        one[i] = range > rounding * size ? (one[i] - least[i]) / range : 0;
      }
  }
  return out;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::abs(a[i] - b[i]));
  return out;
}

/// Mean distance from a return of `from` to the nearest of `to`; to the nearest other one if they are the same.
double mean_distance(const Returns& from, const Returns& to) {
  double sum = 0;
  for (const std::vector<double>& a : from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& b : to)
      if (&a != &b) nearest = std::min(nearest, distance(a, b));
    sum += nearest;
  }
  return sum / static_cast<double>(from.size());
}

}  // namespace

std::vector<std::size_t> attractors(const std::vector<Returns>& motions, double tolerance) {
  const std::vector<Returns> all = scaled(motions);
  std::vector<std::size_t> first, count, out(all.size(), 0);  // the first motion of each attractor, and how many it has
  std::vector<double> spread;                                 // of the first motions
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].empty()) continue;
    const double own = all[k].size() > 1 ? mean_distance(all[k], all[k]) : 0;
    const auto same = [&](std::size_t group) {
      const Returns& other = all[first[group]];
      const double allowed = tolerance + 2 * std::max(own, spread[group]);
      return mean_distance(all[k], other) <= allowed && mean_distance(other, all[k]) <= allowed;
    };
    std::size_t group = 0;
    while (group < first.size() && !same(group)) ++group;
    if (group == first.size()) first.push_back(k), count.push_back(0), spread.push_back(own);
    ++count[group], out[k] = group + 1;
  }
  std::vector<std::size_t> order(first.size()), place(first.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return count[a] > count[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i + 1;
  for (std::size_t& one : out)
    if (one > 0) one = place[one - 1];
  return out;
}

ShareBounds share_bounds(std::size_t k, std::size_t n) {
  if (n == 0) return {};
  constexpr double z = 1.959963984540054;  // of 95 % on both sides
  const double count = static_cast<double>(n), p = static_cast<double>(k) / count, w = z * z / count;
  const double middle = (p + w / 2) / (1 + w), half = z / (1 + w) * std::sqrt(p * (1 - p) / count + w / (4 * count));
  return {k == 0 ? 0 : middle - half, k == n ? 1 : middle + half};
}

}  // namespace pintle
