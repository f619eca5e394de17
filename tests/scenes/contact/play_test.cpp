// Clearance in prismatic, slot and distance joints: against closed forms, a published mechanism, and the joints without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::play_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;
using pintle_test::expect_refused;

constexpr double g = 9.81;

double at(const Whole& w, const std::string& column, double t) {
  const std::vector<double> times = w.column("t [s]"), x = w.column(column);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - t) < 1e-9) return x[i];
  ADD_FAILURE() << "no row at " << t;
  return 0;
}

// The slider-crank of Flores, Leine and Glocker (2010), integrated with three coordinates at 1e-13: free flight until both upper
// corners meet the guide at once.
TEST(Play, SliderCrankComesToItsGuideAsPublished) {
  const Scene scene = [] {
    Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/guide_with_play.yaml");
    s.run.until = 2.8e-3, s.run.tolerance = 1e-12, s.output.every = 1e-4;
    return s;
  }();
  const Whole w = run(scene);
  expect_sound(w);
  const double turn = 2 * std::numbers::pi;
  EXPECT_NEAR(at(w, "crank.angle [rad]", 1e-3) / turn, 0.023251079933, 1e-11);
  EXPECT_NEAR(at(w, "crank.speed [rad/s]", 1e-3), 139.115875790, 2e-9);
  EXPECT_NEAR(at(w, "rod.speed [rad/s]", 1e-3), -68.276294194, 2e-9);
  EXPECT_NEAR(at(w, "slider.y [m]", 1e-3) / 1e-3, 0.077486685, 2e-9);
  EXPECT_NEAR(at(w, "crank.speed [rad/s]", 2e-3), 120.463881714, 2e-9);
  EXPECT_NEAR(at(w, "slider.y [m]", 2e-3) / 1e-3, 0.494395554, 2e-9);
  ASSERT_GE(w.run.impacts.size(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(w.run.impacts[static_cast<std::size_t>(i)].begin, 2.692502752e-3, 1e-12);
  EXPECT_NEAR(at(w, "slider.angle [rad]", 2.6e-3), 0, 1e-12);
}

// A couple turns a block in its guide until two corners lie at opposite walls: L sin φ + h cos φ = h + 2 c, and N presses at each
// with the lever L cos φ − h sin φ.
std::string block(double gap, double round = 0) {
  return "bodies: {block: {rigid: {mass: 1, inertia: 1e-3}}}\n"
         "joints: {guide: {prismatic: [ground, block], clearance: {gap: " +
         number(gap) + ", length: 80 mm, height: 30 mm, " + (round > 0 ? "round: " + number(round) + ", " : "") +
         "normal: {spring-damper: {stiffness: 1e7, damping: 2e3}}}}}\n"
         "forces: {couple: {torque: 2, on: block}}\nrun: {until: 0.5}\noutput: {every: 10 ms}\n";
}
double tilt(double gap) {
  double phi = 2 * gap / 0.08;
  for (int i = 0; i < 50; ++i)
    phi -= (0.08 * std::sin(phi) + 0.03 * std::cos(phi) - 0.03 - 2 * gap) / (0.08 * std::cos(phi) - 0.03 * std::sin(phi));
  return phi;
}
TEST(Play, ABlockTiltsInItsGuide) {
  for (const double gap : {4e-4, 2e-4, 1e-4}) {
    const Whole w = run(block(gap));
    expect_sound(w);
    const double phi = w.last("block.angle [rad]"), lever = 0.08 * std::cos(phi) - 0.03 * std::sin(phi), N = 2 / lever;
    EXPECT_NEAR(phi, tilt(gap) + 2 * N / 1e7 / lever, 1e-7) << gap;
    EXPECT_NEAR(w.last("guide.normal [N]"), 2 * N, 1e-6 * N) << gap;  // two corners
    EXPECT_NEAR(w.last("block.y [m]"), 0, 1e-9) << gap;
  }
}
// As the gap goes to 0 the block comes to the ideal joint, by 2 c/L.
TEST(Play, AGuideTendsToTheIdealJointAsItsGap) {
  const double wide = run(block(1e-3)).last("block.angle [rad]"), half = run(block(5e-4)).last("block.angle [rad]"),
               none = 2 * 2 / 0.08 / 0.08 / 1e7;  // what the contacts give under the couple alone
  EXPECT_NEAR((wide - none) / (half - none), 2, 2e-2);
}
TEST(Play, RoundCornersTouchLater) {
  const double sharp = run(block(4e-4)).last("block.angle [rad]"), round = run(block(4e-4, 5e-3)).last("block.angle [rad]");
  // Arcs in the corners: their centres tilt, (L − 2r) sin φ + (h − 2r) cos φ + 2r = h + 2c
  double phi = sharp;
  for (int i = 0; i < 50; ++i)
    phi -= (0.07 * std::sin(phi) + 0.02 * std::cos(phi) + 0.01 - 0.03 - 8e-4) / (0.07 * std::cos(phi) - 0.02 * std::sin(phi));
  const double lever = 0.07 * std::cos(phi) - 0.02 * std::sin(phi);
  EXPECT_NEAR(round, phi + 2 * 2 / lever / 1e7 / lever, 1e-6);
  EXPECT_GT(round, sharp);
}
// The guide is turned, the block stands across it.
TEST(Play, AGuideMayBeTurned) {
  const Whole w =
      run("bodies: {block: {rigid: {mass: 1, inertia: 1e-3}}}\nground: {points: {G: {at: [0.1, 0.2], angle: 30 deg}}}\n"
          "joints: {guide: {prismatic: [ground.G, block], angle: 90 deg, clearance: {gap: 0.2 mm, length: 80 mm, height: 30 mm, "
          "normal: {spring-damper: {stiffness: 1e7, damping: 2e3}}}}}\n"
          "forces: {push: {force: [0, 50], at: block, follows: false}}\nrun: {until: 0.2}\noutput: {every: 1 ms}\n");
  expect_sound(w);
  const double x = w.last("block.x [m]") - 0.1, y = w.last("block.y [m]") - 0.2;
  const double across = y * std::cos(M_PI / 6) - x * std::sin(M_PI / 6),
               along = x * std::cos(M_PI / 6) + y * std::sin(M_PI / 6) + 0.1 * std::cos(M_PI / 6) + 0.2 * std::sin(M_PI / 6);
  EXPECT_NEAR(across, 2e-4 + 50 * std::cos(M_PI / 6) / 2 / 1e7, 1e-8);
  EXPECT_NEAR(along, 50 * std::sin(M_PI / 6) / 2 * 0.04, 1e-6);
  EXPECT_NEAR(w.last("block.angle [rad]"), 2 * M_PI / 3, 1e-7);
}

// A pin in the slot of a bar that turns is as far from where the ideal joint has it as its gap, seen along the pin's own guide.
std::string yoke(double gap) {
  const std::string play =
      gap > 0 ? ", clearance: {gap: " + number(gap) + ", pin radius: 5 mm, normal: {spring-damper: {stiffness: 1e8, damping: 2e4}}}" : "";
  return "gravity: [0, -9.81]\nbodies:\n  bar: {rigid: {mass: 1, inertia: 1e-2}}\n  pin: {rigid: {mass: 0.5, inertia: 1e-4}}\n"
         "ground: {points: {column: {at: [0.3, 0], angle: 90 deg}}}\n"
         "joints:\n  axle: {revolute: [ground, bar]}\n  guide: {prismatic: [ground.column, pin], angle: -90 deg}\n  slot: {slot: [bar, "
         "pin]" +
         play +
         "}\n"
         "drivers: {motor: {angle: [ground, bar], law: 0.5 rad*sin(2 rad/s*t)}}\nrun: {until: 1.2, tolerance: 1e-9}\noutput: {every: 20 "
         "ms}\n";
}
TEST(Play, APinInASlotIsOffByItsGap) {
  const std::vector<double> ideal = run(yoke(0)).column("pin.y [m]");
  for (const double gap : {1e-3, 1e-4, 1e-5}) {
    const Whole w = run(yoke(gap));
    expect_sound(w);
    const std::vector<double> y = w.column("pin.y [m]"), angle = w.column("bar.angle [rad]"), t = w.column("t [s]");
    for (std::size_t i = 0; i < y.size(); ++i)
      if (t[i] > 0.2) {
        EXPECT_NEAR(y[i], ideal[i] - gap / std::cos(angle[i]), 2e-7 + 1e-3 * gap) << "gap " << gap << ", t = " << t[i];
      }
  }
}
// It flies along the slot and comes back from its round end with the restitution asked for.
TEST(Play, APinReboundsFromTheEndOfItsSlot) {
  const Whole w =
      run("bodies: {pin: {rigid: {mass: 0.5, inertia: 1e-4}}}\n"
          "joints: {slot: {slot: [ground, pin], clearance: {gap: 1 mm, pin radius: 4 mm, travel: 60 mm, "
          "normal: {exact: {restitution: 0.7, stiffness: 1e9}}}}}\n"
          "start: {pin: {vx: 2}}\nrun: {until: 0.04, tolerance: 1e-10}\noutput: {every: 1 ms}\n");
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, 31e-3 / 2, 1e-9);
  EXPECT_NEAR(w.run.impacts[0].separation, 1.4, 1e-6);
  EXPECT_NEAR(w.last("pin.vx [m/s]"), -1.4, 1e-6);
}

// A weight on a rope falls freely until the rope is taut.
TEST(Play, ARopePullsOnlyWhereItIsTaut) {
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {weight: {rigid: {mass: 2, inertia: 1e-3}}}\n"
          "joints: {rope: {distance: [ground, weight], length: 1 m, clearance: {only: pull, normal: {exact: {restitution: 0.5, stiffness: "
          "1e8}}}}}\n"
          "start: {weight: {x: 0, y: -0.4}}\nrun: {until: 0.9, tolerance: 1e-10}\noutput: {every: 1 ms}\n");
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 2u);
  const double taut = std::sqrt(2 * 0.6 / g), fast = std::sqrt(2 * g * 0.6);
  EXPECT_NEAR(w.run.impacts[0].begin, taut, 1e-9);
  EXPECT_NEAR(w.run.impacts[0].approach, fast, 1e-8);
  EXPECT_NEAR(w.run.impacts[0].separation, 0.5 * fast, 5e-3 * fast);  // its weight goes on pulling
  EXPECT_NEAR(w.run.impacts[1].begin - w.run.impacts[0].end, 2 * w.run.impacts[0].separation / g, 1e-7);
}
TEST(Play, APropPushesOnlyWhereItIsShort) {
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {weight: {rigid: {mass: 2, inertia: 1e-3}}}\n"
          "joints: {prop: {distance: [ground, weight], length: 0.3 m, clearance: {only: push, normal: {exact: {restitution: 0.5, "
          "stiffness: 1e8}}}}}\n"
          "start: {weight: {x: 0, y: 0.8}}\nrun: {until: 0.4, tolerance: 1e-10}\noutput: {every: 1 ms}\n");
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, std::sqrt(2 * 0.5 / g), 1e-9);
}
// Between the two ends of its play the end of a rod flies.
TEST(Play, ARodHasPlayAtBothEnds) {
  const Whole w =
      run("bodies: {mass: {rigid: {mass: 1, inertia: 1e-3}}}\n"
          "joints: {rod: {distance: [ground, mass], length: 0.5, clearance: {gap: 2 mm, normal: {hertz: {stiffness: 1e9}}}}}\n"
          "start: {mass: {x: 0.5, y: 0, vx: 0.3}}\nrun: {until: 0.1, tolerance: 1e-10}\noutput: {every: 1 ms}\n");
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 4u);
  EXPECT_NEAR(w.run.impacts[0].begin, 2e-3 / 0.3, 1e-10);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(w.run.impacts[i].begin - w.run.impacts[i - 1].end, 4e-3 / 0.3, 1e-6);
  for (const double x : w.column("mass.x [m]")) EXPECT_NEAR(x, 0.5, 2e-3 + 2e-4);  // v √(m/k) and a little deep
}

TEST(BadPlay, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    std::string joint, key, says;
  };
  const std::string law = "normal: {hertz: {stiffness: 1e9}}";
  for (const Bad& bad : std::vector<Bad>{
           {"prismatic: [ground, a], clearance: {length: 1, height: 1, " + law + "}", "joints.j.clearance", "add for example gap"},
           {"prismatic: [ground, a], clearance: {gap: 0, length: 1, height: 1, " + law + "}", "clearance.gap", "greater than 0"},
           {"prismatic: [ground, a], clearance: {gap: 1 mm, height: 1, " + law + "}", "joints.j.clearance", "add for example length"},
           {"prismatic: [ground, a], clearance: {gap: 1 mm, length: 1, height: 1}", "joints.j.clearance", "add for example normal"},
           {"prismatic: [ground, a], clearance: {gap: 1 mm, length: 1, height: 1, radial: 1 mm, " + law + "}", "clearance.radial",
            "does not belong"},
           {"prismatic: [ground, a], clearance: {gap: 1 mm, length: 1, height: 1, round: 1, " + law + "}", "joints.j.clearance", "round"},
           {"slot: [ground, a], clearance: {gap: 1 mm, " + law + "}", "joints.j.clearance", "add for example pin radius"},
           {"slot: [ground, a], clearance: {gap: 1 mm, pin radius: 5 mm, only: pull, " + law + "}", "clearance.only", "does not belong"},
           {"distance: [ground, a], length: 1, clearance: {" + law + "}", "joints.j.clearance", "gap: 1 mm, or only: pull"},
           {"distance: [ground, a], length: 1, clearance: {gap: 2, " + law + "}", "clearance.gap", "less than the length"},
           {"distance: [ground, a], length: 1, clearance: {only: push, friction: {coulomb: {coefficient: 0.1}}, " + law + "}",
            "clearance.friction", "does not belong"},
           {"weld: [ground, a], clearance: {gap: 1 mm}", "joints.j.clearance", ""},
           {"revolute: [ground, a], clearance: {gap: 1 mm, bearing radius: 1 cm, bearing: a, " + law + "}", "clearance.gap",
            "does not belong"}}) {
    SCOPED_TRACE(bad.joint);
    const std::string text = "bodies: {a: {rigid: {mass: 1, inertia: 1}}}\njoints: {j: {" + bad.joint + "}}\nrun: {until: 1}\n";
    expect_refused([&] { build(read_scene_text(text, "scene.yaml")); }, {bad.key, bad.says});
  }
}

}  // namespace
}  // namespace pintle::play_test
