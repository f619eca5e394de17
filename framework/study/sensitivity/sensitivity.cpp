#include "framework/study/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Values of one measure by case, from 0; NaN if there is none.
std::vector<double> values_of(const SensitivityPlan& plan, const std::vector<Row>& rows, std::size_t measure) {
  std::vector<double> out(plan.cases(), no_value);
  for (const Row& r : rows)
    if (r.status == "finished" && measure < r.values.size()) out[r.number - 1] = r.values[measure];
  return out;
}

std::vector<double> part(const std::vector<double>& values, std::size_t from, std::size_t count) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(from);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

std::vector<double> known(std::vector<double> values) {
  std::erase_if(values, [](double x) { return std::isnan(x); });
  return values;
}

Derivative slope(const SensitivityPlan& plan, const std::vector<double>& values, std::size_t parameter) {
  std::vector<double> plus, minus;
  for (std::size_t k = 0; k < plan.levels; ++k) {
    const std::size_t at = plan.first_difference() + 2 * (parameter * plan.levels + k);
    plus.push_back(values[at]), minus.push_back(values[at + 1]);
  }
  return derivative(plan.parameters[parameter].step, plus, minus);
}

std::optional<MeasureSensitivity::Scatter> scatter_of(std::vector<double> x) {
  if (x.size() < 2) return {};
  MeasureSensitivity::Scatter out{x.size(), 0, 0, 0, 0};
  const double n = static_cast<double>(x.size());
  for (const double v : x) out.mean += v / n;
  for (const double v : x) out.deviation += std::pow(v - out.mean, 2) / (n - 1);
  out.deviation = std::sqrt(out.deviation);
  std::ranges::sort(x);
  const auto quantile = [&](double p) {  // linear between the order statistics
    const double at = p * (n - 1);
    const auto k = std::min(static_cast<std::size_t>(at), x.size() - 2);
    return x[k] + (at - static_cast<double>(k)) * (x[k + 1] - x[k]);
  };
  out.low = quantile(0.025), out.high = quantile(0.975);
  return out;
}

SobolValues sobol_values(const SensitivityPlan& plan, const std::vector<double>& values) {
  const std::size_t n = plan.sobol, first = plan.first_sobol();
  SobolValues out{part(values, first, n), part(values, first + n, n), {}};
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) out.mixed.push_back(part(values, first + (2 + i) * n, n));
  return out;
}

}  // namespace

double Scattered::drawn(double u) const {
  if (spread == Spread::none) return at;
  return at + width * (spread == Spread::uniform ? 2 * u - 1 : normal_quantile(u));
}

double Scattered::reach() const { return spread == Spread::normal ? 3 * width : width; }

std::vector<MeasureSensitivity> sensitivities(const SensitivityPlan& plan, const std::vector<Row>& rows) {
  const std::vector<MeasureRange> ranges = measure_ranges(plan.sweep, rows);
  std::vector<MeasureSensitivity> out;
  for (std::size_t m = 0; m < plan.sweep.study.measures.size(); ++m) {
    const std::vector<double> values = values_of(plan, rows, m);
    MeasureSensitivity one{ranges[m].header, values[0], {}, 0};
    for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
      one.slopes.push_back(slope(plan, values, i));
      if (plan.parameters[i].width > 0) one.linear_worst += std::abs(one.slopes[i].value) * plan.parameters[i].reach();
    }
    if (const std::vector<double> x = known(part(values, plan.first_corner(), plan.corners)); !x.empty()) {
      const auto [least, greatest] = std::ranges::minmax(x);
      one.corners = {least, greatest};
    }
    one.scatter = scatter_of(known(part(values, plan.first_random(), plan.random)));
    if (plan.sobol > 0) one.shares = sobol_indices(sobol_values(plan, values), plan.sobol_seed);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace pintle
