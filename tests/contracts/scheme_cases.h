#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "framework/dynamics/equations/equations.h"
#include "tests/oracles/runge_kutta.h"
#include "tests/oracles/slider_crank_clearance.h"

/// Mechanisms with known motions, for the exams of time integration.
namespace pintle::scheme_cases {

using Eigen::Vector2d;
using Eigen::VectorXd;

// What is compared with the truth: an angle, its rate, two components of λ, then integrals.
struct Case {
  System system;
  State start;
  VectorXd (*seen)(const VectorXd& y, const Equations&);
  std::function<VectorXd(double t)> truth;
};

// A link on a hinge with a damper, under gravity and a torque; angle from +x. By an ODE of our own.
namespace link {
constexpr double m = 1.3, J = 0.04, arm = 0.3, g = 9.81, c = 0.05, torque = 0.6, theta0 = 0.4, w0 = 3;
inline double acceleration(double theta, double w) { return (torque - c * w - m * g * arm * std::cos(theta)) / (J + m * arm * arm); }
inline VectorXd seen(const VectorXd& y, const Equations& eq) { return (VectorXd(6) << y[2], y[5], eq.lambda, y[6], y[7]).finished(); }
inline VectorXd truth(double t) {
  const auto f = [](const pintle_oracle::Vec<4>& y, pintle_oracle::Vec<4>& dy) {
    dy = {y[1], acceleration(y[0], y[1]), c * y[1] * y[1], torque * y[1]};
  };
  const auto y = pintle_oracle::integrate_tightly<4>(f, {theta0, w0, 0, 0}, t, 1e-14, {1, 1, 1, 1});
  const Vector2d u(std::cos(y[0]), std::sin(y[0]));
  const Vector2d a = arm * (acceleration(y[0], y[1]) * perp(u) - y[1] * y[1] * u);
  const Vector2d lambda = m * (Vector2d(0, -g) - a);  // hinge force on the ground
  return (VectorXd(6) << y[0], y[1], lambda, y[2], y[3]).finished();
}
inline Case make() {
  Case k{{}, {}, seen, truth};
  k.system.gravity = {0, -g};
  k.system.bodies = {{"link", m, J}};
  k.system.markers = {{ground, {0.2, 0.1}, 0}, {0, {-arm, 0}, 0}};
  k.system.joints = {Revolute{0, 1}};
  const auto law = [](double) { return Jet{torque, 0, 0}; };
  k.system.forces = {TorsionSpring{0, 1, 0, c, 0}, Torque{0, 1, law}};
  k.system.length = arm;
  number(k.system);
  k.start.y.setZero(k.system.n_y());
  const Vector2d u(std::cos(theta0), std::sin(theta0));
  k.start.y.head<3>() << Vector2d(0.2, 0.1) + arm * u, theta0;
  k.start.y.segment<3>(3) << w0 * arm * perp(u), w0;
  return k;
}
}  // namespace link

// The free slider-crank of the oracle, which integrates its one dof tightly.
namespace crank {
inline pintle_oracle::Params params() {
  pintle_oracle::Params p;
  p.speed = 12;
  p.start_angle = 0.6;
  return p;
}
inline VectorXd seen(const VectorXd& y, const Equations& eq) { return (VectorXd(4) << y[2], y[11], eq.lambda[4], eq.lambda[5]).finished(); }
inline VectorXd truth(double t) {
  const auto i = pintle_oracle::ideal_at(params(), t, 1e-14);
  // λ of the gudgeon pin is the slider's force on the coupler.
  return (VectorXd(4) << i.angle, i.speed, i.pin_force[0], i.pin_force[1]).finished();
}
inline Case make() {
  const auto p = params();
  const auto now = pintle_oracle::evaluate_ideal(p, p.start_angle, p.speed);
  Case k{{}, {}, seen, truth};
  k.system.gravity = {0, -p.gravity};
  k.system.bodies = {
      {"crank", p.crank_mass, p.crank_inertia}, {"coupler", p.coupler_mass, p.coupler_inertia}, {"slider", p.slider_mass, 1e-4}};
  const double half1 = p.crank / 2, half2 = p.coupler / 2;
  k.system.markers = {{ground, {0, 0}, 0}, {0, {-half1, 0}, 0}, {0, {half1, 0}, 0},
                      {1, {-half2, 0}, 0}, {1, {half2, 0}, 0},  {2, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}, Revolute{2, 3}, Revolute{4, 5}, Prismatic{0, 5, 0}};
  k.system.length = p.coupler;
  number(k.system);
  const Vector2d u(std::cos(p.start_angle), std::sin(p.start_angle)), v(std::cos(now.phi), std::sin(now.phi));
  k.start.y.setZero(k.system.n_y());
  k.start.y.head<9>() << half1 * u, p.start_angle, p.crank * u + half2 * v, now.phi, now.x, 0, 0;
  k.start.y.segment<9>(9) << half1 * p.speed * perp(u), p.speed, p.crank * p.speed * perp(u) + half2 * now.phi_rate * perp(v), now.phi_rate,
      now.x_rate, 0, 0;
  return k;
}
}  // namespace crank

// A cart on a rail, a spring and damper in series between it and the ground: ẍ = −k(x − d)/m, ḋ = k(x − d)/c, linear, so its
// motion is a sum of exponentials. The ledger has what the damper lost.
namespace series {
constexpr double m = 1.5, k = 60, c = 9, x0 = 1.4, v0 = -2, d0 = 1.1;
inline Eigen::Vector3d motion(double t) {
  Eigen::Matrix3d A;
  A << 0, 1, 0, -k / m, 0, k / m, k / c, 0, -k / c;
  const Eigen::EigenSolver<Eigen::Matrix3d> pairs(A);
  const Eigen::Matrix3cd V = pairs.eigenvectors();
  const Eigen::Vector3cd parts = V.partialPivLu().solve(Eigen::Vector3d(x0, v0, d0).cast<std::complex<double>>());
  return (V * (pairs.eigenvalues() * t).array().exp().matrix().cwiseProduct(parts)).real();
}
inline double energy(const Eigen::Vector3d& y) { return m * y[1] * y[1] / 2 + k * (y[0] - y[2]) * (y[0] - y[2]) / 2; }
inline VectorXd seen(const VectorXd& y, const Equations&) { return (VectorXd(4) << y[0], y[3], y[6], y[7]).finished(); }
inline VectorXd truth(double t) {
  const Eigen::Vector3d y = motion(t);
  return (VectorXd(4) << y, energy({x0, v0, d0}) - energy(y)).finished();
}
inline Case make() {
  Case k_{{}, {}, seen, truth};
  k_.system.bodies = {{"cart", m, 0.02}};
  k_.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  k_.system.joints = {Prismatic{0, 1, 0}};
  k_.system.forces = {Maxwell{0, 1, k, c}};
  number(k_.system);
  k_.start.y.setZero(k_.system.n_y());
  k_.start.y[0] = x0, k_.start.y[3] = v0, k_.start.y[6] = d0;
  return k_;
}
}  // namespace series

// A block that runs out in its guide, pressed by N, on bristles without damping. With g = μ the deflection follows the way gone,
// z = (μ/σ0)(1 − exp(−σ0 x/μ)), and with it the speed: m v²/2 = m v0²/2 − μ N (x − z). The time is integrated here.
namespace bristles {
constexpr double m = 1.5, N = 8, mu = 0.4, v0 = 6;  // slides on beyond 2 s
inline VectorXd seen(const VectorXd& y, const Equations&) { return (VectorXd(4) << y[0], y[3], y[6], y[7]).finished(); }
inline VectorXd truth(double stiffness, double t) {
  const auto deflection = [&](double x) { return -mu / stiffness * std::expm1(-stiffness * x / mu); };
  const auto speed = [&](double x) { return std::sqrt(v0 * v0 - 2 * mu * N / m * (x - deflection(x))); };
  const auto f = [&](const pintle_oracle::Vec<1>& y, pintle_oracle::Vec<1>& dy) { dy = {speed(y[0])}; };
  const double x = pintle_oracle::integrate_tightly<1>(f, {0}, t, 1e-14, {1})[0], v = speed(x);
  return (VectorXd(4) << x, v, deflection(x), m * (v0 * v0 - v * v) / 2).finished();
}
inline Case make(double stiffness) {
  Case k{{}, {}, seen, [stiffness](double t) { return truth(stiffness, t); }};
  k.system.bodies = {{"block", m, 0.02}};
  k.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  k.system.joints = {Prismatic{0, 1, 0}};
  k.system.frictions = {
      {.joint = 0, .law = LuGre{.mu = mu, .mu_static = mu, .stiffness = stiffness, .damping = 0}, .length = 0.1, .preload = N}};
  number(k.system);
  k.start.y.setZero(k.system.n_y());
  k.start.y[3] = v0;
  k.start.friction.resize(dry_states(k.system));
  return k;
}
}  // namespace bristles

// Slope of log y over log x, by least squares.
inline double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  using Data = Eigen::Map<const Eigen::ArrayXd>;
  Eigen::ArrayXd lx = Data(x.data(), n).log();
  const Eigen::ArrayXd ly = Data(y.data(), n).log();
  lx -= lx.mean();
  return (lx * ly).sum() / lx.square().sum();
}

}  // namespace pintle::scheme_cases
