// pintle fit: known linkages found again from poor starts, springs for a frequency, and what must not depend on workers and kills.
#include "framework/study/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/refusal.h"
#include "tests/scenes/studies/sweep_folder.h"

namespace pintle::fit_test {
namespace {

const fs::path studies = fs::path(PINTLE_SOURCE_DIR) / "examples/studies";
constexpr double pi = std::numbers::pi;

double variable(const FitPlan& plan, const FitEnd& end, const std::string& name) {
  for (std::size_t j = 0; j < plan.variables.size(); ++j)
    if (plan.variables[j].name == name) return variable_value(end.tried.at(end.best.value()), j);
  ADD_FAILURE() << name;
  return 0;
}
double measure(const FitPlan& plan, const FitEnd& end, std::size_t m) {
  return measured_values(plan, end.tried.at(end.best.value())).at(m);
}

/// A mass of 2 kg on a rail, held by a spring: f = √(k/m)/2π.
constexpr const char* oscillator = R"(
parameters: {stiffness: 100 N/m, mass: 2 kg}
bodies: {block: {rigid: {mass: mass, inertia: 0.01 kg m^2}}}
joints: {rail: {prismatic: [ground, block]}}
forces: {spring: {spring: [ground, block], stiffness: stiffness, free length: 0.1 m}}
start: {block: {at: [0.1 m, 0]}}
run: {until: 0.1 s}
)";

/// A study of the oscillator, fitted.
struct Fitted {
  FitPlan plan;
  FitEnd end;
};
Fitted fitted(const SweepFolder& folder, const std::string& study, const FitSettings& settings = {1, {}}, const std::string& out = "out") {
  folder.write("scene.yaml", oscillator);
  folder.write("study.yaml", "scene: scene.yaml\nanalysis: linearize\n" + study);
  Fitted f{read_fit(folder / "study.yaml"), {}};
  f.end = run_fit(f.plan, folder / out, settings);
  return f;
}
const std::string wanted = "goal: {reach: {frequency of mode 1: {to: 3 Hz, tolerance: 0.001 Hz}}}\n";

TEST(Fit, ChebyshevsLinkageIsFoundFromAPoorStart) {
  const SweepFolder folder;
  const FitPlan plan = read_fit(studies / "fit_chebyshev.yaml");
  const FitEnd end = run_fit(plan, folder / "out", {2, {}});
  EXPECT_TRUE(end.meets(plan));
  // 5 : 2 on a ground of 4. The distance grows with the square root of what the search leaves of a millionth squared.
  EXPECT_NEAR(variable(plan, end, "rocker"), 0.5, 1e-5);
  EXPECT_NEAR(variable(plan, end, "coupler"), 0.2, 1e-5);
  EXPECT_TRUE(fs::exists(folder / "out/path.csv"));
}

/// Greatest less least y of Hoecken's P, crank 1, over half a turn or what is said [rad]: by hand.
double hoecken(double ground, double link, double range = pi) {
  double low = 1e9, high = -1e9;
  for (int k = 0; k <= 720; ++k) {
    const double a = pi - range / 2 + range * k / 720, x = std::cos(a), y = std::sin(a), dx = ground - x, dy = -y, d = std::hypot(dx, dy);
    const double height = std::sqrt(link * link - d * d / 4), by = y + dy / 2 + dx / d * height;
    low = std::min(low, 2 * by - y), high = std::max(high, 2 * by - y);
  }
  return high - low;
}

TEST(Fit, HoeckensStraightestLineIsFoundFromAPoorStart) {
  const SweepFolder folder;
  const FitPlan plan = read_fit(studies / "fit_hoecken.yaml");
  const FitEnd end = run_fit(plan, folder / "out", {2, {}});
  const double found = measure(plan, end, plan.goal.measure), ground = variable(plan, end, "ground"), link = variable(plan, end, "link");
  EXPECT_NEAR(found, 0.1 * hoecken(10 * ground, 10 * link), 1e-8) << "the measure is that of the linkage";  // 720 pieces by hand: (π/1440)⁴
  double best = 1;
  for (double g = 2; g < 2.4; g += 0.005)
    for (double l = 2.6; l < 3.0; l += 0.005) best = std::min(best, hoecken(g, l));
  EXPECT_LE(found, 0.1 * best) << "as straight as the best of a fine grid";
  EXPECT_NEAR(ground / 0.22, 1, 0.01);  // Norton's table, to what about so flat a least value can be told from it
  EXPECT_NEAR(link / 0.28, 1, 0.01);
}

// Norton, Design of Machinery, table 3-1: ground and link over the crank that make the line straightest over so much of the crank's turn, and
// how straight it is then, in parts of its length.
TEST(Fit, PublishedOptimaOfACouplerCurveAreFound) {
  struct Optimum {
    double degrees, ground, link, straight;
  };
  for (const Optimum& row : {Optimum{120, 2.625, 3.438, 0.010e-2}, Optimum{160, 2.35, 3.025, 0.047e-2}}) {
    SCOPED_TRACE(row.degrees);
    const SweepFolder folder;
    folder.write("scene.yaml", contents(studies / "../hoecken_straight_line.yaml"));
    folder.write("study.yaml",
                 "scene: scene.yaml\nanalysis: kinematics\nset: {range: " + std::to_string(row.degrees) +
                     " deg}\nmeasure: {length: range of x of coupler.P}\nvary: {ground: {from: 0.2 m, to: 0.35 m, start: 0.3 m}, "
                     "link: {from: 0.25 m, to: 0.45 m, start: 0.4 m}}\ngoal: {minimise: range of y of coupler.P}\n"
                     "fit: {starts: 1, evaluations: 200}\n");
    const FitPlan plan = read_fit(folder / "study.yaml");
    const FitEnd end = run_fit(plan, folder / "out", {2, {}});
    const double found = measure(plan, end, plan.goal.measure), length = measure(plan, end, 0);
    EXPECT_LE(found, 0.1 * hoecken(row.ground, row.link, row.degrees * pi / 180)) << "as straight as the published one";
    EXPECT_NEAR(found / length, row.straight, 0.1 * row.straight) << "its proportions are rounded, which costs it up to a fourteenth";
    EXPECT_NEAR(variable(plan, end, "ground") / (0.1 * row.ground), 1, 0.01);
    EXPECT_NEAR(variable(plan, end, "link") / (0.1 * row.link), 1, 0.01);
  }
}

TEST(Fit, ASpringIsChosenForANaturalFrequency) {
  for (const char* method : {"auto", "slsqp", "sbplx", "isres"}) {
    const SweepFolder folder;
    const Fitted f = fitted(folder, "vary: {stiffness: {from: 10 N/m, to: 5 N/mm, start: 4 N/mm, scale: log}}\n" + wanted +
                                        "fit: {evaluations: 600, method: " + method + "}\n");
    EXPECT_TRUE(f.end.meets(f.plan)) << method;
    // Within the tolerance of 1 mHz: δk/k = 2 δf/f.
    const double exact = 2 * std::pow(6 * pi, 2);
    EXPECT_NEAR(variable(f.plan, f.end, "stiffness"), exact, exact * 2e-3 / 3) << method;
    const std::string text = contents(folder / "out/fitted.yaml");
    EXPECT_NE(text.find("Fitted by pintle fit"), std::string::npos);
    const CaseSource scene = read_case_source(folder / "out/fitted.yaml");
    EXPECT_NEAR(common_scene(scene).parameters.at(0).value, exact, exact * 2e-3 / 3) << text;
  }
}

TEST(Fit, ALimitHoldsTheBestPointAndIsMetThere) {
  // The lightest mass with f ≤ 3 Hz on the spring of 100 N/m: m = k/(6π)².
  for (const char* method : {"auto", "cobyla", "slsqp", "mma"}) {
    const SweepFolder folder;
    folder.write("scene.yaml", oscillator);
    folder.write("study.yaml",
                 std::string("scene: scene.yaml\nanalysis: linearize\nvary: {mass: {from: 0.1 kg, to: 5 kg, start: 4 kg}}\n") +
                     "goal: {maximise: frequency of mode 1}\nsubject to: {frequency of mode 1: {at most: 3 Hz}}\n" +
                     "fit: {evaluations: 300, method: " + method + "}\n");
    const FitPlan plan = read_fit(folder / "study.yaml");
    const FitEnd end = run_fit(plan, folder / "out", {1, {}});
    EXPECT_TRUE(end.meets(plan)) << method;
    EXPECT_NEAR(variable(plan, end, "mass"), 100 / std::pow(6 * pi, 2), 1e-4) << method;
  }
}

TEST(Fit, IsTheSameToTheBitForAnyNumberOfWorkersAndAfterAnyEnd) {
  const SweepFolder folder;
  const std::string study =
      "vary: {stiffness: {from: 10 N/m, to: 5 N/mm}, mass: {from: -1 kg, to: 3 kg, start: 1 kg}}\nmeasure: {f: frequency of mode "
      "1}\ngoal: {reach: {f: {to: 3 Hz, tolerance: 0.001 Hz}}}\nfit: {starts: 3, evaluations: 120}\n";
  const Fitted one = fitted(folder, study, {1, {}}, "one");
  fitted(folder, study, {4, {}}, "four");
  // Stopped again and again, as by Ctrl-C.
  bool stopped = true;
  int sessions = 0;
  for (std::size_t most = 7; stopped; most += 20, ++sessions)
    stopped = fitted(folder, study, {1, [&](std::size_t done, std::size_t) { return done < most; }}, "torn").end.stopped;
  EXPECT_GT(sessions, 2);
  for (const char* file : {"fit.csv", "fitted.yaml"})
    for (const char* other : {"four", "torn"})
      EXPECT_EQ(contents(folder / "one" / file), contents(folder / other / file)) << file << " of " << other;
  EXPECT_FALSE(fs::exists(folder / "torn/fit-so-far.csv"));
  // Masses below 0 are refused, and not the end.
  const auto refused = std::ranges::count_if(one.end.tried, [](const FitCase& t) { return t.row.status == "refused"; });
  EXPECT_GT(refused, 2);
  EXPECT_TRUE(one.end.meets(one.plan));
}

TEST(Fit, ThatCanMeasureNothingOrCannotReachItsGoalSaysSo) {
  const SweepFolder folder;
  const Fitted missed = fitted(folder, "vary: {stiffness: {from: 10 N/m, to: 20 N/m}}\n" + wanted + "fit: {starts: 1, evaluations: 60}\n");
  EXPECT_FALSE(missed.end.meets(missed.plan));
  EXPECT_NEAR(variable(missed.plan, missed.end, "stiffness"), 20, 1e-3) << "the nearest";
  const Fitted none = fitted(
      folder, "vary: {mass: {from: 1 kg, to: 2 kg}}\ngoal: {minimise: frequency of mode 9}\nfit: {evaluations: 60}\n", {1, {}}, "none");
  EXPECT_FALSE(none.end.best);
  EXPECT_FALSE(fs::exists(folder / "none/fitted.yaml"));
}

TEST(Fit, AStudyThatIsWrongIsRefusedInOneLine) {
  const SweepFolder folder;
  folder.write("scene.yaml", oscillator);
  const std::string vary = "vary: {mass: {from: 1 kg, to: 3 kg}}\n", goal = "goal: {minimise: frequency of mode 1}\n";
  struct Bad {
    std::string text;
    std::vector<std::string> says;
  };
  for (const Bad& b : std::vector<Bad>{
           {goal, {"vary"}},
           {vary, {"measure"}},
           {vary + "measure: frequency of mode 1\n", {"goal: {minimise:"}},
           {"vary: {mas: {from: 1 kg, to: 3 kg}}\n" + goal, {"vary.mas", "Did you mean \"mass\"?"}},
           {"vary: {mass: {from: 1 m, to: 3 m}}\n" + goal, {"vary.mass", "is a length"}},
           {"vary: {mass: {from: 3 kg, to: 1 kg}}\n" + goal, {"vary.mass", "to must be greater than from"}},
           {"vary: {mass: {from: 1 kg, to: 3 kg, start: 4 kg}}\n" + goal, {"vary.mass.start", "outside"}},
           {vary + "goal: {minimise: frequency of block}\n", {"goal.minimise", "frequency of mode 1"}},
           {vary + "goal: {minimize: frequency of mode 1}\n", {"minimize", "Did you mean \"minimise\"?"}},
           {vary + "goal: {reach: {frequency of mode 1: 3 kg}}\n", {"goal.reach", "3 kg"}},
           {vary + "goal: {reach: {damping of mode 1: 0}}\n", {"needs a tolerance"}},
           {vary + goal + "subject to: {frequency of mode 1: {at most: 1 N}}\n", {"subject to", "at most"}},
           {vary + goal + "subject to: {frequency of mode 1: {below: 1 Hz}}\n", {"Known here: at most or at least"}},
           {vary + goal + "subject to: {frequency of mode 1: {at most: 1 Hz}}\nfit: {method: sbplx}\n", {"fit.method", "cobyla"}},
           {vary + goal + "fit: {method: newton}\n", {"fit.method", "newton"}},
           {vary + goal + "fit: {evaluations: 3, starts: 5}\n", {"fewer than"}}}) {
    folder.write("study.yaml", "scene: scene.yaml\nanalysis: linearize\n" + b.text);
    pintle_test::expect_refused([&] { read_fit(folder / "study.yaml"); }, b.says);
  }
}

TEST(Fit, AFolderOfAnotherStudyIsRefused) {
  const SweepFolder folder;
  const std::string study =
      "vary: {mass: {from: 1 kg, to: 3 kg}}\ngoal: {minimise: frequency of mode 1}\nfit: {starts: 1, evaluations: 10}\n";
  fitted(folder, study);
  EXPECT_THROW(fitted(folder, study + "title: another\n"), SceneError);
}

}  // namespace
}  // namespace pintle::fit_test
