#include "framework/dynamics/model/pair_tangent.h"

namespace pintle {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix6 = PairTangent::Matrix6;

constexpr int angle_a = 2, r_b = 3, angle_b = 5;  // places in [p_a; p_b]

// The force F on a and −F on b, F a function of r_b − r_a with the derivative K.
void oppose(const Matrix2d& K, Matrix6& out) {
  out.topLeftCorner<2, 2>() -= K;
  out.block<2, 2>(r_b, r_b) -= K;
  out.block<2, 2>(0, r_b) += K;
  out.block<2, 2>(r_b, 0) += K;
}
// The torque τ on a and −τ on b, τ a function of φ_b − φ_a with the derivative k.
void twist(double k, Matrix6& out) {
  out(angle_a, angle_a) -= k;
  out(angle_b, angle_b) -= k;
  out(angle_a, angle_b) += k;
  out(angle_b, angle_a) += k;
}

// ---- joints: minus the Hessian of λ·C in the poses --------------------------------------------

// λ n·d, n = Zu_a
PairTangent ride_line(const MarkerMotion& a, const MarkerMotion& b, double lambda) {
  PairTangent out;
  const Vector2d along = lambda * a.u;
  out.pose.block<2, 1>(0, angle_a) = -along;
  out.pose.block<1, 2>(angle_a, 0) = -along.transpose();
  out.pose.block<2, 1>(r_b, angle_a) = along;
  out.pose.block<1, 2>(angle_a, r_b) = along.transpose();
  out.pose(angle_a, angle_a) = lambda * cross(a.u, b.r - a.r);
  return out;
}
// λ |d|
PairTangent keep_length(const MarkerMotion& a, const MarkerMotion& b, double lambda) {
  PairTangent out;
  const Vector2d d = b.r - a.r;
  const double length = d.norm();
  if (length == 0) return out;
  const Vector2d across = perp(d) / length;
  oppose(lambda / length * across * across.transpose(), out.pose);
  return out;
}

constexpr PairReach nothing{}, everything{true, true, true, false};
constexpr PairReach line{true, false, true, false};  // b's direction and its place among themselves: no

PairReach reach_of(const Revolute&) { return nothing; }
PairReach reach_of(const Slot&) { return line; }
PairReach reach_of(const Prismatic&) { return line; }
PairReach reach_of(const Weld&) { return nothing; }
PairReach reach_of(const Distance&) { return everything; }
PairReach reach_of(const AngleDriver&) { return nothing; }
PairReach reach_of(const DistanceDriver&) { return everything; }

using M = const MarkerMotion&;
PairTangent of(const Revolute&, M, M, const double*) { return {}; }
PairTangent of(const Slot&, M a, M b, const double* lambda) { return ride_line(a, b, lambda[0]); }
PairTangent of(const Prismatic&, M a, M b, const double* lambda) { return ride_line(a, b, lambda[0]); }
PairTangent of(const Weld&, M, M, const double*) { return {}; }
PairTangent of(const Distance&, M a, M b, const double* lambda) { return keep_length(a, b, lambda[0]); }
PairTangent of(const AngleDriver&, M, M, const double*) { return {}; }
PairTangent of(const DistanceDriver&, M a, M b, const double* lambda) { return keep_length(a, b, lambda[0]); }

// ---- force elements ---------------------------------------------------------------------------

PairReach reach_of(const PointForce& f) { return {false, f.follows, false, false}; }
PairReach reach_of(const Torque&) { return nothing; }
PairReach reach_of(const Spring& f) { return {true, true, true, f.c != 0}; }
PairReach reach_of(const TorsionSpring& f) { return {true, true, true, f.c != 0}; }

PairTangent of(const PointForce& f, const ForceEffect& now, M, M) {
  PairTangent out;
  if (f.follows) out.pose.block<2, 1>(r_b, angle_b) = perp(now.on_b.head<2>());
  return out;
}
PairTangent of(const Torque&, const ForceEffect&, M, M) { return {}; }
PairTangent of(const Spring& f, const ForceEffect&, M a, M b) {
  PairTangent out;
  const Vector2d d = b.r - a.r, v = b.v - a.v;
  const double length = d.norm();
  if (length == 0) return out;
  const Vector2d along = d / length, across = perp(along);
  const double pull = f.k * (length - f.free_length) + f.c * along.dot(v);
  const Vector2d slope = f.k * along + f.c * across.dot(v) / length * across;  // of the pull
  oppose(along * slope.transpose() + pull / length * across * across.transpose(), out.pose);
  oppose(f.c * along * along.transpose(), out.rate);
  return out;
}
PairTangent of(const TorsionSpring& f, const ForceEffect&, M, M) {
  PairTangent out;
  twist(f.k, out.pose);
  twist(f.c, out.rate);
  return out;
}

}  // namespace

PairReach reach(const Joint& j) {
  return std::visit([](const auto& k) { return reach_of(k); }, j);
}
PairReach reach(const Force& f) {
  return std::visit([](const auto& k) { return reach_of(k); }, f);
}
PairReach reach(const ContactPair&) { return {true, true, true, true}; }

PairTangent pair_tangent(const Joint& j, const MarkerMotion& a, const MarkerMotion& b, const double* lambda) {
  return std::visit([&](const auto& k) { return of(k, a, b, lambda); }, j);
}
PairTangent pair_tangent(const Force& f, const ForceEffect& now, const MarkerMotion& a, const MarkerMotion& b) {
  return std::visit([&](const auto& k) { return of(k, now, a, b); }, f);
}

PairTangent pair_tangent(const ContactPair& pair, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b) {
  PairTangent out;
  if (now.normal.force == 0) return out;
  const Gap& gap = now.gap;
  const Vector2d &n = gap.n, t = perp(n), v = a.v - b.v;
  const double distance = gap.e.norm(), N = now.normal.force;
  const double across = v.dot(t), turning = across / distance;  // of n

  // Gradients in e = r_journal − r_bearing and in ė: of the normal force, then of friction.
  const Vector2d N_e = now.normal.d_depth * n + now.normal.d_rate * turning * t, N_v = now.normal.d_rate * n;
  Vector2d T_e = Vector2d::Zero(), T_v = T_e;
  double T = 0, T_w = 0;  // T_w: per sliding speed that a spin makes
  if (pair.friction) {
    const bool material = pair.sliding == Sliding::material;
    const FrictionForce law = evaluate(*pair.friction, material ? gap.material_slip : gap.geometric_slip, N);
    T = law.force;
    const double share = material ? 1 : gap.depth / distance;  // of ė's part across
    Vector2d slip_e = -share * gap.rate / distance * t;
    if (!material) slip_e += turning * (1 - share) * n;
    T_e = law.d_speed * slip_e + law.d_normal * N_e;
    T_v = law.d_speed * share * t + law.d_normal * N_v;
    T_w = material ? law.d_speed : 0;
  }

  // The wrench per unit of e, of ė and of sliding speed made by spins, as on the journal but for the radius.
  const Matrix2d F_e = t * T_e.transpose() - n * N_e.transpose() - (N / distance * t + T / distance * n) * t.transpose();
  const Matrix2d F_v = t * T_v.transpose() - n * N_v.transpose();
  const double radius[] = {pair.gap.journal, pair.gap.bearing};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const double on = i == 0 ? 1 : -1, by = j == 0 ? 1 : -1;
      auto pose = out.pose.block<3, 3>(3 * i, 3 * j), rate = out.rate.block<3, 3>(3 * i, 3 * j);
      pose.topLeftCorner<2, 2>() = on * by * F_e;
      pose.bottomLeftCorner<1, 2>() = on * by * radius[i] * T_e.transpose();
      rate.topLeftCorner<2, 2>() = on * by * F_v;
      rate.bottomLeftCorner<1, 2>() = on * by * radius[i] * T_v.transpose();
      rate.topRightCorner<2, 1>() = on * by * radius[j] * T_w * t;
      rate(2, 2) = on * by * radius[i] * radius[j] * T_w;
    }
  return out;
}

}  // namespace pintle
