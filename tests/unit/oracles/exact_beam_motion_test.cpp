// The oracle of large beam motion in motion: balances, limits and its own orders.

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/oracles/exact_beam.h"
#include "tests/oracles/four_bar.h"
#include "tests/oracles/pendulum.h"
#include "tests/unit/oracles/exact_beam_samples.h"

namespace pintle_oracle::exact_beam_motion_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double energy(const BeamFrame& f) { return f.kinetic + f.strain + f.potential; }
/// A beam bent and turning in flight.
BeamStart thrown(const ExactBeam& beam) {
  return [L = beam.length](double s) {
    SectionMotion at{.place = {s, 0.1 * std::sin(pi * s / L), 0.1 * pi / L * std::cos(pi * s / L)}};
    at.rate = {0.3, 2 * (s - 0.4), 2};
    return at;
  };
}

TEST(ExactBeam, FlyingFreelyKeepsItsMomenta) {
  ExactBeam beam = soft();
  beam.a.mass = 0.2;
  const auto frames = simulate(beam, thrown(beam), {0, 0.5, 1}, 0.01);
  EXPECT_GT((frames[2].place - frames[0].place).norm(), beam.length);
  const double size = std::sqrt(2 * 1.2 * frames[0].kinetic);
  for (const BeamFrame& f : frames) EXPECT_LT((f.momentum - frames[0].momentum).norm(), rounding * size) << f.t;
}

/// A soft beam hung at A.
ExactBeam pendulum() {
  ExactBeam beam = soft();
  beam.a.hold = Hold::hinge;
  beam.gravity = {0, -9.81};
  beam.elements = 4;
  beam.degree = 2;
  return beam;
}

TEST(ExactBeam, EnergyOfAPendulumDriftsWithTheSixthOrderOfTheStep) {
  const ExactBeam beam = pendulum();
  std::vector<double> times;
  for (int i = 0; i <= 50; ++i) times.push_back(0.04 * i);
  const auto drift = [&](double step) {
    const auto frames = simulate(beam, flat(), times, step);
    double worst = 0, swing = 0;
    for (const BeamFrame& f : frames) {
      worst = std::max(worst, std::abs(energy(f) - energy(frames[0])));
      swing = std::max(swing, f.kinetic);
    }
    return worst / swing;
  };
  const double coarse = drift(0.008), fine = drift(0.004);
  EXPECT_GT(slope(coarse, fine), 6 - order);
  EXPECT_LT(fine, 1e-8);
}

TEST(ExactBeam, MotionIsOfSixthOrderInTheStep) {
  ExactBeam beam = pendulum();
  beam.elements = 2;  // the fastest mode is resolved
  const auto end = [&](double step) { return simulate(beam, flat(), {1}, step)[0].place; };
  const Places a = end(0.004), b = end(0.002), c = end(0.001);
  EXPECT_GT(slope((b - a).norm(), (c - b).norm()), 6 - order);
}

TEST(ExactBeam, StiffPendulumSwingsAsARigidBody) {
  ExactBeam beam = pendulum();
  beam.EA = beam.GA = beam.EI = 1e9;
  const double L = beam.length, centre = L / 2;
  const double inertia = beam.rhoA * L * L * L / 12 + beam.rhoI * L;
  const Pendulum rigid{.length = equivalent_length(beam.rhoA * L, inertia, centre), .gravity = 9.81, .release = pi / 2};
  for (const BeamFrame& f : simulate(beam, flat(), {0.3, 0.8, 1.3}, 0.01)) {
    const Swing want = evaluate(rigid, f.t);
    // Weight over EA, EI/L² and GA is 1e-8; a swing later that is a few times as much.
    EXPECT_NEAR(f.place(2, 0), want.angle - pi / 2, 1e-7) << f.t;
    EXPECT_NEAR(tip(f.place)[0], L * std::sin(want.angle), 1e-7) << f.t;
  }
}

// Radial equilibrium EA u″ + ρA w²(s + u) = 0: s + u = sin ks/(k cos kL), k = w √(ρA/EA).
TEST(ExactBeam, SpinningBeamStaysStretched) {
  ExactBeam beam{.length = 10, .EA = 2.8e7, .EI = 1.4e4, .GA = 1e7, .rhoA = 1.2, .rhoI = 6e-4};
  const double w = 60, k = w * std::sqrt(beam.rhoA / beam.EA);
  const auto radius = [&](double s) { return std::sin(k * s) / (k * std::cos(k * beam.length)); };
  beam.a = {.hold = Hold::clamp, .law = crank_pin({0, 0}, 0, [w](double t) { return Vector3d(w * t, w, 0); })};
  const BeamStart start = [&](double s) { return SectionMotion{.place = {radius(s), 0, 0}, .rate = {0, w * radius(s), w}}; };
  for (const BeamFrame& f : simulate(beam, start, {0.02, 0.1}, 2.5e-4)) {
    const double r = radius(beam.length);
    EXPECT_NEAR(tip(f.place).head<2>().norm() - beam.length, r - beam.length, 1e-6 * (r - beam.length));
    EXPECT_NEAR(tip(f.place)[2], w * f.t, 1e-9);
    // What holds A pulls with ρA w² ∫ r ds.
    const double pull = beam.rhoA * w * w * (1 / std::cos(k * beam.length) - 1) / (k * k);
    EXPECT_NEAR(f.support_a.head<2>().norm(), pull, 1e-6 * pull);
  }
}

/// Coupler of a slider–crank, crank pin at A and slider at B on a line through the crank's axle.
struct Mechanism {
  ExactBeam beam;
  BeamStart start;
  double crank = 0.3;
};
Mechanism slider_crank(ExactBeam beam, double line, double drive) {
  Mechanism m{.beam = beam, .start = {}};
  // The crank starts from rest on the line, smoothly.
  m.beam.a = {.hold = Hold::hinge, .law = crank_pin({0, 0}, m.crank, [line, drive](double t) {
                                     return Vector3d(line + drive * t * t * t, 3 * drive * t * t, 6 * drive * t);
                                   })};
  m.beam.b = {.hold = Hold::slide, .line = {std::cos(line), std::sin(line)}, .mass = 0.5};
  m.start = rigid_start({m.crank * std::cos(line), m.crank * std::sin(line), line});
  return m;
}

TEST(ExactBeam, StiffCouplerMovesAsSliderCrankKinematicsSay) {
  ExactBeam beam = soft();
  beam.EA = beam.GA = beam.EI = 1e8;
  const Mechanism m = slider_crank(beam, 0, 3);
  for (const BeamFrame& f : simulate(m.beam, m.start, {0.4, 0.8, 1}, 0.005)) {
    const SliderCrankMotion want =
        evaluate(SliderCrank{.crank = m.crank, .coupler = beam.length}, Turn{.angle = 3 * f.t * f.t * f.t, .rate = 9 * f.t * f.t});
    EXPECT_NEAR(tip(f.place)[0], want.x, 1e-6) << f.t;  // inertia forces over EA and EI
    EXPECT_NEAR(tip(f.place)[1], 0, rounding) << f.t;
    EXPECT_NEAR(tip(f.rate)[0], want.x_rate, 1e-4) << f.t;
  }
}

TEST(ExactBeam, TurningTheWorldTurnsTheMotion) {
  const double turn = 0.7;
  const Mechanism level = slider_crank(soft(), 0, 3), inclined = slider_crank(soft(), turn, 3);
  const BeamFrame a = simulate(level.beam, level.start, {1}, 0.01)[0], b = simulate(inclined.beam, inclined.start, {1}, 0.01)[0];
  const Eigen::Matrix2d A = Eigen::Rotation2D<double>(turn).toRotationMatrix();
  EXPECT_LT((b.place.topRows<2>() - A * a.place.topRows<2>()).norm(), 1e-9);  // Newton's end
  EXPECT_LT((b.support_a.head<2>() - A * a.support_a.head<2>()).norm(), 1e-9 * level.beam.EA);
  EXPECT_GT(a.strain, 0.01 * a.kinetic);
}

TEST(ExactBeam, SupportsDoTheWorkThatEnergyGains) {
  const Mechanism m = slider_crank(soft(), 0.7, 3);
  const int n = 400;  // Simpson's rule: of fourth order in 1/n
  std::vector<double> times;
  for (int i = 0; i <= n; ++i) times.push_back(double(i) / n);
  const auto frames = simulate(m.beam, m.start, times, 1.0 / n);
  double work = 0;
  for (int i = 0; i <= n; ++i) {
    const BeamFrame& f = frames[std::size_t(i)];
    const double power = f.support_a.head<2>().dot(f.rate.col(0).head<2>());
    work += power * (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) / (3.0 * n);
    EXPECT_NEAR(f.support_b.head<2>().dot(m.beam.b.line), 0, 1e-9 * m.beam.EA);
  }
  EXPECT_NEAR(energy(frames.back()) - energy(frames.front()), work, 1e-6 * work);
}

TEST(ExactBeam, ConvergedRunIsNearerToTheLimitThanItsLastChange) {
  const Mechanism m = slider_crank(soft(), 0, 3);
  ExactBeam beam = m.beam;
  beam.elements = 2;
  const Converged got = converge(beam, m.start, {0.5, 0.9}, 0.04, 1e-5);
  EXPECT_LE(got.change, 1e-5);
  beam.elements = 2 * got.beam.elements;
  const BeamFrame finer = simulate(beam, m.start, {0.9}, got.step / 2)[0];
  const Place off = tip(finer.place) - tip(got.frames[1].place);
  EXPECT_LT(off.head<2>().norm(), 0.5 * got.change * beam.length);
  beam.elements = 2;
  EXPECT_THROW(converge(beam, m.start, {1}, 0.04, 1e-15, 1), std::runtime_error);
}

}  // namespace
}  // namespace pintle_oracle::exact_beam_motion_test
