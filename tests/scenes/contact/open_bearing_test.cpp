// Bearings that are an arc: against closed forms, and against the whole bearing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::open_bearing_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;
using pintle_test::expect_refused;

constexpr double g = 9.81, R = 10e-3, c = 1e-3, pin = R - c, wall = 4e-3;  // [m/s²], [m]
const std::string soft = "model: spring-damper, stiffness: 1e7, damping: 1e3";

/// A pin of 1 kg in a hook of the ground that is open above.
std::string hook(const std::string& laws, const std::string& start, const std::string& more = "", double radial = c,
                 const std::string& arc = "middle: -90 deg, extent: 180 deg, wall: 4 mm") {
  return "gravity: [0, -9.81]\nbodies: {pin: {rigid: {mass: 1, inertia: 1e-4}}}\n"
         "joints: {hook: {revolute: [ground, pin], clearance: {radial: " +
         number(radial) + ", bearing radius: 10 mm, bearing: ground, arc: {" + arc + "}, " + laws + "}}}\nstart: {pin: {" + start + "}}\n" +
         more;
}
std::string until(double t) { return "run: {until: " + number(t) + ", tolerance: 1e-11, method: verner87}\noutput: {every: 1 ms}\n"; }
const std::string lossy = "normal: {exact: {restitution: 0.7, stiffness: 1e14}}";

// The same numbers, whatever way they are found: bearing on a body that turns, friction, an impact.
TEST(OpenBearing, OfAFullTurnIsTheWholeBearing) {
  const auto scene = [](const std::string& arc) {
    return "gravity: [0, -9.81]\nbodies:\n  arm: {rigid: {mass: 2, inertia: 1e-2}, points: {B: {at: [0.1, 0], angle: 20 deg}}}\n"
           "  rod: {rigid: {mass: 1, inertia: 1e-3, center: [50 mm, 0]}, points: {A: [0, 0]}}\n"
           "joints:\n  axle: {revolute: [ground, arm]}\n  bush: {revolute: [rod.A, arm.B], clearance: {radial: 0.2 mm, bearing radius: "
           "10 mm, bearing: arm, " +
           arc +
           "normal: {lankarani-nikravesh: {restitution: 0.8, stiffness: 1e9}}, friction: {ambrosio: {coefficient: 0.1}}}}\n"
           "start: {arm: {angle: 0}, rod: {angle: -0.3}}\nrun: {until: 7 ms, tolerance: 1e-12, method: verner87}\noutput: {every: 0.1 "
           "ms}\n";
  };
  const Whole whole = run(scene("")), open = run(scene("arc: {middle: 30 deg, extent: 360 deg}, "));
  expect_sound(open);
  ASSERT_EQ(open.run.impacts.size(), whole.run.impacts.size());
  ASSERT_GE(whole.run.impacts.size(), 1u);
  using Group = std::vector<std::string>;  // of one kind of number, the largest of which rounding is measured by
  for (const Group& group : {Group{"bush.ex [m]", "bush.ey [m]", "bush.depth [m]"}, Group{"bush.rate [m/s]", "bush.sliding [m/s]"},
                             Group{"bush.normal [N]", "bush.friction [N]", "bush.fx on arm [N]", "bush.fy on arm [N]"},
                             Group{"rod.angle [rad]"}, Group{"arm.speed [rad/s]"}}) {
    double most = 0, off = 0;
    for (const std::string& column : group) {
      const std::vector<double> a = whole.column(column), b = open.column(column);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k])), off = std::max(off, std::abs(a[k] - b[k]));
    }
    EXPECT_LE(off, 1e-10 * most) << group[0];
  }
}

// Pressed sideways by F a pin of weight W lies where the wall's normal is along both, at atan(F/W) from below: in an arc of 60° to
// either side up to F = √3 W. The force grows over many of the pin's swings, of √(c/g).
std::string pulled(double part) {
  const double F = part * std::sqrt(3) * g;
  return hook(soft, "x: 0, y: -0.1 mm",
              "forces: {pull: {force: [\"" + number(F) +
                  " N*(1 - exp(-(t/(0.3 s))*(t/(0.3 s))))\", 0], at: pin}}\n"
                  "run: {until: 2, tolerance: 1e-8}\noutput: {every: 5 ms}\n",
              1e-4, "middle: -90 deg, extent: 120 deg, wall: 4 mm");
}
TEST(OpenBearing, AHookHoldsUpToTheAngleOfItsEnd) {
  const Whole held = run(pulled(0.98));
  expect_sound(held);
  const double ex = held.last("hook.ex [m]"), ey = held.last("hook.ey [m]");
  const double swing = 2 * 0.98 * std::sqrt(3) / (0.3 * 0.3) / (g / 1e-4);  // that the onset of the force leaves, φ̈/(g/c) [rad]
  EXPECT_NEAR(ex / -ey, 0.98 * std::sqrt(3), 4 * swing);                    // 1 + tan²φ
  EXPECT_NEAR(held.last("hook.normal [N]"), std::hypot(g, 0.98 * std::sqrt(3) * g), 1e-2);
  EXPECT_NEAR(std::hypot(ex, ey), 1e-4 + std::hypot(g, 0.98 * std::sqrt(3) * g) / 1e7, 1e-8);
  const Whole gone = run(pulled(1.02));
  expect_sound(gone);
  EXPECT_GT(std::hypot(gone.last("hook.ex [m]"), gone.last("hook.ey [m]")), 3 * R);
}

TEST(OpenBearing, APinFliesOutOfTheMouth) {
  const Whole w = run(hook(lossy, "x: 0, y: 0, vx: 0.1, vy: 2", until(0.1)));
  expect_sound(w);
  EXPECT_TRUE(w.run.impacts.empty());
  EXPECT_NEAR(w.last("pin.x [m]"), 0.01, 1e-10);
  EXPECT_NEAR(w.last("pin.y [m]"), 0.2 - g * 0.01 / 2, 1e-10);
  EXPECT_NEAR(w.last("hook.ey [m]"), 0.2 - g * 0.01 / 2, 1e-10);
  EXPECT_LT(w.last("hook.depth [m]"), 0);
}
TEST(OpenBearing, APinComesBackThroughTheMouth) {
  const Whole w = run(hook(lossy, "x: 0, y: 0, vy: 1", until(0.21)));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, (1 + std::sqrt(1 + 2 * g * c)) / g, 1e-9);
  EXPECT_NEAR(w.run.impacts[0].approach, std::sqrt(1 + 2 * g * c), 1e-8);
}

// It falls on an end of the hook, a corner or an edge of radius r whose middle lies at (√((R + r)² − r²), −r) or, outside,
// (√((R + w − r)² − r²), −r); or on the face between them.
struct Fall {
  double x, r;
};
void expect_rebound(const Fall& fall, const std::string& laws, double near) {
  SCOPED_TRACE("x " + number(fall.x) + ", r " + number(fall.r));
  const double r = fall.r, inner = std::sqrt(R * R + 2 * R * r), rho = R + wall - r, outer = std::sqrt(rho * rho - r * r);
  double nx = 0, ny = 1, y = pin;
  if (const double middle = fall.x < inner ? inner : outer; fall.x < inner || fall.x > outer) {
    nx = (fall.x - middle) / (pin + r), ny = std::sqrt(1 - nx * nx), y = ny * (pin + r) - r;
  }
  const double v = std::sqrt(2 * g * (0.05 - y)), t = v / g, off = 1.7 * v * ny;
  const std::string edge = r > 0 ? ", edge: " + number(r) : "";
  const Whole w =
      run(hook(laws, "x: " + number(fall.x) + ", y: 50 mm", until(t + 0.01), c, "middle: -90 deg, extent: 180 deg, wall: 4 mm" + edge));
  expect_sound(w);
  ASSERT_EQ(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, t, 1e-9);
  EXPECT_NEAR(w.run.impacts[0].approach, v * ny, 1e-8);
  EXPECT_NEAR(w.last("pin.vx [m/s]"), off * nx, near);
  EXPECT_NEAR(w.last("pin.vy [m/s]"), -v + off * ny - g * 0.01, near);
}
TEST(OpenBearing, APinReboundsFromTheEnds) {
  for (const Fall& fall : {Fall{6e-3, 0}, Fall{12e-3, 0}, Fall{17e-3, 0}, Fall{6e-3, 1e-3}, Fall{12e-3, 1e-3}, Fall{18e-3, 1e-3},
                           Fall{6e-3, 2e-3}, Fall{17e-3, 2e-3}, Fall{-6e-3 + 23e-3, 1.5e-3}}) {
    expect_rebound(fall, "model: impact, restitution: 0.7", 1e-9);
    expect_rebound(fall, lossy, 2e-3);  // gravity goes on, and the pin turns about what it touches: g and v²/R while it is pressed
  }
}

TEST(OpenBearing, APinReboundsFromOutsideTheWall) {
  const Whole w = run(hook("model: impact, restitution: 0.7", "x: 0, y: -0.1, vy: 2", until(0.06)));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 1u);
  const double way = 0.1 - (R + wall + pin), t = (2 - std::sqrt(4 - 2 * g * way)) / g;
  EXPECT_NEAR(w.run.impacts[0].begin, t, 1e-9);
  EXPECT_NEAR(w.run.impacts[0].approach, 2 - g * t, 1e-8);
}

// The arc is turned with the direction of its point and the body.
TEST(OpenBearing, TurnsWithItsBody) {
  const Whole w = run(
      "bodies: {pin: {rigid: {mass: 1, inertia: 1e-4}}}\nground: {points: {H: {at: [0.2, 0.1], angle: 120 deg}}}\n"
      "joints: {hook: {revolute: [ground.H, pin], clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: ground, arc: {middle: 60 deg, "
      "extent: 180 deg, wall: 4 mm}, model: impact, restitution: 0.5}}}\n"  // its middle at 180°: open to the right
      "start: {pin: {x: 0.2, y: 0.1, vx: 1}}\nrun: {until: 0.1}\n");
  expect_sound(w);
  EXPECT_TRUE(w.run.impacts.empty());
  EXPECT_NEAR(w.last("pin.x [m]"), 0.3, 1e-9);
}

TEST(OpenBearing, FilledInReadsBackToItself) {
  const Scene s = read_scene_text(hook(lossy, "x: 0, y: 0", until(1), c, "middle: 1, extent: 2, wall: 4 mm, edge: 1 mm"), "scene.yaml");
  ASSERT_TRUE(is_open(s.joints[0]));
  EXPECT_EQ(s.joints[0].clearance->arc->edge, 1e-3);
  EXPECT_EQ(read_scene_text(s.filled_in, "again").filled_in, s.filled_in);
}

TEST(BadOpenBearing, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    std::string arc, more, key, says;
  };
  for (const Bad& bad :
       std::vector<Bad>{{"extent: 180 deg, wall: 4 mm", lossy, "clearance.arc", "add for example middle"},
                        {"middle: 0, wall: 4 mm", lossy, "clearance.arc", "add for example extent"},
                        {"middle: 0, extent: 180 deg", lossy, "clearance.arc", "add for example wall: 4 mm"},
                        {"middle: 0, extent: 400 deg, wall: 4 mm", lossy, "arc.extent", "360 deg"},
                        {"middle: 0, extent: 0, wall: 4 mm", lossy, "arc.extent", "greater than 0"},
                        {"middle: 0, extent: 1 mm, wall: 4 mm", lossy, "arc.extent", "angle"},
                        {"middle: 0, extent: 180 deg, wall: 4 mm, edge: 3 mm", lossy, "arc.edge", "half of wall"},
                        {"middle: 0, extent: 5 deg, wall: 4 mm, edge: 1 mm", lossy, "joints.hook.clearance", "edges cover the whole arc"},
                        {"middle: 0, extent: 180 deg, wall: 4 mm", "model: massless link", "clearance.arc", "massless link"},
                        {"middle: 0, extent: 180 deg, wall: 4 mm", "model: spring-damper, " + lossy, "joints.hook.clearance",
                         "both stiffness and damping"}}) {
    SCOPED_TRACE(bad.arc);
    expect_refused([&] { build(read_scene_text(hook(bad.more, "x: 0", until(1), c, bad.arc), "scene.yaml")); }, {bad.key, bad.says});
  }
  std::string eccentric = hook(lossy, "x: 0", until(1));
  eccentric.replace(eccentric.find("start: {pin: {x: 0}}"), 20, "start: {hook: {eccentricity: [0, 1 mm]}}");
  expect_refused([&] { read_scene_text(eccentric, "scene.yaml"); }, {"start.hook", "starts where its bodies are"});
}

TEST(OpenBearing, ExampleLetsGoWhereItSays) {
  const Whole w = run(read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/release_hook.yaml"));
  expect_sound(w);
  const std::vector<double> t = w.column("t [s]"), ex = w.column("jaw.ex [m]"), ey = w.column("jaw.ey [m]");
  std::size_t gone = 0;
  while (gone < t.size() && std::hypot(ex[gone], ey[gone]) < 2e-3) ++gone;
  ASSERT_LT(gone, t.size());
  EXPECT_GT(t[gone], 2.0);
  EXPECT_LT(t[gone], 2.1);
}

TEST(OpenBearing, TakesASpringAndDamperOfItsOwn) {
  const Whole w = run(hook("model: spring-damper, stiffness: 1e7, damping: 1e3", "x: 0, y: -1 mm", until(0.2)));
  expect_sound(w);
  EXPECT_NEAR(w.last("hook.depth [m]"), g / 1e7, 1e-11);
}

}  // namespace
}  // namespace pintle::open_bearing_test
