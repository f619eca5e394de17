#include "hertz_bounce.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pintle_oracle {
namespace {

/// (−ln(1 − z) − z)/z² = 1/2 + z/3 + z²/4 + …
double log_rest(double z) {
  if (std::abs(z) > 0.1) return (-std::log1p(-z) - z) / (z * z);
  double sum = 0;
  for (int i = 18; i >= 0; --i) sum = sum * z + 1.0 / (i + 2);
  return sum;
}

/// G from the distance w = 1 − u to the onset; no cancellation near it.
double from_onset(double chi, double w) {
  const double p = w / (1 + chi);
  return p - p * p * log_rest(chi * p);
}

/// G from the distance w = u + e to the rebound.
double from_rebound(double chi, double e, double w) {
  const double p = w / (1 - chi * e);
  return e * p - p * p * log_rest(-chi * p);
}

double depth_from(const Bounce& b, double g) {
  const double n1 = b.exponent + 1;
  return std::pow(n1 * b.mass * b.speed * b.speed / b.stiffness * std::max(0.0, g), 1 / n1);
}

/// ∫₀^length f(w) dw by tanh–sinh, f possibly infinite at w = 0; f sees the distance w exactly.
template <class F>
double quadrature(const F& f, double length) {
  const double step = 1.0 / 64;
  double sum = 0;
  for (int i = -64 * 6; i <= 64 * 6; ++i) {
    const double x = i * step, s = 0.5 * std::numbers::pi * std::sinh(x);
    const double w = length / (1 + std::exp(-2 * s));
    const double weight = 0.5 * length * 0.5 * std::numbers::pi * std::cosh(x) / (std::cosh(s) * std::cosh(s));
    if (w > 0 && weight > 0) sum += weight * f(w);
  }
  return sum * step;
}

}  // namespace

double restitution(double chi) {
  if (chi == 0) return 1;
  double low = 0, high = std::min(1.0, 1 / chi);
  for (int i = 0; i < 100; ++i) {
    const double e = 0.5 * (low + high);
    (from_onset(chi, 1 + e) > 0 ? low : high) = e;
  }
  return 0.5 * (low + high);
}

double depth_at(const Bounce& b, double u) { return depth_from(b, from_onset(b.chi, 1 - u)); }

double deepest(const Bounce& b) { return depth_at(b, 0); }

double peak_force(const Bounce& b) {
  const auto force = [&](double u) { return b.stiffness * std::pow(depth_at(b, u), b.exponent) * (1 + b.chi * u); };
  double low = 0, high = 1;
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  for (int i = 0; i < 80; ++i) {
    const double x = high - golden * (high - low), y = low + golden * (high - low);
    if (force(x) > force(y))
      high = y;
    else
      low = x;
  }
  return force(0.5 * (low + high));
}

double time_to_deepest(const Bounce& b) {
  const auto slowness = [&](double w) { return 1 / (std::pow(depth_from(b, from_onset(b.chi, w)), b.exponent) * (1 + b.chi * (1 - w))); };
  return b.mass * b.speed / b.stiffness * quadrature(slowness, 1);
}

double duration(const Bounce& b) {
  const double e = restitution(b.chi);
  const auto slowness = [&](double w) {
    return 1 / (std::pow(depth_from(b, from_rebound(b.chi, e, w)), b.exponent) * (1 + b.chi * (w - e)));
  };
  return time_to_deepest(b) + b.mass * b.speed / b.stiffness * quadrature(slowness, e);
}

double loss(const Bounce& b) {
  const double e = restitution(b.chi);
  return 0.5 * b.mass * b.speed * b.speed * (1 - e) * (1 + e);
}

}  // namespace pintle_oracle
