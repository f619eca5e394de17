#include "framework/dynamics/model/flank.h"

#include <cmath>

#include "contact/plane.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using Row = Eigen::Matrix<double, 1, 6>;
using Motions = std::array<MarkerMotion, 2>;

MarkerMotion as_marker(const MovingPoint& p) {
  return {.r = p.r, .d = {0, 0}, .u = {std::cos(p.angle), std::sin(p.angle)}, .angle = p.angle, .v = p.v, .w = p.w};
}
Row rates_of(const Motions& m) { return (Row() << m[0].v.transpose(), m[0].w, m[1].v.transpose(), m[1].w).finished(); }

/// Weights in depth = Σ weight C − half.
Vector2d weights(const Flank& f) { return {-std::sin(f.angle), f.side * std::cos(f.angle)}; }

struct Depth {
  double value;
  Row by_pose;
};
Depth depth_of(const Flank& f, const Motions& m) {
  ConstraintRows rows;
  std::array<ConstraintRows::Block, 2> L;
  std::visit([&](const auto& teeth) { pose(teeth, m.data(), 0, rows, L.data()); }, f.teeth);
  const Vector2d w = weights(f);
  Row by_pose;
  by_pose << w.transpose() * L[0].topRows<2>(), w.transpose() * L[1].topRows<2>();
  return {w.dot(rows.C.head<2>()) - f.half, by_pose};
}

/// From b to the pitch point.
Vector2d arm_of_b(const RollsOnDisc& wheels, const MarkerMotion& a, const MarkerMotion& b) {
  return -wheels.radius_b / (wheels.radius_a + wheels.radius_b) * (b.r - a.r);
}
Vector2d arm_of_b(const RollsOnLine& pinion, const MarkerMotion& a, const MarkerMotion&) { return -pinion.radius * perp(a.u); }

}  // namespace

std::array<double, 2> pitch_radii(const Flank& f) {
  const auto* wheels = std::get_if<RollsOnDisc>(&f.teeth);
  return wheels ? std::array{wheels->radius_a, wheels->radius_b} : std::array{0.0, std::get<RollsOnLine>(f.teeth).radius};
}

Gap evaluate(const Flank& f, const MovingPoint& a, const MovingPoint& b) {
  const Motions m{as_marker(a), as_marker(b)};
  const Depth depth = depth_of(f, m);
  Gap out;
  out.depth = depth.value;
  out.rate = depth.by_pose.dot(rates_of(m));
  out.n = -depth.by_pose.segment<2>(3).transpose();
  out.arm_b = std::visit([&](const auto& teeth) { return arm_of_b(teeth, m[0], m[1]); }, f.teeth);
  out.arm_a = b.r - a.r + out.arm_b;
  return out;
}

double closing_acceleration(const Flank& f, const MovingPoint& a, const MovingPoint& b) {
  const Motions m{as_marker(a), as_marker(b)};
  ConstraintRows rows;
  std::visit([&](const auto& teeth) { speed(teeth, m.data(), 0, rows); }, f.teeth);
  return weights(f).dot(rows.kappa.head<2>());
}

// wrench = −N ∂depth/∂p; `bend` holds minus the second derivatives of the depth.
WrenchTangent wrench_tangent(const Flank& f, const NormalForce& normal, const MovingPoint& a, const MovingPoint& b) {
  const Motions m{as_marker(a), as_marker(b)};
  const Row by_pose = depth_of(f, m).by_pose;
  const Vector2d w = weights(f);
  WrenchTangent bend(2), out(2);
  std::visit([&](const auto& teeth) { curve(teeth, m.data(), w.data(), bend); }, f.teeth);
  const Row force_p = normal.d_depth * by_pose - normal.d_rate * rates_of(m) * bend.pose;
  out.pose = normal.force * bend.pose - by_pose.transpose() * force_p;
  out.rate = -normal.d_rate * by_pose.transpose() * by_pose;
  return out;
}

}  // namespace pintle
