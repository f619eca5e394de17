#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "framework/integration/events/event.h"
#include "framework/integration/step.h"

/// Zeros of guards along the dense output of a step.
namespace pintle {

/// The time at which a guard becomes positive between two times of a step: Newton's method on the dense output; bisection where the rate is
/// unknown, leads out of the bracket, or would correct it by less than rounding.
template <class F>
double crossing(F guard, double t0, double t1, double fine) {
  const double f0 = guard(t0).value, f1 = guard(t1).value;
  if (f0 >= 0) return t0;
  double t = t0 - f0 * (t1 - t0) / (f1 - f0);
  for (int i = 0; i < 100; ++i) {
    const Guard now = guard(t);
    (now.value < 0 ? t0 : t1) = t;
    double next = t - now.value / now.rate;
    if (!(now.rate > 0 && next >= t0 && next <= t1)) next = t0 + (t1 - t0) / 2;
    if (std::abs(next - t) <= fine) return next;
    t = next;
  }
  return t;
}

/// A time at which a guard that rises at first and falls at last is positive in between: secants of the rate lead to its maximum.
template <class F>
std::optional<double> positive_between(F guard, double t0, double t1, double rate0, double rate1) {
  double low = t0, high = t1;
  for (int i = 0; i < 8; ++i) {
    const double t = low + (high - low) * rate0 / (rate0 - rate1);
    const Guard now = guard(t);
    if (now.value > 0) return t;
    if (now.value + std::max(now.rate * (high - t), now.rate * (low - t)) <= 0) break;  // then its maximum is not positive either
    (now.rate > 0 ? low : high) = t;
    (now.rate > 0 ? rate0 : rate1) = now.rate;
  }
  return std::nullopt;
}

/// Whether a guard that is negative at both ends of h may be positive in between: its cubic does not stay below zero by a tenth of its
/// change.
inline bool may_be_positive_between(const Guard& from, const Guard& to, double h) {
  constexpr double part = 0.1;
  const double a = h * from.rate, b = h * to.rate, d = to.value - from.value;
  const double change = std::abs(a) + std::abs(b) + std::abs(d);
  const double c3 = a + b - 2 * d, c2 = 3 * d - 2 * a - b;  // of from + a x + c2 x² + c3 x³
  const double root = c2 * c2 - 3 * c3 * a;
  if (!(root >= 0)) return false;
  const double q = -(c2 + std::copysign(std::sqrt(root), c2));
  for (const double x : {q / (3 * c3), a / q})
    if (x > 0 && x < 1 && from.value + x * (a + x * (c2 + x * c3)) > -part * change) return true;
  return false;
}

/// A time at which a value that is positive at three times is negative between them: parabolas through the last three points lead to its
/// minimum.
template <class F>
std::optional<double> below_zero_near(F value, std::array<double, 3> t, std::array<double, 3> f) {
  constexpr double near = 0.1;  // relative to its change
  const double begin = t[0], end = t[2];
  for (int i = 0; i < 4; ++i) {
    const double slope = (f[1] - f[0]) / (t[1] - t[0]), curve = ((f[2] - f[1]) / (t[2] - t[1]) - slope) / (t[2] - t[0]);
    const double least = (t[0] + t[1]) / 2 - slope / (2 * curve);
    if (!(curve > 0 && least > begin && least < end)) return std::nullopt;
    const double expected = f[0] + (least - t[0]) * (slope + curve * (least - t[1]));
    if (expected > near * (std::abs(f[1] - f[0]) + std::abs(f[2] - f[1]))) return std::nullopt;
    const double now = value(least);
    if (now < 0) return least;
    std::size_t farthest = 0;
    for (const std::size_t k : {1u, 2u})
      if (std::abs(t[k] - least) > std::abs(t[farthest] - least)) farthest = k;
    t[farthest] = least, f[farthest] = now;
  }
  return std::nullopt;
}

/// A time inside a step at which a value that is positive at its start is below −`clear`: at eighths of the step, or at the minima of
/// parabolas between them.
template <class F>
std::optional<double> below_zero_inside(F value, const Step& step, double at_start, double clear = 0) {
  constexpr int parts = 8;
  std::array<double, 3> t{0, 0, step.from.state.t}, left{0, 0, at_start + clear};
  const auto more = [&](double when) { return value(when) + clear; };
  for (int i = 1; i <= parts; ++i) {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(left.begin(), left.begin() + 1, left.end());
    t[2] = i < parts ? step.from.state.t + step.h * i / parts : step.to.state.t;
    left[2] = more(t[2]);
    if (left[2] < 0 && i < parts) return t[2];
    if (i == 1) continue;
    if (const std::optional<double> between = below_zero_near(more, t, left)) return between;
  }
  return std::nullopt;
}

/// The first time at which a guard, sampled in parts of a step, is positive.
template <class F>
std::optional<double> positive_in_parts(F guard, double t0, const Guard& at_t0, double t1) {
  constexpr int parts = 8;
  double begin = t0;
  Guard from = at_t0;
  for (int i = 1; i <= parts; ++i) {
    const double end = t0 + (t1 - t0) * i / parts;
    const Guard to = guard(end);
    if (to.value > 0) return end;
    if (from.rate > 0 && to.rate < 0)
      if (const std::optional<double> between = positive_between(guard, begin, end, from.rate, to.rate)) return between;
    begin = end, from = to;
  }
  return std::nullopt;
}

}  // namespace pintle
