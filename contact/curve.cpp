#include "contact/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pintle {

namespace {

using Eigen::Vector2d;

double outer(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
double turn_from(const Vector2d& a, const Vector2d& b) { return std::atan2(outer(a, b), a.dot(b)); }

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// Rows lower x_{i−1} + diagonal x_i + upper x_{i+1} = right, solved in place.
void solve_tridiagonal(const std::vector<double>& lower, std::vector<double> diagonal, const std::vector<double>& upper, Columns& right) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  const auto of = [](const std::vector<double>& v, Eigen::Index i) { return v[static_cast<std::size_t>(i)]; };
  for (Eigen::Index i = 1; i < n; ++i) {
    const double w = of(lower, i) / of(diagonal, i - 1);
    diagonal[static_cast<std::size_t>(i)] -= w * of(upper, i - 1);
    right.row(i) -= w * right.row(i - 1);
  }
  right.row(n - 1) /= diagonal.back();
  for (Eigen::Index i = n - 2; i >= 0; --i) right.row(i) = (right.row(i) - of(upper, i) * right.row(i + 1)) / of(diagonal, i);
}

// Second derivatives at the points of a periodic spline: the closing row is a rank-one update (Sherman and Morrison).
std::vector<Vector2d> periodic_bends(const std::vector<double>& h, const std::vector<Vector2d>& slope) {
  const std::size_t n = h.size();
  std::vector<double> lower(n), diagonal(n);
  Columns x(static_cast<Eigen::Index>(n), 3);
  x.setZero();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    lower[i] = h[before], diagonal[i] = 2 * (h[before] + h[i]);
    x.row(static_cast<Eigen::Index>(i)).head<2>() = 6 * (slope[i] - slope[before]).transpose();
  }
  const double closing = h[n - 1], gamma = -diagonal[0];
  diagonal[0] -= gamma, diagonal[n - 1] -= closing * closing / gamma;
  const Eigen::Index last = static_cast<Eigen::Index>(n) - 1;
  x(0, 2) = gamma, x(last, 2) = closing;
  solve_tridiagonal(lower, diagonal, h, x);
  const auto v = [&](Eigen::Index column) { return x(0, column) + closing / gamma * x(last, column); };
  const Vector2d part = Vector2d(v(0), v(1)) / (1 + v(2));
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i <= n; ++i) {
    const auto row = static_cast<Eigen::Index>(i % n);
    out.emplace_back(x.row(row).head<2>().transpose() - x(row, 2) * part);
  }
  return out;
}

// In an open spline, the third derivative is continuous at the second and at the last but one point.
std::vector<Vector2d> open_bends(const std::vector<double>& h, const std::vector<Vector2d>& slope) {
  const std::size_t n = h.size() - 1;  // inner points
  std::vector<double> lower(n), diagonal(n), upper(n);
  Columns x(static_cast<Eigen::Index>(n), 3);
  x.setZero();
  for (std::size_t i = 0; i < n; ++i) {
    lower[i] = h[i], diagonal[i] = 2 * (h[i] + h[i + 1]), upper[i] = h[i + 1];
    x.row(static_cast<Eigen::Index>(i)).head<2>() = 6 * (slope[i + 1] - slope[i]).transpose();
  }
  const double first = h[0] / h[1], last = h[n] / h[n - 1];  // m₀ = (1 + first) m₁ − first m₂
  diagonal[0] += h[0] * (1 + first), upper[0] -= h[0] * first;
  diagonal[n - 1] += h[n] * (1 + last), lower[n - 1] -= h[n] * last;
  solve_tridiagonal(lower, diagonal, upper, x);
  const auto inner = [&](std::size_t i) { return Vector2d(x.row(static_cast<Eigen::Index>(i)).head<2>().transpose()); };
  std::vector<Vector2d> out{(1 + first) * inner(0) - first * inner(1)};
  for (std::size_t i = 0; i < n; ++i) out.push_back(inner(i));
  out.emplace_back((1 + last) * inner(n - 1) - last * inner(n - 2));
  return out;
}

}  // namespace

SmoothCurve::SmoothCurve(std::vector<Vector2d> points, bool closed) : points_(std::move(points)), knots_{0} {
  const std::size_t n = points_.size(), count = closed ? n : n - 1;
  std::vector<double> h;
  std::vector<Vector2d> slope;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d chord = points_[(i + 1) % n] - points_[i];
    h.push_back(chord.norm());
    slope.emplace_back(chord / h.back());
    knots_.push_back(knots_.back() + h.back());
  }
  const std::vector<Vector2d> m = closed ? periodic_bends(h, slope) : open_bends(h, slope);
  for (std::size_t i = 0; i < count; ++i)
    cubics_.push_back({points_[i], slope[i] - h[i] / 6 * (2 * m[i] + m[i + 1]), m[i], (m[i + 1] - m[i]) / h[i]});
}

CurvePoint SmoothCurve::at(double s) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const Cubic& c = cubics_[i];
  const double t = s - knots_[i];
  const Vector2d first = c.d + t * (c.m + t / 2 * c.j), second = c.m + t * c.j;
  const double speed = first.norm();
  return {c.p + t * (c.d + t / 2 * (c.m + t / 3 * c.j)), first / speed, outer(first, second) / (speed * speed * speed), speed};
}

// The cross product of first and second derivative is d × m + (d × j) t + ½ (m × j) t².
std::vector<double> SmoothCurve::inflections() const {
  constexpr double at_knot = 1e-6;  // of a segment
  std::vector<double> out;
  for (std::size_t i = 0; i < cubics_.size(); ++i) {
    const Cubic& c = cubics_[i];
    const double h = knots_[i + 1] - knots_[i], p = outer(c.d, c.m), q = outer(c.d, c.j), r = outer(c.m, c.j) / 2;
    const double root = q * q - 4 * p * r;
    if (!(root > 0)) continue;
    const double w = -(q + std::copysign(std::sqrt(root), q)) / 2;
    std::vector<double> here;
    for (const double t : {p / w, w / r})  // at a knot it may be found from both segments
      if (t > -at_knot * h && t < (1 + at_knot) * h) here.push_back(knots_[i] + std::clamp(t, 0.0, h));
    std::ranges::sort(here);
    out.insert(out.end(), here.begin(), here.end());
  }
  return out;
}

namespace {
constexpr double most_turn = std::numbers::pi / 4;
}  // namespace

CurveSpan::CurveSpan(std::shared_ptr<const SmoothCurve> curve, double begin, double end)
    : curve_(std::move(curve)), begin_(begin), end_(end), at_begin_(curve_->at(begin)), at_end_(curve_->at(end)) {
  turn_ = turn_from(at_begin_.along, at_end_.along);
  const double length = curve_->length();
  double most = 1 / length;
  const auto look_at = [&](double s) { most = std::max(most, std::abs(curve_->at(s).curvature)); };
  for (int i = 0; i <= 8; ++i) look_at(begin + i * (end - begin) / 8);
  for (const double s : curve_->knots())
    if (s > begin && s < end) look_at(s);
  least_radius_ = 1 / most;
  const auto reach = [&](const CurvePoint& p) {
    const double bend = std::abs(p.curvature);
    return (bend * length > most_turn ? most_turn / bend : length) / p.speed;
  };
  first_bend_ = begin - reach(at_begin_), last_bend_ = end + reach(at_end_);
}

CurvePoint CurveSpan::beyond(const CurvePoint& end, double past, double bends_until) const {
  const double on_arc = (past < 0 ? std::max(past, bends_until) : std::min(past, bends_until)) * end.speed, turn = end.curvature * on_arc,
               half = turn / 2;
  const double chord = on_arc * (std::abs(half) < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half);
  const Vector2d left(-end.along.y(), end.along.x());
  const Vector2d along = std::cos(turn) * end.along + std::sin(turn) * left;
  const double straight = past * end.speed - on_arc;
  return {end.at + chord * (std::cos(half) * end.along + std::sin(half) * left) + straight * along, along,
          straight == 0 ? end.curvature : 0, end.speed};
}

CurvePoint CurveSpan::at(double s) const {
  if (s < begin_) return beyond(at_begin_, s - begin_, first_bend_ - begin_);
  if (s > end_) return beyond(at_end_, s - end_, last_bend_ - end_);
  return curve_->at(s);
}

std::vector<double> CurveSpan::numbers() const {
  std::vector<double> out{begin_, end_, static_cast<double>(curve_->knots().size())};
  for (const Vector2d& p : curve_->points()) out.push_back(p.x()), out.push_back(p.y());
  return out;
}

namespace {

// Angle of the left turn from `begin` along a curve that bends in one direction, in steps of a sixteenth of a segment.
struct Turning {
  const SmoothCurve& curve;
  std::vector<double> s, turn;
  Turning(const SmoothCurve& of, double begin, double end) : curve(of), s{begin}, turn{0} {
    std::vector<double> stops{begin};
    for (const double k : of.knots())
      if (k > begin && k < end) stops.push_back(k);
    stops.push_back(end);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i)
      for (int part = 1; part <= 16; ++part) {
        const double next = part == 16 ? stops[i + 1] : stops[i] + (stops[i + 1] - stops[i]) * part / 16;
        turn.push_back(turn.back() + turn_from(of.at(s.back()).along, of.at(next).along));
        s.push_back(next);
      }
  }
  // The parameter at which this fraction of the whole turn is reached.
  double at_part(double part) const {
    const double wanted = part * turn.back();
    std::size_t i = 1;
    while (i + 1 < s.size() && std::abs(turn[i]) < std::abs(wanted)) ++i;
    const double step = turn[i] - turn[i - 1];
    return step == 0 ? s[i] : s[i - 1] + (s[i] - s[i - 1]) * std::clamp((wanted - turn[i - 1]) / step, 0.0, 1.0);
  }
};

}  // namespace

std::vector<CurveSpan> spans_of(const std::shared_ptr<const SmoothCurve>& curve) {
  constexpr double straight = 1e-6;  // [rad]; a smaller bend is due to rounding of the points
  std::vector<double> cuts{0};
  for (const double s : curve->inflections())
    if (std::abs(Turning(*curve, cuts.back(), s).turn.back()) > straight) cuts.push_back(s);
  if (cuts.size() > 1 && std::abs(Turning(*curve, cuts.back(), curve->length()).turn.back()) <= straight) cuts.pop_back();
  cuts.push_back(curve->length());
  std::vector<CurveSpan> out;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Turning turning(*curve, cuts[i], cuts[i + 1]);
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(turning.turn.back()) / most_turn - 1e-9)));
    double from = cuts[i];
    for (int part = 1; part <= parts; ++part) {
      const double to = part == parts ? cuts[i + 1] : turning.at_part(static_cast<double>(part) / parts);
      out.emplace_back(curve, from, to);
      from = to;
    }
  }
  return out;
}

}  // namespace pintle
