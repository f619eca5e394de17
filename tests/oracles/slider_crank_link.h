#pragma once

#include <array>
#include <cmath>

#include "slider_crank_clearance.h"

/// The slider-crank of slider_crank_clearance.h with a massless link of the clearance's length between the two centres, hand-derived
/// in two coordinates: the crank's angle θ and the link's direction ψ, from bearing to journal. Bearing on the slider, crank free.
///
///   l₂ sin φ = c sin ψ − l₁ sin θ          x = l₁ cos θ + l₂ cos φ − c cos ψ
///   Gᵀ M (G p̈ + g) = Gᵀ f                  p = (θ, ψ), (θ̇, φ̇, ẋ) = G ṗ, with M and f of the mechanism cut at the pin
namespace pintle_oracle {

struct LinkMotion {
  double theta, psi, phi, x;  ///< [rad], [m]
  double phi_rate, x_rate;    ///< [rad/s], [m/s]
  double theta_acceleration, psi_acceleration, x_acceleration;
  double tension;  ///< of the link, from the slider's balance along x [N]; cos ψ ≠ 0
  double energy;   ///< kinetic and gravity [J]
};

/// @param y  θ, ψ and their rates
inline LinkMotion link_motion(const Params& p, const std::array<double, 4>& y) {
  const double l1 = p.crank, l2 = p.coupler, c = p.clearance;
  const double s1 = std::sin(y[0]), c1 = std::cos(y[0]), sp = std::sin(y[1]), cp = std::cos(y[1]), dt = y[2], dp = y[3];
  LinkMotion m{};
  m.theta = y[0], m.psi = y[1];
  const double s2 = (c * sp - l1 * s1) / l2, c2 = std::sqrt(1 - s2 * s2);
  m.phi = std::asin(s2);
  m.x = l1 * c1 + l2 * c2 - c * cp;

  const double phi_t = -l1 * c1 / (l2 * c2), phi_p = c * cp / (l2 * c2);
  m.phi_rate = phi_t * dt + phi_p * dp;
  const double df = m.phi_rate, phi_g = (-c * sp * dp * dp + l1 * s1 * dt * dt + l2 * s2 * df * df) / (l2 * c2);
  const double x_t = -l1 * s1 - l2 * s2 * phi_t, x_p = -l2 * s2 * phi_p + c * sp;
  m.x_rate = x_t * dt + x_p * dp;
  const double x_g = -l2 * s2 * phi_g - l1 * c1 * dt * dt - l2 * c2 * df * df + c * cp * dp * dp;

  const double m11 = p.crank_inertia + (p.crank_mass / 4 + p.coupler_mass) * l1 * l1;
  const double m22 = p.coupler_inertia + p.coupler_mass * l2 * l2 / 4, m33 = p.slider_mass;
  const double half = p.coupler_mass * l1 * l2 / 2, m12 = half * (c1 * c2 + s1 * s2), turn = half * (s1 * c2 - c1 * s2);
  const double w1 = (p.crank_mass / 2 + p.coupler_mass) * p.gravity * l1, w2 = p.coupler_mass * p.gravity * l2 / 2;
  const double f1 = -turn * df * df - w1 * c1 - m12 * phi_g;
  const double f2 = turn * dt * dt - w2 * c2 - m22 * phi_g;
  const double f3 = -m33 * x_g;

  const double a = m11 + 2 * m12 * phi_t + m22 * phi_t * phi_t + m33 * x_t * x_t;
  const double b = m12 * phi_p + m22 * phi_t * phi_p + m33 * x_t * x_p;
  const double d = m22 * phi_p * phi_p + m33 * x_p * x_p;
  const double r1 = f1 + phi_t * f2 + x_t * f3, r2 = phi_p * f2 + x_p * f3;
  const double det = a * d - b * b;
  m.theta_acceleration = (d * r1 - b * r2) / det;
  m.psi_acceleration = (a * r2 - b * r1) / det;
  m.x_acceleration = x_t * m.theta_acceleration + x_p * m.psi_acceleration + x_g;
  m.tension = m33 * m.x_acceleration / cp;
  m.energy = 0.5 * m11 * dt * dt + m12 * dt * df + 0.5 * m22 * df * df + 0.5 * m33 * m.x_rate * m.x_rate + w1 * s1 + w2 * s2;
  return m;
}

/// θ, ψ and their rates after a span [s], tightly integrated.
std::array<double, 4> link_after(const Params&, const std::array<double, 4>& y, double span);

}  // namespace pintle_oracle
