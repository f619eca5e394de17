// Cams, screws, linear relations and lengths that begin as they are drawn, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/build/build.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::relation_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;
using pintle_test::expect_refused;
namespace fs = std::filesystem;

constexpr double g = 9.81;
const std::vector<Method> methods{{"dopri5", "dopri5", 1e-10, 1e-8}, {"alpha", "generalized-alpha", 1e-9, 1e-5}};

// ---- cams ----

struct Lift {
  double y, slope, bend;
};
Lift sine_to_the_fourth(double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  if (s < 0) return {0, 0, 0};
  return {8e-3 * std::pow(s, 4), 8e-3 * 4 * s * s * s * c, 8e-3 * (12 * s * s * c * c - 4 * std::pow(s, 4))};
}

// examples/cam_valve_train.yaml: place, acceleration and the cam's force at every instant, by integration, by algebra, and on whole turns.
TEST(Cam, LiftsItsValve) {
  const Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/cam_valve_train.yaml");
  const Model model = build(s);
  const Whole integrated = run(s);
  expect_sound(integrated);
  const Inverse by_algebra = inverse(s, model, assemble(s, model));
  ASSERT_TRUE(by_algebra.by_algebra);
  for (const Table* table : {&integrated.run.trajectory, &by_algebra.run.trajectory}) {
    const auto t = table->column("t [s]"), y = table->column("valve.y [m]"), a = table->column("valve.ay [m/s^2]"),
               force = table->column("lobe.force [N]"), torque = table->column("camshaft.torque on cam [N m]");
    double most = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const Lift l = sine_to_the_fourth(300 * t[i]);
      const double acceleration = 300 * 300 * l.bend, push = 0.1 * acceleration + 40e3 * (0.02 + l.y);
      EXPECT_NEAR(y[i], 0.05 + l.y, 1e-10);
      EXPECT_NEAR(a[i], acceleration, 1e-4);  // of some 1e3 m/s², by times good to 1e-8
      EXPECT_NEAR(force[i], push, 1e-4);
      EXPECT_NEAR(torque[i], push * l.slope, 1e-5);
      most = std::max(most, l.y);
    }
    EXPECT_NEAR(most, 8e-3, 1e-5);
  }
}

// A table over a whole turn goes on and on; a spline through n points of a sine is off by 5/384 h⁴ of its fourth derivative or so.
TEST(Cam, FollowsATableRoundAndRound) {
  const fs::path folder = fs::path(testing::TempDir()) / "pintle_cam";
  fs::create_directories(folder);
  constexpr int n = 90;
  std::ofstream file(folder / "cam.csv");
  file.precision(17);
  for (int i = 0; i <= n; ++i) file << 360.0 * i / n << " " << 5 * std::sin(2 * M_PI * (i % n) / n) << "\n";
  file.close();
  const Scene s = pintle::read_scene_text(
      "bodies:\n  cam: {rigid: {mass: 1, inertia: 1e-3}}\n  rocker: {rigid: {mass: 1, inertia: 1e-3}, pose: {at: [0.1, 0], angle: 0.2}}\n"
      "ground: {points: {R: [0.1, 0]}}\njoints:\n  A: {revolute: [ground, cam]}\n  B: {revolute: [ground.R, rocker]}\n"
      "  lobe: {cam: [cam, rocker], swing: {table: cam.csv, angle unit: deg, value unit: deg}}\n"
      "drivers: {motor: {angle: [ground, cam], law: -1 + 40*t}}\nrun: {until: 1}\noutput: {frames: 0, every: 0.01}\n",
      "s.yaml", {}, folder);
  const Model model = build(s);
  const pintle::Run moved = kinematics(s, model, assemble(s, model));
  ASSERT_EQ(moved.status, Status::finished) << moved.reason;
  const auto cam = moved.trajectory.column("cam.angle [rad]"), rocker = moved.trajectory.column("rocker.angle [rad]"),
             alpha = moved.trajectory.column("rocker.alpha [rad/s^2]");
  const double swing = 5 * M_PI / 180, h = 2 * M_PI / n;
  for (std::size_t i = 0; i < cam.size(); ++i) {
    EXPECT_NEAR(rocker[i], 0.2 + swing * (std::sin(cam[i]) - std::sin(-1)), 2 * swing * 5.0 / 384 * std::pow(h, 4));
    EXPECT_NEAR(alpha[i], -1600 * swing * std::sin(cam[i]), 1600 * swing * h * h);
  }
  EXPECT_GT(cam.back(), 6 * M_PI);
  fs::remove_all(folder);
}

TEST(Cam, InputIsRefusedWithTheRemedy) {
  const fs::path folder = fs::path(testing::TempDir()) / "pintle_bad_cam";
  fs::create_directories(folder);
  std::ofstream(folder / "open.csv") << "0 0\n90 1\n360 2\n";
  std::ofstream(folder / "part.csv") << "30 0\n60 1\n90 2\n";
  const auto text = [](const std::string& lobe) {
    return "bodies:\n  cam: {rigid: {mass: 1, inertia: 1e-3}}\n  valve: {rigid: {mass: 1, inertia: 1e-3}}\njoints:\n"
           "  A: {revolute: [ground, cam]}\n  G: {prismatic: [ground, valve]}\n  lobe: " +
           lobe + "\ndrivers: {motor: {angle: [ground, cam], law: 4*t}}\nrun: {until: 1}\noutput: {frames: 0}\n";
  };
  const auto refused = [&](const std::string& lobe, const std::vector<std::string>& parts) {
    expect_refused([&] { build(pintle::read_scene_text(text(lobe), "s.yaml", {}, folder)); }, parts);
  };
  refused("{cam: [cam, valve], lift: {table: open.csv, angle unit: deg, value unit: mm}}",
          {"s.yaml:7", "joints.lobe.lift", "open.csv", "full turn"});
  refused("{cam: [cam, valve], lift: {table: part.csv, angle unit: deg, value unit: mm}}", {"joints.lobe", "does not cover", "0 deg"});
  refused("{cam: [cam, valve], lift: 5 deg*sin(angle)}", {"joints.lobe.lift", "expected a length"});
  refused("{cam: [cam, valve], lift: 5 mm*sin(angel)}", {"angel", "angle"});
  for (const char* curve : {"5 mm*abs(sin(angle))", "5 mm*abs(angle)", "5 mm*max(angle, 0)", "5 mm*abs(angle - 2*pi)",
                            "5 mm*abs(angle + 2*pi)", "5 mm*abs(angle - pi)", "5 mm*if(angle < 0, 1, 2)"})
    refused("{cam: [cam, valve], lift: \"" + std::string(curve) + "\"}", {"joints.lobe.lift", "impact on the follower", "step"});
  refused("{cam: [cam, valve], lift: 5 mm*tan(angle/2)}", {"joints.lobe.lift", "not finite"});
  refused("{cam: [cam, valve]}", {"lift", "swing"});
  // What leaves its table while it runs says so, and does not go on.
  const Whole w =
      run(pintle::read_scene_text(text("{cam: [cam, valve], lift: {table: part.csv, angle unit: deg, value unit: mm}}"), "s.yaml",
                                  {{"drivers.motor.law", "45 deg + 4*t"}, {"start", "{cam: {angle: 45 deg}}"}}, folder));
  EXPECT_NE(w.run.status, Status::finished);
  EXPECT_FALSE(w.run.reason.empty());
  fs::remove_all(folder);
}

// ---- screws and linear relations ----

// A nut of mass m on a spindle: (J + m (p/2π)²) α = T + m g p/2π.
TEST(Screw, DrivesItsNut) {
  for (const double lead : {0.02, -0.02})
    for (const Method& method : methods) {
      const Whole w =
          run("gravity: [9.81, 0]\nground: {points: {G: [0, 0.1]}}\nbodies:\n  rotor: {rigid: {mass: 1, inertia: 1e-4}}\n"
              "  nut: {pose: {at: [0.3, 0.1]}, rigid: {mass: 5, inertia: 1e-2}}\njoints:\n  bearing: {revolute: [ground, rotor]}\n"
              "  guide: {prismatic: [ground.G, nut]}\n  spindle: {screw: [rotor, nut, ground.G], lead: " +
                  number(lead) + "}\nforces: {motor: {torque: 0.1, on: rotor}}\nrun: {until: 0.2}\noutput: {frames: 0, every: 0.1}\n",
              method);
      expect_sound(w);
      const double p = lead / (2 * M_PI), alpha = (0.1 + 5 * g * p) / (1e-4 + 5 * p * p), t = 0.2;
      EXPECT_NEAR(w.last("rotor.angle [rad]"), alpha * t * t / 2, std::abs(alpha) * t * t * method.near);
      EXPECT_NEAR(w.last("nut.x [m]"), 0.3 + p * w.last("rotor.angle [rad]"), 1e-10);
      EXPECT_NEAR(w.last("spindle.force [N]"), 5 * (p * alpha - g), 1e-6 + 1e4 * method.near);
    }
}

// A rope over a loose pulley: y₁ + 2 y₂ stays, so that (4 m₁ + m₂) a₂ = (2 m₁ − m₂) g.
TEST(Differential, OfDisplacementsIsATackle) {
  for (const Method& method : methods) {
    const Whole w =
        run("gravity: [0, -9.81]\nground: {points: {U: {at: [0, 0], angle: 90 deg}, V: {at: [1, 0], angle: 90 deg}}}\nbodies:\n"
            "  one: {pose: {at: [0, 0.4]}, rigid: {mass: 3, inertia: 1}}\n  two: {pose: {at: [1, 0.2]}, rigid: {mass: 2, inertia: "
            "1}}\njoints:\n"
            "  A: {prismatic: [ground.U, one], angle: -90 deg}\n  B: {prismatic: [ground.V, two], angle: -90 deg}\n"
            "  tackle: {differential: [{displacement: [ground.U, one]}, {displacement: [ground.V, two], ratio: 2}]}\n"
            "run: {until: 0.3}\noutput: {frames: 0, every: 0.1}\n",
            method);
    expect_sound(w);
    const double a = (2 * 3 - 2) * g / (4 * 3 + 2), t = 0.3;
    EXPECT_NEAR(w.last("two.y [m]"), 0.2 + a * t * t / 2, a * t * t * method.near);
    EXPECT_NEAR(w.last("one.y [m]"), 0.4 - a * t * t, 2 * a * t * t * method.near);
  }
}

// Two cylinders on one pipe, pistons of 1 and 0.5: what one arm takes in the other gives out, 1:2. Statics by virtual work.
TEST(Differential, OfDistancesLinksTwoArms) {
  const Whole w = run(
      "ground: {points: {P: [0, -0.3], Q: [2, -0.3], B: [2, 0]}}\nbodies:\n  left: {rigid: {mass: 1, inertia: 0.1}, points: {C: [0.5, "
      "0]}}\n"
      "  right: {pose: {at: [2, 0]}, rigid: {mass: 1, inertia: 0.1}, points: {C: [-0.4, 0.1]}}\njoints:\n  A: {revolute: [ground, left]}\n"
      "  B: {revolute: [ground.B, right]}\n  pipe: {differential: [{distance: [ground.P, left.C]}, {distance: [ground.Q, right.C], ratio: "
      "0.5}]}\n"
      "drivers: {hand: {angle: [ground, left], law: 0.3*sin(3*t)}}\nrun: {until: 1}\noutput: {frames: 0, every: 0.1}\n");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const auto left = w.column("left.angle [rad]"), right = w.column("right.angle [rad]");
  const auto one = [](double q) { return std::hypot(0.5 * std::cos(q), 0.5 * std::sin(q) + 0.3); };
  const auto two = [](double q) { return std::hypot(-0.4 * std::cos(q) - 0.1 * std::sin(q), 0.1 * std::cos(q) - 0.4 * std::sin(q) + 0.3); };
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_NEAR(one(left[i]) - one(0) + 0.5 * (two(right[i]) - two(0)), 0, 1e-9);
}

TEST(Differential, RefusesTermsThatCannotBe) {
  const auto refused = [](const std::string& terms, const std::vector<std::string>& parts) {
    const std::string text =
        "bodies:\n  a: {rigid: {mass: 1, inertia: 1}, points: {P: [1, 0], Q: [0, 1]}}\n  b: {rigid: {mass: 1, inertia: 1}}\njoints:\n  j: "
        "{differential: " +
        terms + "}\nrun: {until: 1}\n";
    expect_refused([&] { build(pintle::read_scene_text(text, "s.yaml")); }, parts);
  };
  refused("[{angle: [ground, a]}]", {"s.yaml:5", "joints.j.differential", "two or three terms"});
  refused("[{angle: [ground, a]}, {angle: [ground, b], ratio: 0}]", {"ratio", "must not be 0"});
  refused("[{angle: [ground, a]}, {distance: [ground, b], ratio: 2 mm}]", {"ratio", "2 mm"});
  refused("[{angle: [ground, a]}, {angel: [ground, b]}]", {"angel", "angle"});
  refused("[{distance: [ground, a.P]}, {distance: [ground, a.Q]}]", {"joints.j", "two of its points", "\"P\"", "\"Q\""});
  refused("[{angle: [ground, a]}, {angle: [b, b]}]", {"both ends are on \"b\""});
}

// ---- lengths that begin as they are drawn ----

double between(double a, double b, double angle) { return std::sqrt(a * a + b * b - 2 * a * b * std::cos(angle)); }

// examples/excavator.yaml: each arm turns by what the cosine rule makes of its cylinder's stroke, and the boom's cylinder bears the weight.
TEST(Cylinders, MoveAnExcavator) {
  const Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/excavator.yaml");
  const Model model = build(s);
  const pintle::Run moved = kinematics(s, model, assemble(s, model));
  ASSERT_EQ(moved.status, Status::finished) << moved.reason;
  // An arm turns about a pivot between two points, at distances and directions from it that are fixed in the bodies that carry them.
  struct Arm {
    double ax, ay, bx, by, stroke;
  };
  const auto turned = [](const Arm& arm, double drawn) {
    const double a = std::hypot(arm.ax, arm.ay), b = std::hypot(arm.bx, arm.by), first = std::atan2(arm.ay, arm.ax),
                 opening = drawn + std::atan2(arm.by, arm.bx) - first, l = between(a, b, opening) + arm.stroke;
    const double after = std::acos((a * a + b * b - l * l) / (2 * a * b));
    return (std::remainder(opening, 2 * M_PI) < 0 ? -after : after) - std::remainder(opening, 2 * M_PI);
  };
  const double deg = M_PI / 180;
  const double boom = turned({0.6, -0.4, 2.4, 0.2, 0.30}, 35 * deg), stick = turned({2.8 - 5.6, 0.9, -0.7, 0.1, -0.25}, -105 * deg),
               bucket = turned({0.3 - 2.9, 0.5, 0.1, 0.45, -0.30}, -50 * deg);
  const double q1 = 35 * deg + boom, q2 = q1 - 105 * deg + stick, q3 = q2 - 50 * deg + bucket;
  const auto last = [&](const std::string& column) { return moved.trajectory.column(column).back(); };
  EXPECT_NEAR(last("boom.angle [rad]"), q1, 1e-9);
  EXPECT_NEAR(last("stick.angle [rad]"), q2, 1e-9);
  EXPECT_NEAR(last("bucket.angle [rad]"), q3, 1e-9);
  EXPECT_NEAR(last("bucket.tip.x [m]"), 5.6 * std::cos(q1) + 2.9 * std::cos(q2) + 1.4 * std::cos(q3), 1e-8);
  EXPECT_NEAR(last("bucket.tip.y [m]"), 1.6 + 5.6 * std::sin(q1) + 2.9 * std::sin(q2) + 1.4 * std::sin(q3), 1e-8);

  // At the start all stand still: the thrust of the boom's cylinder against the moments of three weights about the foot.
  const double c1 = std::cos(35 * deg), s1 = std::sin(35 * deg), c2 = std::cos(-70 * deg), c3 = std::cos(-120 * deg);
  const double moment = g * (1200 * (2.7 * c1 - 0.3 * s1) + 600 * (5.6 * c1 + c2) + 450 * (5.6 * c1 + 2.9 * c2 + 0.6 * c3));
  const double px = 2.4 * c1 - 0.2 * s1, py = 2.4 * s1 + 0.2 * c1, dx = px - 0.6, dy = py + 0.4, l = std::hypot(dx, dy);
  const Inverse efforts = inverse(s, model, assemble(s, model));
  EXPECT_NEAR(efforts.drivers[0].value.front(), moment / ((px * dy - py * dx) / l), 1e-6 * moment);
}

TEST(Present, HoldsARodAsItIsDrawn) {
  const std::string text =
      "gravity: [0, -9.81]\nground: {points: {C: [0, -1]}}\nbodies: {arm: {rigid: {mass: 1, inertia: 1}, points: {P: [1, 0.2]}}}\n"
      "joints:\n  A: {revolute: [ground, arm]}\n  rod: {distance: [ground.C, arm.P], length: present}\n"
      "start: {arm: {angle: 0.3}}\nrun: {until: 0.1}\noutput: {frames: 0, every: 0.1}\n";
  const Whole w = run(text);
  expect_sound(w, 1e-12);
  EXPECT_NEAR(w.last("arm.angle [rad]"), 0.3, 1e-12);
  const Scene again = pintle::read_scene_text(pintle::read_scene_text(text, "s.yaml").filled_in, "again.json");
  EXPECT_NEAR(run(again).last("arm.angle [rad]"), 0.3, 1e-12);
  const auto refused = [&](const std::string& key, const std::string& value, const std::vector<std::string>& parts) {
    expect_refused([&] { build(pintle::read_scene_text(text, "s.yaml", {{key, value}})); }, parts);
  };
  refused("joints.rod.length", "2*present", {"joints.rod.length", "may only add to present"});
  refused("joints.rod.length", "present - 5 m", {"joints.rod", "above 0"});
  refused("drivers", "{lift: {distance: [ground.C, arm.P], law: present*t}}", {"drivers.lift.law", "present"});
  refused("drivers", "{lift: {distance: [ground.C, arm.P], law: presents + 1}}", {"presents"});
}

}  // namespace
}  // namespace pintle::relation_test
