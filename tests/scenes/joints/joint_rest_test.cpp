// Rest of mechanisms whose own states only rest together with the pose: integrals, observers, counters.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/common/dense.h"
#include "framework/configuration/equilibrium.h"
#include "framework/dynamics/model/signal_values.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::joint_rest_test {
namespace {

// About its pin the arm has 1 kg m² and weighs 9.81 N m cos(angle).
std::string arm(const std::string& states, const std::string& torque, const std::string& more = "") {
  return R"yaml(
parameters: {target: 0.5 rad}
gravity: [0, -9.81 m/s^2]
bodies: {arm: {rigid: {mass: 2 kg, inertia: 0.5 kg m^2}, points: {O: [-0.5 m, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
run: {until: 1 s}
)yaml" + ("states: {" + states + "}\nforces: {servo: {torque: \"" + torque + "\", on: arm}}\n" + more);
}
const std::string integral = "integral: {rate: target - arm.angle, start: 0 rad s}";
const std::string pid = "40 N m*(target - arm.angle) + 15 N m/s*integral - 4 N m s*arm.speed";

struct Found {
  explicit Found(const std::string& text)
      : scene(read_scene_text(text, "scene.yaml")), model(build(scene)), rest(find_equilibrium(scene, model, assemble(scene, model))) {}
  double state(int i) const { return rest.state.y[own_state(model.system, i)]; }
  double angle() const { return rest.state.y[2]; }
  bool warns(const std::string& of) const {
    return std::ranges::any_of(rest.warnings, [&](const std::string& w) { return w.find(of) != std::string::npos; });
  }
  Scene scene;
  Model model;
  Equilibrium rest;
};

const double weight = 9.81, target = 0.5;

TEST(JointRest, AnIntegralHoldsWhatTheArmWeighs) {
  const Found found(arm(integral, pid));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.angle(), target, 1e-10);
  EXPECT_NEAR(found.state(0), weight * std::cos(target) / 15, 1e-9);
  EXPECT_FALSE(found.rest.stability.judged);
}

// At the start 40 N m/rad by 2 rad is far beyond the limit, where the integral does nothing.
TEST(JointRest, ALimitAtTheStartIsLeft) {
  const Found found(arm(integral, "saturate(" + pid + ", -12 N m, 12 N m)", "start: {arm: {angle: -1.5 rad}}\n"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.angle(), target, 1e-10);
  EXPECT_NEAR(found.state(0), weight * std::cos(target) / 15, 1e-9);
}

TEST(JointRest, ATorqueThatIsTooSmallIsNoRest) {
  const Found found(arm(integral, "saturate(" + pid + ", -5 N m, 5 N m)"));
  EXPECT_FALSE(found.rest.found);
  EXPECT_FALSE(found.rest.reason.empty());
}

// Behind a filter of its own the integral holds the same.
TEST(JointRest, AFilterBehindTheIntegralRestsWithIt) {
  const Found found(arm(integral + ", lag: {rate: \"(integral - lag)/(0.1 s)\", start: 0 rad s}",
                        "40 N m*(target - arm.angle) + 15 N m/s*lag - 4 N m s*arm.speed"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.angle(), target, 1e-10);
  EXPECT_NEAR(found.state(0), weight * std::cos(target) / 15, 1e-9);
  EXPECT_NEAR(found.state(1), found.state(0), 1e-9);
}

// Turns are counted: any number of them rests, and 40 (0.5 − x) = 9.81 cos x.
TEST(JointRest, ACounterStaysAsItStarts) {
  const Found found(arm("turned: {rate: arm.speed, start: 2 rad}, heater: {rate: 0, start: 1}", "40 N m*(target - arm.angle)"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_EQ(found.state(0), 2);
  EXPECT_EQ(found.state(1), 1);
  EXPECT_NEAR(40 * (target - found.angle()), weight * std::cos(found.angle()), 1e-9);
  EXPECT_TRUE(found.warns("\"turned\" keeps its start value, 2"));
  EXPECT_FALSE(found.warns("heater"));
  EXPECT_TRUE(found.rest.stability.judged);
}

// Far from its target the rate of the demand is at its limit, whatever the demand is; and so is the torque.
TEST(JointRest, ALimitedRateRestsAtItsTarget) {
  const std::string u = ", u: {pid: demand - seen, gains: [40 N m, 15 N m/s, 4 N m s], filter: 2 ms, limits: [-12 N m, 12 N m]}";
  for (const std::string demand :
       {"demand: {rate limit: target, most: 3 rad/s, time: 1 ms}",
        "demand: {rate limit: target, most: [-1 rad/s, 3 rad/s], time: 9 ms, start: 3 rad}",
        "demand: {rate: \"max(-3 rad/s, min(3 rad/s, (target - demand)/(1 ms)))\", start: 0 rad}",
        "demand: {rate: \"saturate((target - demand)/(1 ms), -cap, cap)\", start: 0 rad}, cap: {rate: 0, start: 3 rad/s}"}) {
    const Found found(arm(demand + ", seen: {lag: arm.angle, time: 20 ms, lead: 8 ms}" + u, "u", "start: {arm: {angle: -1.4 rad}}\n"));
    ASSERT_TRUE(found.rest.found) << demand << ": " << found.rest.reason;
    EXPECT_NEAR(found.angle(), target, 1e-9) << demand;
    EXPECT_NEAR(found.state(0), target, 1e-9) << demand;
    EXPECT_NEAR(found.rest.table.column("u integral [N m]").at(0), weight * std::cos(target), 1e-7) << demand;
    EXPECT_NEAR(found.rest.table.column("u [N m]").at(0), weight * std::cos(target), 1e-7) << demand;
  }
}

// It acts on nothing, and the arm hangs down, from where its weight has no slope.
TEST(JointRest, ALimitedRateThatIsOnlyWrittenDownRestsToo) {
  const Found found(arm("demand: {rate limit: arm.angle, most: 3 rad/s, time: 1 ms, start: 5 rad}", "0*arm.angle*(1 N m)"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.angle(), -std::numbers::pi / 2, 1e-7);
  EXPECT_NEAR(found.state(0), found.angle(), 1e-7);
}

TEST(JointRest, ARateWhoseLimitsLeaveOutZeroIsNoRest) {
  const Found found(
      arm("demand: {rate: \"saturate((target - demand)/(1 s), 1 rad/s, 2 rad/s)\", start: 0 rad}", "40 N m*(demand - arm.angle)"));
  EXPECT_FALSE(found.rest.found);
  pintle_test::expect_says(found.rest.reason, {"\"demand\" does not come to rest", "1 rad/s"});
}

TEST(JointRest, ALimitedRateThatFollowsAnotherRestsWithIt) {
  const Found found(arm("first: {rate limit: target, most: 3 rad/s, time: 1 ms}, demand: {rate limit: first, most: 1 rad/s, time: 1 ms}",
                        "40 N m*(demand - arm.angle)"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.state(0), target, 1e-9);
  EXPECT_NEAR(found.state(1), target, 1e-9);
  EXPECT_NEAR(40 * (target - found.angle()), weight * std::cos(found.angle()), 1e-7);
}

// 5 N m hold the arm where it weighs as much. The integral is led back: 15 e + (5 − 40 e − I)/(40/15) = 0.
TEST(JointRest, AControllerAtItsLimitRestsThere) {
  const Found found(
      arm("demand: {rate limit: target, most: 3 rad/s, time: 1 ms}, "
          "u: {pid: demand - arm.angle, gains: [40 N m, 15 N m/s, 0], limits: [-5 N m, 5 N m]}",
          "u - 4 N m s*arm.speed", "start: {arm: {angle: -1 rad}}\n"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  const double e = target - found.angle();
  EXPECT_NEAR(found.state(0), target, 1e-9);
  EXPECT_NEAR(weight * std::cos(found.angle()), 5, 1e-6);
  EXPECT_NEAR(found.rest.table.column("u [N m]").at(0), 5, 1e-9);
  EXPECT_NEAR(found.state(1), 15 * e * 40 / 15 + 5 - 40 * e, 1e-6);
}

TEST(JointRest, WhatNothingBringsToRestIsNamed) {
  const Found clock(arm("clock: {rate: 1}", "40 N m*(target - arm.angle)"));
  EXPECT_FALSE(clock.rest.found);
  pintle_test::expect_says(clock.rest.reason, {"\"clock\" never rests", "1 1/s", "leave it out"});
  const Found seen(arm(integral, "40 N m*(target - arm.angle)"));  // nothing uses it
  EXPECT_FALSE(seen.rest.found);
  pintle_test::expect_says(seen.rest.reason, {"\"integral\" never rests"});
}

TEST(JointRest, StatesThatOnlyTheirSumDecidesAreNamed) {
  const Found found(arm(integral + ", other: {rate: 2*(target - arm.angle), start: 0 rad s}",
                        "40 N m*(target - arm.angle) + 15 N m/s*(integral + other)"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.state(0) + found.state(1), weight * std::cos(target) / 15, 1e-9);
  EXPECT_TRUE(found.warns("\"integral\" and \"other\""));
}

// s³ + 4 s² + (40 − 9.81 sin 0.5) s + 15, and a run from the rest stays there.
TEST(JointRest, IsWhereALinearisationAndARunBegin) {
  const std::string text = arm(integral, pid);
  const Found found(text);
  const Linearization lin = linearize(found.scene, found.model, found.rest.state, Laws::hold);
  const Eigen::VectorXcd roots = lin.space.A.eigenvalues();
  ASSERT_EQ(roots.size(), 3);
  for (const std::complex<double>& s : roots)
    EXPECT_LT(std::abs(s * s * s + 4.0 * s * s + (40 - weight * std::sin(target)) * s + 15.0), 1e-7);
  ASSERT_EQ(lin.space.inputs, std::vector<std::string>{"servo.torque [N m]"});  // on 1 kg m²
  EXPECT_LT((lin.space.B - Eigen::Vector3d(0, 1, 0)).norm(), 1e-9);
  const pintle_scenes::Whole w = pintle_scenes::run(text + "start: equilibrium\n");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  for (const double angle : w.column("arm.angle [rad]")) EXPECT_NEAR(angle, target, 1e-9);
}

}  // namespace
}  // namespace pintle::joint_rest_test
