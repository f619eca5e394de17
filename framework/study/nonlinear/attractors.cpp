#include "framework/study/nonlinear/attractors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pintle {

namespace {

constexpr std::size_t most_compared = 500;  // of more, the last

std::vector<double> ranges_of(const std::vector<SettledMotion>& motions) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> least, most;
  for (const SettledMotion& motion : motions)
    for (const std::vector<double>& one : motion.returns) {
      least.resize(one.size(), infinity), most.resize(one.size(), -infinity);
      for (std::size_t i = 0; i < one.size(); ++i) least[i] = std::min(least[i], one[i]), most[i] = std::max(most[i], one[i]);
    }
  for (std::size_t i = 0; i < least.size(); ++i) most[i] -= least[i];
  return most;
}

/// Distances between the returns of two motions.
class Metric {
 public:
  Metric(const SettledMotion& a, const SettledMotion& b, const std::vector<double>& range, double equal) {
    for (std::size_t i = 0; i < range.size(); ++i) {
      const double size = std::max(a.largest[i], b.largest[i]);
      scale_.push_back(std::max(std::min(range[i], size), least_motion)), none_.push_back(std::max(equal * size, least_motion));
    }
  }

  /// Mean distance from a return of `from` to the nearest of `to`; to the nearest other one if they are the same.
  double mean(const Returns& from, const Returns& to) const {
    double sum = 0;
    for (const std::vector<double>& a : from) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::vector<double>& b : to)
        if (&a != &b) nearest = std::min(nearest, between(a, b));
      sum += nearest;
    }
    return sum / static_cast<double>(from.size());
  }

 private:
  double between(const std::vector<double>& a, const std::vector<double>& b) const {
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (const double off = std::abs(a[i] - b[i]); off > none_[i]) out = std::max(out, off / scale_[i]);
    return out;
  }

  std::vector<double> scale_, none_;  ///< of each signal
};

}  // namespace

std::vector<std::size_t> attractors(const std::vector<SettledMotion>& motions, const Nearness& nearness) {
  const std::vector<double> range = ranges_of(motions);
  std::vector<SettledMotion> all = motions;
  for (SettledMotion& one : all)
    if (one.returns.size() > most_compared) one.returns.erase(one.returns.begin(), one.returns.end() - most_compared);
  std::vector<std::size_t> first, count, out(all.size(), 0);  // the first motion of each attractor, and how many it has
  std::vector<double> spread;                                 // of the first motions
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Returns& returns = all[k].returns;
    if (returns.empty()) continue;
    const double own = returns.size() > 1 ? Metric(all[k], all[k], range, nearness.equal).mean(returns, returns) : 0;
    const auto same = [&](std::size_t group) {
      const SettledMotion& other = all[first[group]];
      const Metric metric(all[k], other, range, nearness.equal);
      const double allowed = nearness.tolerance + 2 * std::max(own, spread[group]);
      return metric.mean(returns, other.returns) <= allowed && metric.mean(other.returns, returns) <= allowed;
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
