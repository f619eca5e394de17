// Sweeps and sensitivities of every analysis, against closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/study/sensitivity/sensitivity.h"
#include "framework/study/sweep/sweep.h"
#include "tests/refusal.h"
#include "tests/scenes/studies/sweep_folder.h"

namespace pintle::study_analysis_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A bar of 2 kg hinged at its end, 0.3 m from its mass centre, turned steadily by a motor.
constexpr const char* turned = R"(
gravity: [0, -9.81]
parameters: {arm: 0.3 m, speed: 2 rad/s}
bodies: {bar: {rigid: {mass: 2 kg, inertia: 0.05 kg m^2}, points: {O: [-arm, 0], E: [arm, 0]}, pose: {at: [arm, 0]}}}
joints: {hinge: {revolute: [ground, bar.O]}}
drivers: {motor: {angle: [ground, bar], law: speed*t}}
run: {until: 1 s}
)";
/// The same hanging on a spring about its hinge, damped.
constexpr const char* hung = R"(
gravity: [0, -9.81]
parameters: {stiffness: 40 N m/rad, damping: 0.4 N m s/rad, mass: 2 kg, arm: 0.3 m}
bodies: {bar: {rigid: {mass: mass, inertia: 0.05 kg m^2}, points: {O: [0, arm]}, pose: {at: [0, -arm]}}}
joints: {hinge: {revolute: [ground, bar.O]}}
forces: {spring: {torsion spring: [ground, bar], stiffness: stiffness, damping: damping, free angle: 0}}
run: {until: 1 s}
)";

std::vector<Row> swept(const SweepFolder& folder, const std::string& scene, const std::string& study) {
  folder.write("scene.yaml", scene);
  folder.write("study.yaml", "scene: scene.yaml\n" + study);
  fs::remove_all(folder / "out");
  return run_sweep(read_sweep(folder / "study.yaml"), folder / "out", {2, nullptr, {}}).rows;
}

TEST(StudyAnalysis, KinematicsIsSweptWithItsCurves) {
  const SweepFolder folder;
  const std::vector<Row> rows =
      swept(folder, turned,
            "analysis: kinematics\nmeasure: {reach: greatest x of bar.E, angle: final angle of bar}\nkeep: [y of bar.E]\n"
            "sweep: {grid: {speed: [2 rad/s, 4 rad/s]}}\n");
  for (const Row& r : rows) {
    ASSERT_EQ(r.status, "finished") << r.reason;
    EXPECT_NEAR(r.values[0], 0.6, 1e-9);
    EXPECT_NEAR(r.values[1], r.number == 1 ? 2 : 4, 1e-9);
  }
  const std::string curve = contents(folder / "out/curves/case-2.csv");
  EXPECT_TRUE(curve.starts_with("t [s],y of bar.E [m]\n0,0\n")) << curve.substr(0, 80);
  std::istringstream last(curve.substr(curve.rfind('\n', curve.size() - 2) + 1));
  double t = 0, y = 0;
  char comma = 0;
  last >> t >> comma >> y;
  EXPECT_EQ(t, 1);
  EXPECT_NEAR(y, 0.6 * std::sin(4), 1e-9);
}

TEST(StudyAnalysis, InverseDynamicsIsSwept) {
  const SweepFolder folder;
  // The motor holds the weight; the hinge leads the mass centre round.
  const std::vector<Row> rows = swept(folder, turned,
                                      "analysis: inverse\nmeasure: {torque: torque of motor at 0 s, force: force x at hinge at 0 s}\n"
                                      "sweep: {grid: {arm: [0.2 m, 0.3 m]}}\n");
  for (const Row& r : rows) {
    const double arm = r.number == 1 ? 0.2 : 0.3;
    ASSERT_EQ(r.status, "finished") << r.reason;
    EXPECT_NEAR(std::abs(r.values[0]), 2 * 9.81 * arm, 1e-8);
    EXPECT_NEAR(std::abs(r.values[1]), 2 * arm * 4, 1e-8);
  }
}

TEST(StudyAnalysis, StaticsIsSwept) {
  const SweepFolder folder;
  // The lever of examples/statics_lever.yaml: tan θ = (k h − m g)/(k d).
  const std::string scene = R"(
gravity: [0, -9.81]
parameters: {k: 150 N/m}
ground: {points: {O: [0, 0], S: [0.2, 0.4]}}
bodies: {lever: {rigid: {mass: 2 kg}, points: {O: [-0.3, 0], M: [0, 0]}, pose: {at: [0.3, 0]}}}
joints: {pivot: {revolute: [ground.O, lever.O]}}
forces: {spring: {spring: [ground.S, lever.M], stiffness: k, free length: 0}}
)";
  const std::vector<Row> rows =
      swept(folder, scene,
            "analysis: statics\nmeasure: {angle: angle of lever, height: y of lever.M}\nsweep: {grid: {k: [100 N/m, 150 N/m, 400 N/m]}}\n");
  for (const Row& r : rows) {
    const double k = std::vector{100.0, 150.0, 400.0}[r.number - 1], angle = std::atan2(k * 0.4 - 2 * 9.81, k * 0.2);
    ASSERT_EQ(r.status, "finished") << r.reason;
    EXPECT_NEAR(r.values[0], angle, 1e-8);
    EXPECT_NEAR(r.values[1], 0.3 * std::sin(angle), 1e-8);
  }
}

TEST(StudyAnalysis, ALinearisationIsSwept) {
  const SweepFolder folder;
  const std::vector<Row> rows = swept(folder, hung,
                                      "analysis: linearize\nmeasure: {f: frequency of mode 1, n: natural frequency of mode 1, d: damping "
                                      "of root 1, r: real part of root 1}\n"
                                      "sweep: {grid: {stiffness: [10 N m/rad, 40 N m/rad]}}\n");
  for (const Row& r : rows) {
    const double J = 0.05 + 2 * 0.09, k = (r.number == 1 ? 10 : 40) + 2 * 9.81 * 0.3, w = std::sqrt(k / J), zeta = 0.4 / (2 * J * w);
    ASSERT_EQ(r.status, "finished") << r.reason;
    EXPECT_NEAR(r.values[0], w * std::sqrt(1 - zeta * zeta) / (2 * pi), 1e-8);
    EXPECT_NEAR(r.values[1], w / (2 * pi), 1e-8);
    EXPECT_NEAR(r.values[2], zeta, 1e-8);
    EXPECT_NEAR(r.values[3], -zeta * w, 1e-7);
  }
}

TEST(StudyAnalysis, ModesOfABodyAreSwept) {
  const SweepFolder folder;
  // Free Euler beam: f₁ = 4.73004²/(2π L²) √(EI/ρA), I/A = h²/12; eight cubic elements are within 1e-4 of it.
  const std::string scene =
      "parameters: {h: 10 mm}\nbodies: {rod: {beam: {from: a, to: b, elements: 8, section: {rectangle: [h, 20 mm]}, young: 210 GPa, "
      "poisson: 0.3, "
      "density: 7800 kg/m^3, theory: euler, rotary inertia: false}, points: {a: [0, 0], b: [1 m, 0]}}}\n";
  const std::vector<Row> rows =
      swept(folder, scene, "analysis: modes\nmeasure: {f: frequency of mode 1 of rod}\nsweep: {grid: {h: [10 mm, 20 mm]}}\n");
  ASSERT_EQ(rows.size(), 2u);
  for (const Row& r : rows) {
    const double h = 0.01 * static_cast<double>(r.number);
    ASSERT_EQ(r.status, "finished") << r.reason;
    EXPECT_NEAR(r.values[0] / (std::pow(4.730040745, 2) / (2 * pi) * std::sqrt(210e9 / 7800 * h * h / 12)), 1, 2e-4);
  }
}

TEST(StudyAnalysis, ACaseGoesThroughSeveralSpeedsAndLoads) {
  const SweepFolder folder;
  const std::string study =
      "analysis: inverse\nsituations: {slow: {speed: 2 rad/s}, fast: {speed: 10 rad/s, gravity: [0, 0]}, wrong: {arm: 0.1 m}}\n"
      "measure: {force: force x at hinge at 0 s, torque: torque of motor at 0 s}\nsweep: {grid: {arm: [0.2 m, 0.3 m]}}\n";
  const std::vector<Row> rows = swept(folder, turned, study);
  for (const Row& r : rows) {
    const double arm = r.number == 1 ? 0.2 : 0.3;
    ASSERT_EQ(r.status, "finished") << r.reason;
    EXPECT_NEAR(std::abs(r.values[0]), 2 * arm * 4, 1e-8);
    EXPECT_NEAR(std::abs(r.values[1]), 2 * arm * 100, 1e-8);
    EXPECT_NEAR(std::abs(r.values[2]), 2 * 0.1 * 4, 1e-8) << "what a situation sets comes after the case";
    EXPECT_NEAR(std::abs(r.values[3]), 2 * 9.81 * arm, 1e-8);
    EXPECT_NEAR(r.values[4], 0, 1e-8);
  }
  EXPECT_NE(contents(folder / "out/sweep.csv").find(",force in slow [N],force in fast [N],"), std::string::npos);
  pintle_test::expect_refused([&] { swept(folder, turned, "situations: {slow: {sped: 1}}\n" + study.substr(study.find("measure"))); },
                              {"situations.slow", "Did you mean \"speed\"?"});
}

TEST(StudyAnalysis, WhatAnAnalysisDoesNotKnowIsRefused) {
  const SweepFolder folder;
  const std::string sweep = "sweep: {grid: {arm: [0.2 m, 0.3 m]}}\n";
  struct Bad {
    std::string text;
    std::vector<std::string> says;
  };
  for (const Bad& b :
       std::vector<Bad>{{"analysis: kinematics\nmeasure: peak force at hinge\n", {"motion only", "inverse"}},
                        {"analysis: inverse\nmeasure: energy lost\n", {"does not record energies"}},
                        {"analysis: statics\nmeasure: peak force at hinge\n", {"one state"}},
                        {"analysis: statics\nmeasure: force at hing\n", {"hing"}},
                        {"analysis: linearize\nmeasure: force at hinge\n", {"frequency of mode 1"}},
                        {"analysis: linearize\nmeasure: frequency of mode 0\n", {"frequency of mode 1"}},
                        {"analysis: modes\nmeasure: frequency of mode 1 of bar\n", {"bar"}},
                        {"analysis: kinematic\nmeasure: final angle of bar\n", {"kinematic"}},
                        {"measure: final angle of bar\nat: 1 s\n", {"analysis: statics and analysis: linearize only"}},
                        {"analysis: statics\nmeasure: angle of bar\nkeep: [x of bar]\n", {"keep", "over time"}},
                        {"measure: final angle of bar\nkeep: [x of bra]\n", {"keep", "bra"}},
                        {"measure: final angle of bar\nkeep: [the peak angle of bar]\n", {"keep[1]", "by \"peak\"", "under measure"}},
                        {"measure: final angle of bar\nkeep: [time of least angle of bar]\n", {"keep", "by \"time of\""}},
                        {"measure: final angle of bar\nkeep: [angle of bar at 0.05 s]\n", {"keep", "an instant or a window"}},
                        {"measure: final angle of bar\nkeep: [frequency of angle of bar]\n", {"keep", "by \"frequency of\""}},
                        {"measure: final angle of bar\nkeep: [angle of bar after 10 ms]\n", {"keep", "window"}},
                        {"measure: final angle of bar\nkeep: [angle of bar in the last 10 ms]\n", {"keep", "window"}},
                        {"measure: final angle of bar\nkeep: [x of bar, x of bar]\n", {"keep", "twice"}}})
    pintle_test::expect_refused([&] { swept(folder, turned, b.text + sweep); }, b.says);
}

TEST(Sensitivity, OfAFrequencyMeetsItsClosedFormWithinItsError) {
  const SweepFolder folder;
  folder.write("scene.yaml", hung);
  folder.write("study.yaml",
               "scene: scene.yaml\nanalysis: linearize\nmeasure: {f: natural frequency of mode 1}\n"
               "sensitivity: {parameters: {stiffness: {uniform: 2 N m/rad}, mass: {normal: 0.02 kg}, damping: {step: 0.1 N m s/rad}}, "
               "sobol: {count: 64}, "
               "monte carlo: {count: 400}}\n");
  const SensitivityPlan plan = read_sensitivity(folder / "study.yaml");
  const SweepEnd end = run_sweep(plan.sweep, folder / "out", {2, nullptr, {}});
  const MeasureSensitivity m = sensitivities(plan, end.rows).at(0);
  const auto f = [](double k, double mass) { return std::sqrt((k + mass * 9.81 * 0.3) / (0.05 + mass * 0.09)) / (2 * pi); };
  const double J = 0.05 + 2 * 0.09, K = 40 + 2 * 9.81 * 0.3, f0 = f(40, 2);
  EXPECT_NEAR(m.nominal, f0, 1e-9);
  const double exact[] = {f0 / (2 * K), f0 / 2 * (9.81 * 0.3 / K - 0.09 / J), 0};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::abs(m.slopes[i].value - exact[i]), m.slopes[i].error + 1e-9) << i;
  EXPECT_LT(m.slopes[0].error, 1e-6 * exact[0]);
  EXPECT_NEAR(m.linear_worst, std::abs(exact[0]) * 2 + std::abs(exact[1]) * 0.06, 1e-6);
  ASSERT_TRUE(m.corners && m.scatter);
  EXPECT_NEAR(m.corners->least, f(38, 2.06), 1e-9);
  EXPECT_NEAR(m.corners->greatest, f(42, 1.94), 1e-9);
  // Nearly linear: variances add, (2/√3)² of the even one. 400 cases know a deviation to 1/√800 of it; four times that.
  const double spread = std::hypot(exact[0] * 2 / std::sqrt(3.0), exact[1] * 0.02);
  EXPECT_NEAR(m.scatter->deviation, spread, 4 * spread / std::sqrt(800.0));
  EXPECT_NEAR(m.scatter->mean, f0, 4 * spread / 20 + 1e-4 * f0);
  EXPECT_NEAR(m.shares[0].total.value, std::pow(exact[0] * 2 / std::sqrt(3.0) / spread, 2), m.shares[0].total.high - m.shares[0].total.low);
  EXPECT_NEAR(m.shares[2].total.value, 0, 1e-9) << "it does not scatter";
}

TEST(Sensitivity, AStudyThatIsWrongIsRefusedInOneLine) {
  const SweepFolder folder;
  folder.write("scene.yaml", hung);
  for (const auto& [section, says] : std::vector<std::pair<std::string, std::string>>{
           {"{parameters: {}}", "names no parameter"},
           {"{parameters: {stifness: {step: 1}}}", "sensitivity.parameters.stifness"},
           {"{parameters: {stiffness: {uniform: 1 mm}}}", "units of one kind"},
           {"{parameters: {stiffness: {uniform: 1, normal: 2}}}", "two distributions"},
           {"{parameters: {stiffness: {step: 1}}, sobol: {count: 9}}", "needs parameters with a distribution"},
           {"{parameters: {forces.spring.free angle: {uniform: 1 deg, step: 0}}}", "must be greater than 0"},
           {"{parameters: {forces.spring.free angle: {}}}", "it needs a step"}}) {
    folder.write("study.yaml", "scene: scene.yaml\nanalysis: linearize\nmeasure: frequency of mode 1\nsensitivity: " + section + "\n");
    pintle_test::expect_refused([&] { read_sensitivity(folder / "study.yaml"); }, {says});
  }
}

}  // namespace
}  // namespace pintle::study_analysis_test
