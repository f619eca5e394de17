#include "framework/dynamics/model/massless_boundary.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace pintle {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Row = Eigen::Matrix<double, 1, 6>;   // derivatives with respect to the poses of both markers, or to their rates
using Rows = Eigen::Matrix<double, 2, 6>;  // of a vector

const Matrix2d Z = (Matrix2d() << 0, -1, 1, 0).finished();

struct Elastic {
  double force, stored, stiffness;
};
Elastic elastic(const ContactPair& pair, double depth) {
  const NormalForce at_rest = evaluate(pair.normal, Approach{depth, 0, 1});
  return {at_rest.force, at_rest.stored, at_rest.d_depth};
}

Matrix2d turned(const Matrix2d& compliance, double angle) {
  const Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return R * compliance * R.transpose();
}

/// The displaced centres in equilibrium: q = e − (A + B) F n.
struct Equilibrium {
  Matrix2d A, B;  ///< compliances of a and b, world axes [m/N]
  Vector2d q, n;  ///< from b's displaced centre to a's [m], and its direction
  double depth;   ///< of the contact alone [m]
  Elastic contact;
  double flexibility;                                                         ///< along n [m/N]
  double share() const { return 1 / (1 + flexibility * contact.stiffness); }  ///< of the contact in a change of the approach
};

// With μ = F/|q|: q = (1 + μ G)⁻¹ e, whose length decreases with μ, while F increases with it: one root, in (0, depth of the gap).
Equilibrium equilibrium(const ContactPair& pair, const MovingPoint& a, const MovingPoint& b, const Gap& gap) {
  constexpr int most = 200;
  Equilibrium out{turned(pair.massless->a, a.angle), turned(pair.massless->b, b.angle), gap.e, gap.n, gap.depth, {}, 0};
  const double clearance = pair.gap.clearance();
  const Matrix2d G = out.A + out.B;
  double low = 0, high = gap.depth;
  for (int i = 0; i < most; ++i) {
    out.contact = elastic(pair, out.depth);
    const double reach = clearance + out.depth, mu = out.contact.force / reach;
    const Matrix2d inverse = (Matrix2d::Identity() + mu * G).inverse();
    out.q = inverse * gap.e;
    const double length = out.q.norm(), miss = length - reach;
    out.n = out.q / length;
    const double slope = 1 + out.n.dot(inverse * (G * out.q)) * (out.contact.stiffness - mu) / reach;
    (miss > 0 ? low : high) = out.depth;
    double next = out.depth + miss / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    const bool found = std::abs(next - out.depth) <= 4 * std::numeric_limits<double>::epsilon() * reach;
    if (found || next == low || next == high) break;
    out.depth = next;
  }
  out.flexibility = out.n.dot(G * out.n);
  return out;
}

/// Motion of the displaced centres as points of the bodies.
struct CentreMotion {
  Vector2d arm_a, arm_b, v;  ///< from the markers to the displaced centres [m]; relative velocity [m/s]
  double approach;           ///< [m/s]
};
CentreMotion motion_of_centres(const Equilibrium& s, const MovingPoint& a, const MovingPoint& b) {
  const Vector2d f = s.contact.force * s.n;
  CentreMotion out{-(s.A * f), s.B * f, {}, 0};
  out.v = a.v + a.w * perp(out.arm_a) - b.v - b.w * perp(out.arm_b);
  out.approach = out.v.dot(s.n);
  return out;
}

/// The law at the depth of the contact, whose damper the residual flexibility relieves twice: of speed and of force.
NormalForce local_force(const ContactPair& pair, const Equilibrium& s, const CentreMotion& r, double latched) {
  return evaluate(pair.normal, Approach{s.depth, s.share() * s.share() * r.approach, latched});
}

double slip(const ContactPair& pair, const Equilibrium& s, const CentreMotion& r, const MovingPoint& a, const MovingPoint& b) {
  return r.v.dot(perp(s.n)) + pair.gap.a.radius * a.w + pair.gap.b.radius * b.w;
}

NormalForce force_at_markers(const ContactPair& pair, const Equilibrium& s, const CentreMotion& r, double latched) {
  NormalForce out = local_force(pair, s, r, latched);
  const double share = s.share();
  out.stored += s.flexibility * s.contact.force * s.contact.force / 2;
  out.dissipation /= share * share;
  out.d_depth *= share;
  out.d_rate *= share * share;
  return out;
}

Row moment(const Vector2d& arm, const Rows& arm_p, const Vector2d& force, const Rows& force_p) {
  return force.y() * arm_p.row(0) - force.x() * arm_p.row(1) + arm.x() * force_p.row(1) - arm.y() * force_p.row(0);
}

/// Second derivative of the elastic force.
double stiffening(const ContactPair& pair, double depth) {
  const double step = 1e-5 * depth;
  return (elastic(pair, depth + step).stiffness - elastic(pair, depth - step).stiffness) / (2 * step);
}

}  // namespace

NormalForce massless_force(const ContactPair& pair, const MovingPoint& a, const MovingPoint& b, const Gap& gap, double latched) {
  const Equilibrium s = equilibrium(pair, a, b, gap);
  return force_at_markers(pair, s, motion_of_centres(s, a, b), latched);
}

void press_massless(const ContactPair& pair, const MovingPoint& a, const MovingPoint& b, double latched, ContactEffect& out) {
  const Equilibrium s = equilibrium(pair, a, b, out.gap);
  const CentreMotion r = motion_of_centres(s, a, b);
  out.normal = force_at_markers(pair, s, r, latched);
  Vector2d force = -out.normal.force * s.n;
  if (pair.friction && out.normal.force > 0) {
    const double speed = slip(pair, s, r, a, b);
    const FrictionForce law = evaluate(*pair.friction, speed, out.normal.force);
    out.friction = law.force, out.d_slip = law.d_speed, out.d_normal = law.d_normal;
    out.friction_loss = -out.friction * speed;
    force += out.friction * perp(s.n);
  }
  out.on_a << force, pair.gap.a.radius * out.friction + cross(r.arm_a, force);
  out.on_b << -force, pair.gap.b.radius * out.friction - cross(r.arm_b, force);
}

// Derivatives of everything above, in its order.
WrenchTangent massless_tangent(const ContactPair& pair, const ContactEffect& now, const MovingPoint& a, const MovingPoint& b) {
  const Equilibrium s = equilibrium(pair, a, b, now.gap);
  const CentreMotion r = motion_of_centres(s, a, b);
  const Vector2d &n = s.n, t = perp(n), f = s.contact.force * n;
  const double F = s.contact.force, k = s.contact.stiffness, share = s.share();
  const auto column = [](int i, const Vector2d& v) {
    Rows out = Rows::Zero();
    out.col(i) = v;
    return out;
  };
  const Rows turn_a = column(2, (Z * s.A - s.A * Z) * f), turn_b = column(5, (Z * s.B - s.B * Z) * f);
  const Matrix2d G = s.A + s.B, H = k * n * n.transpose() + F / s.q.norm() * t * t.transpose();
  Rows e_p = Rows::Zero();
  e_p.leftCols<2>().setIdentity(), e_p.middleCols<2>(3) = -Matrix2d::Identity();
  const Rows q_p = (Matrix2d::Identity() + G * H).inverse() * (e_p - turn_a - turn_b);
  const Rows arm_a_p = -turn_a - s.A * H * q_p, arm_b_p = turn_b + s.B * H * q_p;
  const Row n_p = t.transpose() * q_p / s.q.norm(), depth_p = n.transpose() * q_p;

  const Rows v_p = Z * (a.w * arm_a_p - b.w * arm_b_p);
  Rows v_v = e_p;
  v_v.col(2) = perp(r.arm_a), v_v.col(5) = -perp(r.arm_b);
  const Row approach_p = r.v.dot(t) * n_p + n.transpose() * v_p, approach_v = n.transpose() * v_v;

  Row flexibility_p = 2 * t.dot(G * n) * n_p;
  flexibility_p[2] -= 2 * t.dot(s.A * n), flexibility_p[5] -= 2 * t.dot(s.B * n);
  const Row share_p = -share * share * (k * flexibility_p + s.flexibility * stiffening(pair, s.depth) * depth_p);
  const double local_depth = now.normal.d_depth / share, local_rate = now.normal.d_rate / (share * share);
  const Row N_p = local_depth * depth_p + local_rate * share * (share * approach_p + 2 * r.approach * share_p);
  const Row N_v = local_rate * share * share * approach_v;

  Row T_p = Row::Zero(), T_v = Row::Zero();
  if (pair.friction) {
    Row slip_v = t.transpose() * v_v;
    slip_v[2] += pair.gap.a.radius, slip_v[5] += pair.gap.b.radius;
    T_p = now.d_slip * (t.transpose() * v_p - r.v.dot(n) * n_p) + now.d_normal * N_p;
    T_v = now.d_slip * slip_v + now.d_normal * N_v;
  }

  WrenchTangent out(2);
  const Vector2d force = now.on_a.head<2>();
  const auto place = [&](auto& to, const Rows& force_p, const Row& dT, const Rows& da, const Rows& db) {
    to.template topRows<2>() = force_p;
    to.template middleRows<2>(3) = -force_p;
    to.row(2) = pair.gap.a.radius * dT + moment(r.arm_a, da, force, force_p);
    to.row(5) = pair.gap.b.radius * dT - moment(r.arm_b, db, force, force_p);
  };
  const double N = now.normal.force, T = now.friction;
  place(out.pose, t * T_p - n * N_p - (N * t + T * n) * n_p, T_p, arm_a_p, arm_b_p);
  place(out.rate, t * T_v - n * N_v, T_v, Rows::Zero(), Rows::Zero());
  return out;
}

}  // namespace pintle
