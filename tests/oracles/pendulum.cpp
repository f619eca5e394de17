#include "pendulum.h"

#include <cmath>
#include <numbers>

namespace pintle_oracle {

double elliptic_k(double k) {
  double a = 1, b = std::sqrt((1 - k) * (1 + k));
  for (int i = 0; i < 12 && std::abs(a - b) > 1e-16 * a; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi / (a + b);
}

Jacobi jacobi(double u, double k) {
  // Descending by arithmetic–geometric means, then back up through the amplitudes.
  u = std::remainder(u, 4 * elliptic_k(k));
  double a[16], c[16];
  a[0] = 1, c[0] = k;
  double b = std::sqrt((1 - k) * (1 + k));
  int n = 0;
  while (n < 15 && std::abs(c[n]) > 1e-17) {
    a[n + 1] = 0.5 * (a[n] + b);
    c[n + 1] = 0.5 * (a[n] - b);
    b = std::sqrt(a[n] * b);
    ++n;
  }
  double phi = std::ldexp(a[n] * u, n);
  for (int i = n; i > 0; --i) phi = 0.5 * (phi + std::asin(c[i] / a[i] * std::sin(phi)));
  const double sn = std::sin(phi), cn = std::cos(phi);
  return {sn, cn, std::sqrt((1 - k * k) + k * k * cn * cn)};
}

double period(const Pendulum& p) { return 4 * elliptic_k(std::sin(std::abs(p.release) / 2)) * std::sqrt(p.length / p.gravity); }

Swing evaluate(const Pendulum& p, double t) {
  const double k = std::sin(p.release / 2), rate0 = std::sqrt(p.gravity / p.length);
  const Jacobi j = jacobi(rate0 * t, std::abs(k));
  Swing s;
  s.angle = 2 * std::asin(k * j.cn / j.dn);
  s.rate = -2 * rate0 * k * std::cos(p.release / 2) * j.sn / j.dn;
  s.acceleration = -p.gravity / p.length * std::sin(s.angle);
  s.x = p.length * std::sin(s.angle);
  s.y = -p.length * std::cos(s.angle);
  s.tension = p.length * s.rate * s.rate + p.gravity * std::cos(s.angle);
  return s;
}

double equivalent_length(double mass, double inertia, double centre) { return centre + inertia / (mass * centre); }

void rhs(const DoublePendulum& p, const Vec<4>& y, Vec<4>& dy) {
  const double m11 = p.inertia[0] + p.mass[0] * p.centre[0] * p.centre[0] + p.mass[1] * p.length * p.length;
  const double m22 = p.inertia[1] + p.mass[1] * p.centre[1] * p.centre[1];
  const double h = p.mass[1] * p.length * p.centre[1];
  const double m12 = h * std::cos(y[0] - y[1]), turn = h * std::sin(y[0] - y[1]);
  const double f1 = -turn * y[3] * y[3] - (p.mass[0] * p.centre[0] + p.mass[1] * p.length) * p.gravity * std::sin(y[0]);
  const double f2 = turn * y[2] * y[2] - p.mass[1] * p.centre[1] * p.gravity * std::sin(y[1]);
  const double det = m11 * m22 - m12 * m12;
  dy = {y[2], y[3], (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det};
}

double energy(const DoublePendulum& p, const Vec<4>& y) {
  const double m11 = p.inertia[0] + p.mass[0] * p.centre[0] * p.centre[0] + p.mass[1] * p.length * p.length;
  const double m22 = p.inertia[1] + p.mass[1] * p.centre[1] * p.centre[1];
  const double m12 = p.mass[1] * p.length * p.centre[1] * std::cos(y[0] - y[1]);
  return 0.5 * (m11 * y[2] * y[2] + m22 * y[3] * y[3]) + m12 * y[2] * y[3] -
         (p.mass[0] * p.centre[0] + p.mass[1] * p.length) * p.gravity * std::cos(y[0]) -
         p.mass[1] * p.centre[1] * p.gravity * std::cos(y[1]);
}

Vec<4> evaluate(const DoublePendulum& p, const Vec<4>& start, double t, double tolerance) {
  if (t == 0) return start;
  const auto f = [&](const Vec<4>& y, Vec<4>& dy) { rhs(p, y, dy); };
  return integrate_tightly<4>(f, start, t, tolerance, {1, 1, 1, 1});
}

}  // namespace pintle_oracle
