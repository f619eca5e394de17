#include "framework/study/measures/path_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

double squared(double x) { return x * x; }

/// The curve between rows i and i + 1, s from 0 to 1.
struct CurvePiece {
  const Curve2& c;
  std::size_t i;
  double h() const { return c.t[i + 1] - c.t[i]; }
  double cubic(const std::vector<double>& p, const std::vector<double>& v, double s) const {
    const double r = 1 - s;
    return r * r * ((1 + 2 * s) * p[i] + s * h() * v[i]) + s * s * ((3 - 2 * s) * p[i + 1] - r * h() * v[i + 1]);
  }
  Passage at(double s, const std::array<double, 2>& to) const {
    const double x = cubic(c.x, c.vx, s), y = cubic(c.y, c.vy, s);
    return {c.t[i] + s * h(), x, y, std::hypot(x - to[0], y - to[1])};
  }
  /// The nearest position, by golden-section search: in a piece next to the nearest row the distance has one minimum.
  Passage nearest(const std::array<double, 2>& to) const {
    constexpr double golden = 0.6180339887498949;
    double a = 0, b = 1, u = 1 - golden, v = golden;
    Passage at_u = at(u, to), at_v = at(v, to);
    for (int k = 0; k < 60; ++k) {
      if (at_u.distance < at_v.distance)
        b = v, v = u, at_v = at_u, u = b - golden * (b - a), at_u = at(u, to);
      else
        a = u, u = v, at_u = at_v, v = a + golden * (b - a), at_v = at(v, to);
    }
    Passage best = at_u.distance < at_v.distance ? at_u : at_v;
    for (const double end : {0.0, 1.0})
      if (const Passage p = at(end, to); p.distance <= best.distance) best = p;
    return best;
  }
};

/// The nearest position on the pieces that meet at a row.
Passage nearest_about(const Curve2& c, std::size_t row, const std::array<double, 2>& to) {
  Passage best{c.t[row], c.x[row], c.y[row], std::hypot(c.x[row] - to[0], c.y[row] - to[1])};
  for (std::size_t i = row > 0 ? row - 1 : 0; i <= row && i + 1 < c.size(); ++i)
    if (const Passage p = CurvePiece{c, i}.nearest(to); p.distance < best.distance) best = p;
  return best;
}

struct RowChoice {
  double cost = endless;
  std::vector<std::size_t> rows;
};

/// Rows in ascending order, one for each point, with the least sum of squares: least[k][r] is for points up to k at rows up to r.
RowChoice in_order(const std::vector<std::array<double, 2>>& points, const Curve2& c) {
  const std::size_t n = points.size(), m = c.size();
  std::vector<double> least(m, 0), next(m);
  std::vector<std::vector<std::size_t>> chosen(n, std::vector<std::size_t>(m));
  for (std::size_t k = 0; k < n; ++k) {
    double best = endless;
    std::size_t at = 0;
    for (std::size_t r = 0; r < m; ++r) {
      const double cost = least[r] + squared(c.x[r] - points[k][0]) + squared(c.y[r] - points[k][1]);
      if (cost < best) best = cost, at = r;
      next[r] = best, chosen[k][r] = at;
    }
    std::swap(least, next);
  }
  RowChoice out{least[m - 1], std::vector<std::size_t>(n)};
  for (std::size_t k = n, r = m - 1; k-- > 0;) r = out.rows[k] = chosen[k][r];
  return out;
}

bool closes(const Curve2& c) {
  const auto [x0, x1] = std::ranges::minmax(c.x);
  const auto [y0, y1] = std::ranges::minmax(c.y);
  return std::hypot(c.x.back() - c.x.front(), c.y.back() - c.y.front()) <= 1e-6 * std::hypot(x1 - x0, y1 - y0);
}

/// The rows of the points, for any point that the curve may pass first.
std::vector<std::size_t> rows_in_order(const PathTarget& target, const Curve2& c) {
  const std::size_t n = target.through.size();
  const bool closed = closes(c);
  RowChoice best;
  std::vector<std::size_t> rows(n);
  for (const bool backwards : {false, true}) {
    if (backwards && target.order != Passing::either_way) continue;
    for (std::size_t first = 0; first < (closed ? n : 1); ++first) {
      std::vector<std::size_t> turn(n);
      for (std::size_t k = 0; k < n; ++k) turn[k] = backwards ? (2 * n - 1 - first - k) % n : (first + k) % n;
      std::vector<std::array<double, 2>> points(n);
      for (std::size_t k = 0; k < n; ++k) points[k] = target.through[turn[k]];
      const RowChoice found = in_order(points, c);
      if (!(found.cost < best.cost)) continue;
      best = found;
      for (std::size_t k = 0; k < n; ++k) rows[turn[k]] = found.rows[k];
    }
  }
  return rows;
}

std::size_t nearest_row(const Curve2& c, const std::array<double, 2>& to) {
  std::size_t best = 0;
  double least = endless;
  for (std::size_t r = 0; r < c.size(); ++r)
    if (const double d = squared(c.x[r] - to[0]) + squared(c.y[r] - to[1]); d < least) least = d, best = r;
  return best;
}

Passage at_time(const Curve2& c, double t, const std::array<double, 2>& to) {
  const auto after = std::ranges::upper_bound(c.t, t);
  const auto i = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - c.t.begin() - 1)), c.size() - 2);
  return CurvePiece{c, i}.at(std::clamp((t - c.t[i]) / (c.t[i + 1] - c.t[i]), 0.0, 1.0), to);
}

}  // namespace

double PathTarget::extent() const {
  double x0 = endless, x1 = -endless, y0 = endless, y1 = -endless;
  for (const auto& [x, y] : through) x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  return std::hypot(x1 - x0, y1 - y0);
}

std::vector<Passage> passages(const PathTarget& target, const Curve2& c) {
  std::vector<Passage> out;
  if (c.size() < 2) return out;
  if (!target.times.empty()) {
    const double slack = 1e-9 * c.t.back();
    if (std::ranges::max(target.times) > c.t.back() + slack) return out;
    for (std::size_t k = 0; k < target.through.size(); ++k) out.push_back(at_time(c, target.times[k], target.through[k]));
    return out;
  }
  std::vector<std::size_t> rows;
  if (target.order != Passing::any) rows = rows_in_order(target, c);
  for (std::size_t k = 0; k < target.through.size(); ++k)
    out.push_back(nearest_about(c, rows.empty() ? nearest_row(c, target.through[k]) : rows[k], target.through[k]));
  return out;
}

double rms_distance(const std::vector<Passage>& passed) {
  if (passed.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const Passage& p : passed) sum += squared(p.distance);
  return std::sqrt(sum / static_cast<double>(passed.size()));
}

}  // namespace pintle
