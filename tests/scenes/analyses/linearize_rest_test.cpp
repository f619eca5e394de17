// Small motion about where a mechanism rests, of mechanisms with more joints than they need, and what is refused.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/mechanisms.h"
#include "tests/refusal.h"

namespace pintle_scenes::linearize_rest_test {
namespace {

pintle::Linearization about_rest(const pintle::Scene& scene) {
  const pintle::Model model = build(scene);
  const pintle::Equilibrium rest = find_equilibrium(scene, model, assemble(scene, model));
  EXPECT_TRUE(rest.found) << rest.reason;
  return linearize(scene, model, rest.state, pintle::Laws::hold);
}

pintle::Linearization about_start(const pintle::Scene& scene) {
  const pintle::Model model = build(scene);
  return linearize(scene, model, state_at(model, assemble(scene, model).start, 0));
}
bool says(const pintle::Linearization& lin, const std::string& words) {
  return std::ranges::any_of(lin.notes, [&](const std::string& n) { return n.find(words) != std::string::npos; });
}

TEST(LinearizeAtRest, ReleasedPendulumSwingsAboutWhereItHangs) {
  const pintle::Linearization lin = about_rest(pendulum(Hanging::by_pin, 1.0));
  ASSERT_EQ(lin.modes.size(), 1U);
  EXPECT_NEAR(lin.modes[0].root.imag(), std::sqrt(9.81), 1e-8);  // as the square of the angle that is left
  EXPECT_EQ(lin.coefficients, pintle::Coefficients::constant);
}

// x″ + 20 x′ + 100 x = 0: both roots are −10, and as a double root known to the square root of rounding.
TEST(LinearizeAtRest, ADoubleRootIsDampedAndKnownToHalfTheDigits) {
  const pintle::Linearization lin =
      about_rest(scene_of("bodies: {block: {rigid: {mass: 1, inertia: 1}}}\njoints: {guide: {prismatic: [ground, block]}}\n"
                          "ground: {points: {P: [-1, 0]}}\n"
                          "forces: {coil: {spring: [ground.P, block], stiffness: 100, damping: 20, free length: 1}}\nrun: {until: 1}\n"));
  ASSERT_EQ(lin.modes.size(), 2U);
  for (const pintle::LinearMode& mode : lin.modes) {
    EXPECT_NEAR(std::abs(mode.root), 10, 1e-4);
    EXPECT_LT(mode.uncertainty, 1e-3);
    EXPECT_LE(std::abs(mode.root + 10.0), std::max(mode.uncertainty, 1e-9));
  }
}

// About its pin 0.24 kg m², rubbed by 1 N m s: 0.24 λ² + λ + 2·9.81·0.3 = 0, whatever else is only written down.
TEST(LinearizeAtRest, AStateThatNothingChangesOrThatChangesNothingIsNoMode) {
  const pintle::Linearization lin =
      about_rest(scene_of("gravity: [0, -9.81]\n"
                          "parameters: {load: 0 N m}\n"
                          "bodies: {arm: {rigid: {mass: 2, inertia: 0.06, center: [0.3, 0]}, points: {O: [0, 0]}}}\n"
                          "joints: {pivot: {revolute: [ground, arm.O]}}\n"
                          "states: {heater: {rate: 0, start: 1}, turned: {rate: arm.speed, start: 2 rad}}\n"
                          "forces: {push: {torque: load + 1 N m*(heater - 1), on: arm}, rub: {torque: -1 N m s*arm.speed, on: arm}}\n"
                          "events: {on: {when: arm.speed < -1 rad/s, do: {set: {load: 3 N m}}}}\n"
                          "start: {arm: {angle: -80 deg}}\n"
                          "run: {until: 1}\n"));
  ASSERT_EQ(lin.modes.size(), 1U);
  EXPECT_NEAR(std::abs(lin.modes[0].root - std::complex<double>(-1, std::sqrt(4 * 0.24 * 5.886 - 1)) / 0.48), 0, 1e-7);
  EXPECT_TRUE(says(lin, "\"load\", \"heater\", \"turned\" have no mode"));
  EXPECT_EQ(lin.space.A.rows(), 5);  // the state space keeps them
}

TEST(Linearize, ACounterAddsNoRootToAFreeTurn) {
  const pintle::Scene scene = scene_of(
      "bodies: {wheel: {rigid: {mass: 2, inertia: 0.06}, points: {O: [0, 0]}}}\n"
      "joints: {axle: {revolute: [ground, wheel.O]}}\n"
      "states: {turned: {rate: wheel.speed, start: 0 rad}}\n"
      "run: {until: 1}\n");
  const pintle::Model model = build(scene);
  const pintle::Linearization lin = linearize(scene, model, assemble(scene, model).start);
  ASSERT_EQ(lin.modes.size(), 1U);
  EXPECT_EQ(lin.modes[0].kind, pintle::LinearMode::Kind::zero);
  EXPECT_EQ(lin.modes[0].roots, 2);
}

TEST(LinearizeAtRest, StartThatIsNoEquilibriumIsSaidToBeNone) {
  const pintle::Scene scene = pendulum(Hanging::by_pin, 1.0);
  const pintle::Model model = build(scene);
  const pintle::Linearization lin = linearize(scene, model, assemble(scene, model).start);
  EXPECT_EQ(lin.coefficients, pintle::Coefficients::frozen);
  ASSERT_FALSE(lin.notes.empty());
  EXPECT_NE(lin.notes[0].find("--equilibrium"), std::string::npos) << lin.notes[0];
}

// Under a motor that would turn the guide the bead rests at the end of its spring, as if the guide stood.
TEST(LinearizeAtRest, DriversAndLoadsAreHeld) {
  const pintle::Linearization lin =
      about_rest(scene_of("bodies:\n"
                          "  arm: {rigid: {mass: 1, inertia: 0.2}}\n"
                          "  bead: {rigid: {mass: 0.5, inertia: 0.01}, pose: {at: [0.64, 0]}}\n"
                          "joints: {axle: {revolute: [ground, arm]}, slide: {prismatic: [arm, bead]}}\n"
                          "drivers: {motor: {angle: [ground, arm], law: 3*t}}\n"
                          "forces: {k: {spring: [arm, bead], stiffness: 12.5, free length: 0.6}}\n"
                          "run: {until: 1}\n"));
  ASSERT_EQ(lin.modes.size(), 1U);
  EXPECT_NEAR(lin.modes[0].root.imag(), 5, 1e-8);  // not √(25 − 9)
  EXPECT_EQ(lin.coefficients, pintle::Coefficients::constant);
}

TEST(Linearize, DoorOnTwoHingesSwingsAsOnOne) {
  const auto door = [](const std::string& more) {
    pintle::Scene scene = scene_of(
        "bodies: {door: {rigid: {mass: 3, inertia: 0.4}, points: {A: [-0.5, 0]}, pose: {at: [0.5, 0]}}}\n"
        "joints: {one: {revolute: [ground, door.A]}" +
        more +
        "}\n"
        "forces: {closer: {torsion spring: [ground, door], stiffness: 20, damping: 1}}\n");
    const pintle::Model model = build(scene);
    return linearize(scene, model, assemble(scene, model).start);
  };
  const pintle::Linearization one = door(""), two = door(", two: {revolute: [ground, door.A]}");
  ASSERT_EQ(one.modes.size(), 1U);
  ASSERT_EQ(two.modes.size(), 1U);
  EXPECT_NEAR(std::abs(two.modes[0].root - one.modes[0].root), 0, 1e-10);
  EXPECT_NEAR(one.modes[0].natural(), std::sqrt(20 / 1.15) / (2 * M_PI), 1e-10);
}

TEST(Linearize, RefusesWhatIsTooLargeForDenseMatricesAndSaysWhatToDo) {
  pintle::Scene s;
  s.file = "crowd.yaml";
  for (int i = 0; i <= pintle::most_linearized / 3; ++i) s.bodies.push_back(body("b" + std::to_string(i), 1, 1, {}));
  const pintle::Model model = build(s);
  pintle_test::expect_refused([&] { linearize(s, model, assemble(s, model).start); }, {"1500", "crowd.yaml"});
}

// A pin of mass m pressed by its weight: δ = (m g/k)^(1/n); up and down k n δⁿ⁻¹, sideways m g/|e|, its spin is free.
TEST(LinearizeAtRest, PinAtRestInItsBearingHasTheContactsInstantaneousFrequencies) {
  pintle::Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("O", 0)};
  s.bodies = {body("pin", 0.8, 1e-4, {point("P", 0)})};
  s.joints = {joint("bearing", pintle::JointKind::revolute, "ground.O", "pin.P")};
  s.joints[0].clearance = clearance("ground", 1e-4, 1.0);
  const double k = 2e9, depth = std::pow(0.8 * 9.81 / k, 1 / 1.5), arm = 1e-4 + depth;
  s.joints[0].clearance->normal.stiffness = k;
  s.start_journals = {{"bearing", {0, -arm}, {0, 0}, {}}};
  const pintle::Linearization lin = about_start(s);
  ASSERT_EQ(lin.contacts.size(), 1U);
  EXPECT_TRUE(lin.contacts[0].closed);
  const double stiffness = 1.5 * k * std::sqrt(depth);
  EXPECT_NEAR(lin.contacts[0].stiffness, stiffness, 1e-9 * stiffness);
  ASSERT_EQ(lin.modes.size(), 3U);
  EXPECT_EQ(lin.modes[0].kind, pintle::LinearMode::Kind::zero);
  EXPECT_EQ(lin.modes[0].carrier, "pin.angle");
  const double tolerance = 1e-8;  // the depth is a ten-thousandth of the eccentricity it is the difference of
  EXPECT_NEAR(lin.modes[1].root.imag(), std::sqrt(9.81 / arm), tolerance * lin.modes[1].root.imag());
  EXPECT_NEAR(lin.modes[2].root.imag(), std::sqrt(stiffness / 0.8), tolerance * lin.modes[2].root.imag());
  EXPECT_TRUE(says(lin, "\"bearing\" is closed"));

  s.start_journals = {{"bearing", {0, -0.5e-4}, {0, 0}, {}}};
  const pintle::Linearization open = about_start(s);
  EXPECT_TRUE(says(open, "\"bearing\" is open and adds nothing"));
  for (const pintle::LinearMode& m : open.modes) EXPECT_EQ(m.kind, pintle::LinearMode::Kind::zero);
}

}  // namespace
}  // namespace pintle_scenes::linearize_rest_test
