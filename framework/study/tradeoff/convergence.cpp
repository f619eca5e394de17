#include "framework/study/tradeoff/convergence.h"

#include <algorithm>
#include <cmath>

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

Ladder validate_ladder(const std::vector<double>& values, double cap, double scale) {
  Ladder out;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) out.differences.push_back(std::abs(values[i + 1] - values[i]));
  const std::vector<double>& d = out.differences;
  const std::size_t n = d.size();
  if (n == 0) return out;
  const double tiny = 1e-12 * std::abs(scale) + 1e-300, last = d[n - 1], before = n > 1 ? d[n - 2] : last;
  out.rounding = n > 1 && std::max(last, before) <= tiny;
  if (n == 1) {
    out.error = last;
    return out;
  }
  const double mean = std::pow(std::max(d[0], tiny) / std::max(last, tiny), 1.0 / static_cast<double>(n - 1));
  // A first difference that is small by chance must not hide that all later ones fall.
  const double late = std::max(before, tiny) / std::max(last, tiny);
  const double fall = std::max(mean, n > 2 ? late : mean);
  out.falling = !out.rounding && fall >= 2 && last <= 0.5 * *std::max_element(d.begin(), d.end() - 1);
  out.error = std::max(last, before);
  if (out.falling) {
    out.ratio = fall;
    const double counted = std::clamp(mean, 2.0, cap);
    out.error = 3 * std::max(last, before / cap) / (counted - 1);
  }
  return out;
}

Sample sample_of(const std::vector<double>& values) {
  Sample s;
  for (const double v : values)
    if (std::isfinite(v)) s.mean += v, ++s.count;
  if (s.count == 0) return {NAN, NAN, NAN, 0};
  const auto n = static_cast<double>(s.count);
  s.mean /= n;
  for (const double v : values)
    if (std::isfinite(v)) s.deviation += (v - s.mean) * (v - s.mean);
  s.deviation = s.count > 1 ? std::sqrt(s.deviation / (n - 1)) : 0;
  s.error = s.deviation / std::sqrt(n);
  return s;
}

namespace {

/// Columns of positions and angles, with their ranges in `a`.
std::vector<std::pair<std::size_t, double>> motion_columns(const Table& a) {
  std::vector<std::pair<std::size_t, double>> out;
  for (std::size_t c = 0; c < a.columns(); ++c) {
    if (!a.header[c].ends_with("[m]") && !a.header[c].ends_with("[rad]")) continue;
    double least = INFINITY, most = -INFINITY;
    for (std::size_t i = 0; i < a.rows(); ++i) {
      least = std::min(least, a.data[i * a.columns() + c]);
      most = std::max(most, a.data[i * a.columns() + c]);
    }
    if (most - least > 1e-12) out.emplace_back(c, most - least);
  }
  return out;
}

}  // namespace

Parting parting(const Run& one, const Run& other) {
  const Table &a = one.trajectory, &b = other.trajectory;
  if (a.header != b.header || a.columns() == 0) return {};
  const auto columns = motion_columns(a);
  const std::size_t rows = std::min(a.rows(), b.rows());
  if (rows < 20 || columns.empty()) return {};
  Parting out;
  double n = 0, st = 0, sl = 0, stt = 0, stl = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    double far = 0;
    for (const auto& [c, range] : columns) far = std::max(far, std::abs(a.data[i * a.columns() + c] - b.data[i * b.columns() + c]) / range);
    if (i < rows / 20) out.first = std::max(out.first, far);
    out.last = std::max(out.last, far);
    if (far < 1e-14 || out.last > 0.03) continue;  // rounding; saturated
    const double t = a.data[i * a.columns()], l = std::log(far);
    n += 1, st += t, sl += l, stt += t * t, stl += t * l;
  }
  if (const double spread = n * stt - st * st; n >= 8 && spread > 0) out.rate = (n * stl - st * sl) / spread;
  return out;
}

}  // namespace pintle
