#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "framework/dynamics/equations/equations.h"

/// Two bodies whose markers a joint, a force or a contact holds, and random states of them.
namespace pintle {

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double within(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
  /// Two turns either way; every third within 1e-5 of ±π.
  double angle() {
    if (++count_ % 3 != 0) return within(-12, 12);
    return (count_ % 2 == 0 ? 1 : -1) * (M_PI + within(-1e-5, 1e-5));
  }
  Eigen::Vector3d pose() { return {within(-1, 1), within(-1, 1), angle()}; }
  Eigen::Vector3d rates() { return {within(-2, 2), within(-2, 2), within(-3, 3)}; }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns, double reach) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return within(-reach, reach); });
  }
  Eigen::MatrixXd symmetric(Eigen::Index n, double reach) {
    const Eigen::MatrixXd A = matrix(n, n, reach);
    return (A + A.transpose()) / 2;
  }

 private:
  std::mt19937 random_;
  int count_ = 0;
};

/// Laws of time, written out.
inline Jet sine(double t) { return {0.7 + 0.3 * std::sin(2 * t), 0.6 * std::cos(2 * t), -1.2 * std::sin(2 * t)}; }
inline Jet steady(double) { return {-1.3, 0, 0}; }

/// A marker in the middle of a body, pose and rates [m, m, rad].
inline MarkerMotion moving(const Eigen::Vector3d& p, const Eigen::Vector3d& p_rate) {
  MarkerMotion m;
  m.r = p.head<2>();
  m.d.setZero();
  m.angle = p[2];
  m.u = {std::cos(p[2]), std::sin(p[2])};
  m.v = p_rate.head<2>();
  m.w = p_rate[2];
  return m;
}
/// About the world's origin.
inline double moment(const Eigen::Vector3d& p, const Wrench& wrench) { return cross(p.head<2>(), wrench.head<2>()) + wrench[2]; }

/// What carries a marker. A stiffening body has displacements of second order.
enum class Carrier { rigid, flexible, stiffening, fixed };

struct Carriers {
  Carrier a, b;
};
inline std::string name_of(const Carriers& c) {
  const char* names[] = {"Rigid", "Flexible", "Stiffening", "Ground"};
  return std::string(names[static_cast<int>(c.a)]) + names[static_cast<int>(c.b)];
}
inline void PrintTo(const Carriers& c, std::ostream* out) { *out << name_of(c); }
/// Every kind on either side; one side at most is fixed.
inline std::vector<Carriers> all_carriers() {
  std::vector<Carriers> all;
  for (const Carrier a : {Carrier::rigid, Carrier::flexible, Carrier::stiffening, Carrier::fixed})
    for (const Carrier b : {Carrier::rigid, Carrier::flexible, Carrier::stiffening, Carrier::fixed})
      if (a != Carrier::fixed || b != Carrier::fixed) all.push_back({a, b});
  return all;
}

inline constexpr int cloud_modes = 3;

/// A cloud of particles about its mass centre, moved by random shapes φ and, if it stiffens, by
/// random ψ at second order: every invariant is a sum over particles.
inline Body cloud(const std::string& name, double mass, bool stiffens, Draw& draw) {
  constexpr int particles = 10, n = cloud_modes;
  const double m = mass / particles;
  Eigen::MatrixXd x = draw.matrix(2, particles, 0.5);
  x.colwise() -= x.rowwise().mean().eval();
  const Eigen::MatrixXd raw = draw.matrix(2 * particles, n, 1);
  const Eigen::LLT<Eigen::MatrixXd> gram(m * raw.transpose() * raw);
  const Eigen::MatrixXd phi = gram.matrixL().solve(raw.transpose()).transpose();

  Body body{name, mass, m * x.squaredNorm()};
  FlexInertia& f = body.flex.emplace();
  f.S.setZero(2, n);
  f.j.setZero(n);
  f.h.setZero(n);
  f.G.setZero(n, n);
  f.omega = Eigen::Vector3d(4, 9, 15);
  f.zeta = Eigen::Vector3d(0.02, 0.1, 0);
  if (stiffens) {
    Foreshortening& F = f.second.emplace();
    F.S[0] = F.S[1] = F.j = F.h = Eigen::MatrixXd::Zero(n, n);
  }
  for (int k = 0; k < particles; ++k) {
    const Eigen::Vector2d at = x.col(k);
    const Eigen::Matrix2Xd shape = phi.middleRows<2>(2 * k);
    Eigen::Matrix2Xd turned(2, n);  // Zᵀφ
    turned << shape.row(1), -shape.row(0);
    f.S += m * shape;
    f.j += m * at.transpose() * shape;
    f.h += m * at.transpose() * turned;
    f.G += m * shape.transpose() * turned;
    if (!stiffens) continue;
    Foreshortening& F = *f.second;
    const Eigen::MatrixXd along = draw.symmetric(n, 0.5), across = draw.symmetric(n, 0.5);
    F.S[0] += m * along;
    F.S[1] += m * across;
    F.j += m * (at.x() * along + at.y() * across);
    F.h += m * (at.x() * across - at.y() * along);
  }
  return body;
}

/// Bodies 0 and 1 with markers 0 and 1 on them, the marker of a fixed side on the ground instead.
/// Neither joints nor forces yet: add them, then `number`.
inline System two_bodies(const Carriers& carriers) {
  Draw draw(3);
  System s;
  s.bodies = {{"first", 2.0, 0.3}, {"second", 0.7, 0.05}};
  s.markers = {{0, {0.3, -0.2}, 0.9}, {1, {-0.25, 0.4}, -2.2}};
  for (const int side : {0, 1}) {
    const Carrier carrier = side == 0 ? carriers.a : carriers.b;
    const auto at = static_cast<std::size_t>(side);
    if (carrier == Carrier::fixed) s.markers[at] = {ground, {0.15, -0.1}, 0.9};
    if (carrier != Carrier::flexible && carrier != Carrier::stiffening) continue;
    s.bodies[at] = cloud(s.bodies[at].name, s.bodies[at].m, carrier == Carrier::stiffening, draw);
    s.markers[at].shape = draw.matrix(2, cloud_modes, 1);
    s.markers[at].slope = draw.matrix(1, cloud_modes, 2);
    if (carrier == Carrier::stiffening) s.markers[at].second = {draw.symmetric(cloud_modes, 1), draw.symmetric(cloud_modes, 1)};
  }
  return s;
}

/// The same with a third, rigid body and marker 2 on it, for joints of three ends.
inline System three_bodies(const Carriers& carriers) {
  System s = two_bodies(carriers);
  s.bodies.push_back({"third", 1.3, 0.11});
  s.markers.push_back({2, {0.1, 0.35}, 1.4});
  return s;
}
/// As many bodies as the joint has ends.
inline System bodies_for(const Joint& joint, const Carriers& carriers) {
  return ends_of(joint).n == 2 ? two_bodies(carriers) : three_bodies(carriers);
}

/// Time, poses, deformations, all speeds and internal states at random, the two markers more than 0.3 m apart.
/// Leaves the pose in `eq`.
inline State random_state(const System& system, Draw& draw, Equations& eq) {
  State s;
  s.t = draw.within(-3, 3);
  s.y.setZero(system.n_y());
  const int n_modal = system.n() - system.n_rigid();
  for (;;) {
    for (int b = 0; 3 * b < system.n_rigid(); ++b) {
      s.y.segment<3>(3 * b) = draw.pose();
      s.y.segment<3>(system.n() + 3 * b) = draw.rates();
    }
    s.y.segment(system.n_rigid(), n_modal) = draw.matrix(n_modal, 1, 0.1);
    s.y.segment(system.n() + system.n_rigid(), n_modal) = draw.matrix(n_modal, 1, 1);
    s.y.segment(system.x_begin(), system.n_x()) = draw.matrix(system.n_x(), 1, 0.8);
    pose(system, s.t, s.y, eq);
    if ((eq.motion[0].r - eq.motion[1].r).norm() > 0.3) return s;
  }
}

}  // namespace pintle
