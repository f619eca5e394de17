#include "framework/dynamics/model/joint_friction.h"

#include <algorithm>
#include <cmath>

namespace pintle {

using Eigen::Vector2d;

namespace {

bool turns(const Joint& joint) { return std::holds_alternative<Revolute>(joint); }

double power(const std::array<Wrench, 2>& unit, const Vector2d& v_a, double w_a, const Vector2d& v_b, double w_b) {
  return unit[0].head<2>().dot(v_a) + unit[0][2] * w_a + unit[1].head<2>().dot(v_b) + unit[1][2] * w_b;
}

}  // namespace

std::array<Wrench, 2> unit_friction(const Joint& joint, const JointFriction& rub, const MarkerMotion& a, const MarkerMotion& b) {
  if (turns(joint)) return {Wrench(0, 0, -rub.radius), Wrench(0, 0, rub.radius)};
  return {Wrench(-a.u.x(), -a.u.y(), -cross(b.r - a.r, a.u)), Wrench(a.u.x(), a.u.y(), 0)};
}

double slip(const Joint& joint, const JointFriction& rub, const MarkerMotion& a, const MarkerMotion& b) {
  return power(unit_friction(joint, rub, a, b), a.v, a.w, b.v, b.w);
}

// d/dt of u·(v_b − v_a − w_a Z d): u rotates with w_a, and ḋ = v_b − v_a.
double slip_acceleration(const Joint& joint, const JointFriction& rub, const MarkerMotion& a, const MarkerMotion& b) {
  const double free = power(unit_friction(joint, rub, a, b), a.a0, a.alpha0, b.a0, b.alpha0);
  if (turns(joint)) return free;
  const Vector2d d = b.r - a.r, d_rate = b.v - a.v;
  return free + a.w * perp(a.u).dot(d_rate - a.w * perp(d)) - a.w * a.u.dot(perp(d_rate));
}

double load(const Joint& joint, const JointFriction& rub, const MarkerMotion& a, const Wrench& on_b) {
  if (turns(joint)) return rub.preload + on_b.head<2>().norm();
  const double across = std::abs(cross(a.u, on_b.head<2>()));
  return rub.preload + (rub.length > 0 ? std::max(across, 2 * std::abs(on_b[2]) / rub.length) : across);
}

namespace {

Eigen::Vector<double, 6> stacked(const std::array<Wrench, 2>& unit) { return (Eigen::Vector<double, 6>() << unit[0], unit[1]).finished(); }

}  // namespace

WrenchTangent wrench_tangent(const std::array<Wrench, 2>& unit, const JointFrictionEffect& now) {
  WrenchTangent out(2);
  out.rate = now.load * now.d_slip * stacked(unit) * stacked(unit).transpose();
  return out;
}

InternalTangent internal_tangent(const std::array<Wrench, 2>& unit, const JointFriction& rub, const JointFrictionEffect& now,
                                 const double* x) {
  const BristleForce law = bend(rub.law, now.slip, x);
  InternalTangent out(2, bristle_states(rub.law));
  for (Eigen::Index i = 0; i < out.n(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.wrench.col(i) = now.load * law.d_state[k] * stacked(unit);
    out.g_rate.row(i) = law.rate_d_speed[k] * stacked(unit).transpose();
    for (Eigen::Index j = 0; j < out.n(); ++j) out.g_x(i, j) = law.rate_d_state[k][static_cast<std::size_t>(j)];
  }
  return out;
}

}  // namespace pintle
