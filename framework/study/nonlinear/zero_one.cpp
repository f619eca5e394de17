#include "framework/study/nonlinear/zero_one.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/study/sweep/sampling.h"

namespace pintle {

namespace {

constexpr std::size_t most_counted = 2000;  // returns used
constexpr int frequencies = 100;
constexpr std::uint64_t seed = 1;

double mean_of(const std::vector<double>& x) {
  double out = 0;
  for (const double one : x) out += one / static_cast<double>(x.size());
  return out;
}

/// Mean square displacement over n steps of (p, q), the sums of x cos jc and x sin jc. @pre x has mean 0; a mean would make it oscillate
std::vector<double> displacement(const std::vector<double>& x, double c) {
  const std::size_t size = x.size(), cut = size / 10;
  std::vector<double> p(size + 1, 0.0), q(size + 1, 0.0), out;
  for (std::size_t j = 0; j < size; ++j) {
    const double angle = static_cast<double>(j + 1) * c;
    p[j + 1] = p[j] + x[j] * std::cos(angle), q[j + 1] = q[j] + x[j] * std::sin(angle);
  }
  for (std::size_t n = 1; n <= cut; ++n) {
    double sum = 0;
    for (std::size_t j = 1; j + cut <= size; ++j) sum += (p[j + n] - p[j]) * (p[j + n] - p[j]) + (q[j + n] - q[j]) * (q[j + n] - q[j]);
    out.push_back(sum / static_cast<double>(size - cut));
  }
  return out;
}

/// Correlation of y with its index. A variance of y below `least` squared counts as 0.
double correlation(const std::vector<double>& y, double least) {
  const double mean = mean_of(y), middle = (static_cast<double>(y.size()) + 1) / 2;
  double cross = 0, places = 0, values = least * least * static_cast<double>(y.size());
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double place = static_cast<double>(k + 1) - middle;
    cross += place * (y[k] - mean), places += place * place, values += (y[k] - mean) * (y[k] - mean);
  }
  return values == 0 ? 0 : cross / std::sqrt(places * values);
}

}  // namespace

double zero_one_test(const std::vector<double>& x, double same) {
  if (x.size() < least_of_zero_one) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> last(x.end() - static_cast<std::ptrdiff_t>(std::min(x.size(), most_counted)), x.end());
  const double mean = mean_of(last);
  for (double& one : last) one -= mean;
  Stream stream(seed, "0-1 test");
  std::vector<double> all;
  for (int k = 0; k < frequencies; ++k) {
    const double c = std::numbers::pi * (0.2 + 0.6 * stream.uniform());  // near 0 and pi it resonates with means and alternation
    all.push_back(correlation(displacement(last, c), same * same));
    if (!std::isfinite(all.back())) return all.back();
  }
  std::ranges::sort(all);
  return (all[frequencies / 2 - 1] + all[frequencies / 2]) / 2;
}

}  // namespace pintle
