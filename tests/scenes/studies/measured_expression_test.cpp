// Measures of signals and expressions, of runs that an event stops, and curves of situations, against closed forms.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "framework/study/sweep/sweep.h"
#include "tests/refusal.h"
#include "tests/scenes/studies/sweep_folder.h"

namespace pintle::measured_expression_test {
namespace {

/// A bar of 2 kg hinged at its end, 0.3 m from its mass centre, turned steadily by a motor.
const std::string turned = R"(
gravity: [0, -9.81]
parameters: {speed: 2 rad/s}
bodies: {bar: {rigid: {mass: 2 kg, inertia: 0.05 kg m^2}, points: {O: [-0.3, 0], E: [0.3, 0]}, pose: {at: [0.3, 0]}}}
ground: {points: {W: [1, 0]}}
joints: {hinge: {revolute: [ground, bar.O]}}
drivers: {motor: {angle: [ground, bar], law: speed*t}}
forces: {coil: {spring: [ground.W, bar.E], stiffness: 1e-6 N/m, free length: 0}}
outputs: {lift: bar.E.y, load: hinge.fy}
run: {until: 1 s}
)";

SweepEnd swept(const SweepFolder& folder, const std::string& scene, const std::string& study) {
  folder.write("scene.yaml", scene);
  folder.write("study.yaml", "scene: scene.yaml\n" + study);
  fs::remove_all(folder / "out");
  return run_sweep(read_sweep(folder / "study.yaml"), folder / "out", {1, nullptr, {}});
}
std::string refused(const std::string& study) {
  const SweepFolder folder;
  return pintle_test::refusal_by([&] { swept(folder, turned, study + "\nsweep: {grid: {speed: [2 rad/s]}}\n"); });
}
const std::string grid = "sweep: {grid: {speed: [2 rad/s, 4 rad/s]}}\n";

TEST(MeasuredExpression, SignalsAndFormulasAreMeasuredAsOutputsAre) {
  const SweepFolder folder;
  const auto rows =
      swept(folder, turned,
            "measure: {turn: final hinge.angle, least: least coil.length, at: \"coil.length at 0 s\", rate: greatest coil.rate, twice: "
            "\"final 2*bar.angle - hinge.angle\", work: peak motor.power in the last 1 s}\n" +
                grid)
          .rows;
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(rows[i].status, "finished") << rows[i].reason;
    const double w = i == 0 ? 2 : 4;
    EXPECT_NEAR(rows[i].values[0], w, 1e-9);
    EXPECT_NEAR(rows[i].values[1], 0.4, 1e-7);
    EXPECT_NEAR(rows[i].values[2], 0.4, 1e-9);
    EXPECT_NEAR(rows[i].values[4], w, 1e-9);
    EXPECT_NEAR(rows[i].values[5], 2 * 9.81 * 0.3 * w, 1e-4);  // the weight's torque at its longest arm, at the start
  }
}

TEST(MeasuredExpression, KinematicsMeasuresWhatNamesNoForce) {
  const SweepFolder folder;
  const auto rows =
      swept(folder, turned,
            "analysis: kinematics\nmeasure: {up: final lift, turn: final hinge.angle, fall: final bar.alpha*1 m}\nkeep: [lift]\n" + grid)
          .rows;
  ASSERT_EQ(rows.size(), 2U);
  ASSERT_EQ(rows[0].status, "finished") << rows[0].reason;
  EXPECT_NEAR(rows[0].values[0], 0.6 * std::sin(2.0), 1e-9);
  EXPECT_NEAR(rows[0].values[1], 2, 1e-9);
  EXPECT_NEAR(rows[0].values[2], 0, 1e-9);
  EXPECT_TRUE(fs::exists(folder / "out/curves/case-1.csv"));
  pintle_test::expect_says(refused("analysis: kinematics\nmeasure: {q: final load}"), {"kinematics computes motion only"});
  pintle_test::expect_says(refused("analysis: kinematics\nmeasure: {q: final 2*motor.torque}"), {"kinematics computes motion only"});
}

// speed t = 1 rad
TEST(MeasuredExpression, ARunThatAnEventStopsIsMeasuredOverItsSpan) {
  const SweepFolder folder;
  const auto rows =
      swept(folder, turned + "events: {there: {when: bar.angle > 1 rad, do: {stop: it is there}}}\n",
            "measure: {turn: final angle of bar, end: time of the end, mean: mean speed of bar in the last 0.1 s, lift: final lift, "
            "never: angle of bar at 0.9 s, whole: range of angle of bar}\n" +
                grid)
          .rows;
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(rows[i].status, "finished") << rows[i].reason;
    const double w = i == 0 ? 2 : 4;
    EXPECT_NEAR(rows[i].values[0], 1, 1e-9);
    EXPECT_NEAR(rows[i].values[1], 1 / w, 1e-9);
    EXPECT_NEAR(rows[i].values[2], w, 1e-9);
    EXPECT_NEAR(rows[i].values[3], 0.6 * std::sin(1.0), 1e-9);
    EXPECT_TRUE(std::isnan(rows[i].values[4]));
    EXPECT_NEAR(rows[i].values[5], 1, 1e-9);
  }
}

TEST(MeasuredExpression, WhatNoCaseCanHaveIsRefusedByName) {
  pintle_test::expect_says(refused("measure: {q: peak coil.depth}"), {"coil.depth", "in no case", "coil.length"});
  pintle_test::expect_says(refused("measure: {q: mean hinge.normal}"), {"hinge.normal", "in no case", "hinge.fx"});
  pintle_test::expect_says(refused("measure: {q: peak coil.lenth}"), {"coil.lenth", "Did you mean \"coil.length\"?"});
  pintle_test::expect_says(refused("measure: {q: peak hinge.power}"), {"does no work"});
  pintle_test::expect_says(refused("measure: {q: peak hinge.fx*speed}"), {"parameters are not allowed in measures"});
}

TEST(MeasuredExpression, CurvesAreKeptOfEachSituation) {
  const SweepFolder folder;
  swept(folder, turned,
        "situations: {slow: {speed: 1 rad/s}, fast: {speed: 3 rad/s}}\nmeasure: {turn: final angle of bar}\nkeep: [angle of bar]\n"
        "sweep: {grid: {run.tolerance: [1e-8]}}\n");
  for (const auto& [name, turn] : {std::pair{"slow", 1.0}, {"fast", 3.0}}) {
    std::ifstream file(folder / ("out/curves/case-1-" + std::string(name) + ".csv"));
    ASSERT_TRUE(file) << name;
    std::string line, last;
    while (std::getline(file, line)) last = line;
    EXPECT_NEAR(std::stod(last.substr(last.find(',') + 1)), turn, 1e-9);
  }
}

}  // namespace
}  // namespace pintle::measured_expression_test
