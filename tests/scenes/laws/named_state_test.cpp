// Lags, PID controllers and limited rates by name: against closed forms, and against the same written out by hand.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::named_state_test {
namespace {

using pintle_scenes::Whole;
using pintle_test::expect_one_line;
using pintle_test::expect_says;

Scene scene(const std::string& text) { return read_scene_text(text, "scene.yaml"); }

// What has a state needs a mechanism; this one does nothing.
const std::string still = R"yaml(
bodies: {cart: {rigid: {mass: 1 kg, inertia: 0.1 kg m^2}}}
joints: {rail: {prismatic: [ground, cart]}}
run: {until: 2 s, method: dopri5, tolerance: 1e-10}
output: {every: 10 ms}
)yaml";

// A run of tolerance 1e-10 errs by some hundred of it.
constexpr double near = 1e-7;

template <class Exact>
void expect_column(const Whole& w, const std::string& name, const Exact& exact) {
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const auto t = w.run.trajectory.column("t [s]"), y = w.run.trajectory.column(name);
  ASSERT_EQ(t.size(), y.size());
  for (std::size_t i = 0; i < t.size(); ++i) ASSERT_NEAR(y[i], exact(t[i]), near) << name << " at " << t[i] << " s";
}

TEST(NamedStates, ALagAnswersAStepByItsExponential) {
  const Whole w = pintle_scenes::run(still + "states: {f: {lag: 5 N, time: 0.2 s}}\n");
  expect_column(w, "f [N]", [](double t) { return 5 * (1 - std::exp(-t / 0.2)); });
}

// (1 + L s)/(1 + T s): jumps by L/T, and goes on to 1.
TEST(NamedStates, ALeadAnswersAStepAtOnceByItsPart) {
  const Whole w = pintle_scenes::run(still + "states: {f: {lag: 5 N, time: 0.2 s, lead: 0.05 s}}\n");
  expect_column(w, "f [N]", [](double t) { return 5 * (1 - 0.75 * std::exp(-t / 0.2)); });
}

// To 1 at 2 a second; the last 2 T of it, 0.1, by the exponential of T.
TEST(NamedStates, ALimitedRateRampsAndThenLags) {
  const Whole w = pintle_scenes::run(still + "states: {r: {rate limit: 1 rad, most: 2 rad/s, time: 50 ms}}\n");
  expect_column(w, "r [rad]", [](double t) { return t < 0.45 ? 2 * t : 1 - 0.1 * std::exp(-(t - 0.45) / 0.05); });
  const Whole down = pintle_scenes::run(still + "states: {r: {rate limit: -1 rad, most: [-1 rad/s, 2 rad/s], time: 50 ms}}\n");
  expect_column(down, "r [rad]", [](double t) { return t < 0.95 ? -t : -1 + 0.05 * std::exp(-(t - 0.95) / 0.05); });
}

// u = 3 e + 2 ∫e drives x' = u to 1: poles at −1 and −2, x = 1 + e^−t − 2 e^−2t.
TEST(NamedStates, APiControllerLeadsAnIntegratorByItsPoles) {
  const Whole w = pintle_scenes::run(still + "states:\n  x: {rate: u, start: 0 m}\n  u: {pid: 1 m - x, gains: [3 1/s, 2 1/s^2, 0]}\n");
  expect_column(w, "x [m]", [](double t) { return 1 + std::exp(-t) - 2 * std::exp(-2 * t); });
  expect_column(w, "u [m/s]", [](double t) { return -std::exp(-t) + 4 * std::exp(-2 * t); });
}

// D s/(1 + T s) of a step: D/T e^(−t/T).
TEST(NamedStates, AFilteredDerivativeDiesAwayByItsFilter) {
  const Whole w = pintle_scenes::run(still + "states: {u: {pid: 2 m, gains: [0 N/m, 0 N/m/s, 3 N s/m], filter: 0.1 s}}\n");
  expect_column(w, "u [N]", [](double t) { return 60 * std::exp(-t / 0.1); });
}

const std::string arm = R"yaml(
gravity: [0, -9.81 m/s^2]
parameters: {target: 0 deg}
bodies:
  arm: {rigid: {mass: 2 kg, inertia: 0.06 kg m^2, center: [0.3 m, 0]}, points: {O: [0, 0]}, pose: {angle: -90 deg}}
joints: {pivot: {revolute: [ground, arm.O]}}
start: {arm: {angle: -90 deg}}
run: {until: 3 s, method: METHOD}
output: {every: 20 ms}
)yaml";
const std::string named = R"yaml(
states:
  u: {pid: target - arm.angle, gains: [40 N m, 15 N m/s, 6 N m s], filter: 5 ms, limits: [-9 N m, 9 N m], tracking: 0.5 s}
forces:
  servo: {torque: u, on: arm}
)yaml";
const std::string by_hand = R"yaml(
states:
  u integral: {rate: "15 N m/s*(target - arm.angle) + (saturate(40 N m*(target - arm.angle) + u integral + 1200 N m*(target - arm.angle) - u filter, -9 N m, 9 N m) - (40 N m*(target - arm.angle) + u integral + 1200 N m*(target - arm.angle) - u filter))/(0.5 s)", unit: N m, scale: 9 N m}
  u filter: {rate: "(1200 N m*(target - arm.angle) - u filter)/(5 ms)", unit: N m, scale: 9 N m}
forces:
  servo: {torque: "saturate(40 N m*(target - arm.angle) + u integral + 1200 N m*(target - arm.angle) - u filter, -9 N m, 9 N m)", on: arm}
)yaml";
std::string by(const std::string& method, const std::string& text) {
  std::string out = arm + text;
  return out.replace(out.find("METHOD"), 6, method);
}

// Their formulas have the same operations in other orders, of which rounding alone may tell.
TEST(NamedStates, APidIsTheSameControllerWrittenOutByHand) {
  for (const char* method : {"dopri5", "generalized-alpha"}) {
    const Whole w = pintle_scenes::run(by(method, named)), hand = pintle_scenes::run(by(method, by_hand));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_EQ(hand.run.status, Status::finished) << hand.run.reason;
    for (const char* column : {"arm.angle [rad]", "u integral [N m]", "u filter [N m]", "servo.torque on arm [N m]"}) {
      const auto a = w.run.trajectory.column(column), b = hand.run.trajectory.column(column);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-6) << column << " row " << i << " " << method;
    }
    const auto u = w.run.trajectory.column("u [N m]");
    EXPECT_EQ(*std::ranges::max_element(u), 9);  // it was at its limit
  }
}

TEST(NamedStates, TheSceneFilledInReadsBackToTheSameRun) {
  const Scene first = scene(by("dopri5", named)), again = scene(first.filled_in);
  EXPECT_EQ(again.filled_in, first.filled_in);
  const Whole a = pintle_scenes::run(first), b = pintle_scenes::run(again);
  EXPECT_EQ(a.run.trajectory.header, b.run.trajectory.header);
  EXPECT_EQ(a.run.trajectory.data, b.run.trajectory.data);
}

// One controller may lead another, whichever stands first; in a circle they are refused.
TEST(NamedStates, AControllerMayLeadAnother) {
  const std::string inner = "  u: {pid: v - arm.speed, gains: [8 N m s, 20 N m, 0], unit: N m}\n",
                    outer = "  v: {pid: target - arm.angle, gains: [5 1/s, 0, 0], unit: rad/s}\n",
                    force = "forces: {servo: {torque: u, on: arm}}\n";
  const Whole a = pintle_scenes::run(by("dopri5", "states:\n" + inner + outer + force)),
              b = pintle_scenes::run(by("dopri5", "states:\n" + outer + inner + force));
  EXPECT_EQ(a.run.trajectory.column("arm.angle [rad]"), b.run.trajectory.column("arm.angle [rad]"));
  const std::string said = pintle_test::refusal_by(
      [&] { scene(by("dopri5", "states:\n  u: {pid: v, gains: [1, 0, 0]}\n  v: {pid: u + 1, gains: [1, 0, 0]}\n")); });
  expect_says(said, {"would depend on itself"});
}

// The loop of u = 11 e + 6 ∫e − 6 ω about I = 1 has the poles −1, −2, −3; the rate is taken of the arm itself.
TEST(NamedStates, LinearizedItHasThePolesOfItsGains) {
  std::string text = by("dopri5",
                        "states: {u: {pid: target - arm.angle, gains: [11 N m, 6 N m/s, 0 N m s]}}\n"
                        "forces: {servo: {torque: u - 6 N m s*arm.speed, on: arm}}\n");
  text.replace(text.find("-9.81"), 5, "0");
  text.replace(text.find("inertia: 0.06 kg m^2, center: [0.3 m, 0]"), 40, "inertia: 1 kg m^2");
  const Scene s = scene(text);
  const Model model = build(s);
  const Eigen::VectorXcd found = linearize(s, model, assemble(s, model).start).space.A.eigenvalues();
  ASSERT_EQ(found.size(), 3);
  for (const double root : {-1.0, -2.0, -3.0}) {
    double nearest = 1e300;
    for (const std::complex<double>& r : found) nearest = std::min(nearest, std::abs(r - root));
    EXPECT_LT(nearest, 1e-10);
  }
}

// It begins at its limit, where the integral follows from the pose, and rests within it, where the integral holds 2 kg 9.81 m/s² 0.3 m.
TEST(NamedStates, AtRestTheIntegralHoldsTheLoad) {
  const Scene s = scene(by("dopri5", named));
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model), 0);
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.table.column("u integral [N m]").back(), 5.886, 1e-6);
  EXPECT_NEAR(rest.table.column("arm.angle [rad]").back(), 0, 1e-7);
}

TEST(NamedStates, WhatCannotBeIsRefusedByName) {
  const auto refusal = [](const std::string& state) {
    return pintle_test::refusal_by([&] { build(scene(still + "states:\n  u: " + state + "\n")); });
  };
  const std::string place = "scene.yaml:7: states.u";
  expect_one_line(refusal("{pid: cart.x, gains: [0 N/m, 0 N/m/s, 3 N s/m]}"), place, {"needs a filter", "filter: 2 ms"});
  expect_one_line(refusal("{pid: cart.x, gains: [1 N/m, 0 N/m/s, 0 N s/m], filter: 2 ms}"), place + ".filter: ", {"leave it out"});
  expect_one_line(refusal("{pid: cart.x, gains: [0, 0, 0]}"), place + ".gains: ", {"no gain"});
  expect_one_line(refusal("{pid: cart.x, gains: [1 N/m, 0, 0], limits: [2 N, -2 N]}"), place + ".limits: ", {"lower limit first"});
  expect_one_line(refusal("{pid: cart.x, gains: [0 N/m, 1 N/m/s, 0], limits: [-2 N, 2 N]}"), place + ": ", {"tracking"});
  expect_one_line(refusal("{pid: cart.x, gains: [1 N/m, 0 N/m/s, 0], tracking: 1 s}"), place + ".tracking: ", {"leave it out"});
  expect_one_line(refusal("{lag: cart.x}"), place + ": ", {"time: 20 ms"});
  expect_one_line(refusal("{lag: cart.x, time: 0 s}"), place + ".time: ", {"greater than 0"});
  expect_one_line(refusal("{lag: cart.x, time: 1 s, unit: N}"), place + ".unit: ", {"a force [N]; expected a length [m]"});
  expect_one_line(refusal("{lag: cart.y2, time: 1 s}"), place + ".lag: ", {"\"cart.y2\"", "there is no signal"});
  expect_one_line(refusal("{rate limit: cart.x, time: 1 s}"), place + ": ", {"most"});
  expect_one_line(refusal("{rate limit: cart.x, time: 1 s, most: [1 m/s, 2 m/s]}"), place + ".most: ", {"both directions"});
  expect_one_line(refusal("{lagg: cart.x, time: 1 s}"), place + ".lagg: ", {"Did you mean \"lag\"?"});
  expect_one_line(refusal("{lag: cart.x, time: 1 s, gains: [1, 2, 3]}"), place + ".gains: ", {"does not belong to lag but to pid"});
}

// The line and key that is wrong, not those of the force that uses the state, and in the words of the scene.
TEST(NamedStates, AWrongUnitIsFoundWhereItStands) {
  const auto refusal = [](const std::string& state) {
    return pintle_test::refusal_by([&] {
      build(scene(still + "forces: {push: {force: [u, 0], at: cart}}\nstates:\n  other: {lag: 2 m, time: 1 s}\n  u: " + state + "\n"));
    });
  };
  const std::string u = "scene.yaml:9: states.u", gains = "gains: [1 N/m, 2 N/m/s, 3 N s/m], filter: 2 ms";
  expect_one_line(refusal("{pid: other - cart.x, gains: [1 N/m, 2 N/m, 3 N s/m], filter: 2 ms}"),
                  u + ".gains[2]: ", {"\"2 N/m\" times the error's integral is ", "expected a force [N]"});
  expect_one_line(refusal("{pid: other - cart.x, gains: [1 N/m, 2 N/m/s, 3 N/m], filter: 2 ms, limits: [-1 N, 1 N]}"),
                  u + ".gains[3]: ", {"\"3 N/m\" times the error's rate is ", "expected a force [N]"});
  expect_one_line(refusal("{pid: other - cart.x, " + gains + ", limits: [-9 N m, 9 N m]}"),
                  u + ".limits[1]: ", {"\"-9 N m\" is a torque or energy [N*m]; expected a force [N]"});
  expect_one_line(refusal("{pid: other - cart.x, " + gains + ", limits: [-9 N, 9 N], start: 1 N m}"), u + ".limits", {"expected a torque"});
  expect_one_line(refusal("{pid: other - cart.angle, " + gains + "}"),
                  u + ".pid: ", {"\"other - cart.angle\"", "- mixes a length [m] and an angle"});
  expect_one_line(refusal("{pid: other - cart.ax, " + gains + "}"), u + ".pid: ", {"cart.ax depends on the accelerations"});
  expect_one_line(refusal("{lag: cart.ax, time: 1 s}"), u + ".lag: ", {"cart.ax depends on the accelerations"});
  expect_one_line(refusal("{lag: cart.x + 1 N, time: 1 s}"), u + ".lag: ", {"\"cart.x + 1 N\"", "+ mixes a length [m] and a force [N]"});
  expect_one_line(refusal("{lag: cart.x, time: 1 s, start: 2 N}"), u + ".start: ", {"a force [N]; expected a length [m]"});
  expect_one_line(refusal("{rate limit: cart.x + 1 N, time: 1 s, most: 1 N/s}"), u + ".rate limit: ", {"+ mixes"});
}

TEST(NamedStates, AnEventSetsTheStatesOfAControllerAndIsToldThem) {
  const auto refusal = [](const std::string& gains) {
    return pintle_test::refusal_by(
        [&] { build(scene(still + "states: {u: {pid: cart.x, " + gains + "}}\nevents: {e: {when: t > 1 s, do: {set: {u: 1 N}}}}\n")); });
  };
  const std::string place = "scene.yaml:7: events.e.do.set.u: ";
  expect_one_line(refusal("gains: [1 N/m, 2 N/m/s, 0]"), place, {"\"u\" is not a state", "set one of its states: \"u integral\""});
  expect_one_line(refusal("gains: [1 N/m, 2 N/m/s, 3 N s/m], filter: 2 ms"), place, {"\"u integral\" or \"u filter\""});
  expect_one_line(refusal("gains: [1 N/m, 0, 0]"), place, {"\"u\" is not a state", "set a state or a parameter"});
}

}  // namespace
}  // namespace pintle::named_state_test
