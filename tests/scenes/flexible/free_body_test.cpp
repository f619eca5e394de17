// A flexible body alone in space: it flies, spins and vibrates, and keeps momentum, moment of
// momentum and energy.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "framework/bodies/mechanism_body.h"
#include "framework/build/build.h"
#include "framework/component/fe/fe_model.h"
#include "framework/dynamics/model/flexible.h"
#include "framework/integration/integrator.h"
#include "tests/scenes/flexible/flexible_scenes.h"

namespace pintle_scenes::free_body_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using pintle::State;
using pintle::System;

constexpr double rounding = 1e-12;  // relative to the terms summed

/// [m v; L] of body 0 about the world's origin: what kinetic energy gains when the body moves along
/// x, along y, and turns about the origin. T is quadratic in s, so that differences are exact.
Vector3d momenta(const System& system, const VectorXd& y) {
  Vector3d p;
  for (int k = 0; k < 3; ++k) {
    Vector3d along = Vector3d::Unit(k);
    if (k == 2) along << -y[1], y[0], 1;
    VectorXd more = y, less = y;
    more.segment<3>(system.n()) += along;
    less.segment<3>(system.n()) -= along;
    p[k] = (kinetic_energy(system, more, 0) - kinetic_energy(system, less, 0)) / 2;
  }
  return p;
}

/// The same as ∫ρv and ∫ρ r × v over the finite elements of a plate: products of nodal places and
/// velocities with its mass matrix.
Vector3d momenta_of_plate(const pintle::Scene& scene, const System& system, const VectorXd& y) {
  const auto body = pintle::mechanism_body(scene, pintle::elastic_body(scene, scene.bodies[0]));
  const auto& model = body.elastic.model;
  const int n = system.n(), modes = system.bodies[0].modes();
  const VectorXd u = body.modes.shapes * y.segment(3, modes), du = body.modes.shapes * y.segment(n + 3, modes);
  const Eigen::Rotation2Dd A(y[2]);
  VectorXd turned_place(model.N()), velocity(model.N()), along[2];
  for (VectorXd& a : along) a.setZero(model.N());
  for (Eigen::Index k = 0; k < model.x.cols(); ++k) {
    const Eigen::Index i = model.begin[static_cast<std::size_t>(k)];
    const Vector2d d = A * (model.x.col(k) - body.centre + u.segment<2>(i));
    turned_place.segment<2>(i) = pintle::perp(y.segment<2>(0) + d);
    velocity.segment<2>(i) = y.segment<2>(n) + y[n + 2] * pintle::perp(d) + A * Vector2d(du.segment<2>(i));
    along[0][i] = along[1][i + 1] = 1;
  }
  const VectorXd mv = body.elastic.M * velocity;
  return {along[0].dot(mv), along[1].dot(mv), turned_place.dot(mv)};
}

double energy(const System& system, const VectorXd& y) { return kinetic_energy(system, y, 0) + strain_energy(system, y, 0); }

/// Natural frequencies of a free body of the shapes kept, at rest and straight, ascending [rad/s].
VectorXd frequencies(const pintle::Body& body) {
  const auto& f = *body.flex;
  MatrixXd mass = MatrixXd::Identity(f.omega.size(), f.omega.size());
  mass -= f.S.transpose() * f.S / body.m + f.h.transpose() * f.h / body.J;
  const MatrixXd stiffness = f.omega.cwiseAbs2().asDiagonal();
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(stiffness, mass).eigenvalues().cwiseSqrt();
}

struct Free {
  pintle::Scene scene;
  pintle::Model model;
  State start;
  double lowest, highest;  ///< frequency [rad/s]
};

/// Bent by a hundredth of `length` or less, vibrating, flying as fast, turning once in twenty
/// periods of its lowest mode.
Free freed(const std::string& keys, double length) {
  Free f;
  f.scene = scene_of("bodies:\n" + body_text("rod", keys) + "run: {until: 1, method: dopri5}\n");
  f.model = pintle::build(f.scene);
  f.start = pintle::assemble(f.scene, f.model).start;
  const pintle::Body& body = f.model.system.bodies[0];
  const VectorXd omega = frequencies(body);
  f.lowest = omega.minCoeff(), f.highest = omega.maxCoeff();
  const int n = f.model.system.n();
  const double amplitude = 0.01 * length, modal = amplitude * std::sqrt(body.m);
  f.start.y.segment<3>(0) << length, -length / 2, 0.7;
  f.start.y.segment<3>(n) << amplitude * f.lowest, -amplitude * f.lowest / 2, f.lowest / 20;
  for (int i = 0; i < body.modes(); ++i) {
    f.start.y[3 + i] = (i % 2 ? -0.4 : 0.6) * modal * body.flex->omega[0] / body.flex->omega[i];
    f.start.y[n + 3 + i] = 0.5 * modal * f.lowest;
  }
  return f;
}

/// Largest change in a run, each relative to the size at the start.
struct Drift {
  double momentum = 0, spin = 0, energy = 0;
  double steps = 0, step = 0;  ///< their number and mean length [s]
};

Drift drift_over(Free& f, double periods, double tolerance) {
  const System& system = f.model.system;
  f.model.scheme.tolerance = tolerance;
  pintle::Integrator integrator(system, f.model.scheme, f.start);
  const VectorXd& a = f.start.y;
  const Vector3d p = momenta(system, a);
  const double until = periods * 2 * std::numbers::pi / f.lowest, e = energy(system, a);
  Drift d;
  while (integrator.state().t < until && integrator.advance(until)) {
    if (integrator.counts().steps % 64 != 0 && integrator.state().t < until) continue;
    const VectorXd& b = integrator.state().y;
    const Vector3d change = momenta(system, b) - p;
    d.momentum = std::max(d.momentum, change.head<2>().norm() / p.head<2>().norm());
    d.spin = std::max(d.spin, std::abs(change[2] / p[2]));
    d.energy = std::max(d.energy, std::abs(energy(system, b) / e - 1));
  }
  EXPECT_EQ(integrator.failure(), "");
  d.steps = static_cast<double>(integrator.counts().steps), d.step = until / d.steps;
  return d;
}

/// What Dormand–Prince damps: on the imaginary axis |R(iy)|² = 1 − y⁶/1800 + …, of energy, in each
/// step, if all of it vibrated at the highest frequency; twice that for steps of unequal length.
double damped(const Free& f, const Drift& d) { return 2 * d.steps * std::pow(f.highest * d.step, 6) / 1800; }

// Fifth order, steps as the fifth root of the tolerance: the loss of energy is in proportion to the
// tolerance, the drift of momenta, which has no one sign, falls with it or faster.
constexpr double order = 0.1;  // of a slope
// Momentum of a body whose frame rides its mean axes is linear in the state, and any Runge–Kutta
// method keeps that: a random walk of roundings over 1e6 steps is left.
constexpr double linear = 1e3 * rounding;

void expect_kept(Free f, double periods, bool rides_mean_axes, double tolerance = 1e-6) {
  const double tolerances[] = {tolerance, tolerance / 10};
  Drift d[2];
  for (int i = 0; i < 2; ++i) {
    d[i] = drift_over(f, periods, tolerances[i]);
    const double bound = damped(f, d[i]);
    EXPECT_LE(d[i].energy, bound);
    EXPECT_LE(d[i].momentum, rides_mean_axes ? linear : bound);
    EXPECT_LE(d[i].spin, bound);
  }
  const auto slope = [&](double Drift::*what) { return std::log10(d[0].*what / d[1].*what); };
  EXPECT_NEAR(slope(&Drift::energy), 1, order);
  EXPECT_GE(slope(&Drift::spin), 1 - order);
  if (!rides_mean_axes) {
    EXPECT_GE(slope(&Drift::momentum), 1 - order);
  }
}

std::string beam(const std::string& modes, const std::string& more = "") {
  FlexibleBeam b;
  b.length = 1, b.diameter = 0.02, b.mass = 2, b.modes = modes, b.more = more;
  return text(b);
}
constexpr double plate_length = 0.21;  ///< [m]

TEST(FreeBody, MomentaOfAPlateAreThoseOfItsElements) {
  for (const char* modes : {"{frame: {tangent: A}, count: 5}", "{frame: {chord: [A, B]}, keep: all}", "{frame: mean axes, count: 9}"}) {
    const Free f = freed(holed_plate(modes), plate_length);
    const System& system = f.model.system;
    const Vector3d p = momenta(system, f.start.y), q = momenta_of_plate(f.scene, system, f.start.y);
    EXPECT_LE((p - q).head<2>().norm(), rounding * q.head<2>().norm()) << modes;
    EXPECT_NEAR(p[2], q[2], rounding * std::abs(q[2])) << modes;
  }
}

TEST(FreeBody, SpinningBeamKeepsMomentaAndEnergyOverTenThousandPeriods) {
  expect_kept(freed(beam("{frame: mean axes, count: 2}"), 1), 1e4, true);
}

TEST(FreeBody, SpinningPlateKeepsMomentaAndEnergyOverTenThousandPeriods) {
  // One shape: the fast second one would be damped away within so many periods of the slow first.
  expect_kept(freed(holed_plate("{frame: mean axes, count: 1}"), plate_length), 1e4, true, 1e-7);
}

TEST(FreeBody, SpinningBeamInAFrameAtItsEndKeepsMomentaAndEnergy) { expect_kept(freed(beam("{frame: tangent, count: 2}"), 1), 1e3, false); }

TEST(FreeBody, SpinningPlateInAFrameAtItsHoleKeepsMomentaAndEnergy) {
  expect_kept(freed(holed_plate("{frame: {tangent: A}, count: 2}"), plate_length), 1e3, false);
}

TEST(FreeBody, SpinningBeamThatStiffensKeepsMomentaAndEnergy) {
  for (const char* frame : {"tangent", "chord"})
    expect_kept(freed(beam(std::string("{frame: ") + frame + ", count: 2}", "stiffening: rotation"), 1), 1e3, false);
}

}  // namespace
}  // namespace pintle_scenes::free_body_test
