// Signals in linearize and statics, in restarts, and what is refused of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/integration/integrator.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::signal_question_test {
namespace {

using pintle_scenes::Whole;

const std::string servo = R"yaml(
parameters: {target: 0.5 rad}
bodies: {arm: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0], tip: [1 m, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states:
  integral: {rate: target - arm.angle, start: 0 rad s}
forces:
  servo: {torque: "11 N m*(target - arm.angle) + 6 N m/s*integral - 6 N m s*arm.speed", on: arm}
run: {until: 2 s, method: METHOD}
)yaml";
std::string with(const std::string& text, const std::string& from, const std::string& to) {
  std::string out = text;
  const std::size_t at = out.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return out.replace(at, from.size(), to);
}
Scene scene(const std::string& text) { return read_scene_text(text, "scene.yaml"); }

// s³ + 6 s² + 11 s + 6, in every pose
TEST(SignalsLinearized, APidLoopHasThePolesOfItsGains) {
  const Scene s = scene(with(servo, "METHOD", "dopri5"));
  const Model model = build(s);
  const Linearization lin = linearize(s, model, assemble(s, model).start);
  const Eigen::VectorXcd found = lin.space.A.eigenvalues();
  ASSERT_EQ(found.size(), 3);
  for (const double root : {-1.0, -2.0, -3.0}) {
    double nearest = 1e300;
    for (const std::complex<double>& r : found) nearest = std::min(nearest, std::abs(r - root));
    EXPECT_LT(nearest, 1e-10);
  }
  EXPECT_EQ(lin.space.states.back(), "integral [s]");
}

// 3 kN at 10 mm and 5 kN at 20 mm, straight between, against a spring of 400 N/mm.
TEST(SignalsAtRest, ATableOverTheStrokeHoldsASpring) {
  const auto folder = std::filesystem::temp_directory_path() / "pintle_signal_table";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "load.csv") << "stroke,load\n0,0\n10,3\n20,5\n";
  const Scene s = read_scene_text(R"yaml(
bodies: {ram: {rigid: {mass: 5 kg, inertia: 0.01}, points: {P: [0, 0]}}}
joints: {guide: {prismatic: [ground, ram]}}
forces:
  press: {force: [{table: load.csv, over: ram.x, over unit: mm, value unit: kN, interpolation: linear}, 0], at: ram.P}
  frame: {spring: [ground, ram.P], law: "400 N/mm*frame.length - 1500 N"}
start: {ram: {x: 14 mm}}
run: {until: 1 s}
)yaml",
                                  "scene.yaml", {}, folder);
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model), 0);
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.state.y[0], 0.0125, 1e-12);  // 3000 + 200 (x − 10) = 400 x − 1500 in mm: x = 12.5
}

// With a leak the integral's rest is 20 s times the error: 11 e + 6·20 e = 0.
TEST(SignalsAtRest, ALeakyIntegralFollowsThePose) {
  const Scene leaky = scene(with(with(servo, "METHOD", "dopri5"), "target - arm.angle,", "target - arm.angle - integral/(20 s),"));
  const Model leaking = build(leaky);
  const Equilibrium held = find_equilibrium(leaky, leaking, assemble(leaky, leaking), 0);
  ASSERT_TRUE(held.found) << held.reason;
  EXPECT_NEAR(held.state.y[2], 0.5, 1e-10);
}

// Without a load all forces vanish at rest, and nothing is left to compare them with.
TEST(SignalsAtRest, AnIntegralWithoutALoadReachesItsTarget) {
  const Scene s = read_scene_text(R"yaml(
parameters: {target: 1 rad}
bodies: {hub: {rigid: {mass: 1 kg, inertia: 0.05}}}
joints: {shaft: {revolute: [ground, hub]}}
states: {u: {rate: target - hub.angle, start: 0 rad s}}
forces: {servo: {torque: '20 N m*(target - hub.angle) + 5 N m/s*u - 6 N m s*hub.speed', on: hub}}
run: {until: 5 s}
)yaml",
                                  "scene.yaml");
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model), 0);
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.state.y[2], 1, 1e-9);
}

class SignalsSaved : public testing::TestWithParam<const char*> {};

TEST_P(SignalsSaved, GoOnFromAnyStepBitForBit) {
  const Scene s = scene(with(servo, "METHOD", GetParam()));
  const Model model = build(s);
  const State start = assemble(s, model).start;
  Integrator run(model.system, model.scheme, start);
  std::vector<std::string> saved;
  for (int i = 0; i < 30; ++i) {
    if (i % 10 == 5) saved.push_back(run.save());
    ASSERT_TRUE(run.advance(50)) << run.failure();
  }
  for (std::size_t k = 0; k < saved.size(); ++k) {
    Integrator next(model.system, model.scheme, start);
    next.load(saved[k]);
    for (std::size_t i = 5 + 10 * k; i < 30; ++i) ASSERT_TRUE(next.advance(50)) << next.failure();
    EXPECT_EQ(next.state().t, run.state().t);
    EXPECT_EQ(next.state().y, run.state().y);
  }
}

// What is written out changes nothing.
TEST_P(SignalsSaved, MoveAlikeHoweverOftenTheyAreWritten) {
  Scene often = scene(with(servo, "METHOD", GetParam()) + "outputs: {power: servo.torque*arm.speed, tip: pivot.fx + arm.tip.x*1 N/m}\n");
  Scene seldom = scene(with(servo, "METHOD", GetParam()));
  often.output.every = 1e-3, seldom.output.every = 0.5;
  const Whole a = pintle_scenes::run(often), b = pintle_scenes::run(seldom);
  EXPECT_EQ(a.column("arm.angle [rad]").back(), b.column("arm.angle [rad]").back());
  EXPECT_EQ(a.column("integral [s]").back(), b.column("integral [s]").back());
}
INSTANTIATE_TEST_SUITE_P(Each, SignalsSaved, testing::Values("dopri5", "verner87", "generalized-alpha"),
                         [](const auto& p) { return p.param[0] == 'g' ? "GeneralizedAlpha" : std::string(p.param); });

std::string refusal_of_force(const std::string& torque) {
  return pintle_test::refusal_by([&] {
    build(scene(with(with(servo, "METHOD", "dopri5"), "11 N m*(target - arm.angle) + 6 N m/s*integral - 6 N m s*arm.speed", torque)));
  });
}

TEST(BadSignals, AreRefusedWithPlaceAndRemedy) {
  using pintle_test::expect_one_line;
  const std::string place = "scene.yaml:8: forces.servo.torque: ";
  expect_one_line(refusal_of_force("1 N m*arm.angel"), place, {"there is no signal \"arm.angel\"", "Did you mean \"arm.angle\"?"});
  expect_one_line(refusal_of_force("1 N m*arm.tp.vx"), place, {"\"arm.tp.vx\"", "arm.tip.vx"});
  expect_one_line(refusal_of_force("2 N*arm.speed"), place, {"expected a torque or energy [N*m]"});
  expect_one_line(refusal_of_force("1 N m + arm.angle"), place, {"+ mixes", "an angle [rad]"});
  expect_one_line(refusal_of_force("1 m*pivot.fx"), place, {"pivot.fx depends on the accelerations", "only outputs"});
  expect_one_line(refusal_of_force("1 N m s^2*arm.alpha"), place, {"arm.alpha", "algebraic feedback"});
  expect_one_line(refusal_of_force("integrl*1 N m/s"), place, {"\"integrl\" is neither", "Did you mean \"integral\"?"});
  expect_one_line(refusal_of_force("saturate(1 N m*arm.angle, 2 N m, 1 N m)"), place, {"lo below hi"});
}

TEST(BadSignals, OutputsInACircleAreNamed) {
  const auto refusal = [](const std::string& outputs) {
    return pintle_test::refusal_by([&] { build(scene(with(servo, "METHOD", "dopri5") + "outputs:\n" + outputs)); });
  };
  pintle_test::expect_one_line(refusal("  a: b*2\n  b: a*3\n"), "scene.yaml:11: outputs.a: ", {"a and b would depend on each other"});
  pintle_test::expect_one_line(refusal("  a: a*2\n"), "scene.yaml:11: outputs.a: ", {"a would depend on itself"});
  pintle_test::expect_one_line(refusal("  integral: arm.angle\n"), "scene.yaml:11: outputs.integral: ", {"state", "a name of its own"});
  pintle_test::expect_one_line(refusal("  a: arm.tip.ax\n"), "scene.yaml:11: outputs.a: ", {"not a column", "output.points"});
  EXPECT_EQ(refusal("  a: arm.alpha\n  b: a*1 kg m^2\n"), "accepted");
  const std::string named = pintle_test::refusal_by(
      [&] { build(scene(with(with(servo, "METHOD", "dopri5"), "6 N m/s*integral", "demand") + "outputs: {demand: 6 N m/s*integral}\n")); });
  pintle_test::expect_one_line(named, "scene.yaml:8: forces.servo.torque: ", {"demand is an output", "write its expression here"});
}

TEST(BadSignals, StatesNeedARateOfTheirUnit) {
  const auto refusal = [](const std::string& state) {
    return pintle_test::refusal_by(
        [&] { build(scene(with(with(servo, "METHOD", "dopri5"), "{rate: target - arm.angle, start: 0 rad s}", state))); });
  };
  pintle_test::expect_one_line(refusal("{rate: arm.tip.vx, start: 0 rad s}"),
                               "scene.yaml:6: states.integral.rate: ", {"a speed [m/s]", "expected a number"});
  pintle_test::expect_one_line(refusal("{start: 0 rad s}"), "scene.yaml:6: states.integral: ", {"lacks", "rate"});
  pintle_test::expect_one_line(refusal("{rate: arm.angle, start: 0 rad s, scale: 0}"),
                               "scene.yaml:6: states.integral.scale: ", {"greater than 0"});
}

// The root of x has no value below 0: the run ends and says which law, when and where.
TEST(BadSignals, ALawWithoutAValueEndsTheRunWithItsName) {
  const Whole w = pintle_scenes::run(R"yaml(
bodies: {cart: {rigid: {mass: 1 kg, inertia: 0.1}, points: {P: [0, 0]}}}
joints: {rail: {prismatic: [ground, cart]}}
forces: {root: {force: ["-1 N*sqrt(cart.x/(1 m))", 0], at: cart.P}}
start: {cart: {x: 0.1 m, vx: -1 m/s}}
run: {until: 1 s, method: dopri5}
)yaml");
  EXPECT_EQ(w.run.status, Status::failed);
  pintle_test::expect_says(w.run.reason, {"\"root\"", "not a finite number", "cart.x = "});
}

}  // namespace
}  // namespace pintle::signal_question_test
