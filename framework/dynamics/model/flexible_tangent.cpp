#include "framework/dynamics/model/flexible_tangent.h"

#include <Eigen/LU>
#include <cmath>

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Part = Eigen::Map<const VectorXd>;
using Square = Eigen::Ref<Eigen::MatrixXd>;

// The motion of one body, world axes.
struct Motion {
  double cos, sin, spin;
  Part eta, rate, accel;
  Vector2d against_gravity;  // r̈ − g
  double spin_accel;
};

// ∂(Bv)/∂η at constant v.
void bend(const FlexInertia& f, const Motion& m, const Part& v, const VectorXd& G_v, Eigen::Matrix3Xd& out) {
  out.topRows<2>().setZero();
  out.row(2) = G_v.transpose();
  if (!f.second) return;
  const Eigen::MatrixXd &Sx = f.second->S[0], &Sy = f.second->S[1], &h = f.second->h;
  for (Index i = 0; i < v.size(); ++i) {
    const double x = Sx.col(i).dot(v), y = Sy.col(i).dot(v);
    out.col(i) += Vector3d(m.cos * x - m.sin * y, m.sin * x + m.cos * y, h.col(i).dot(v));
  }
}

void fill(const FlexInertia& f, const Motion& m, FlexibleScratch& scratch) {
  scratch.G_rate.noalias() = f.G * m.rate;
  scratch.G_accel.noalias() = f.G * m.accel;
  bend(f, m, m.rate, scratch.G_rate, scratch.bent_rate);
  bend(f, m, m.accel, scratch.G_accel, scratch.bent_accel);
  scratch.j_rate = m.rate;
  if (f.second) scratch.j_rate.noalias() += f.second->j * m.rate;
}

// Rows and columns of the frame.
void add_frame(double mass, const FlexibleInertia& e, const Motion& m, const TangentWeights& w, const FlexibleScratch& scratch, Square K) {
  const FlexibleInertia::Part& p = e.whole;
  const auto S = p.B.topRows<2>();
  const double spin = m.spin, jv = p.j.dot(m.rate);
  Vector2d drift, pull;  // A S(η)η̇, A S(η)η̈
  drift.noalias() = S * m.rate;
  pull.noalias() = S * m.accel;
  Vector2d along;  // A η̇ᵀS₂η̇
  along.noalias() = scratch.bent_rate.topRows<2>() * m.rate;

  K(0, 0) += w.a * mass;
  K(1, 1) += w.a * mass;
  K.block<1, 2>(2, 0) += w.a * p.M.block<1, 2>(2, 0);
  K.block<2, 1>(0, 2) += w.a * p.M.block<2, 1>(0, 2) + w.s * (2 * perp(drift) - 2 * spin * e.arm) +
                         w.q * (perp(pull + along - spin * spin * e.arm) - m.spin_accel * e.arm - 2 * spin * drift);
  K(2, 2) += w.a * p.M(2, 2) + w.s * 2 * jv - w.q * e.arm.dot(m.against_gravity);

  const double turned = w.q * m.spin_accel + 2 * w.s * spin, straight = w.a - w.q * spin * spin;
  for (Index i = 0; i < e.n; ++i) {
    const Vector2d s = S.col(i), bent = scratch.bent_rate.col(i).head<2>(), in_turn = perp(s);
    const double weight = in_turn.dot(m.against_gravity);
    const Index k = 3 + i;
    K.block<2, 1>(0, k) +=
        straight * s + turned * in_turn + w.q * scratch.bent_accel.col(i).head<2>() + 2 * w.q * spin * perp(bent) + 2 * w.s * bent;
    K.block<1, 2>(k, 0) += w.a * s.transpose();
    const double h_rate = scratch.bent_rate(2, i) - scratch.G_rate[i];  // h₂η̇
    K(2, k) += w.a * p.B(2, i) + 2 * w.s * (spin * p.j[i] + h_rate) +
               w.q * (weight + 2 * m.spin_accel * p.j[i] + scratch.bent_accel(2, i) + 2 * spin * scratch.j_rate[i]);
    K(k, 2) += w.a * p.B(2, i) - 2 * w.s * (spin * p.j[i] + scratch.G_rate[i]) + w.q * weight;
  }
}

// Rows and columns of the shapes, without the contribution of E.
void add_shapes(const FlexInertia& f, const Motion& m, const TangentWeights& w, Square K) {
  const Index n = m.eta.size();
  auto shapes = K.bottomRightCorner(n, n);
  const double spin2 = m.spin * m.spin;
  shapes.noalias() -= (w.q * m.spin_accel + 2 * w.s * m.spin) * f.G;  // Gᵀ = −G
  shapes.diagonal().array() += w.a - w.q * spin2;
  shapes.diagonal().array() += f.omega.array() * (w.q * f.omega.array() + 2 * w.s * f.zeta.array());
  if (!f.second) return;
  const Vector2d& b = m.against_gravity;
  const Vector2d push = w.q * Vector2d(m.cos * b.x() + m.sin * b.y(), m.cos * b.y() - m.sin * b.x());
  const Foreshortening& F = *f.second;
  shapes += push.x() * F.S[0] + push.y() * F.S[1] + w.q * m.spin_accel * F.h - w.q * spin2 * F.j;
}

// Ṁx where the first moment changes by q_h and half of J by j.
Vector3d inertia_change(const Vector3d& q, double j, const Vector3d& x) {
  Vector3d out;
  out << x[2] * perp(q.head<2>()), cross(q.head<2>(), x.head<2>()) + 2 * j * x[2];
  return out;
}

// Contribution of ½ zᵀM z, z = M⁻¹Bη̇, to η, times sign.
void add_carried(const FlexInertia& f, const FlexibleInertia::Part& p, bool second, double sign, const Motion& m, const TangentWeights& w,
                 FlexibleScratch& scratch, Square K) {
  const Index n = m.eta.size();
  auto shapes = K.bottomRightCorner(n, n);
  scratch.B = p.B.transpose();
  const auto bent = [&](const Eigen::Matrix3Xd& whole, const VectorXd& G, Index i) -> Vector3d {
    return second ? Vector3d(whole.col(i)) : Vector3d(0, 0, G[i]);
  };
  const Matrix3d inverse = p.M.inverse();
  Vector3d momentum, force;
  momentum.noalias() = p.B * m.rate;
  force.noalias() = p.B * m.accel;
  const Vector3d z = inverse * momentum;
  if (second) force.noalias() += scratch.bent_rate * m.rate;
  const double j_rate = p.j.dot(m.rate);
  const Vector3d z_rate = inverse * (force - inertia_change(momentum, j_rate, z));
  Vector3d y = z_rate;
  y.head<2>() -= z[2] * perp(z.head<2>());

  for (Index i = 0; i < n; ++i) {
    const Vector3d B = p.B.col(i), by_rate = bent(scratch.bent_rate, scratch.G_rate, i),
                   by_accel = bent(scratch.bent_accel, scratch.G_accel, i);
    const double j_bent = second ? scratch.j_rate[i] : m.rate[i];
    const Vector3d swung = inertia_change(B, p.j[i], z), twice(0, 0, scratch.G_rate[i]);
    const Vector3d dz = inverse * (w.q * (by_rate - swung) + w.s * B);
    const Vector3d force_i = w.q * (by_accel - inertia_change(by_rate, j_bent, z) - inertia_change(B, p.j[i], z_rate)) +
                             w.s * (2 * (by_rate - twice) - swung) - inertia_change(momentum, j_rate, dz) + w.a * B;
    Vector3d dy = inverse * force_i;
    dy.head<2>() -= dz[2] * perp(z.head<2>()) + z[2] * perp(dz.head<2>());
    dy *= sign;
    shapes.col(i).noalias() += scratch.B.lazyProduct(dy);
    shapes.col(i) += (2 * sign * dz[2]) * (z[2] * p.j.transpose() - scratch.G_rate);
  }
  shapes -= sign * (w.q * y[2] + 2 * w.s * z[2]) * f.G;  // Gᵀ = −G
  const double centrifugal = sign * w.q * z[2] * z[2];
  shapes.diagonal().array() += centrifugal;
  if (!second) return;
  const Foreshortening& F = *f.second;
  const Vector2d push = sign * w.q * Vector2d(m.cos * y[0] + m.sin * y[1], m.cos * y[1] - m.sin * y[0]);
  shapes += push.x() * F.S[0] + push.y() * F.S[1] + sign * w.q * y[2] * F.h + centrifugal * F.j;
}

}  // namespace

void add_inertia_tangent(const System& system, const FlexibleInertia& e, const VectorXd& y, const VectorXd& a, const TangentWeights& w,
                         FlexibleScratch& scratch, Eigen::Ref<Eigen::MatrixXd> K) {
  const Body& body = system.bodies[static_cast<std::size_t>(e.body)];
  const FlexInertia& f = *body.flex;
  const Index frame = 3 * e.body, n_q = system.n();
  const double angle = y[frame + 2];
  const Motion m{std::cos(angle),
                 std::sin(angle),
                 y[n_q + frame + 2],
                 Part(y.data() + e.begin, e.n),
                 Part(y.data() + n_q + e.begin, e.n),
                 Part(a.data() + e.begin, e.n),
                 a.segment<2>(frame) - system.gravity,
                 a[frame + 2]};
  fill(f, m, scratch);
  add_frame(body.m, e, m, w, scratch, K);
  add_shapes(f, m, w, K);
  if (!e.stiffens) return;
  add_carried(f, e.whole, true, 1, m, w, scratch, K);
  add_carried(f, e.linear, false, -1, m, w, scratch, K);
}

}  // namespace pintle
