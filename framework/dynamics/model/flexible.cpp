#include "framework/dynamics/model/flexible.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Part = Eigen::Map<const VectorXd>;

// aᵀ F b without a temporary.
template <class A, class B>
double form(const Eigen::MatrixXd& F, const A& a, const B& b) {
  double sum = 0;
  for (Index c = 0; c < F.cols(); ++c) sum += b[c] * F.col(c).dot(a);
  return sum;
}

// w = c + Sη + ½ηᵀS₂η, with c = 0 since the origin is the mass centre.
Vector2d first_moment(const FlexInertia& f, const Part& eta) {
  Vector2d w(f.S.row(0).dot(eta), f.S.row(1).dot(eta));
  if (f.second) w += Vector2d(form(f.second->S[0], eta, eta), form(f.second->S[1], eta, eta)) / 2;
  return w;
}

// [m 1, ZAw; ·, J]
Eigen::Matrix3d rigid_block(double m, const Vector2d& arm, double J) {
  const Vector2d turn = perp(arm);
  Eigen::Matrix3d M;
  M << m, 0, turn.x(), 0, m, turn.y(), turn.x(), turn.y(), J;
  return M;
}

void turn_columns(double c, double s, Eigen::Matrix3Xd& B) {
  for (Index i = 0; i < B.cols(); ++i) B.col(i).head<2>() = turned(c, s, B.col(i).head<2>());
}

// Explicit factorization R = L Lᵀ, root = L⁻ᵀ.
bool invert(const Eigen::Matrix3d& R, FlexibleInertia::Inverse& out) {
  if (!(R(0, 0) > 0)) return false;
  const double i0 = 1 / std::sqrt(R(0, 0)), l10 = R(1, 0) * i0, l20 = R(2, 0) * i0, d1 = R(1, 1) - l10 * l10;
  if (!(d1 > 0)) return false;
  const double i1 = 1 / std::sqrt(d1), l21 = (R(2, 1) - l20 * l10) * i1, d2 = R(2, 2) - l20 * l20 - l21 * l21;
  if (!(d2 > 0)) return false;
  const double i2 = 1 / std::sqrt(d2);
  out.root << i0, -l10 * i0 * i1, (l10 * l21 * i1 - l20) * i0 * i2, 0, i1, -l21 * i1 * i2, 0, 0, i2;
  out.inverse.noalias() = out.root * out.root.transpose();
  return out.inverse.allFinite();
}

// Generalized forces on η of the term ½ zᵀM z, z = M⁻¹Bη̇, that E adds to the kinetic energy, times sign: −d/dt(Bᵀz) + ∂/∂η without
// accelerations. bend = Ḃη̇, G_rate = Gη̇.
void add_carried(const FlexibleInertia::Part& p, const Eigen::Vector3d& bend, const Part& rate, const VectorXd& G_rate, double sign,
                 Eigen::Ref<VectorXd> modal) {
  const Eigen::LLT<Eigen::Matrix3d> M(p.M);
  const Eigen::Vector3d momentum = p.B * rate, z = M.solve(momentum);
  const Vector2d w_rate = perp(momentum.head<2>());  // Zẇ
  const Eigen::Vector3d M_rate_z(w_rate.x() * z[2], w_rate.y() * z[2], w_rate.dot(z.head<2>()) + 2 * p.j.dot(rate) * z[2]);
  Eigen::Vector3d rest = M.solve(bend - M_rate_z);
  rest.head<2>() -= z[2] * perp(z.head<2>());  // Zᵀ = −Z
  modal += (2 * sign * z[2]) * G_rate;
  modal.noalias() -= sign * p.B.transpose() * rest;
  modal -= (sign * z[2] * z[2]) * p.j.transpose();
}

}  // namespace

FlexibleInertia::FlexibleInertia(const System& system, int i)
    : body(i),
      begin(system.eta_begin[static_cast<std::size_t>(i)]),
      n(system.bodies[static_cast<std::size_t>(i)].modes()),
      stiffens(system.bodies[static_cast<std::size_t>(i)].flex->second.has_value()),
      work(VectorXd::Zero(n)),
      other(work) {
  for (Part* part : {&whole, &linear}) {
    part->B.setZero(3, n);
    part->j.setZero(n);
  }
}

void evaluate_inertia(const System& system, const VectorXd& q, double c, double s, FlexibleInertia& e) {
  const Body& body = system.bodies[static_cast<std::size_t>(e.body)];
  const FlexInertia& f = *body.flex;
  const Part eta(q.data() + e.begin, e.n);
  FlexibleInertia::Part& p = e.whole;
  for (Index i = 0; i < e.n; ++i) p.B.col(i) << f.S(0, i), f.S(1, i), f.h[i] + f.G.col(i).dot(eta);  // still in body axes
  p.j = f.j + eta.transpose();
  double J = body.J + (f.j + p.j).dot(eta);  // J₀ + 2jη + ηᵀη
  if (e.stiffens) {
    e.linear.B = p.B;
    e.linear.j = p.j;
    turn_columns(c, s, e.linear.B);
    e.linear.M = rigid_block(body.m, turned(c, s, {f.S.row(0).dot(eta), f.S.row(1).dot(eta)}), J);
    const Foreshortening& F = *f.second;
    e.work.noalias() = F.j * eta;
    p.j += e.work.transpose();
    J += e.work.dot(eta);
    const std::array<const Eigen::MatrixXd*, 3> second{&F.S[0], &F.S[1], &F.h};
    for (Index k = 0; k < 3; ++k) {
      e.work.noalias() = *second[static_cast<std::size_t>(k)] * eta;
      p.B.row(k) += e.work.transpose();
    }
  }
  turn_columns(c, s, p.B);
  e.arm = turned(c, s, first_moment(f, eta));
  p.M = rigid_block(body.m, e.arm, J);
}

bool invert(FlexibleInertia& e) {
  if (e.stiffens && !invert(e.whole.M, e.rigid)) return false;
  const FlexibleInertia::Part& p = e.stiffens ? e.linear : e.whole;
  Eigen::Matrix3d R = p.M;
  for (Index i = 0; i < e.n; ++i) {
    const Eigen::Vector3d b = p.B.col(i);
    R.noalias() -= b * b.transpose();
  }
  return invert(R, e.frame);
}

// Without foreshortening the shapes are eliminated first, since their block is 1. With it the frame is eliminated first; this leaves 1 −
// B₁ᵀM₁⁻¹B₁, whose inverse is 1 + B₁ᵀ(M₁ − B₁B₁ᵀ)⁻¹B₁.
void solve(FlexibleInertia& e, double* v) {
  Eigen::Map<Eigen::Vector3d> r(v + 3 * e.body);
  Eigen::Map<VectorXd> eta(v + e.begin, e.n);
  const Eigen::Matrix3Xd& B = e.whole.B;
  Eigen::Vector3d left = r;
  if (!e.stiffens) {
    left -= B.lazyProduct(eta);
    const Eigen::Vector3d a = e.frame.inverse * left;
    r = a;
    eta -= B.transpose().lazyProduct(a);
    return;
  }
  r.noalias() = e.rigid.inverse * left;
  eta.noalias() -= B.transpose() * r;
  const Eigen::Vector3d carried = e.frame.inverse * (e.linear.B * eta);
  eta.noalias() += e.linear.B.transpose() * carried;
  left.noalias() -= B * eta;
  r.noalias() = e.rigid.inverse * left;
}

void to_metric(const FlexibleInertia& e, const Eigen::Matrix3d& L_r, const Eigen::Ref<const RowBlock>& L_eta, Eigen::Matrix3d& B_hat,
               RowBlock& B_eta_hat) {
  if (!e.stiffens) {
    Eigen::Matrix3d rest = L_r;
    for (Index i = 0; i < e.n; ++i) rest.noalias() -= L_eta.col(i) * e.whole.B.col(i).transpose();
    B_hat.noalias() = rest * e.frame.root;
    B_eta_hat = L_eta;
    return;
  }
  B_hat.noalias() = L_r * e.rigid.root;
  const Eigen::Matrix3d gain = L_r * e.rigid.inverse;
  auto shapes = B_eta_hat.leftCols(e.n);
  shapes = L_eta;
  shapes.noalias() -= gain * e.whole.B;
  const Eigen::Matrix3d carried = shapes * e.linear.B.transpose();
  B_eta_hat.rightCols<3>().noalias() = carried * e.frame.root;
}

void add_mass_times(const FlexibleInertia& e, const double* v, double* out) {
  const Eigen::Map<const Eigen::Vector3d> r(v + 3 * e.body);
  const Part eta(v + e.begin, e.n);
  Eigen::Map<Eigen::Vector3d> frame(out + 3 * e.body);
  Eigen::Map<VectorXd> shapes(out + e.begin, e.n);
  const auto carried = [&](const FlexibleInertia::Part& p, double sign) {  // ± BᵀM⁻¹Bη
    const Eigen::Vector3d momentum = p.B * eta, z = p.M.llt().solve(momentum);
    shapes.noalias() += sign * p.B.transpose() * z;
  };
  frame.noalias() += e.whole.M * r;
  frame.noalias() += e.whole.B * eta;
  shapes.noalias() += e.whole.B.transpose() * r;
  shapes += eta;
  if (!e.stiffens) return;
  carried(e.whole, 1);
  carried(e.linear, -1);
}

Eigen::MatrixXd mass_matrix(const FlexibleInertia& e) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(3 + e.n, 3 + e.n);
  M.topLeftCorner<3, 3>() = e.whole.M;
  M.topRightCorner(3, e.n) = e.whole.B;
  M.bottomLeftCorner(e.n, 3) = e.whole.B.transpose();
  if (e.stiffens)
    M.bottomRightCorner(e.n, e.n) +=
        e.whole.B.transpose() * e.whole.M.llt().solve(e.whole.B) - e.linear.B.transpose() * e.linear.M.llt().solve(e.linear.B);
  return M;
}

void add_forces(const System& system, const VectorXd& y, FlexibleInertia& e, VectorXd& f) {
  const Body& body = system.bodies[static_cast<std::size_t>(e.body)];
  const FlexInertia& flex = *body.flex;
  const double* s = y.data() + system.n();
  const double spin = s[3 * e.body + 2];
  const Part eta(y.data() + e.begin, e.n), rate(s + e.begin, e.n);
  auto r = f.segment<3>(3 * e.body);
  auto modal = f.segment(e.begin, e.n);

  const FlexibleInertia::Part& p = e.whole;
  if (has_gravity(system)) {  // M times the acceleration of the frame
    const Vector2d& g = system.gravity;
    r[0] += body.m * g.x();
    r[1] += body.m * g.y();
    r[2] += cross(e.arm, g);
    modal += p.B.topRows<2>().transpose().lazyProduct(g);
  }

  const Vector2d drift = p.B.topRows<2>().lazyProduct(rate);  // A S(η) η̇
  r.head<2>() += spin * spin * e.arm - 2 * spin * perp(drift);
  r[2] -= 2 * spin * p.j.dot(rate);
  modal += spin * spin * p.j.transpose();
  for (Index i = 0; i < e.n; ++i) e.work[i] = -flex.G.col(i).dot(rate);  // Gη̇, G being skew
  modal += 2 * spin * e.work;
  if (e.stiffens) {
    const Foreshortening& F = *flex.second;
    const double angle = y[3 * e.body + 2];
    const Vector2d along = turned(std::cos(angle), std::sin(angle), {form(F.S[0], rate, rate), form(F.S[1], rate, rate)});
    const Eigen::Vector3d bend(along.x(), along.y(), form(F.h, rate, rate));
    r -= bend;
    add_carried(e.whole, bend, rate, e.work, 1, modal);
    add_carried(e.linear, Eigen::Vector3d::Zero(), rate, e.work, -1, modal);
  }
  modal -= flex.omega.cwiseAbs2().cwiseProduct(eta) + (2 * flex.zeta).cwiseProduct(flex.omega).cwiseProduct(rate);
}

double kinetic_energy(const System& system, const VectorXd& y, int i) {
  const Body& body = system.bodies[static_cast<std::size_t>(i)];
  const double* q = y.data() + 3 * i;
  const double* s = q + system.n();
  const double rigid = (body.m * (s[0] * s[0] + s[1] * s[1]) + body.J * s[2] * s[2]) / 2;
  if (body.modes() == 0) return rigid;
  const FlexInertia& f = *body.flex;
  const int begin = system.eta_begin[static_cast<std::size_t>(i)];
  const Part eta(y.data() + begin, body.modes()), rate(y.data() + system.n() + begin, body.modes());
  const double cosine = std::cos(q[2]), sine = std::sin(q[2]);
  const Vector2d w = first_moment(f, eta), v = turned(cosine, -sine, {s[0], s[1]});  // body axes
  Eigen::Vector3d carried(f.S.row(0).dot(rate), f.S.row(1).dot(rate), f.h.dot(rate) + form(f.G, eta, rate));
  double J = 2 * f.j.dot(eta) + eta.squaredNorm(), beside = 0;
  if (f.second) {
    const Foreshortening& F = *f.second;
    const auto energy = [&](const Vector2d& arm) { return carried.dot(rigid_block(body.m, arm, body.J + J).llt().solve(carried)) / 2; };
    beside -= energy({f.S.row(0).dot(eta), f.S.row(1).dot(eta)});
    J += form(F.j, eta, eta);
    carried += Eigen::Vector3d(form(F.S[0], eta, rate), form(F.S[1], eta, rate), form(F.h, eta, rate));
    beside += energy(w);
  }
  return rigid + v.dot(s[2] * perp(w) + carried.head<2>()) + s[2] * (s[2] * J / 2 + carried[2]) + rate.squaredNorm() / 2 + beside;
}

double strain_energy(const System& system, const VectorXd& y, int i) {
  const Body& body = system.bodies[static_cast<std::size_t>(i)];
  if (body.modes() == 0) return 0;
  const Part eta(y.data() + system.eta_begin[static_cast<std::size_t>(i)], body.modes());
  return body.flex->omega.cwiseProduct(eta).squaredNorm() / 2;
}

double damping_loss(const System& system, const VectorXd& y, int i) {
  const Body& body = system.bodies[static_cast<std::size_t>(i)];
  if (body.modes() == 0) return 0;
  const Part rate(y.data() + system.n() + system.eta_begin[static_cast<std::size_t>(i)], body.modes());
  return 2 * body.flex->zeta.cwiseProduct(body.flex->omega).dot(rate.cwiseAbs2());
}

Vector2d mass_centre(const System& system, const VectorXd& y, int i) {
  const Body& body = system.bodies[static_cast<std::size_t>(i)];
  const double* q = y.data() + 3 * i;
  Vector2d r(q[0], q[1]);
  if (body.modes() == 0) return r;
  const Part eta(y.data() + system.eta_begin[static_cast<std::size_t>(i)], body.modes());
  return r + turned(std::cos(q[2]), std::sin(q[2]), first_moment(*body.flex, eta)) / body.m;
}

}  // namespace pintle
