#include "framework/dynamics/model/forces.h"

#include <cmath>
#include <type_traits>

#include "framework/common/result_columns.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using M = const MarkerMotion&;

constexpr WrenchPattern constant{};
constexpr WrenchPattern between(bool rate) { return {{{{true, true}, {true, true}}}, rate}; }

ForceEffect effect(const PointForce& f, M, M b, double t, const double*) {
  Vector2d force(f.x(t).value, f.y(t).value);
  if (f.follows) force = force.x() * b.u + force.y() * perp(b.u);
  ForceEffect e;
  e.on_b << force, 0;
  e.input = force.dot(b.v);
  return e;
}
WrenchPattern pattern(const PointForce& f) { return {{{{}, {false, f.follows}}}, false}; }
void curve(const PointForce& f, const ForceEffect& now, M, M, WrenchTangent& out) {
  if (f.follows) out.pose.block<2, 1>(place_of(1), angle_of(1)) = perp(now.on_b.head<2>());
}

ForceEffect effect(const Torque& f, M a, M b, double t, const double*) {
  const double torque = f.law(t).value;
  ForceEffect e;
  e.on_a[2] = -torque;
  e.on_b[2] = torque;
  e.input = torque * (b.w - a.w);
  return e;
}
WrenchPattern pattern(const Torque&) { return constant; }
void curve(const Torque&, const ForceEffect&, M, M, WrenchTangent&) {}

ForceEffect effect(const Spring& f, M a, M b, double, const double*) {
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
WrenchPattern pattern(const Spring& f) { return between(f.c != 0); }
void curve(const Spring& f, const ForceEffect&, M a, M b, WrenchTangent& out) {
  const Vector2d d = b.r - a.r, v = b.v - a.v;
  const double length = d.norm();
  if (length == 0) return;
  const Vector2d along = d / length, across = perp(along);
  const double pull = f.k * (length - f.free_length) + f.c * along.dot(v);
  const Vector2d slope = f.k * along + f.c * across.dot(v) / length * across;  // derivative of the pull
  oppose(along * slope.transpose() + pull / length * across * across.transpose(), out.pose);
  oppose(f.c * along * along.transpose(), out.rate);
}

ForceEffect effect(const TorsionSpring& f, M a, M b, double, const double*) {
  const double twist = b.angle - a.angle - f.free_angle, rate = b.w - a.w;
  const double torque = f.k * twist + f.c * rate;
  ForceEffect e;
  e.on_a[2] = torque;
  e.on_b[2] = -torque;
  e.stored = 0.5 * f.k * twist * twist;
  e.dissipation = f.c * rate * rate;
  return e;
}
WrenchPattern pattern(const TorsionSpring& f) { return between(f.c != 0); }
void curve(const TorsionSpring& f, const ForceEffect&, M, M, WrenchTangent& out) {
  twist(f.k, out.pose);
  twist(f.c, out.rate);
}

ForceEffect effect(const Maxwell& f, M a, M b, double, const double* x) {
  const Vector2d d = b.r - a.r;
  const double length = d.norm(), pull = f.k * (length - x[0]);
  ForceEffect e;
  e.stored = 0.5 * f.k * (length - x[0]) * (length - x[0]);
  e.x_rate[0] = pull / f.c;
  e.dissipation = pull * e.x_rate[0];
  if (length == 0) return e;
  e.on_a << pull / length * d, 0;
  e.on_b = -e.on_a;
  return e;
}
WrenchPattern pattern(const Maxwell&) { return between(false); }
void curve(const Maxwell& f, const ForceEffect& now, M a, M b, WrenchTangent& out) {
  const Vector2d d = b.r - a.r;
  const double length = d.norm();
  if (length == 0) return;
  const Vector2d along = d / length, across = perp(along);
  oppose(f.k * along * along.transpose() + now.x_rate[0] * f.c / length * across * across.transpose(), out.pose);
}
constexpr InternalState damper_length[] = {{column::damper_length[0].name, column::damper_length[0].unit, 0}};
std::span<const InternalState> states(const Maxwell&) { return damper_length; }
void curve(const Maxwell& f, M a, M b, InternalTangent& out) {
  const Vector2d d = b.r - a.r;
  const double length = d.norm();
  out.g_x(0, 0) = -f.k / f.c;
  if (length == 0) return;
  const Vector2d along = d / length;
  out.wrench.block<2, 1>(place_of(0), 0) = -f.k * along;
  out.wrench.block<2, 1>(place_of(1), 0) = f.k * along;
  out.g_pose.block<1, 2>(0, place_of(0)) = -f.k / f.c * along.transpose();
  out.g_pose.block<1, 2>(0, place_of(1)) = f.k / f.c * along.transpose();
}

ForceEffect effect(const SizedForce& f, M a, M b, const double* laws) {
  ForceEffect e;
  for (const bool other : {false, true}) {
    const int law = other ? f.other : f.size;
    if (law < 0) continue;
    const UnitWrenches unit = unit_wrenches(f, other, a, b);
    e.on_a += laws[law] * unit.on_a;
    e.on_b += laws[law] * unit.on_b;
  }
  e.input = e.on_a.head<2>().dot(a.v) + e.on_a[2] * a.w + e.on_b.head<2>().dot(b.v) + e.on_b[2] * b.w;
  return e;
}
// With its components held; their dependence on the motion is in the tangent of the laws.
WrenchPattern pattern(const SizedForce& f) {
  if (f.way == SizedForce::follows) return {{{{}, {false, true}}}, false};
  return f.way == SizedForce::pull ? between(false) : constant;
}
void curve(const SizedForce& f, const ForceEffect& now, M a, M b, WrenchTangent& out) {
  if (f.way == SizedForce::follows) out.pose.block<2, 1>(place_of(1), angle_of(1)) = perp(now.on_b.head<2>());
  const Vector2d d = b.r - a.r;
  const double length = d.norm();
  if (f.way != SizedForce::pull || length == 0) return;
  const Vector2d across = perp(d / length);
  oppose(now.on_a.head<2>().dot(d) / (length * length) * across * across.transpose(), out.pose);
}

// Most have no internal states.
template <class Kind>
std::span<const InternalState> states(const Kind&) {
  return {};
}
template <class Kind>
void curve(const Kind&, M, M, InternalTangent&) {}

}  // namespace

UnitWrenches unit_wrenches(const SizedForce& f, bool other, const MarkerMotion& a, const MarkerMotion& b) {
  UnitWrenches out;
  switch (f.way) {
    case SizedForce::world: out.on_b[other ? 1 : 0] = 1; break;
    case SizedForce::follows: out.on_b.head<2>() = other ? perp(b.u) : b.u; break;
    case SizedForce::couple: out.on_a[2] = -1, out.on_b[2] = 1; break;
    case SizedForce::restoring: out.on_a[2] = 1, out.on_b[2] = -1; break;
    case SizedForce::pull: {
      const Vector2d d = b.r - a.r;
      if (const double length = d.norm(); length > 0) out.on_a.head<2>() = d / length, out.on_b = -out.on_a;
    }
  }
  return out;
}

ForceEffect evaluate(const Force& f, const MarkerMotion& a, const MarkerMotion& b, double t, const double* x, const double* laws) {
  return std::visit(
      [&](const auto& k) {
        if constexpr (std::is_same_v<std::decay_t<decltype(k)>, SizedForce>)
          return effect(k, a, b, laws);
        else
          return effect(k, a, b, t, x);
      },
      f);
}

std::span<const InternalState> internal_states(const Force& f) {
  return std::visit([](const auto& k) { return states(k); }, f);
}

WrenchPattern wrench_pattern(const Force& f) {
  return std::visit([](const auto& k) { return pattern(k); }, f);
}

WrenchTangent wrench_tangent(const Force& f, const ForceEffect& now, const MarkerMotion& a, const MarkerMotion& b) {
  WrenchTangent out(2);
  std::visit([&](const auto& k) { curve(k, now, a, b, out); }, f);
  return out;
}

InternalTangent internal_tangent(const Force& f, const ForceEffect&, const MarkerMotion& a, const MarkerMotion& b) {
  InternalTangent out(2, static_cast<int>(internal_states(f).size()));
  std::visit([&](const auto& k) { curve(k, a, b, out); }, f);
  return out;
}

}  // namespace pintle
