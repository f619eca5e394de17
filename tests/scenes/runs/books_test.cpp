// What a run says of its own energies and forces: the bound of its energy balance, and numbers that it knows only roughly.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/analysis/simulate/energy_balance.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::books_test {
namespace {

pintle::Scene damped_pendulum(const char* method, double tolerance, double damping) {
  pintle::Scene s = pintle::read_scene_text(
      "gravity: [0, -9.81]\n"
      "bodies: {rod: {rigid: {mass: 1, inertia: 0.01, center: [0.3, 0]}, points: {O: [0, 0]}}}\n"
      "joints: {pin: {revolute: [ground, rod.O]}}\n"
      "forces: {brake: {torsion spring: [ground, rod], damping: " +
          std::to_string(damping) +
          "}}\n"
          "start: {rod: {x: 0, y: 0, angle: 0, speed: 0}}\n"
          "run: {until: 2}\n",
      "damped.yaml");
  s.run.method = method, s.run.tolerance = tolerance;
  return s;
}
bool says(const pintle::Run& run, const char* what) {
  return std::any_of(run.warnings.begin(), run.warnings.end(), [&](const std::string& w) { return w.find(what) != std::string::npos; });
}

TEST(Books, ALossThatIsSmallBesideWhatIsUnexplainedIsNamed) {
  const Whole loose = run(damped_pendulum("generalized-alpha", 1e-4, 1e-4)), tight = run(damped_pendulum("dopri5", 1e-10, 1e-4)),
              large = run(damped_pendulum("generalized-alpha", 1e-4, 0.5));
  ASSERT_EQ(loose.run.status, pintle::Status::finished) << loose.run.reason;
  EXPECT_TRUE(says(loose.run, "brake.lost to damper")) << loose.run.worst_unexplained;
  EXPECT_TRUE(says(loose.run, "tighten run.tolerance"));
  EXPECT_FALSE(says(tight.run, "tighten run.tolerance"));
  EXPECT_FALSE(says(large.run, "lost to damper"));
}

// A wheel that a driver turns up, beside a pendulum with ten thousand times its energy.
TEST(Books, ADriversWorkThatIsSmallBesideWhatIsUnexplainedIsNamed) {
  const auto books = [](const char* method, double tolerance) {
    pintle::Scene s = pintle::read_scene_text(
        "gravity: [0, -9.81]\n"
        "bodies:\n  rod: {rigid: {mass: 1, inertia: 0.01, center: [0.3, 0]}, points: {O: [0, 0]}}\n"
        "  wheel: {rigid: {mass: 0.1, inertia: 1e-4}}\n"
        "joints: {pin: {revolute: [ground, rod.O]}, axle: {revolute: [ground, wheel]}}\n"
        "drivers: {motor: {angle: [ground, wheel], law: 0.5*t^2}}\n"
        "start: {rod: {x: 0, y: 0, angle: 0, speed: 0}}\nrun: {until: 2}\n",
        "driven.yaml");
    s.run.method = method, s.run.tolerance = tolerance;
    return run(s);
  };
  const Whole loose = books("generalized-alpha", 1e-4), tight = books("dopri5", 1e-10);
  ASSERT_EQ(loose.run.status, pintle::Status::finished) << loose.run.reason;
  EXPECT_TRUE(says(loose.run, "\"motor.work in\"")) << loose.run.worst_unexplained;
  EXPECT_NEAR(tight.ledger("motor.work in [J]"), 2e-4, 1e-9);  // ½ J ω² at 2 rad/s
  EXPECT_TRUE(tight.run.warnings.empty()) << tight.run.warnings.front();
}

// The torque of a driver that turns a ringing coupler, beside that of a run of a much finer tolerance.
TEST(Implicit, TorquesThatALooseToleranceGivesRoughlyAreWarnedOf) {
  const auto driven = [](const char* method, double tolerance) {
    pintle::Scene s = pintle::read_scene_text(R"(
bodies:
  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [0, 0], A: [50 mm, 0]}}
  coupler:
    beam: {from: A, to: B, section: {rectangle: [10 mm, 10 mm]}, elements: 8, young: 207 GPa, poisson: 0.3, density: 7850}
    points: {A: [0, 0], B: [0.12, 0]}
    pose: {at: [50 mm, 0]}
    damping: {ratios: 0.02}
    modes: {frame: chord, count: 8}
  slider: {rigid: {mass: 0.14, inertia: 1e-5}, pose: {at: [0.17, 0]}}
joints:
  main: {revolute: [ground, crank.O]}
  a: {revolute: [crank.A, coupler.A]}
  b: {revolute: [coupler.B, slider]}
  guide: {prismatic: [ground, slider]}
drivers: {motor: {angle: [ground, crank], law: 300*t}}
run: {until: 0.01}
output: {every: 50 us}
)",
                                              "driven.yaml");
    s.run.method = method, s.run.tolerance = tolerance;
    return run(s);
  };
  const char* const torque = "motor.torque on crank [N m]";
  const std::vector<double> exact = driven("dopri5", 1e-9).column(torque);
  struct Case {
    const char* method;
    double tolerance;
    bool rough;
  };
  for (const Case& c : {Case{"generalized-alpha", 1e-4, true}, Case{"generalized-alpha", 1e-6, false}, Case{"dopri5", 1e-4, false}}) {
    SCOPED_TRACE(c.method + std::string(" at ") + std::to_string(c.tolerance));
    const Whole w = driven(c.method, c.tolerance);
    EXPECT_EQ(says(w.run, "torques of drivers"), c.rough);
    EXPECT_EQ(relative_difference(w.column(torque), exact) > 0.1, c.rough) << relative_difference(w.column(torque), exact);
  }
}

// The parts of a run that its judgement depends on.
pintle::Run judged(const char* method, double tolerance, double unexplained, double in_play, double floor) {
  const pintle::Scene s = damped_pendulum(method, tolerance, 0.5);
  const pintle::Model model = pintle::build(s);
  pintle::Run r;
  r.worst_unexplained = unexplained, r.energy_in_play = in_play;
  pintle::check_energy_balance(s, model, !model.scheme.tableau, floor, r);
  return r;
}

TEST(Books, WhatOnlyTheFloorOfRoundingLetsPassIsSaid) {
  const pintle::Run passed = judged("dopri5", 1e-8, 0.997e-12, 1e-12, 1e-11), closed = judged("dopri5", 1e-8, 1e-18, 1e-12, 1e-11);
  EXPECT_EQ(passed.status, pintle::Status::finished);
  EXPECT_EQ(passed.ledger_floor, 1e-11);
  EXPECT_TRUE(says(passed, "0.997 of the energy in play")) << passed.warnings.size();
  EXPECT_TRUE(says(passed, "rounding alone may leave 1e-11 J"));
  EXPECT_TRUE(closed.warnings.empty());
  EXPECT_TRUE(judged("dopri5", 1e-8, 1e-12, 1e-12, 1e-11).warnings.empty());  // nothing moves but the last digit of heights
  EXPECT_EQ(judged("dopri5", 1e-8, 0.997, 1, 1e-11).status, pintle::Status::ledger_over_bound);
}

// (hω)² at 1e-4 is a hundredth.
TEST(Books, BoundOfGeneralizedAlphaFollowsItsOrder) {
  const auto status = [](const char* method, double tolerance, double share) { return judged(method, tolerance, share, 1, 0).status; };
  EXPECT_EQ(status("generalized-alpha", 1e-4, 5e-3), pintle::Status::finished);
  EXPECT_EQ(status("generalized-alpha", 1e-4, 5e-2), pintle::Status::ledger_over_bound);
  EXPECT_EQ(status("generalized-alpha", 1e-8, 2e-3), pintle::Status::ledger_over_bound);
  EXPECT_EQ(status("dopri5", 1e-4, 5e-3), pintle::Status::ledger_over_bound);
  EXPECT_EQ(status("generalized-alpha", 1e-4, NAN), pintle::Status::ledger_over_bound);
}

TEST(Books, ABoundThatIsAskedForHolds) {
  pintle::Scene s = damped_pendulum("generalized-alpha", 1e-4, 0.5);
  s.run.ledger_bound = 1e-9;
  EXPECT_EQ(run(s).run.status, pintle::Status::ledger_over_bound);
}

}  // namespace
}  // namespace pintle_scenes::books_test
