// Driven motions against closed forms, through singular configurations, and to the end of reach.
#include "framework/analysis/kinematics/kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/mechanisms.h"
#include "tests/refusal.h"

namespace pintle_scenes::kinematics_test {
namespace {

using namespace pintle;
using namespace pintle_oracle;
using std::numbers::pi;

constexpr double closed_form = 1e-10;  ///< relative to 1: Newton's method to rounding, conditions of some hundreds

Run driven(const Scene& scene) {
  const Scene ready = ready_for_kinematics(scene);
  const Model model = build(ready);
  return kinematics(ready, model, assemble(ready, model));
}
template <class Error>
std::string refusal(const Scene& scene) {
  return pintle_test::refusal_by<Error>([&] { driven(scene); });
}
double apart(double a, double b) { return std::remainder(a - b, 2 * pi); }

constexpr FourBar bars{0.4, 0.1, 0.35, 0.25, true};
const LinkMass no_masses[3] = {{0, 0}, {0, 0}, {0, 0}};

TEST(Kinematics, AFourBarWithoutMassesMovesAsItsClosedForm) {
  Scene s = four_bar(bars, no_masses, 0, 0.3, 12, -5);
  s.run.until = 2, s.output.every = 0.01;
  const auto run = driven(s);
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  const auto t = run.trajectory.column("t [s]");
  ASSERT_EQ(t.size(), 201u);
  const auto value = [&](const std::string& c) { return run.trajectory.column(c); };
  const auto coupler = value("coupler.angle [rad]"), rate = value("coupler.speed [rad/s]"), accel = value("coupler.alpha [rad/s^2]"),
             rocker = value("rocker.angle [rad]"), rocker_accel = value("rocker.alpha [rad/s^2]");
  for (std::size_t k = 0; k < t.size(); ++k) {
    const FourBarMotion m = evaluate(bars, {0.3 + 12 * t[k] - 2.5 * t[k] * t[k], 12 - 5 * t[k], -5});
    EXPECT_NEAR(apart(coupler[k], m.coupler.angle), 0, closed_form);
    EXPECT_NEAR(apart(rocker[k], m.rocker.angle), 0, closed_form);
    EXPECT_NEAR(rate[k], m.coupler.rate, closed_form * 12);
    EXPECT_NEAR(accel[k], m.coupler.acceleration, closed_form * 144);
    EXPECT_NEAR(rocker_accel[k], m.rocker.acceleration, closed_form * 144);
  }
  for (const std::string& column : run.trajectory.header) EXPECT_EQ(column.find(" on "), std::string::npos) << "forces: " << column;
}

TEST(Kinematics, ASliderCrankMovesAsItsClosedForm) {
  SliderCrank o;
  o.clearance = 0, o.driven = true, o.speed = 150, o.angle = 0.2, o.until = 0.1, o.outputs = 37;
  Scene s = scene(o);
  for (SceneBody& b : s.bodies) b.mass = b.inertia = 0;
  const auto run = driven(s);
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  const auto t = run.trajectory.column("t [s]"), x = run.trajectory.column("slider.x [m]"), v = run.trajectory.column("slider.vx [m/s]"),
             a = run.trajectory.column("slider.ax [m/s^2]");
  for (std::size_t k = 0; k < t.size(); ++k) {
    const SliderCrankMotion m = evaluate(pintle_oracle::SliderCrank{0.05, 0.12}, {0.2 + 150 * t[k], 150, 0});
    EXPECT_NEAR(x[k], m.x, closed_form);
    EXPECT_NEAR(v[k], m.x_rate, closed_form * 10);
    EXPECT_NEAR(a[k], m.x_acceleration, closed_form * 2000);
  }
}

// Few outputs, many turns between them: the same as with many.
TEST(Kinematics, WhatIsComputedDoesNotDependOnHowOftenItIsWritten) {
  Scene s = four_bar(bars, no_masses, 0, 0.3, 40, 3);
  s.run.until = 3;
  s.output.every = 1.5;
  const auto seldom = driven(s);
  s.output.every = 0.003;
  const auto often = driven(s);
  EXPECT_NEAR(seldom.trajectory.column("rocker.angle [rad]").back(), often.trajectory.column("rocker.angle [rad]").back(), closed_form);
}

// Equal opposite sides: at angle π all links lie on one line, where the coupler may go on parallel to the ground or
// turn over; one output lies on the line exactly.
TEST(Kinematics, AParallelogramStaysOneThroughItsFlatPoses) {
  const FourBar flat{0.4, 0.1, 0.4, 0.1, true};
  for (const double every : {0.1, 0.25, 0.05}) {
    Scene s = four_bar(flat, no_masses, 0, pi / 4, pi, 0);
    s.run.until = 4, s.output.every = every;
    const auto run = driven(s);
    ASSERT_EQ(run.status, Status::finished) << run.reason;
    const auto coupler = run.trajectory.column("coupler.angle [rad]"), rocker = run.trajectory.column("rocker.angle [rad]"),
               t = run.trajectory.column("t [s]"), speed = run.trajectory.column("rocker.speed [rad/s]");
    for (std::size_t k = 0; k < t.size(); ++k) {
      EXPECT_NEAR(coupler[k], 0, 1e-7) << t[k];  // at the line itself second order in a step of 1e-3
      EXPECT_NEAR(rocker[k], pi / 4 + pi * t[k], 1e-7) << t[k];
      EXPECT_NEAR(speed[k], pi, 1e-5) << t[k];
    }
  }
}

// A platform on three equal cranks: two rows more than it takes.
Scene platform() {
  Scene s;
  s.gravity = {0, -9.81};
  s.bodies = {body("platform", 4, 0.3, {})};
  s.bodies[0].at = {0.2 * std::cos(0.5), 0.2 * std::sin(0.5)};
  for (int i = 0; i < 3; ++i) {
    const std::string name = "crank " + std::to_string(i), foot = "F" + std::to_string(i);
    s.ground.push_back(point(foot, 0.3 * i));
    s.bodies[0].points.push_back(point(foot, 0.3 * i));
    s.bodies.push_back(body(name, 1, 0.01, {point("O", -0.1), point("P", 0.1)}));
    s.bodies.back().at = {0.3 * i + 0.1 * std::cos(0.5), 0.1 * std::sin(0.5)}, s.bodies.back().angle = 0.5;
    s.joints.push_back(joint("foot " + std::to_string(i), JointKind::revolute, "ground." + foot, name + ".O"));
    s.joints.push_back(joint("top " + std::to_string(i), JointKind::revolute, name + ".P", "platform." + foot));
  }
  s.drivers = {angle_driver("motor", "ground", "crank 0", law(0.5, 2))};
  s.run.until = 3, s.output.every = 0.1;
  return s;
}

TEST(Kinematics, RowsThatRepeatOthersAreNoObstacle) {
  Scene s = platform();
  s.drivers.push_back(angle_driver("second motor", "ground", "crank 2", law(0.5, 2)));
  const auto run = driven(s);
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  const auto t = run.trajectory.column("t [s]"), x = run.trajectory.column("platform.x [m]"),
             a = run.trajectory.column("platform.ay [m/s^2]");
  for (std::size_t k = 0; k < t.size(); ++k) {
    EXPECT_NEAR(x[k], 0.2 * std::cos(0.5 + 2 * t[k]), closed_form);
    EXPECT_NEAR(a[k], -0.8 * std::sin(0.5 + 2 * t[k]), 1e-8);
  }
}

// Cranks that turn evenly: the motor bears the weights alone, (3 m/2 + M) g l cos θ.
TEST(Kinematics, ItsTorqueIsThatOfTheWeightsWhoeverSharesTheJointForces) {
  Scene s = platform();
  s.run.until = 1;
  const Model model = build(s);
  const Inverse found = inverse(s, model, assemble(s, model));
  ASSERT_EQ(found.run.status, Status::finished) << found.run.reason;
  const DriverEffort& motor = found.drivers.at(0);
  for (std::size_t k = 0; k < motor.t.size(); k += 10)
    EXPECT_NEAR(motor.value[k], 5.5 * 9.81 * 0.2 * std::cos(0.5 + 2 * motor.t[k]), 1e-8) << motor.t[k];
}

TEST(Kinematics, DriversThatFightAreBothNamed) {
  Scene s = platform();
  s.drivers.push_back(angle_driver("second motor", "ground", "crank 2", law(0.5, 2, 0.1)));
  std::string said = refusal<AssemblyError>(s);
  if (said == "accepted") {
    const auto run = driven(s);
    EXPECT_EQ(run.status, Status::failed);
    said = run.reason;
  }
  EXPECT_NE(said.find("\"motor\""), std::string::npos) << said;
  EXPECT_NE(said.find("\"second motor\""), std::string::npos) << said;
}

TEST(Kinematics, AnUndrivenFreedomIsRefusedWithTheBodiesThatMove) {
  Scene s = four_bar(bars, no_masses, 0, 0.3, 12, 0);
  s.bodies.push_back(body("idle", 0, 0, {point("P", 0)}));
  s.joints.push_back(joint("spindle", JointKind::revolute, "ground", "idle.P"));
  const std::string said = refusal<AssemblyError>(s);
  EXPECT_NE(said.find("1 degree of freedom is not driven"), std::string::npos) << said;
  EXPECT_NE(said.find("\"idle\" moves"), std::string::npos) << said;
  EXPECT_EQ(said.find("\"crank\""), std::string::npos) << said;
}

TEST(Kinematics, FrictionOfAJointIsNoColumnWhereNoForceIsOne) {
  const auto run =
      driven(scene_of("bodies: {arm: {rigid: {mass: 2, inertia: 0.06}, points: {O: [-0.3, 0]}}}\n"
                      "joints: {pivot: {revolute: [ground, arm.O], friction: {coulomb: {coefficient: 0.1}, radius: 20 mm}}}\n"
                      "drivers: {motor: {angle: [ground, arm], law: 2*t}}\n"
                      "run: {until: 1}\n"));
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  for (const std::string& heading : run.trajectory.header) EXPECT_FALSE(heading.starts_with("pivot")) << heading;
}

// A lag of the angle would stand at its start.
TEST(Kinematics, WhatFollowsFromRatesIsLeftOut) {
  const auto run =
      driven(scene_of("bodies: {arm: {rigid: {mass: 2, inertia: 0.06}, points: {O: [-0.3, 0], T: [0.5, 0]}}}\n"
                      "joints:\n"
                      "  pivot:\n"
                      "    revolute: [ground, arm.O]\n"
                      "    friction: {lugre: {coefficient: 0.1, static: 0.2, stribeck speed: 1 mm/s, bristle stiffness: 1e5 1/m, bristle "
                      "damping: 100 s/m}, radius: 20 mm}\n"
                      "drivers: {motor: {angle: [ground, arm], law: 2*t}}\n"
                      "states: {seen: {lag: arm.angle, time: 10 ms}}\n"
                      "forces: {s: {maxwell: [ground, arm.T], stiffness: 100 N/m, damping: 10 N s/m}}\n"
                      "outputs: {late: arm.angle - seen, twice: 2*arm.angle}\n"
                      "run: {until: 1}\n"));
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  for (const std::string& heading : run.trajectory.header)
    EXPECT_TRUE(heading == "t [s]" || heading.starts_with("arm.") || heading == "twice [rad]") << heading;
  EXPECT_NEAR(run.trajectory.column("twice [rad]").back(), 4, closed_form);
  EXPECT_TRUE(std::ranges::any_of(run.warnings, [](const std::string& w) { return w.find("states") != std::string::npos; }));
}

TEST(Kinematics, AClearanceIsRefused) {
  SliderCrank o;
  o.driven = true;
  EXPECT_NE(refusal<AssemblyError>(scene(o)).find("\"gudgeon pin\""), std::string::npos);
}

// A ram between (0, 0) and a bar's end: the bar reaches 0.3 + 0.5 at most, at t = 0.3 s.
TEST(Kinematics, ADriverThatAsksBeyondReachEndsTheMotionThereAndIsNamed) {
  Scene s;
  s.ground = {point("O", 0), point("P", 0.3)};
  s.bodies = {body("bar", 0, 0, {point("P", 0), point("end", 0.5)})};
  s.bodies[0].at = {0.3, 0}, s.bodies[0].angle = 1.2;
  s.joints = {joint("pivot", JointKind::revolute, "ground.P", "bar.P")};
  s.drivers = {{"ram", DriverKind::distance, ref("ground.O"), ref("bar.end"), law(0.5, 1), {}}};
  s.run.until = 1, s.output.every = 0.01;
  const auto run = driven(s);
  EXPECT_EQ(run.status, Status::failed);
  EXPECT_NEAR(run.t_end, 0.3, 1e-6);
  EXPECT_EQ(run.trajectory.rows(), 30u) << "what was computed is kept";
  EXPECT_NE(run.reason.find("\"ram\""), std::string::npos) << run.reason;
}

// More links than are solved dense: each turns against the one before it.
TEST(Kinematics, ALongDrivenChainMovesAsItsSums) {
  constexpr int n = 60;
  Scene s;
  double x = 0, y = 0;
  for (int i = 0; i < n; ++i) {
    const std::string name = "link " + std::to_string(i), before = i == 0 ? "ground" : "link " + std::to_string(i - 1);
    s.bodies.push_back(body(name, 0, 0, {point("A", 0), point("B", 0.1)}));
    const double angle = 0.05 * (i + 1);
    s.bodies.back().at = {x, y}, s.bodies.back().angle = angle;
    x += 0.1 * std::cos(angle), y += 0.1 * std::sin(angle);
    s.joints.push_back(joint("pin " + std::to_string(i), JointKind::revolute, i == 0 ? "ground" : before + ".B", name + ".A"));
    s.drivers.push_back(angle_driver("motor " + std::to_string(i), before, name, law(0.05, 0.02 * (i % 3 - 1), 0.1)));
  }
  s.run.until = 1, s.output.every = 0.5;
  s.output.points = {ref("link 59.B")};
  const auto run = driven(s);
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  const double t = 1;
  double angle = 0, rate = 0, accel = 0, ax = 0, vx = 0;
  x = 0;
  for (int i = 0; i < n; ++i) {
    const double r = 0.02 * (i % 3 - 1);
    angle += 0.05 + r * t + 0.05 * t * t, rate += r + 0.1 * t, accel += 0.1;
    x += 0.1 * std::cos(angle), vx -= 0.1 * rate * std::sin(angle);
    ax -= 0.1 * (accel * std::sin(angle) + rate * rate * std::cos(angle));
  }
  EXPECT_NEAR(run.trajectory.column("link 59.B.x [m]").back(), x, 1e-9);
  EXPECT_NEAR(run.trajectory.column("link 59.B.vx [m/s]").back(), vx, 1e-8);
  EXPECT_NEAR(run.trajectory.column("link 59.B.ax [m/s^2]").back(), ax, 1e-7);
}

TEST(Kinematics, AStartAtRestIsLeft) {
  Scene s = four_bar(bars, no_masses, 0, 0.3, 0, 0);
  s.drivers[0].law = {[](double t) { return Jet{0.3 + t * t * t, 3 * t * t, 6 * t}; }, "0.3 + t^3", false};
  s.run.until = 2, s.output.every = 0.5;
  const auto run = driven(s);
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  const FourBarMotion m = evaluate(bars, {8.3, 12, 12});
  EXPECT_NEAR(apart(run.trajectory.column("rocker.angle [rad]").back(), m.rocker.angle), 0, closed_form);
}

}  // namespace
}  // namespace pintle_scenes::kinematics_test
