#include "framework/dynamics/model/contact_pair.h"

namespace pintle {

MovingPoint moving_point(const MarkerMotion& m) { return {m.r, m.v, m.w}; }

ContactEffect evaluate(const ContactPair& pair, const MarkerMotion& journal, const MarkerMotion& bearing, double impact_rate) {
  ContactEffect out;
  out.gap = evaluate(pair.gap, moving_point(journal), moving_point(bearing));
  if (impact_rate <= 0 || is_held(pair) || (out.gap.depth <= 0 && !begins_with_jump(pair.normal))) return out;

  out.normal = evaluate(pair.normal, Approach{out.gap.depth, out.gap.rate, impact_rate});
  Eigen::Vector2d force = -out.normal.force * out.gap.n;
  if (pair.friction) {
    const double slip = pair.sliding == Sliding::material ? out.gap.material_slip : out.gap.geometric_slip;
    out.friction = evaluate(*pair.friction, slip, out.normal.force).force;
    out.friction_loss = -out.friction * slip;
    force += out.friction * perp(out.gap.n);
  }
  out.on_journal << force, pair.gap.journal * cross(out.gap.n, force);
  out.on_bearing << -force, -pair.gap.bearing * cross(out.gap.n, force);
  return out;
}

WrenchTangent wrench_tangent(const ContactPair& pair, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b) {
  using Eigen::Matrix2d;
  using Eigen::Vector2d;
  WrenchTangent out(2);
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
