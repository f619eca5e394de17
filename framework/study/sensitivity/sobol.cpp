#include "framework/study/sensitivity/sobol.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/study/sweep/sampling.h"

namespace pintle {

namespace {

constexpr int replicates = 1000;

struct FirstAndTotal {
  double first, total;
};

/// Estimates from the points `rows`, which a bootstrap may name several times.
FirstAndTotal estimate(const SobolValues& v, std::size_t input, const std::vector<std::size_t>& rows) {
  const double n = static_cast<double>(rows.size());
  double mean = 0, variance = 0, first = 0, total = 0;
  for (const std::size_t k : rows) mean += (v.a[k] + v.b[k]) / (2 * n);
  for (const std::size_t k : rows) {
    variance += (std::pow(v.a[k] - mean, 2) + std::pow(v.b[k] - mean, 2)) / (2 * n);
    first += (v.b[k] - mean) * (v.mixed[input][k] - v.a[k]) / n;
    total += std::pow(v.a[k] - v.mixed[input][k], 2) / (2 * n);
  }
  return {first / variance, total / variance};
}

Share share_with_interval(double value, std::vector<double> drawn) {
  std::ranges::sort(drawn);
  const auto at = [&](double p) { return drawn[static_cast<std::size_t>(std::lround(p * static_cast<double>(drawn.size() - 1)))]; };
  return {value, at(0.025), at(0.975)};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const SobolValues& v, std::uint64_t seed) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < v.a.size(); ++k)
    if (std::isfinite(v.a[k]) && std::isfinite(v.b[k]) && std::ranges::all_of(v.mixed, [&](const auto& m) { return std::isfinite(m[k]); }))
      rows.push_back(k);
  const bool varies = rows.size() > 1 && std::ranges::any_of(rows, [&](std::size_t k) { return v.a[k] != v.a[rows[0]]; });
  std::vector<SobolIndex> out(v.mixed.size(), {{nothing, nothing, nothing}, {nothing, nothing, nothing}});
  for (std::size_t i = 0; varies && i < out.size(); ++i) {
    Stream stream(seed, "bootstrap " + std::to_string(i));
    std::vector<double> first, total;
    std::vector<std::size_t> drawn(rows.size());
    for (int r = 0; r < replicates; ++r) {
      for (std::size_t& k : drawn) k = rows[stream.below(rows.size())];
      const FirstAndTotal one = estimate(v, i, drawn);
      if (std::isfinite(one.first)) first.push_back(one.first), total.push_back(one.total);
    }
    const FirstAndTotal all = estimate(v, i, rows);
    out[i] = {share_with_interval(all.first, first), share_with_interval(all.total, total)};
  }
  return out;
}

double normal_quantile(double u) {
  double low = -9, high = 9;
  for (int k = 0; k < 64; ++k) {
    const double x = (low + high) / 2;
    (0.5 * std::erfc(-x / std::numbers::sqrt2) < u ? low : high) = x;
  }
  return (low + high) / 2;
}

}  // namespace pintle
