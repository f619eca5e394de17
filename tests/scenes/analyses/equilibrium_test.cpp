// Where mechanisms rest: against closed forms and against their own damped motion.
#include "framework/configuration/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/work_done.h"
#include "framework/scene/yaml/reader.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/refusal.h"

namespace pintle_scenes::equilibrium_test {
namespace {

using namespace pintle;
using std::numbers::pi;

constexpr double solved = 1e-10;  ///< relative: Newton's method to the end, a few sums of rounding
constexpr double contact = 1e-7;  ///< relative: depth of a stiff contact beside the coordinates it is a difference of

struct Found {
  Model model;
  Equilibrium rest;
  double value(const std::string& column) const { return rest.table.column(column).at(0); }
};
Found rest_of(const Scene& scene, double at = 0) {
  const Scene ready = ready_for_statics(scene);
  Model model = build(ready);
  const Assembly assembly = assemble(ready, model);
  Equilibrium rest = find_equilibrium(ready, model, assembly, at);
  return {std::move(model), std::move(rest)};
}

SceneBody link(const std::string& name, double mass, double length) {
  return body(name, mass, mass * length * length / 12, {point("A", -length / 2), point("B", length / 2)});
}

TEST(Equilibrium, APendulumComesToHangBelowItsPivot) {
  const Found f = rest_of(pendulum(Hanging::by_pin, 1.0));
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(f.value("bob.angle [rad]"), -pi / 2, solved);
  EXPECT_NEAR(f.value("rod.fy on bob [N]"), 9.81, solved * 9.81);
  EXPECT_EQ(f.rest.stability.unstable, 0);
  EXPECT_EQ(f.rest.stability.neutral, 0);
  EXPECT_EQ(f.rest.stability.dofs, 1);
}

TEST(Equilibrium, AnUprightStartIsKeptAndReportedUnstable) {
  const Found f = rest_of(pendulum(Hanging::by_pin, pi));
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(std::cos(f.value("bob.angle [rad]") - pi / 2), 1, 1e-12);
  EXPECT_EQ(f.rest.stability.unstable, 1);
  EXPECT_EQ(f.rest.stability.moving, std::vector<std::string>{"bob"});
}

TEST(Equilibrium, ANearlyUprightStartFalls) {
  const Found f = rest_of(pendulum(Hanging::by_pin, pi - 1e-3));
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(std::sin(f.value("bob.angle [rad]")), -1, solved);
  EXPECT_EQ(f.rest.stability.unstable, 0);
}

// Uniform links between two supports: with the horizontal pull H, link j's direction has
// tan θ_j = w (j + ½ − N/2)/H, and H follows from the span.
TEST(Equilibrium, AHangingChainTakesTheShapeOfItsFunicular) {
  constexpr int n = 12;
  constexpr double length = 0.25, mass = 0.4, span = 2.0, weight = mass * 9.81;
  Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("L", 0), point("R", span)};
  for (int i = 0; i < n; ++i) {  // started as an arc below
    const double part = (i + 0.5) / n;
    s.bodies.push_back(link("link " + std::to_string(i), mass, length));
    s.bodies.back().at = {span * part, -2 * part * (1 - part)};
    s.bodies.back().angle = -1 + 2 * part;
    s.joints.push_back(joint("pin " + std::to_string(i), JointKind::revolute, i == 0 ? "ground.L" : "link " + std::to_string(i - 1) + ".B",
                             "link " + std::to_string(i) + ".A"));
  }
  s.joints.push_back(joint("last pin", JointKind::revolute, "link 11.B", "ground.R"));
  const auto angle = [&](double pull, int j) { return std::atan(weight * (j + 0.5 - n / 2.0) / pull); };
  double low = 1e-3, high = 1e4;
  for (int i = 0; i < 200; ++i) {
    const double pull = 0.5 * (low + high);
    double reach = 0;
    for (int j = 0; j < n; ++j) reach += length * std::cos(angle(pull, j));
    (reach < span ? low : high) = pull;
  }
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  for (int j = 0; j < n; ++j) EXPECT_NEAR(f.value("link " + std::to_string(j) + ".angle [rad]"), angle(low, j), 1e-9) << j;
  EXPECT_NEAR(std::abs(f.value("last pin.fx on link 11 [N]")), low, 1e-9 * low);
  EXPECT_EQ(f.rest.stability.unstable, 0);
  EXPECT_EQ(f.rest.stability.dofs, n - 2);
}

// A spring without free length from (d, h) to the lever's middle: its moment is k a (h cos θ − d sin θ), and the
// lever rests where tan θ = (k a h − m g a)/(k a d).
Scene lever(double d, double h, double stiffness) {
  Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("O", 0), point("S", d, h)};
  s.bodies = {body("lever", 2, 0.1, {point("O", -0.3), point("M", 0)})};
  s.bodies[0].at = {0.3, 0};
  s.joints = {joint("pivot", JointKind::revolute, "ground.O", "lever.O")};
  s.loads = {spring("spring", "ground.S", "lever.M", stiffness, 3, 0)};
  return s;
}

TEST(Equilibrium, ASpringLoadedLeverBalancesItsMoments) {
  const Found f = rest_of(lever(0.2, 0.4, 150));
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(f.value("lever.angle [rad]"), std::atan2(150 * 0.4 - 2 * 9.81, 150 * 0.2), solved);
  EXPECT_EQ(f.rest.stability.unstable, 0);
}

TEST(Equilibrium, APerfectlyBalancedLeverIsNeutral) {
  const Found f = rest_of(lever(0, 0.4, 2 * 9.81 / 0.4));
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_EQ(f.rest.iterations, 0);
  EXPECT_EQ(f.rest.stability.neutral, 1);
  EXPECT_EQ(f.rest.stability.unstable, 0);
}

TEST(Equilibrium, AThreeHingedArchCarriesItsThrust) {
  constexpr double half = 1.5, rise = 0.8, load = 700;
  const double length = std::hypot(half, rise), slope = std::atan2(rise, half);
  Scene s;  // neither masses nor gravity
  s.ground = {point("L", 0), point("R", 2 * half)};
  s.bodies = {link("left", 0, length), link("right", 0, length)};
  s.bodies[0].at = {half / 2, rise / 2}, s.bodies[0].angle = slope;
  s.bodies[1].at = {1.5 * half, rise / 2}, s.bodies[1].angle = -slope;
  s.joints = {joint("foot", JointKind::revolute, "ground.L", "left.A"), joint("crown", JointKind::revolute, "left.B", "right.A"),
              joint("other foot", JointKind::revolute, "right.B", "ground.R")};
  s.loads = {force("load", "left.B", law(0), law(-load))};
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(f.value("foot.fx on left [N]"), load * half / (2 * rise), 1e-9 * load);
  EXPECT_NEAR(f.value("foot.fy on left [N]"), load / 2, 1e-9 * load);
  EXPECT_NEAR(f.value("other foot.fx on right [N]"), -load * half / (2 * rise), 1e-9 * load);
  EXPECT_EQ(f.rest.stability.dofs, 0);
}

TEST(Equilibrium, ADriverHoldsWithTheTorqueOfTheInstantAskedFor) {
  Scene s = pendulum(Hanging::by_pin, pi / 2);
  s.start_bodies.clear();
  s.drivers = {angle_driver("motor", "ground.P", "bob.P", law(0, 2, 1))};
  for (const double at : {0.0, 0.4, 3.0}) {
    const Found f = rest_of(s, at);
    ASSERT_TRUE(f.rest.found) << f.rest.reason;
    const double angle = 2 * at + at * at / 2;
    EXPECT_NEAR(f.value("bob.angle [rad]"), angle, 1e-12);
    EXPECT_NEAR(f.value("motor.torque on bob [N m]"), 9.81 * 0.5 * std::cos(angle), solved * 5);
    EXPECT_EQ(f.rest.state.y.tail(f.rest.state.y.size() - 3).norm(), 0) << "at rest";
  }
}

// A rod of 2 m about the origin, whose end a ram at (3, 0) pushes away from 3.6 m: it is straight at 5 m, after 1.4 s of 4 s.
TEST(Equilibrium, TellsHowFarItsDriversAreFollowed) {
  const Scene s = read_scene_text(R"(
ground: {points: {O: [0, 0], far: [3, 0]}}
bodies: {rod: {rigid: {mass: 1, inertia: 1}, points: {O: [-1, 0], end: [1, 0]}, pose: {at: [0, 1], angle: 90 deg}}}
joints: {hinge: {revolute: [ground.O, rod.O]}}
drivers: {ram: {distance: [ground.far, rod.end], law: 3.6 m + 1 m/s*t}}
)",
                                  "scene.yaml");
  EXPECT_FALSE(rest_of(s, 4).rest.found);
  EXPECT_NEAR(work_done, 1.4 / 4, 1e-3);
}

// kδⁿ carries the weight; without friction the journal is free to turn.
TEST(Equilibrium, AJournalSinksIntoItsBearingAsTheHertzLawSays) {
  constexpr double mass = 3, c = 1e-4;
  Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("O", 0)};
  s.bodies = {body("rotor", mass, 0.01, {point("O", 0)})};
  s.joints = {joint("bearing", JointKind::revolute, "ground.O", "rotor.O")};
  s.joints[0].clearance = clearance("ground", c, 0.9);
  s.start_journals = {{"bearing", {0.3e-4, 0.2e-4}, {0, 0}, {}}};
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  const double depth = std::pow(mass * 9.81 / std::get<ImpactLaw>(f.model.system.contacts[0].normal).k, 2.0 / 3);
  EXPECT_NEAR(f.value("bearing.depth [m]"), depth, contact * depth + 1e-16);
  EXPECT_NEAR(f.value("bearing.ey [m]"), -(c + depth), 1e-9 * c);
  EXPECT_NEAR(f.value("bearing.ex [m]"), 0, 1e-6 * c);
  EXPECT_NEAR(f.value("bearing.normal [N]"), mass * 9.81, 1e-8 * mass);
  EXPECT_GT(f.rest.state.impact_rate[0], 0);
  EXPECT_EQ(f.rest.stability.neutral, 1);
  EXPECT_EQ(f.rest.stability.unstable, 0);
}

// A door on two hinges: moments give the pull across, and of the weight each bears half by the least norm.
TEST(Equilibrium, ADoublyHingedDoorHangsInBothHinges) {
  constexpr double mass = 30, width = 0.9, height = 1.4, weight = mass * 9.81;
  Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("low", 0), point("high", 0, height)};
  s.bodies = {body("door", mass, 5, {point("low", 0), point("high", 0, height)})};
  s.bodies[0].center = {width / 2, height / 2};
  s.joints = {joint("lower hinge", JointKind::revolute, "ground.low", "door.low"),
              joint("upper hinge", JointKind::revolute, "ground.high", "door.high")};
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(f.value("upper hinge.fx on door [N]"), -weight * width / 2 / height, 1e-9 * weight);
  EXPECT_NEAR(f.value("lower hinge.fx on door [N]"), weight * width / 2 / height, 1e-9 * weight);
  constexpr double shared = 1e-6;  // what least norm shares out: rounding over the solver's shift
  EXPECT_NEAR(f.value("lower hinge.fy on door [N]"), weight / 2, shared * weight);
  EXPECT_NEAR(f.value("upper hinge.fy on door [N]"), weight / 2, shared * weight);
}

// Friction at rest is taken as 0, what presses the surfaces is not: the weights, and a preload.
TEST(Equilibrium, WhatPressesAJointWithFrictionIsTold) {
  const Found found =
      rest_of(scene_of("gravity: [0, -9.81]\n"
                       "bodies:\n"
                       "  wheel: {rigid: {mass: 10, inertia: 0.2}, points: {O: [0, 0]}}\n"
                       "  drawer: {rigid: {mass: 3, inertia: 0.02}, points: {O: [0, 0]}}\n"
                       "joints:\n"
                       "  axle: {revolute: [ground, wheel.O], friction: {coulomb: {coefficient: 0.1}, radius: 20 mm}}\n"
                       "  guide: {prismatic: [ground, drawer.O], friction: {coulomb: {coefficient: 0.3}, length: 0.2 m, preload: 5 N}}\n"));
  ASSERT_TRUE(found.rest.found) << found.rest.reason;
  EXPECT_NEAR(found.value("axle.load [N]"), 98.1, 98.1 * solved);
  EXPECT_NEAR(found.value("guide.load [N]"), 3 * 9.81 + 5, 35 * solved);
  EXPECT_EQ(found.value("axle.friction [N]"), 0);
}

TEST(Equilibrium, AFallingBodyHasNoneAndIsNamed) {
  Scene s = pendulum(Hanging::by_pin, 1);
  s.bodies.push_back(body("loose", 1, 1, {}));
  const Found f = rest_of(s);
  EXPECT_FALSE(f.rest.found);
  EXPECT_NE(f.rest.reason.find("\"loose\""), std::string::npos) << f.rest.reason;
  EXPECT_EQ(f.rest.reason.find("\"bob\""), std::string::npos) << f.rest.reason;
}

TEST(Equilibrium, ATorqueThatNothingBalancesHasNone) {
  Scene s = pendulum(Hanging::by_pin, 1);
  s.loads = {torque("drive", "bob", law(6))};  // more than m g l = 4.9 N m
  EXPECT_FALSE(rest_of(s).rest.found);
  s.loads = {torque("drive", "bob", law(3))};
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(std::sin(f.value("bob.angle [rad]") + pi / 2), 3 / (9.81 * 0.5), solved);
}

// A force that stays across the bar has a constant moment and no potential that the search could follow.
TEST(Equilibrium, ALoadThatFollowsIsBalancedToo) {
  constexpr double force_ = 40, length = 0.5, stiffness = 15;
  Scene s;
  s.bodies = {body("bar", 1, 0.02, {point("O", 0), point("tip", length)})};
  s.joints = {joint("pivot", JointKind::revolute, "ground", "bar.O")};
  s.loads = {force("push", "bar.tip", law(0), law(force_), true)};
  s.loads.push_back({"spring", SceneTorsionSpring{ref("ground"), ref("bar"), stiffness, 0, 0}, {}});
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_NEAR(f.value("bar.angle [rad]"), force_ * length / stiffness, solved);
}

TEST(Equilibrium, ACantileverBendsByItsTipLoad) {
  const Found f = rest_of(scene_of(R"(
bodies:
  bar:
    beam: {from: A, to: B, section: {rectangle: [4 mm, 20 mm]}, young: 200 GPa, poisson: 0.3, density: 7800, elements: 4, theory: euler}
    points: {A: [0, 0], B: [400 mm, 0]}
    modes: {frame: {tangent: A}, keep: all}
joints: {wall: {weld: [ground, bar.A]}}
forces: {load: {force: [0, -5 N], at: bar.B}}
output: {points: [bar.B]}
run: {until: 1 s}
)"));
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  const double I = 0.02 * std::pow(0.004, 3) / 12, sag = 5 * std::pow(0.4, 3) / (3 * 200e9 * I);
  EXPECT_NEAR(f.value("bar.B.uy [m]"), -sag, 1e-8 * sag);
  EXPECT_NEAR(std::abs(f.value("wall.torque on bar [N m]")), 2, 1e-8);
  EXPECT_EQ(f.rest.stability.unstable, 0);
}

// A slider-crank with a clearance between its last pin and slider, held up by a spring, against the end of its own
// heavily damped motion.
TEST(Equilibrium, IsWhereDampedMotionEnds) {
  SliderCrank o;
  o.clearance = 1e-3, o.speed = 0, o.angle = 0.7, o.until = 6, o.tolerance = 1e-9, o.outputs = 10;
  Scene s = scene(o);
  s.ground.push_back(point("S", 0.3));
  s.loads = {spring("buffer", "ground.S", "slider.P", 80, 13, 0.12)};
  s.loads.push_back({"drag", SceneTorsionSpring{ref("ground"), ref("crank"), 0, 0.015, 0}, {}});
  s.loads.push_back({"rub", SceneTorsionSpring{ref("crank"), ref("coupler"), 0, 0.015, 0}, {}});
  const Whole moved = run(s);
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  for (const char* column : {"crank.angle [rad]", "coupler.angle [rad]", "slider.x [m]"})
    EXPECT_NEAR(f.value(column), moved.last(column), 1e-5) << column;
  EXPECT_NEAR(f.value("gudgeon pin.normal [N]"), moved.last("gudgeon pin.normal [N]"), 1e-3);
}

TEST(Equilibrium, OneThatNeedsNoForcesIsFoundAtOnce) {
  Scene s;
  s.bodies = {body("brick", 1, 1, {})};
  const Found f = rest_of(s);
  ASSERT_TRUE(f.rest.found) << f.rest.reason;
  EXPECT_EQ(f.rest.stability.neutral, 3);
}

TEST(Equilibrium, ABodyWithoutMassIsRefusedWhereGravityActs) {
  Scene s = pendulum(Hanging::by_pin, 1);
  s.bodies[0].mass = 0;
  pintle_test::expect_refused([&] { build(ready_for_statics(s)); }, {"mass: 0.3 kg"});
  s.bodies[0].mass = 1, s.bodies[0].inertia = 0;
  EXPECT_TRUE(rest_of(s).rest.found);
}

}  // namespace
}  // namespace pintle_scenes::equilibrium_test
