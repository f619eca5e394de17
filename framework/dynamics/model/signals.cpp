#include "framework/dynamics/model/signals.h"

#include <cmath>

#include "contact/plane.h"

namespace pintle {

using Eigen::Vector2d;
using Kind = MotionSignal::Kind;

bool of_two(Kind kind) { return kind >= Kind::length && kind < Kind::state; }
bool is_speed(Kind kind) {
  return kind == Kind::vx || kind == Kind::vy || kind == Kind::speed || kind == Kind::length_rate || kind == Kind::relative_speed;
}

double signal_value(const MotionSignal& signal, const MovingPoint& a, const MovingPoint& b) {
  const auto value = [&] {
    switch (signal.kind) {
      case Kind::x: return a.r.x();
      case Kind::y: return a.r.y();
      case Kind::angle: return a.angle;
      case Kind::vx: return a.v.x();
      case Kind::vy: return a.v.y();
      case Kind::speed: return a.w;
      case Kind::length: return (b.r - a.r).norm();
      case Kind::length_rate: {
        const Vector2d d = b.r - a.r;
        const double length = d.norm();
        return length > 0 ? d.dot(b.v - a.v) / length : 0.0;
      }
      case Kind::relative_angle: return b.angle - a.angle;
      case Kind::relative_speed: return b.w - a.w;
      case Kind::along: return (b.r - a.r).dot(Vector2d(std::cos(a.angle), std::sin(a.angle)));
      case Kind::across: return (b.r - a.r).dot(Vector2d(-std::sin(a.angle), std::cos(a.angle)));
      case Kind::state: break;
    }
    return 0.0;
  };
  return value() - signal.offset;
}

SignalSlope signal_slope(const MotionSignal& signal, const MovingPoint& a, const MovingPoint& b) {
  SignalSlope out;
  const Vector2d d = b.r - a.r;
  const auto of_points = [&](const Vector2d& by_b) { out.pose_b.head<2>() = by_b, out.pose_a.head<2>() = -by_b; };
  const auto in_axes = [&](const Vector2d& axis) { of_points(axis), out.pose_a[2] = d.dot(perp(axis)); };
  switch (signal.kind) {
    case Kind::x: out.pose_a[0] = 1; break;
    case Kind::y: out.pose_a[1] = 1; break;
    case Kind::angle: out.pose_a[2] = 1; break;
    case Kind::vx: out.rate_a[0] = 1; break;
    case Kind::vy: out.rate_a[1] = 1; break;
    case Kind::speed: out.rate_a[2] = 1; break;
    case Kind::length:
    case Kind::length_rate: {
      const double length = d.norm();
      if (length == 0) break;
      const Vector2d along = d / length, v = b.v - a.v;
      if (signal.kind == Kind::length) {
        of_points(along);
      } else {
        of_points((v - along.dot(v) * along) / length);
        out.rate_b.head<2>() = along, out.rate_a.head<2>() = -along;
      }
      break;
    }
    case Kind::relative_angle: out.pose_b[2] = 1, out.pose_a[2] = -1; break;
    case Kind::relative_speed: out.rate_b[2] = 1, out.rate_a[2] = -1; break;
    case Kind::along: in_axes({std::cos(a.angle), std::sin(a.angle)}); break;
    case Kind::across: in_axes({-std::sin(a.angle), std::cos(a.angle)}); break;
    case Kind::state: break;
  }
  return out;
}

}  // namespace pintle
