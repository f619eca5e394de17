#include <cmath>

#include "runge_kutta.h"
#include "slider_crank_clearance.h"

namespace pintle_oracle {
namespace {

/// φ and x as functions of θ, with their first two derivatives, from the closed loop.
struct Loop {
  double s1, c1, s2, c2, phi, phi1, phi2, x, x1, x2;
  Loop(const Params& p, double angle)
      : s1(std::sin(angle)),
        c1(std::cos(angle)),
        s2(-p.crank * s1 / p.coupler),
        c2(std::sqrt(1 - s2 * s2)),
        phi(std::asin(s2)),
        phi1(-p.crank * c1 / (p.coupler * c2)),
        phi2((p.crank * s1 + p.coupler * s2 * phi1 * phi1) / (p.coupler * c2)),
        x(p.crank * c1 + p.coupler * c2),
        x1(-p.crank * s1 - p.coupler * s2 * phi1),
        x2(-p.crank * c1 - p.coupler * (c2 * phi1 * phi1 + s2 * phi2)) {}
};

}  // namespace

Ideal evaluate_ideal(const Params& p, double angle, double speed) {
  const Loop k(p, angle);
  const double m11 = p.crank_inertia + (p.crank_mass / 4 + p.coupler_mass) * p.crank * p.crank;
  const double m22 = p.coupler_inertia + p.coupler_mass * p.coupler * p.coupler / 4;
  const double h = p.coupler_mass * p.crank * p.coupler / 2;
  const double weight1 = (p.crank_mass / 2 + p.coupler_mass) * p.gravity * p.crank;
  const double weight2 = p.coupler_mass * p.gravity * p.coupler / 2;
  const double m12 = h * (k.c1 * k.c2 + k.s1 * k.s2), turn = h * (k.s1 * k.c2 - k.c1 * k.s2);
  // T = ½ M(θ) θ̇², M′ its slope in θ, V = weight₁ sin θ + weight₂ sin φ.
  const double mass = m11 + 2 * m12 * k.phi1 + m22 * k.phi1 * k.phi1 + p.slider_mass * k.x1 * k.x1;
  const double slope = 2 * (-turn * (1 - k.phi1) * k.phi1 + m12 * k.phi2 + m22 * k.phi1 * k.phi2 + p.slider_mass * k.x1 * k.x2);
  const double load = 0.5 * slope * speed * speed + weight1 * k.c1 + weight2 * k.c2 * k.phi1;
  Ideal out{};
  out.angle = angle, out.speed = speed;
  out.acceleration = p.driven ? 0 : -load / mass;
  out.torque = p.driven ? load : 0;
  out.phi = k.phi, out.phi_rate = k.phi1 * speed;
  out.x = k.x, out.x_rate = k.x1 * speed;
  out.x_acceleration = k.x1 * out.acceleration + k.x2 * speed * speed;
  const double phi_acceleration = k.phi1 * out.acceleration + k.phi2 * speed * speed;
  out.pin_force[0] = -p.slider_mass * out.x_acceleration;
  // The coupler's own equation, moments about the crank pin.
  out.pin_force[1] =
      ((m12 * out.acceleration + m22 * phi_acceleration - turn * speed * speed + weight2 * k.c2) / p.coupler + out.pin_force[0] * k.s2) /
      k.c2;
  out.energy = 0.5 * mass * speed * speed + weight1 * k.s1 + weight2 * k.s2;
  return out;
}

Ideal ideal_at(const Params& p, double t, double tolerance) {
  const auto f = [&](const Vec<2>& y, Vec<2>& dy) { dy = {y[1], evaluate_ideal(p, y[0], y[1]).acceleration}; };
  const Vec<2> y = integrate_tightly<2>(f, {p.start_angle, p.speed}, t, tolerance, {1.0, std::abs(p.speed) + 1});
  return evaluate_ideal(p, y[0], y[1]);
}

}  // namespace pintle_oracle
