// Clearance in joints between rigid bodies: bearings, guides, slots and ropes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_play_test {
namespace {

using pintle_scenes::at, pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number,
    pintle_scenes::run, pintle_scenes::run_for, pintle_scenes::struck_by, pintle_scenes::Whole;

constexpr double g = 9.81;

class RigidPlay : public testing::TestWithParam<Method> {
 protected:
  Whole run_it(const std::string& text) const { return run(text, GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(All, RigidPlay, testing::ValuesIn(struck_by), name_of);

// ---- a pin in its bearing ---------------------------------------------------------------------

std::string hung(const std::string& centre, const std::string& laws, const std::string& start, double until) {
  return "gravity: [0, -9.81]\nbodies: {rod: {rigid: {mass: 1, inertia: 0.02}, points: {A: " + centre +
         "}}}\njoints: {pin: {revolute: [ground, rod.A], clearance: {radial: 20 mm, bearing radius: 30 mm, bearing: ground, model: "
         "impact, " +
         laws + "}}}\nstart: {rod: {" + start + "}}\n" + run_for(until, 1e-3);
}

TEST_P(RigidPlay, APinInItsBearingPartsByNewtonsLaw) {
  for (const std::string friction : {"", ", friction: {coulomb: {coefficient: 0.2}}"}) {
    const Whole w = run_it(hung("[0, 0.3]", "restitution: 0.6" + friction, "at: [0, -0.3], velocity: [0.5, 0]", 0.8));
    expect_sound(w);
    std::size_t parted = 0;
    for (const Impact& i : w.run.impacts)
      if (i.end == i.begin) {
        ++parted;
        EXPECT_NEAR(i.separation, 0.6 * i.approach, 1e-12 * i.approach + 1e-14) << i.begin;
        EXPECT_GT(i.impulse, 0);
      }
    EXPECT_GE(parted, 5u);
    for (const double depth : w.column("pin.depth [m]")) EXPECT_LT(depth, 1e-12);
  }
}

// Centred on its pin, a body is a particle in a hollow of radius c. Started at the bottom with v₀² = k g c, 2 < k < 5, it leaves the wall
// at cos φ = (2 − k)/3, when N = m (v²/c + g cos φ) comes to 0.
TEST_P(RigidPlay, APinLeavesItsBearingWhereItWouldPull) {
  const double c = 0.02, k = 3.5, leaves = std::acos((2 - k) / 3);
  double t = 0;  // ∫ dφ/φ', Simpson's rule
  constexpr int parts = 2000;
  for (int i = 0; i <= parts; ++i) {
    const double phi = leaves * i / parts, rate = std::sqrt(g / c * (k - 2 + 2 * std::cos(phi)));
    t += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) / rate * leaves / parts / 3;
  }
  const Whole w = run_it(hung("[0, 0]", "restitution: 0",
                              "angle: 0}, pin: {eccentricity: [0, -20 mm], speed: [" + number(std::sqrt(k * g * c)) + ", 0]", t + 0.01));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].end, t, GetParam().near * t);
  EXPECT_EQ(w.run.impacts[0].separation, 0);
  EXPECT_NEAR(w.run.impacts[0].peak_force, (k + 1) * g, 0.02 * g);  // at the bottom, where it begins
  const auto times = w.column("t [s]"), N = w.column("pin.normal [N]"), x = w.column("rod.x [m]");
  const double v = std::sqrt(g * c * (k - 2) / 3);  // v² = −g c cos φ
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < t) {
      EXPECT_GT(N[i], 0) << times[i];
    } else {  // it flies
      EXPECT_NEAR(x[i], c * std::sin(leaves) + v * std::cos(leaves) * (times[i] - t), 1e-8) << times[i];
    }
  }
}

// With friction it comes to rest at the bottom.
TEST_P(RigidPlay, APinRollsInItsBearingUntilItRests) {
  const Whole w = run_it(hung("[0, 0.1]", "restitution: 0, friction: {coulomb: {coefficient: 0.3}}",
                              "angle: 0, speed: 4}, pin: {eccentricity: [0, -20 mm]", 1));
  expect_sound(w);
  for (const double N : w.column("pin.normal [N]")) EXPECT_GT(N, 0);
  EXPECT_NEAR(w.last("pin.depth [m]"), 0, 1e-12);
  EXPECT_GT(w.ledger("pin.lost to friction [J]"), 0);
}

// A rider hangs on a journal that turns slowly, ω. The contact climbs by rolling, ω r t = c φ + R ψ, and the rider leans by ψ = R sin φ/L
// so that its weight stays below the contact; at tan φ = μ it begins to slip, and stays there. The damper holds it back by D ψ'/(m g L).
TEST(RigidPlayRun, AJournalRollsUpToTheFrictionAngleAndSlips) {
  const double friction = 0.35, c = 1e-3, R = 0.02, L = 0.2, m = 2, D = 1, omega = 2e-3, phi = std::atan(friction);
  const double slips = (c * phi + R * R * std::sin(phi) / L) / (omega * (R - c)), late = D / (m * g * L), every = 0.05;
  const Whole w = run(
      "gravity: [0, -9.81]\nbodies:\n  shaft: {rigid: {mass: 1, inertia: 1e-3}}\n  rider: {rigid: {mass: 2, inertia: 0.05}, points: {C: "
      "[0, "
      "0.2]}}\njoints:\n  axle: {revolute: [ground, shaft]}\n  eye: {revolute: [shaft, rider.C], clearance: {radial: 1 mm, bearing radius: "
      "20 mm, bearing: rider, model: impact, restitution: 0, friction: {coulomb: {coefficient: 0.35}}}}\n"
      "drivers: {motor: {angle: [ground, shaft], law: 2 mrad/s*t}}\n"
      "forces: {settle: {torsion spring: [ground, rider], damping: 1}}\n"
      "start: {eye: {eccentricity: [0, 1 mm]}, rider: {angle: 0, speed: 0}}\n" +
      run_for(40, every));
  expect_sound(w);
  const auto t = w.column("t [s]"), N = w.column("eye.normal [N]"), T = w.column("eye.friction [N]");
  double holds = 0;  // the last time
  for (std::size_t i = 0; i < t.size(); ++i)
    if (std::abs(T[i]) < friction * N[i] * (1 - 1e-9)) holds = t[i];
  EXPECT_NEAR(holds, slips, late + every);
  EXPECT_NEAR(w.last("eye.ex [m]") / w.last("eye.ey [m]"), friction, 1e-9);
  EXPECT_NEAR(std::hypot(N.back(), T.back()), m * g, 1e-9 * m * g);  // what bears the weight is upright
}

// ---- ropes, guides and slots --------------------------------------------------------------------

TEST_P(RigidPlay, AWeightBouncesOnItsRopeAndThenHangs) {
  const double h = 0.5, fall = std::sqrt(2 * h / g), end = 3 * fall;
  const Whole w = run_it(
      "gravity: [0, -9.81]\nbodies: {weight: {rigid: {mass: 2, inertia: 1e-3}}}\n"
      "joints: {rope: {distance: [ground, weight], length: 1 m, clearance: {only: pull, model: impact, restitution: 0.5}}}\n"
      "start: {weight: {at: [0, -0.5]}}\n" +
      run_for(1.5, 0.01));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 10u);
  EXPECT_NEAR(w.run.impacts[0].begin, fall, 1e-13);
  EXPECT_NEAR(w.run.impacts[0].separation, g * fall / 2, 1e-12);
  EXPECT_NEAR(w.run.impacts[0].impulse, 3 * g * fall, 1e-11);
  EXPECT_NEAR(w.run.impacts.back().begin, end, 1e-9 * end);
  EXPECT_NEAR(w.last("weight.y [m]"), -1, 1e-12);
  EXPECT_NEAR(w.last("rope.normal [N]"), 2 * g, 1e-10 * g);
}

// Its corners meet the walls in pairs: a block goes to and fro without loss, and does not turn.
TEST_P(RigidPlay, ABlockGoesToAndFroInItsGuide) {
  const Whole w = run_it(
      "bodies: {block: {rigid: {mass: 1, inertia: 1e-3}}}\njoints: {guide: {prismatic: [ground, block], clearance: {gap: 1 mm, length: 80 "
      "mm, height: 30 mm, model: impact, restitution: 1}}}\nstart: {block: {at: [0, 0], velocity: [0.1, 0.5]}}\n" +
      run_for(0.1, 1e-3));
  expect_sound(w);
  ASSERT_EQ(w.run.impacts.size(), 50u);        // of two corners each, 4 ms apart, from 2 ms on
  constexpr double passage = 2 * 1e-13 / 0.5;  // is shorter by what counts as closed, of a length of 1 m, at either wall
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(w.run.impacts[i].begin, 2e-3 + 4e-3 * static_cast<double>(i / 2), 25 * passage) << i;
    EXPECT_NEAR(w.run.impacts[i].impulse, 0.5, 1e-11) << i;
  }
  EXPECT_NEAR(w.last("block.angle [rad]"), 0, 1e-11);
  EXPECT_NEAR(w.last("block.x [m]"), 0.01, 1e-13);
}

TEST_P(RigidPlay, APinReboundsFromTheEndOfItsSlot) {
  const Whole w = run_it(
      "bodies: {pin: {rigid: {mass: 0.5, inertia: 1e-4}}}\njoints: {slot: {slot: [ground, pin], clearance: {gap: 1 mm, pin radius: 4 mm, "
      "travel: 60 mm, model: impact, restitution: 0.7}}}\nstart: {pin: {at: [0, 0], velocity: [2, 0]}}\n" +
      run_for(0.04, 1e-3));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, 31e-3 / 2, 1e-12);
  EXPECT_NEAR(w.run.impacts[0].separation, 1.4, 1e-12);
  EXPECT_NEAR(w.last("pin.vx [m/s]"), -1.4, 1e-12);
}

}  // namespace
}  // namespace pintle::rigid_play_test
