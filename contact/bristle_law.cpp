#include "contact/bristle_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pintle {

namespace {

double sign_of(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

// exp(−(v/scale)²) and its derivative.
struct Bell {
  double value, slope;
};
Bell bell(double v, double scale) {
  const double x = v / scale, value = std::exp(-x * x);
  return {value, -2 * x / scale * value};
}

Bell stribeck_curve(const LuGre& law, double v) {
  const Bell falls = bell(v, law.stribeck);
  const double more = law.mu_static - law.mu;
  return {law.mu + more * falls.value, more * falls.slope};
}

}  // namespace

BristleForce bend(const LuGre& law, double v, const double* x) {
  const double z = x[0], speed = std::abs(v);
  const Bell g = stribeck_curve(law, v), damping = bell(v, law.damping_speed);
  const double c = law.damping * damping.value, decay = law.stiffness * speed / g.value,
               d_decay = law.stiffness / g.value * (sign_of(v) - speed * g.slope / g.value), rate = v - decay * z,
               rate_d_speed = 1 - d_decay * z;
  BristleForce out;
  out.force = -(law.stiffness * z + c * rate + law.viscous * v);
  out.d_speed = -(law.damping * damping.slope * rate + c * rate_d_speed + law.viscous);
  out.d_state[0] = -(law.stiffness - c * decay);
  out.rate[0] = rate;
  out.rate_d_speed[0] = rate_d_speed;
  out.rate_d_state[0][0] = -decay;
  return out;
}

BristleForce bend(const Gonthier& law, double v, const double* x) {
  const double z = x[0], dwell = x[1], more = law.mu_static - law.mu, stiffness = law.stiffness, damping = law.damping;
  const Bell s = bell(v, law.stribeck);
  const double slides = (law.mu * sign_of(v) - stiffness * z) / damping, pace = s.value >= dwell ? 1 / law.dwell : stiffness / damping;
  BristleForce out;
  out.rate = {s.value * v + (1 - s.value) * slides, pace * (s.value - dwell)};
  out.rate_d_speed = {s.value + s.slope * (v - slides), pace * s.slope};
  out.rate_d_state[0][0] = -(1 - s.value) * stiffness / damping;
  out.rate_d_state[1][1] = -pace;
  const double bristles = stiffness * z + damping * out.rate[0], most = law.mu + more * dwell;
  if (std::abs(bristles) <= most) {
    out.force = -(bristles + law.viscous * v);
    out.d_speed = -(damping * out.rate_d_speed[0] + law.viscous);
    out.d_state[0] = -s.value * stiffness;
  } else {
    out.force = -(std::copysign(most, bristles) + law.viscous * v);
    out.d_speed = -law.viscous;
    out.d_state[1] = -std::copysign(more, bristles);
  }
  return out;
}

SteadyFriction steady_friction(const LuGre& law, double speed) {
  const Bell g = stribeck_curve(law, speed);
  return {g.value + law.viscous * speed, g.slope + law.viscous};
}

// ż = 0: σ0 z = μ + σ1 v s/(1 − s), s/(1 − s) = 1/(exp(v²/v_s²) − 1), clipped with d = s.
SteadyFriction steady_friction(const Gonthier& law, double speed) {
  const Bell s = bell(speed, law.stribeck);
  const double x = speed / law.stribeck, more = law.mu_static - law.mu, odds = std::expm1(x * x);
  const double bent = speed > 0 ? law.damping * speed / odds : std::numeric_limits<double>::infinity();
  if (bent >= more * s.value) return {law.mu + more * s.value + law.viscous * speed, more * s.slope + law.viscous};
  const double slope = std::isfinite(odds) ? law.damping * (1 - 2 * x * x * (odds + 1) / odds) / odds : 0;
  return {law.mu + bent + law.viscous * speed, slope + law.viscous};
}

double critical_damping(double stiffness) { return 2 * std::sqrt(stiffness / 9.81); }

double gentle_damping_speed(double mu, double damping) {
  return damping > 0 ? std::sqrt(2 * std::numbers::e) * mu / damping : std::numeric_limits<double>::infinity();
}

}  // namespace pintle
