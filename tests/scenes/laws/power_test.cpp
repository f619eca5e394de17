// Powers by name: what drivers, forces, springs and joints with friction put into the mechanism, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/build/build.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::power_test {
namespace {

using pintle_scenes::Whole;

template <class Exact>
void expect_power(const Whole& w, const Exact& exact, double near, const char* name = "power [W]") {
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const auto t = w.run.trajectory.column("t [s]"), p = w.run.trajectory.column(name);
  ASSERT_GT(t.size(), 10U);
  for (std::size_t i = 0; i < t.size(); ++i) ASSERT_NEAR(p[i], exact(t[i]), near) << t[i];
}

const std::string end = "run: {until: 1 s, method: dopri5, tolerance: 1e-10}\noutput: {every: 20 ms}\n";
const std::string shaft =
    "bodies: {arm: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0], A: [0.5 m, 0]}}}\n"
    "joints: {pin: {revolute: [ground, arm.O]}}\n" +
    end;
const std::string cart =
    "bodies: {cart: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0]}}}\n"
    "ground: {points: {W: [1 m, 0]}}\n" +
    end;

// ω = 2 t
TEST(Power, OfATorque) {
  const std::string motor = shaft + "forces: {motor: {torque: 2 N m, on: arm}}\n";
  expect_power(
      pintle_scenes::run(motor + "outputs: {power: motor.power}\n"), [](double t) { return 4 * t; }, 1e-8);
}
// A driver that turns it so does the same, whichever body it names first.
TEST(Power, OfAnAngleDriver) {
  for (const char* ends : {"[ground, arm], law: 1 rad/s^2*t^2", "[arm, ground], law: -1 rad/s^2*t^2"})
    expect_power(
        pintle_scenes::run(shaft + "drivers: {motor: {angle: " + ends + "}}\noutputs: {power: motor.power}\n"),
        [](double t) { return 4 * t; }, 1e-8);
}
TEST(Power, OfADistanceDriver) {
  for (const char* ends : {"[ground.W, cart.O]", "[cart.O, ground.W]"})
    expect_power(
        pintle_scenes::run(cart + "joints: {rail: {prismatic: [ground, cart]}}\ndrivers: {rod: {distance: " + ends +
                           ", law: 1 m + 1 m/s^2*t^2}}\noutputs: {power: rod.power}\n"),
        [](double t) { return 4 * t; }, 1e-8);
}
// x = 0.1 cos 3t: the pull −9 x times −0.3 sin 3t
TEST(Power, OfASpring) {
  expect_power(
      pintle_scenes::run(cart + "joints: {rail: {prismatic: [ground, cart]}}\n"
                                "forces: {coil: {spring: [ground.W, cart.O], stiffness: 9 N/m, free length: 1 m}}\n"
                                "outputs: {power: coil.power}\nstart: {cart: {x: 0.1 m}}\n"),
      [](double t) { return 9 * 0.1 * std::cos(3 * t) * 0.3 * std::sin(3 * t); }, 1e-7);
}
TEST(Power, OfATorsionSpring) {
  expect_power(
      pintle_scenes::run(shaft + "forces: {coil: {torsion spring: [ground, arm], stiffness: 9 N m/rad}}\n"
                                 "outputs: {power: coil.power}\nstart: {arm: {angle: 0.1 rad}}\n"),
      [](double t) { return 9 * 0.1 * std::cos(3 * t) * 0.3 * std::sin(3 * t); }, 1e-7);
}
// 3 N at v = 3 t
TEST(Power, OfAForceAtAPoint) {
  expect_power(
      pintle_scenes::run(cart + "joints: {rail: {prismatic: [ground, cart]}}\nforces: {push: {force: [3 N, 0], at: cart.O}}\n"
                                "outputs: {power: push.power}\n"),
      [](double t) { return 9 * t; }, 1e-8);
}
// 0.1 of 10 N against v = 5 − t
TEST(Power, OfFrictionInAJointIsLost) {
  expect_power(
      pintle_scenes::run("gravity: [0, -10 m/s^2]\n" + cart +
                         "joints: {rail: {prismatic: [ground, cart], friction: {coulomb: {coefficient: 0.1}, length: 60 mm}}}\n"
                         "outputs: {power: rail.power}\nstart: {cart: {vx: 5 m/s}}\n"),
      [](double t) { return -(5 - t); }, 1e-7);
}
// A disc alone in its hole: what the wall does to it is all that its kinetic energy gets. Trapezoids over the thousand rows and more of a
// contact err by less than (π/1000)² of it.
TEST(Power, OfAClearanceIsWhatTheKineticEnergyGets) {
  const Whole w = pintle_scenes::run(R"yaml(
bodies: {pin: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0]}}}
joints: {hole: {revolute: [ground, pin.O], clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: ground, normal: {hunt-crossley: {stiffness: 1e8, restitution: 0.5}}}}}
start: {hole: {speed: [0.1 m/s, 0]}}
outputs: {power: hole.power}
run: {until: 20 ms, method: dopri5, tolerance: 1e-10}
output: {every: 1 us}
)yaml");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const auto p = w.run.trajectory.column("power [W]"), kinetic = w.run.ledger.column("kinetic [J]");
  double got = 0;
  for (std::size_t i = 1; i < p.size(); ++i) got += (p[i] + p[i - 1]) / 2 * 1e-6;
  EXPECT_LT(kinetic.back(), 0.9 * kinetic.front());
  EXPECT_NEAR(got, kinetic.back() - kinetic.front(), 1e-4 * kinetic.front());
}

TEST(Power, MayStandInAConditionButInNoForce) {
  const std::string motor = shaft + "forces: {motor: {torque: 2 N m, on: arm}";
  const Whole w = pintle_scenes::run(motor + "}\nevents: {strong: {when: motor.power > 2 W, once: true, do: {row: true}}}\n");
  ASSERT_EQ(w.run.happenings.size(), 1U);
  EXPECT_NEAR(w.run.happenings[0].t, 0.5, 1e-8);
  const auto refusal = [](const std::string& text) { return pintle_test::refusal_by([&] { build(read_scene_text(text, "scene.yaml")); }); };
  pintle_test::expect_says(refusal(motor + ", other: {torque: motor.power*1 s, on: arm}}\n"), {"motor.power depends on the accelerations"});
  pintle_test::expect_says(refusal(motor + "}\noutputs: {p: pin.power}\n"), {"pin.power is 0 at all times", "driver, force or spring"});
}

TEST(Power, ColumnsMayBeNamedAsTheTableHasThem) {
  const Whole w = pintle_scenes::run(shaft + "forces: {push: {force: [0, 3 N], at: arm.A}}\noutputs: {a: pin.fy on arm, b: pin.fy}\n");
  EXPECT_EQ(w.run.trajectory.column("a [N]"), w.run.trajectory.column("b [N]"));
}

}  // namespace
}  // namespace pintle::power_test
