#include "flexible_slider_crank.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pintle_oracle::flexible {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

// Gauss–Legendre on [0, 1], exact to degree 7: ρA JᵀJ is of degree 6 in ξ.
constexpr double gauss_at[4] = {0.069431844202973712, 0.330009478207571868, 0.669990521792428132, 0.930568155797026288};
constexpr double gauss_weight[4] = {0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929};

Vector2d quarter_turn(const Vector2d& v) { return {-v.y(), v.x()}; }

/// Sines and cosines of a state, for all points of the coupler.
struct Pose {
  Pose(const Params& p, const Y& y)
      : crank(std::cos(y[0]), std::sin(y[0])), along(std::cos(y[1]), std::sin(y[1])), across(quarter_turn(along)), length(p.coupler) {}
  Vector2d crank, along, across;  // units along the crank, along the chord, left of it
  double length;
};

/// A point of the coupler: ṙ = J q̇, r̈ = J q̈ + drift.
struct Point {
  Vector2d r, drift;
  Matrix26 J;
};

Point point(const Params& p, const Pose& at, const Y& y, double xi) {
  const double n2 = at.length * xi * (1 - xi) * (1 - xi), n4 = at.length * xi * xi * (xi - 1);
  const double along = (at.length + y[2]) * xi, across = n2 * y[3] + n4 * y[4];
  const double along_rate = y[8] * xi, across_rate = n2 * y[9] + n4 * y[10];
  const Vector2d arm = along * at.along + across * at.across;
  const Vector2d arm_rate = along_rate * at.along + across_rate * at.across;  // seen on the chord
  Point out;
  out.r = p.crank * at.crank + arm;
  out.drift = -p.crank * y[6] * y[6] * at.crank - y[7] * y[7] * arm + 2 * y[7] * quarter_turn(arm_rate);
  out.J << p.crank * quarter_turn(at.crank), quarter_turn(arm), xi * at.along, n2 * at.across, n4 * at.across, Vector2d::Zero();
  return out;
}

Vector6 rates(const Y& y) { return Eigen::Map<const Vector6>(y.data() + dofs); }

Inertia inertia(const Params& p, const Pose& at, const Y& y) {
  Inertia out{Matrix6::Zero(), Vector6::Zero(), Vector6::Zero()};
  for (int g = 0; g < 4; ++g) {
    const Point b = point(p, at, y, gauss_at[g]);
    const double dm = gauss_weight[g] * p.rho_a * p.coupler;
    out.mass.noalias() += dm * b.J.transpose() * b.J;
    out.velocity.noalias() += dm * b.J.transpose() * b.drift;
    out.weight -= dm * p.gravity * b.J.row(1).transpose();
  }
  const double half = p.crank / 2;
  out.mass(0, 0) += p.crank_inertia + p.crank_mass * half * half;
  out.mass(5, 5) += p.slider_mass;
  out.weight(0) -= p.crank_mass * p.gravity * half * at.crank.x();
  return out;
}

struct Contact {
  Vector2d force = Vector2d::Zero();  // on the coupler at B
  double moment = 0;                  // on its end section
  double elastic = 0, normal = 0, friction = 0, slip = 0;
};

/// Without force unless touching.
Contact contact(const Model& m, const Gap& g, const Y& y, bool touching, double latch) {
  Contact f;
  const double r = m.p.clearance + g.depth, spin = y[7] + y[10];
  const Vector2d n = r > 0 ? Vector2d(g.e / r) : Vector2d(1, 0), t = quarter_turn(n);
  f.slip = g.e_rate.dot(t) + m.side * m.lever * spin;
  if (!touching || g.depth <= 0) return f;
  f.elastic = m.p.stiffness * g.depth * std::sqrt(g.depth);
  f.normal = std::max(0.0, f.elastic * (1 + m.p.chi * g.rate / latch));
  const double v = m.p.slip == Slip::material ? f.slip : g.e_rate.dot(t) * g.depth / r;
  const double factor = std::clamp((std::abs(v) - m.p.v0) / (m.p.v1 - m.p.v0), 0.0, 1.0);
  f.friction = -std::copysign(m.p.mu * factor * f.normal, v);
  f.force = m.side * (f.friction * t - f.normal * n);
  f.moment = m.side * f.friction * m.lever;
  return f;
}

struct Motion {
  Vector6 acceleration;
  Vector2d pin_force;
  double hysteresis_power, friction_power, rayleigh_power;
};

/// Ideal pin: closed as `close_loop` leaves it.
Motion motion(const Model& m, const Y& y, bool touching, double latch) {
  const Pose at(m.p, y);
  const Inertia mass = inertia(m.p, at, y);
  const Vector3d strain(y[2], y[3], y[4]), strain_rate(y[8], y[9], y[10]);
  const Vector3d damping = m.coupler.damping * strain_rate;
  Vector6 f = mass.weight - mass.velocity;
  f.segment<3>(2) -= m.coupler.stiffness * strain + damping;
  Motion out{Vector6::Zero(), Vector2d::Zero(), 0, 0, strain_rate.dot(damping)};
  const Eigen::LLT<Matrix6> M(mass.mass);
  if (!m.ideal && !touching) {
    out.acceleration = M.solve(f);
    return out;
  }
  const Point b = point(m.p, at, y, 1);
  Matrix26 C = b.J;  // velocity of B against the slider
  C(0, 5) = -1;
  if (m.ideal) {
    const Eigen::Matrix<double, 6, 2> W = M.solve(C.transpose());
    const Vector6 free = M.solve(f);
    const Eigen::Matrix2d S = C * W;
    out.pin_force = -S.inverse() * (C * free + b.drift);
    out.acceleration = free + W * out.pin_force;
    return out;
  }
  const Gap g = gap(m, y);
  const Contact c = contact(m, g, y, touching, latch);
  f += C.transpose() * c.force;
  f(1) += c.moment;
  f(4) += c.moment;
  out.acceleration = M.solve(f);
  out.pin_force = c.force;
  out.hysteresis_power = (c.normal - c.elastic) * g.rate;
  out.friction_power = -c.friction * c.slip;
  return out;
}

}  // namespace

Beam beam(const Params& p) {
  Beam out;
  out.mass.setZero();
  out.stiffness.setZero();
  const double length = p.coupler;
  for (int g = 0; g < 4; ++g) {
    const double xi = gauss_at[g];
    const Eigen::Matrix<double, 2, 3> N{{xi, 0, 0}, {0, length * xi * (1 - xi) * (1 - xi), length * xi * xi * (xi - 1)}};
    out.mass += gauss_weight[g] * p.rho_a * length * N.transpose() * N;
  }
  out.stiffness(0, 0) = p.ea / length;
  out.stiffness.bottomRightCorner<2, 2>() << 4 * p.ei / length, 2 * p.ei / length, 2 * p.ei / length, 4 * p.ei / length;
  out.omega = Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d>(out.stiffness, out.mass).eigenvalues().cwiseSqrt();
  // ζ = α/2ω + βω/2 at the two lowest.
  const double w1 = out.omega[0], w2 = out.omega[1], spread = (w2 - w1) * (w2 + w1);
  out.alpha = 2 * w1 * w2 * (p.zeta[0] * w2 - p.zeta[1] * w1) / spread;
  out.beta = 2 * (p.zeta[1] * w2 - p.zeta[0] * w1) / spread;
  out.damping = out.alpha * out.mass + out.beta * out.stiffness;
  return out;
}

Model::Model(const Params& from)
    : p(from),
      coupler(beam(from)),
      ideal(from.clearance == 0),
      side(from.bearing_on_slider ? 1 : -1),
      lever(from.bearing_on_slider ? from.bearing_radius - from.clearance : from.bearing_radius) {}

Inertia inertia(const Params& p, const Y& y) { return inertia(p, Pose(p, y), y); }

Gap gap(const Model& m, const Y& y) {
  const Point b = point(m.p, Pose(m.p, y), y, 1);
  Gap g;
  g.e = m.side * (b.r - Vector2d(y[5], 0));
  g.e_rate = m.side * (b.J * rates(y) - Vector2d(y[11], 0));
  const double r = g.e.norm();
  g.depth = r - m.p.clearance;
  g.rate = r > 0 ? g.e_rate.dot(g.e) / r : g.e_rate.x();
  return g;
}

void close_loop(const Params& p, Y& y, const Vector2d& offset) {
  const double length = p.coupler + y[2], s1 = std::sin(y[0]), c1 = std::cos(y[0]);
  const double s2 = (offset.y() - p.crank * s1) / length, c2 = std::sqrt(1 - s2 * s2);
  y[1] = std::asin(s2);
  y[5] = p.crank * c1 + length * c2 - offset.x();
  y[7] = -(p.crank * c1 * y[6] + s2 * y[8]) / (length * c2);
  y[11] = -p.crank * s1 * y[6] + c2 * y[8] - length * s2 * y[7];
}

State start(const Params& p) {
  const double side = p.bearing_on_slider ? 1 : -1;
  const Vector2d e = side * Vector2d(p.start_e[0], p.start_e[1]);
  State s;
  s.y[0] = p.start_angle;
  s.y[6] = p.speed;
  close_loop(p, s.y, p.clearance > 0 ? e : Vector2d::Zero());
  s.touching = p.clearance > 0 && e.norm() > p.clearance;
  return s;
}

Sample evaluate(const Model& m, const State& s) {
  Sample out{};
  const Y& y = s.y;
  const Pose at(m.p, y);
  const Motion now = motion(m, y, s.touching, s.latch);
  const Gap g = gap(m, y);
  const Contact c = contact(m, g, y, s.touching && !m.ideal, s.latch);
  out.state = s;
  out.acceleration = now.acceleration;
  out.pin_force = now.pin_force;
  out.e = g.e;
  out.depth = g.depth, out.rate = g.rate;
  out.normal = c.normal, out.friction = c.friction, out.slip = c.slip;
  out.kinetic = 0.5 * rates(y).dot(inertia(m.p, at, y).mass * rates(y));
  out.gravity = m.p.crank_mass * m.p.gravity * m.p.crank / 2 * at.crank.y();
  for (int i = 0; i < 4; ++i) out.gravity += gauss_weight[i] * m.p.rho_a * m.p.coupler * m.p.gravity * point(m.p, at, y, gauss_at[i]).r.y();
  const Vector3d strain(y[2], y[3], y[4]);
  out.strain = 0.5 * strain.dot(m.coupler.stiffness * strain);
  out.contact = 0.4 * c.elastic * std::max(0.0, g.depth);
  out.ledger = out.kinetic + out.gravity + out.strain + out.contact + y[12] + y[13] + y[14];
  return out;
}

void rhs(const Model& m, const State& s, Y& dy) {
  Y y = s.y;
  if (m.ideal) close_loop(m.p, y);
  const Motion now = motion(m, y, s.touching, s.latch);
  for (std::size_t i = 0; i < dofs; ++i) {
    dy[i] = y[dofs + i];
    dy[dofs + i] = now.acceleration[static_cast<int>(i)];
  }
  dy[12] = now.hysteresis_power;
  dy[13] = now.friction_power;
  dy[14] = now.rayleigh_power;
}

}  // namespace pintle_oracle::flexible
