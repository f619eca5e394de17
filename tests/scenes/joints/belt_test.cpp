// Elastic belts against closed forms: docs/theory/gears.md.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::belt_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number, pintle_scenes::run,
    pintle_scenes::Whole;
using pintle_test::expect_refused;

// examples/belt_drive.yaml
constexpr double r1 = 0.04, r2 = 0.08, J1 = 1e-3, J2 = 5e-3, apart = 0.3, EA = 20e3;
double span_stiffness(double across) { return EA / std::sqrt(apart * apart - across * across); }

// The twist x = r₂φ₂ − r₁φ₁ swings by ω² = 2k (r₁²/J₁ + r₂²/J₂); of a crossed belt the radius has the other sign.
TEST(BeltDrive, SwingsInItsTwist) {
  const std::vector<Method> methods{{"dopri5", "dopri5", 1e-11, 1e-7}, {"alpha", "generalized-alpha", 1e-10, 1e-4}};
  for (const bool crossed : {false, true})
    for (const Method& method : methods) {
      const Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/belt_drive.yaml", {{"forces.belt.crossed", crossed ? "true" : "false"}});
      const Whole w = run(s, method);
      expect_sound(w);
      const double sign = crossed ? -1 : 1, k = span_stiffness(r2 - sign * r1);
      const double rate = std::sqrt(2 * k * (r1 * r1 / J1 + r2 * r2 / J2)), most = r2 * 3 / rate;
      const auto t = w.column("t [s]"), motor = w.column("motor.angle [rad]"), drum = w.column("drum.angle [rad]"),
                 tight = w.column("belt 1.tension [N]"), loose = w.column("belt 2.tension [N]");
      for (std::size_t i = 0; i < t.size(); ++i) {
        const double x = most * std::sin(rate * t[i]);
        EXPECT_NEAR(r2 * drum[i] - sign * r1 * motor[i], x, most * method.near);
        EXPECT_NEAR(tight[i], 200 + sign * k * x, k * most * method.near);
        EXPECT_NEAR(loose[i], 200 - sign * k * x, k * most * method.near);
      }
    }
}

TEST(BeltDrive, HasItsFrequencyWhereItIsLinearized) {
  const Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/belt_drive.yaml");
  const Model model = build(s);
  State start = assemble(s, model).start;
  start.y.segment(model.system.n(), model.system.n()).setZero();
  double found = 0;
  for (const LinearMode& mode : linearize(s, model, start).modes) found = std::max(found, mode.root.imag());
  const double rate = std::sqrt(2 * span_stiffness(r2 - r1) * (r1 * r1 / J1 + r2 * r2 / J2));
  EXPECT_NEAR(found, rate, 1e-7 * rate);
}

// Without pretension one span or the other is slack, and pulls not at all; with damping the books close too.
TEST(BeltDrive, PullsOnly) {
  const Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/belt_drive.yaml",
                             {{"forces.belt.pretension", "0 N"}, {"forces.belt.damping", "2 N s"}, {"run.until", "20 ms"}});
  const Whole w = run(s);
  expect_sound(w);
  const auto one = w.column("belt 1.tension [N]"), two = w.column("belt 2.tension [N]");
  double most = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(std::min(one[i], two[i]), 0);
    most = std::max({most, one[i], two[i]});
  }
  // One span after the other swings alone: ω² = k (r₁²/J₁ + r₂²/J₂), damped by ζ = 0.022 over a quarter of a period.
  const double k = span_stiffness(r2 - r1), rate = std::sqrt(k * (r1 * r1 / J1 + r2 * r2 / J2)), undamped = k * r2 * 3 / rate;
  EXPECT_NEAR(most, undamped, 0.05 * undamped);
  EXPECT_GT(w.ledger("belt 1.lost to damper [J]"), 0);
}

// A tensioner's pulley slides away from the other under a force: at rest each span carries F / (2 cos β), sin β = (r₂ − r₁)/L, and the
// centres have come apart by what stretches both spans so. Heavily damped by the guide's damper.
TEST(BeltDrive, IsHeldTautByATensioner) {
  constexpr double F = 500, L0 = 0.3;
  const Whole w =
      run("ground: {points: {D: [0.3, 0]}}\nbodies:\n  motor: {rigid: {mass: 1, inertia: 1e-3}}\n"
          "  drum: {pose: {at: [0.3, 0]}, rigid: {mass: 1, inertia: 5e-3}}\njoints:\n  bearing: {revolute: [ground, motor]}\n"
          "  guide: {slot: [ground, drum]}\nforces:\n  belt: {belt: [motor, drum], radii: [0.04, 0.08], stiffness: 20 kN}\n"
          "  pull: {force: [500, 0], at: drum}\n  damper: {spring: [ground, drum], damping: 600}\n"
          "run: {until: 0.6, tolerance: 1e-10}\noutput: {frames: 0, every: 0.1}\n");
  expect_sound(w);
  const double L = w.last("drum.x [m]"), delta = 0.04, k = span_stiffness(delta), l = std::sqrt(L * L - delta * delta),
               l0 = std::sqrt(L0 * L0 - delta * delta), cosine = l / L;
  EXPECT_NEAR(2 * w.last("belt 1.tension [N]") * cosine, F, 1e-5 * F);
  EXPECT_NEAR(w.last("belt 1.tension [N]"), w.last("belt 2.tension [N]"), 1e-6);
  // A span's own length and what the turned tangents unwind: de = cos β dL, integrated.
  const double wound = delta * (std::asin(delta / L) - std::asin(delta / L0));
  EXPECT_NEAR(w.last("belt 1.tension [N]"), k * (l - l0 + wound), 1e-5 * F);
}

// Round three pulleys, one on the back: turned by hand without slip all go as their radii, and the belt is not stretched.
TEST(BeltDrive, GoesRoundManyPulleys) {
  const Whole w =
      run("ground: {points: {B: [0.4, 0], C: [0.2, 0.12]}}\nbodies:\n  a: {rigid: {mass: 1, inertia: 1e-3}}\n"
          "  b: {pose: {at: [0.4, 0]}, rigid: {mass: 1, inertia: 1e-3}}\n  c: {pose: {at: [0.2, 0.12]}, rigid: {mass: 1, inertia: 1e-3}}\n"
          "joints:\n  A: {revolute: [ground, a]}\n  B: {revolute: [ground.B, b]}\n  C: {revolute: [ground.C, c]}\n"
          "forces:\n  belt: {belt: [a, b, c], radii: [0.05, 0.08, -0.03], stiffness: 20 kN, pretension: 100 N}\n"
          "drivers:\n  one: {angle: [ground, a], law: 20*t}\n  two: {angle: [ground, b], law: 20*t*0.05/0.08}\n  three: {angle: [ground, "
          "c], law: -20*t*0.05/0.03}\n"
          "run: {until: 1}\noutput: {frames: 0, every: 0.1}\n");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  for (const std::string span : {"1", "2", "3"})
    for (const double tension : w.column("belt " + span + ".tension [N]")) EXPECT_NEAR(tension, 100, 1e-6);
}

TEST(BeltInput, IsRefusedWithTheRemedy) {
  const auto refused = [](const std::string& belt, const std::vector<std::string>& parts) {
    expect_refused([&] { build(read_scene(PINTLE_SOURCE_DIR "/examples/belt_drive.yaml", {{"forces.belt", belt}})); }, parts);
  };
  refused("{belt: [motor, drum], radii: [0.1, 0.25], stiffness: 20 kN, crossed: true}", {"forces.belt", "300 mm apart", "350 mm"});
  refused("{belt: [motor, drum], radii: [0.1, 0.25], stiffness: 20 kN}", {"forces.belt", "300 mm apart", "350 mm"});
  refused("{belt: [motor, drum], radii: [0.1, -0.1], stiffness: 20 kN, crossed: true}", {"forces.belt.radii", "leave out crossed"});
  refused("{belt: [motor, drum], radii: [0.1], stiffness: 20 kN}", {"forces.belt.radii", "each of the 2 pulleys"});
  refused("{belt: [motor, drum], radii: [0.1, 0], stiffness: 20 kN}", {"must not be 0"});
  refused("{belt: [motor, drum], radii: [0.1, 0.1]}", {"stiffness"});
  refused("{belt: [motor, motor], radii: [0.1, 0.1], stiffness: 1 kN}", {"both ends are on \"motor\""});
}

}  // namespace
}  // namespace pintle::belt_test
