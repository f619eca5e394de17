#include "framework/dynamics/model/forces.h"

#include <cmath>

namespace pintle {

namespace {

using Eigen::Vector2d;

ForceEffect effect(const PointForce& f, const MarkerMotion&, const MarkerMotion& b, double t) {
  Vector2d force(f.x(t).value, f.y(t).value);
  if (f.follows) force = force.x() * b.u + force.y() * perp(b.u);
  ForceEffect e;
  e.on_b << force, 0;
  e.input = force.dot(b.v);
  return e;
}

ForceEffect effect(const Torque& f, const MarkerMotion& a, const MarkerMotion& b, double t) {
  const double torque = f.law(t).value;
  ForceEffect e;
  e.on_a[2] = -torque;
  e.on_b[2] = torque;
  e.input = torque * (b.w - a.w);
  return e;
}

ForceEffect effect(const Spring& f, const MarkerMotion& a, const MarkerMotion& b, double) {
  const Vector2d d = b.r - a.r;
  const double length = d.norm(), stretch = length - f.free_length;
  ForceEffect e;
  e.stored = 0.5 * f.k * stretch * stretch;
  if (length == 0) return e;
  const Vector2d along = d / length;
  const double rate = along.dot(b.v - a.v);
  const Vector2d pull = (f.k * stretch + f.c * rate) * along;
  e.on_a << pull, 0;
  e.on_b << -pull, 0;
  e.dissipation = f.c * rate * rate;
  return e;
}

ForceEffect effect(const TorsionSpring& f, const MarkerMotion& a, const MarkerMotion& b, double) {
  const double twist = b.angle - a.angle - f.free_angle, rate = b.w - a.w;
  const double torque = f.k * twist + f.c * rate;
  ForceEffect e;
  e.on_a[2] = torque;
  e.on_b[2] = -torque;
  e.stored = 0.5 * f.k * twist * twist;
  e.dissipation = f.c * rate * rate;
  return e;
}

}  // namespace

ForceEffect evaluate(const Force& f, const MarkerMotion& a, const MarkerMotion& b, double t) {
  return std::visit([&](const auto& k) { return effect(k, a, b, t); }, f);
}

}  // namespace pintle
