#include "framework/dynamics/flexible.h"

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

Vector2d turned(double c, double s, const Vector2d& v) { return {c * v.x() - s * v.y(), s * v.x() + c * v.y()}; }

// w = c + Sη + ½ηᵀS₂η, the origin being the mass centre: c = 0.
Vector2d first_moment(const FlexInertia& f, const Part& eta) {
  Vector2d w(f.S.row(0).dot(eta), f.S.row(1).dot(eta));
  if (f.second) w += Vector2d(form(f.second->S[0], eta, eta), form(f.second->S[1], eta, eta)) / 2;
  return w;
}

}  // namespace

void evaluate_inertia(const System& system, const VectorXd& q, double c, double s, FlexibleInertia& e) {
  const Body& body = system.bodies[static_cast<std::size_t>(e.body)];
  const FlexInertia& f = *body.flex;
  const Part eta(q.data() + e.begin, e.n);
  e.arm = turned(c, s, first_moment(f, eta));
  e.j = f.j + eta.transpose();
  double J = body.J + (f.j + e.j).dot(eta);  // J₀ + 2jη + ηᵀη
  if (f.second) {  // rows S(η), h(η) first, in body axes
    const Foreshortening& F = *f.second;
    e.work.noalias() = F.j * eta;
    e.j += e.work.transpose();
    J += e.work.dot(eta);
    for (Index k = 0; k < 2; ++k) {
      e.work.noalias() = F.S[static_cast<std::size_t>(k)] * eta;
      e.B.row(k) = f.S.row(k) + e.work.transpose();
    }
    e.work.noalias() = F.h * eta;
    e.B.row(2) = f.h + e.work.transpose();
  } else {
    e.B.topRows<2>() = f.S;
    e.B.row(2) = f.h;
  }
  e.work.noalias() = f.G.transpose() * eta;
  e.B.row(2) += e.work.transpose();
  for (Index i = 0; i < e.n; ++i) e.B.col(i).head<2>() = turned(c, s, e.B.col(i).head<2>());
  const Vector2d turn = perp(e.arm);
  e.M << body.m, 0, turn.x(), 0, body.m, turn.y(), turn.x(), turn.y(), J;
}

bool invert(FlexibleInertia& e) {
  Eigen::Matrix3d R = e.M;
  R.noalias() -= e.B * e.B.transpose();
  const Eigen::LLT<Eigen::Matrix3d> factor(R);
  if (factor.info() != Eigen::Success) return false;
  e.root = factor.matrixU().solve(Eigen::Matrix3d::Identity());
  e.inverse.noalias() = e.root * e.root.transpose();
  return e.inverse.allFinite();
}

void solve(const FlexibleInertia& e, double* v) {
  Eigen::Map<Eigen::Vector3d> r(v + 3 * e.body);
  Eigen::Map<VectorXd> eta(v + e.begin, e.n);
  Eigen::Vector3d left = r;
  left.noalias() -= e.B * eta;
  r.noalias() = e.inverse * left;
  eta.noalias() -= e.B.transpose() * r;
}

void add_forces(const System& system, const VectorXd& y, FlexibleInertia& e, VectorXd& f) {
  const Body& body = system.bodies[static_cast<std::size_t>(e.body)];
  const FlexInertia& flex = *body.flex;
  const double* s = y.data() + system.n();
  const double spin = s[3 * e.body + 2];
  const Part eta(y.data() + e.begin, e.n), rate(s + e.begin, e.n);
  auto r = f.segment<3>(3 * e.body);
  auto modal = f.segment(e.begin, e.n);

  // Gravity is M times an acceleration of the frame.
  const Vector2d& g = system.gravity;
  r[0] += body.m * g.x();
  r[1] += body.m * g.y();
  r[2] += cross(e.arm, g);
  modal.noalias() += e.B.topRows<2>().transpose() * g;

  Vector2d drift;  // A S(η) η̇
  drift.noalias() = e.B.topRows<2>() * rate;
  r.head<2>() += spin * spin * e.arm - 2 * spin * perp(drift);
  r[2] -= 2 * spin * e.j.dot(rate);
  modal += spin * spin * e.j.transpose();
  e.work.noalias() = flex.G * rate;
  modal += 2 * spin * e.work;
  if (flex.second) {
    const Foreshortening& F = *flex.second;
    const double angle = y[3 * e.body + 2];
    r.head<2>() -= turned(std::cos(angle), std::sin(angle), {form(F.S[0], rate, rate), form(F.S[1], rate, rate)});
    r[2] -= form(F.h, rate, rate);
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
  const Vector2d v(s[0], s[1]), w = first_moment(f, eta);
  Vector2d drift(f.S.row(0).dot(rate), f.S.row(1).dot(rate));
  double J = 2 * f.j.dot(eta) + eta.squaredNorm(), h = f.h.dot(rate) + form(f.G, eta, rate);
  if (f.second) {
    const Foreshortening& F = *f.second;
    drift += Vector2d(form(F.S[0], eta, rate), form(F.S[1], eta, rate));
    J += form(F.j, eta, eta);
    h += form(F.h, eta, rate);
  }
  return rigid + v.dot(turned(cosine, sine, s[2] * perp(w) + drift)) + s[2] * (s[2] * J / 2 + h) +
         rate.squaredNorm() / 2;
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
