// Play that vanishes: slots and guides tend to the ideal joint as their gap, with a stiffness and as rigid bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::play_limit_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;

const std::vector<std::string> laws{"model: impact, restitution: 0", "normal: {spring-damper: {stiffness: 1e8, damping: 2e4}}"};

// ---- a pin in the slot of a bar that turns lies on one side of it -------------------------------

std::string yoke(double gap, const std::string& law) {
  const std::string play = gap > 0 ? ", clearance: {gap: " + number(gap) + ", pin radius: 5 mm, " + law + "}" : "";
  return "gravity: [0, -9.81]\nbodies:\n  bar: {rigid: {mass: 1, inertia: 1e-2}}\n  pin: {rigid: {mass: 0.5, inertia: 1e-4}}\n"
         "ground: {points: {column: {at: [0.3, 0], angle: 90 deg}}}\n"
         "joints:\n  axle: {revolute: [ground, bar]}\n  guide: {prismatic: [ground.column, pin], angle: -90 deg}\n  slot: {slot: [bar, "
         "pin]" +
         play +
         "}\ndrivers: {motor: {angle: [ground, bar], law: 0.5 rad*sin(2 rad/s*t)}}\nrun: {until: 1.2, tolerance: 1e-10}\n"
         "output: {every: 20 ms, frames: 0}\n";
}

TEST(PlayLimit, APinInASlotTendsToTheIdealJointInPlaceAndForce) {
  const Whole ideal = run(yoke(0, ""));
  const std::vector<double> y0 = ideal.column("pin.y [m]"), fx = ideal.column("slot.fx on pin [N]"),
                            fy = ideal.column("slot.fy on pin [N]");
  for (const std::string& law : laws) {
    const bool rigid = law == laws.front();
    const double sinks = rigid ? 0 : 2 * 0.5 * 9.81 / 1e8;  // under twice the pin's weight at the most
    double before = 0;
    for (const double gap : {1e-2, 1e-3, 1e-4}) {
      SCOPED_TRACE(law + ", " + number(gap));
      const Whole w = run(yoke(gap, law));
      expect_sound(w);
      const std::vector<double> y = w.column("pin.y [m]"), N = w.column("slot.normal [N]"), angle = w.column("bar.angle [rad]"),
                                t = w.column("t [s]");
      double off = 0;
      for (std::size_t i = 0; i < y.size(); ++i) {
        if (t[i] < 0.3) continue;
        EXPECT_NEAR(y[i], y0[i] - gap / std::cos(angle[i]), 1e-9 + 2 * sinks) << t[i];
        off = std::max(off, std::abs(N[i] - std::hypot(fx[i], fy[i])));
      }
      if (before > 0) {
        EXPECT_NEAR(before / off, 10, 1) << off;
      }
      before = off;
    }
  }
}

// ---- a block tilts in its guide until two of its corners bear the couple -------------------------

TEST(PlayLimit, ATiltedBlockTendsToTheIdealGuideInAngleAndCouple) {
  constexpr double L = 0.08, h = 0.03, couple = 2;
  for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Whole w = run(
        "bodies: {block: {rigid: {mass: 1, inertia: 1e-3}}}\njoints: {guide: {prismatic: [ground, block], clearance: {gap: " + number(gap) +
        ", length: 80 mm, height: 30 mm, model: impact, restitution: 0.3}}}\nforces: {couple: {torque: 2, on: block}}\n"
        "run: {until: 0.5}\noutput: {every: 10 ms, frames: 0}\n");
    expect_sound(w);
    double phi = 2 * gap / L;  // L sin φ + h cos φ = h + 2 c
    for (int i = 0; i < 50; ++i) phi -= (L * std::sin(phi) + h * std::cos(phi) - h - 2 * gap) / (L * std::cos(phi) - h * std::sin(phi));
    EXPECT_NEAR(w.last("block.angle [rad]"), phi, 1e-12) << gap;
    EXPECT_NEAR(phi / (2 * gap / L), 1, 2 * gap / L) << gap;
    const double lever = L * std::cos(phi) - h * std::sin(phi);
    EXPECT_NEAR(w.last("guide.normal [N]") / 2 * lever, couple, 1e-10 * couple) << gap;  // two corners
  }
}

// ---- a slider-crank whose slider has play is nowhere farther from the ideal one than its gap lets it --------

std::string slider_crank(double gap, const std::string& law) {
  const std::string play = gap > 0 ? ", clearance: {gap: " + number(gap) + ", length: 40 mm, height: 20 mm, " + law + "}" : "";
  return "gravity: [0, -9.81]\nbodies:\n  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {A: [50 mm, 0]}}\n"
         "  rod: {rigid: {mass: 0.2, inertia: 4e-4, center: [60 mm, 0]}, points: {B: [120 mm, 0]}}\n"
         "  slider: {rigid: {mass: 0.4, inertia: 1e-4}}\n"
         "joints:\n  axle: {revolute: [ground, crank]}\n  big end: {revolute: [crank.A, rod]}\n  small end: {revolute: [rod.B, slider]}\n"
         "  guide: {prismatic: [ground, slider]" +
         play +
         "}\ndrivers: {motor: {angle: [ground, crank], law: 0.6 rad + 20 rad/s*t}}\nrun: {until: 0.4, tolerance: 1e-9}\n"
         "output: {every: 2 ms, frames: 0}\n";
}

TEST(PlayLimit, ASliderWithPlayStaysWithinItsGapOfTheIdealOne) {
  const std::vector<double> x0 = run(slider_crank(0, "")).column("slider.x [m]");
  const auto lets = [](double y) { return std::sqrt(0.12 * 0.12 - 0.05 * 0.05) - std::sqrt(0.12 * 0.12 - std::pow(0.05 + y, 2)); };
  for (const std::string& law :
       {std::string("model: impact, restitution: 0.4"), std::string("normal: {exact: {restitution: 0.4, stiffness: 1e10}}")})
    for (const double gap : {1e-3, 1e-4, 1e-5}) {
      SCOPED_TRACE(law + ", " + number(gap));
      const Whole w = run(slider_crank(gap, law));
      expect_sound(w);
      double deepest = 0, farthest = 0;
      for (const Impact& i : w.run.impacts) deepest = std::max(deepest, i.deepest);
      EXPECT_GT(w.run.impacts.size(), 3u);
      const std::vector<double> x = w.column("slider.x [m]"), y = w.column("slider.y [m]");
      for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_LE(std::abs(y[i]), gap + deepest + 1e-12) << i;
        farthest = std::max(farthest, std::abs(x[i] - x0[i]));
      }
      EXPECT_LT(farthest, lets(gap + deepest) + 1e-9);  // the crank across, the slider at the other wall
      EXPECT_GT(farthest, 0.3 * lets(gap));
    }
}

}  // namespace
}  // namespace pintle::play_limit_test
