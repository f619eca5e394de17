#include "framework/dynamics/model/belt_span.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/dynamics/model/forces.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using M = const MarkerMotion&;
using Gradient = Eigen::Matrix<double, 6, 1>;

/// The span: its length and direction t, the derivatives of e with respect to both poses, and the derivative of ∇e along n = Zt.
struct Span {
  double length, angle;
  Vector2d t;
  Gradient slope, bend;
};
Span span_of(const BeltSpan& s, M a, M b) {
  const Vector2d d = b.r - a.r;
  const double delta = s.radius_b - s.radius_a, apart = std::max(d.squaredNorm() - delta * delta, 0.0);
  Span out;
  out.length = std::sqrt(apart);
  const double tau = std::atan2(d.y(), d.x()) - std::atan2(delta, out.length);
  out.angle = s.turn + std::remainder(tau - s.turn, 2 * std::numbers::pi);
  out.t = {std::cos(out.angle), std::sin(out.angle)};
  const Vector2d n = perp(out.t);
  out.slope << -out.t, -s.radius_a, out.t, s.radius_b;
  out.bend << -n, 0, n, 0;
  return out;
}
Gradient rates(M a, M b) {
  Gradient out;
  out << a.v, a.w, b.v, b.w;
  return out;
}
double elongation(const BeltSpan& s, const Span& span, M a, M b) {
  return span.length - (s.radius_b - s.radius_a) * span.angle + s.radius_b * b.angle - s.radius_a * a.angle;
}

}  // namespace

Elongation elongation(const BeltSpan& s, M a, M b) {
  const Span span = span_of(s, a, b);
  return {elongation(s, span, a, b), span.slope.dot(rates(a, b))};
}

double tension(const BeltSpan& s, M a, M b) {
  const Elongation e = elongation(s, a, b);
  return e.value > s.loose ? std::max(0.0, s.k * (e.value - s.loose) + s.c * e.rate) : 0;
}

ForceEffect effect(const BeltSpan& s, M a, M b, double, const double*) {
  ForceEffect out;
  const Span span = span_of(s, a, b);
  const double stretch = elongation(s, span, a, b) - s.loose, rate = span.slope.dot(rates(a, b));
  if (!(stretch > 0)) return out;
  const double pull = std::max(0.0, s.k * stretch + s.c * rate);
  out.stored = 0.5 * s.k * stretch * stretch;
  out.dissipation = (pull - s.k * stretch) * rate;
  out.on_a = -pull * span.slope.head<3>();
  out.on_b = -pull * span.slope.tail<3>();
  return out;
}

WrenchPattern pattern(const BeltSpan& s) { return {{{{true, true}, {true, true}}}, s.c != 0}; }

// Tangent of −T ∇e: −∇e ∂T − T ∂∇e, with ∂∇e = bend bendᵀ / ℓ.
void curve(const BeltSpan& s, const ForceEffect& now, M a, M b, WrenchTangent& out) {
  const Span span = span_of(s, a, b);
  const double pull = -now.on_b.head<2>().dot(span.t);
  if (!(pull > 0) || span.length == 0) return;
  const Gradient along = s.k * span.slope + s.c * span.bend.dot(rates(a, b)) / span.length * span.bend;
  out.pose -= span.slope * along.transpose() + pull / span.length * span.bend * span.bend.transpose();
  out.rate -= s.c * span.slope * span.slope.transpose();
}

}  // namespace pintle
