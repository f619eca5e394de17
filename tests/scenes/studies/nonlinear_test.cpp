// Poincaré sections, periods and Lyapunov exponents against closed forms.
#include "framework/study/nonlinear/nonlinear.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scenes/studies/nonlinear_study.h"
#include "tests/unit/scarce_threads.h"

namespace pintle {
namespace {

// E. N. Lorenz (1963), by states of the scene's own.
const char* const lorenz =
    "parameters: {sigma: 10, rho: 28, beta: 8/3}\n"
    "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
    "joints: {held: {weld: [ground, plate]}}\n"
    "states:\n"
    "  X: {rate: \"sigma*(Y - X)/(1 s)\", start: 1}\n"
    "  Y: {rate: \"(X*(rho - Z) - Y)/(1 s)\", start: 1}\n"
    "  Z: {rate: \"(X*Y - beta*Z)/(1 s)\", start: 20}\n"
    "run: {until: 1000 s, tolerance: 1e-9, method: verner87}\n";

// The divergence of the flow is -(sigma + 1 + beta) everywhere; the flow's own direction neither grows nor shrinks.
TEST(Nonlinear, LorenzHasItsExponentsAndTheirSumIsTheDivergence) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, lorenz, "lyapunov: {exponents: 3, every: 0.2 s, over: 300 s, transient: 20 s}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].value + found[1].value + found[2].value, -(10 + 1 + 8.0 / 3), 1e-3);
  // 0.9056 (Sprott 2003); the time is finite: within four of its own standard errors, and these are small.
  EXPECT_LT(found[0].error, 0.05);
  EXPECT_NEAR(found[0].value, 0.9056, 4 * found[0].error);
  EXPECT_NEAR(found[1].value, 0, 4 * found[1].error + 0.01);
}

// On van der Pol's limit cycle the greatest exponent is 0. The logarithm of the distance along it rises and falls by that of the speed
// (X', Y'), which is between 0.6 and 4: where the time begins and ends in a period leaves ln 7/time at most. Batches, of one period and a
// half, scatter a hundred times less.
TEST(Nonlinear, ExponentsOfALimitCycleAreZeroWithinTheirErrors) {
  for (const double over : {100.0, 200.0, 400.0}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder,
                                       "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
                                       "joints: {held: {weld: [ground, plate]}}\n"
                                       "states:\n"
                                       "  X: {rate: Y/(1 s), start: 2}\n"
                                       "  Y: {rate: \"((1 - X^2)*Y - X)/(1 s)\", start: 0.1}\n"
                                       "run: {until: 700 s, tolerance: 1e-10, method: verner87}\n",
                                       "lyapunov: {exponents: 2, every: 0.5 s, over: " + std::to_string(over) + " s, transient: 67.3 s}\n");
    const Exponent& zero = done.values.at(0).orbit.exponents.at(0);
    EXPECT_NEAR(zero.value, 0, zero.error) << over;
    EXPECT_LT(zero.error, 2 * std::log(7) / over) << over;
  }
}

TEST(Nonlinear, FollowsItsValuesInTheThreadsThatCanBeStartedAndSaysSo) {
  const SweepFolder folder;
  const std::string study =
      "section: {every: 2*pi/omega, record: [block.x], transient: 2, returns: 3}\nover: {omega: [2, 2.1, 2.2]}\n"
      "direction: from start\n";
  follow_study(folder, impact_oscillator, study);
  const std::string plenty = contents(folder / "out/section.csv");
  for (const int allowed : {0, 1, 2}) {
    fs::remove_all(folder / "out");
    SweepSettings settings;
    settings.threads = 3;
    const Nonlinear read = read_nonlinear(folder / "study.yaml");
    SweepEnd end;
    {
      const ScarceThreads scarce(allowed);
      end = run_nonlinear(read, folder / "out", settings);
    }
    EXPECT_TRUE(end.whole) << allowed;
    EXPECT_EQ(contents(folder / "out/section.csv"), plenty) << allowed;
    EXPECT_TRUE(end.shortage.starts_with(std::to_string(allowed) + " of 3 threads could be started")) << end.shortage;
  }
  fs::remove_all(folder / "out");
  SweepSettings stopping;
  stopping.progress = [](const SweepCount&) { return false; };
  const ScarceThreads scarce(0);
  EXPECT_FALSE(run_nonlinear(read_nonlinear(folder / "study.yaml"), folder / "out", stopping).whole);
}

TEST(Nonlinear, ABouncingBallDoublesItsPeriodAtTheClosedForm) {
  const VibratingTable table;
  for (const double part : {0.98, 1.02}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, table.scene(part * table.doubling(), 1.001), once_a_period(300, 16));
    EXPECT_EQ(done.values.at(0).period, part < 1 ? 1u : 2u);
    EXPECT_EQ(done.values[0].orbit.impacts.count, 16);
    EXPECT_EQ(done.values[0].orbit.impacts.grazing, 0);
  }
}

// Deviations d of a return obey d'' - sum d' + product d = 0.
TEST(Nonlinear, ReturnsOfABouncingBallConvergeByTheMultipliersOfTheClosedForm) {
  const VibratingTable table;
  const double gamma = 1.2;
  const SweepFolder folder;
  const Followed done = follow_study(folder, table.scene(gamma, 1.0005), once_a_period(0, 40));
  const std::vector<std::vector<double>>& returns = done.values.at(0).orbit.signals;
  const auto d = [&](std::size_t k) { return returns[k][1] - returns.back()[1]; };
  const std::size_t k = 4;  // small by then, so that squares are some 1e-4 of it
  const double det = d(k) * d(k + 2) - d(k + 1) * d(k + 1);
  const double sum = (d(k) * d(k + 3) - d(k + 1) * d(k + 2)) / det;
  const double product = (d(k + 1) * d(k + 3) - d(k + 2) * d(k + 2)) / det;
  EXPECT_NEAR(sum, table.sum(gamma), 2e-3);
  EXPECT_NEAR(product, table.e * table.e, 2e-3);
}

// Both multipliers have the size e where they are complex, so both exponents are log(e) a period: neighbours pass impacts.
TEST(Nonlinear, ExponentsOfABouncingBallAreTheLogarithmsOfItsMultipliers) {
  const VibratingTable table;
  const double period = 2 * pi / table.omega;
  const SweepFolder folder;
  const Followed done = follow_study(folder, table.scene(1.2, 1.0),
                                     "lyapunov: {exponents: 2, every: 2*pi/omega, over: 200*2*pi/omega, transient: 50*2*pi/omega}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR((found[0].value + found[1].value) * period, 2 * std::log(table.e), 1e-3);
  EXPECT_NEAR(found[0].value * period, std::log(table.e), 0.02);  // the share of the last, unfinished turn of the pair
}

// x of the ball is 0 but for rounding, which does not repeat.
TEST(Nonlinear, ASignalThatIsRoundingHidesNoPeriod) {
  const VibratingTable table;
  const SweepFolder folder;
  const std::string study =
      "section: {every: 2*pi/omega, record: [ball.y, ball.x + 1e-17 m*sin(1e6 rad/s*t), ball.vx], transient: 300, returns: 16}\n";
  EXPECT_EQ(follow_study(folder, table.scene(0.98 * table.doubling(), 1.001), study).values.at(0).period, 1u);
}

// A damped block at rest at each return, but for noise that does not repeat.
TEST(Nonlinear, RestIsOfPeriodOne) {
  const char* const block =
      "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}}}\njoints: {guide: {prismatic: [ground, block]}}\n"
      "forces: {pull: {force: [\"-1 N/m*block.x - 1 N s/m*block.vx\", 0], at: block}}\n"
      "start: {block: {x: 0.1 m, vx: 0}}\nrun: {until: 10 s, method: dopri5}\n";
  for (const std::string noise : {"1e-7 m", "1e-14 m"}) {
    const SweepFolder folder;
    const bool moved = noise == "1e-7 m";  // otherwise all that is seen is the noise
    const std::string study = "section: {every: 1 s, record: [" + std::string(moved ? "block.x + " : "") + noise +
                              "*sin(1e6 rad/s*t)], transient: " + (moved ? "40" : "0") + ", returns: 8}\n";
    EXPECT_EQ(follow_study(folder, block, study).values.at(0).period, 1u) << noise;
  }
}

// Just below the birth of its orbit the ball comes to rest in each period, where all deviations vanish; far below it rests for good.
TEST(Nonlinear, ExponentsOfAMotionThatComesToRestAreDoubted) {
  const VibratingTable table;
  const std::string study = "lyapunov: {exponents: 1, every: 2*pi/omega, over: 20*2*pi/omega, transient: 5*2*pi/omega}\n";
  for (const double gamma : {0.5, 0.98 * table.birth(), 1.02 * table.birth()}) {  // 0.5: it stays on the table
    const SweepFolder folder;
    const Followed done =
        follow_study(folder, table.scene(1.02 * table.birth(), 1), "set: {gamma: " + std::to_string(gamma) + "}\n" + study);
    EXPECT_EQ(done.values.at(0).reason.find("stayed closed") != std::string::npos, gamma < table.birth()) << gamma;
  }
}

// A ball that stays on a table of a compliant contact, whose deviations fall by e^-60 in a period, and by e^-6 in a tenth of it.
TEST(Nonlinear, ExponentsOfNeighboursLostInRoundingAreDoubted) {
  const VibratingTable table;
  std::string scene = table.scene(1.02 * table.birth(), 1);
  const std::string rigid = "model: impact, restitution: 0.5";
  const std::size_t at = scene.find(rigid);
  ASSERT_NE(at, std::string::npos) << scene;
  scene.replace(at, rigid.size(), "normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e8 N/m^1.5}}");
  for (const char* every : {"2*pi/omega", "0.1*2*pi/omega"}) {
    const SweepFolder folder;
    const Followed done = follow_study(
        folder, scene,
        std::string("set: {gamma: 0.5}\nlyapunov: {exponents: 2, every: ") + every + ", over: 20*2*pi/omega, transient: 20*2*pi/omega}\n");
    EXPECT_EQ(done.values.at(0).reason.find("shorten lyapunov.every") != std::string::npos, every[0] == '2') << done.values[0].reason;
  }
}

// Near the doubling they are real and apart, and neighbours take the time that is not counted to turn to the slower one.
TEST(Nonlinear, ExponentsOfABouncingBallAreThoseOfItsRealMultipliers) {
  const VibratingTable table;
  const double period = 2 * pi / table.omega, gamma = 1.5, sum = table.sum(gamma), root = std::sqrt(sum * sum - 4 * table.e * table.e);
  const double slow = (sum - root) / 2, fast = (sum + root) / 2;  // both below 0
  const SweepFolder folder;
  const Followed done =
      follow_study(folder, table.scene(gamma, 1.0), "lyapunov: {exponents: 2, every: 2*pi/omega, over: 200*2*pi/omega}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].value * period, std::log(-slow), 1e-4);
  EXPECT_NEAR(found[1].value * period, std::log(-fast), 1e-3);
}

TEST(Nonlinear, ErrorsOfExponentsAreToldOfEnoughIntervals) {
  for (const int intervals : {19, 20}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, lorenz, "lyapunov: {every: 0.2 s, over: " + std::to_string(intervals) + "*0.2 s}\n");
    EXPECT_EQ(std::isnan(done.values.at(0).orbit.exponents.at(0).error), intervals < 20);
  }
}

// Free motion takes areas of the phase plane by exp(-c t/m), an impact by e^2: the product of the multipliers of an orbit that hits once
// a period, and the sum of its exponents.
TEST(Nonlinear, AnImpactOscillatorsMultipliersHaveTheProductOfTheClosedForm) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, impact_oscillator,
                                     "section: {every: 2*pi/omega, record: [block.x, block.vx], transient: 100, returns: 20}\n"
                                     "lyapunov: {exponents: 2, every: 2*pi/omega, over: 100*2*pi/omega}\n");
  EXPECT_EQ(done.values.at(0).period, 1u);
  EXPECT_EQ(done.values[0].orbit.impacts.count, 20);
  const std::vector<Exponent>& found = done.values[0].orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR((found[0].value + found[1].value) * pi, 2 * std::log(0.6) - 0.1 * pi, 1e-4);
}

TEST(Nonlinear, AnInterruptedStudyGoesOnToTheSameFilesToTheByte) {
  const VibratingTable table;
  const std::string study = once_a_period(5, 6) + "over: {gamma: [1.2, 1.3, 1.4]}\ndirection: both\norbit: {}\n";
  const SweepFolder whole, cut;
  follow_study(whole, table.scene(1.2, 1.0), study);
  cut.write("scene.yaml", table.scene(1.2, 1.0));
  cut.write("study.yaml", "scene: scene.yaml\n" + study);
  const Nonlinear again = read_nonlinear(cut / "study.yaml");
  run_nonlinear(again, cut / "out", {});
  // All but the heading and the first two values are lost, the third is torn.
  const std::string journal = contents(cut / "out/journal-0.txt");
  std::size_t end = 0;
  for (int line = 0; line < 3; ++line) end = journal.find('\n', end) + 1;
  std::ofstream(cut / "out/journal-0.txt", std::ios::binary) << journal.substr(0, end + 40);
  for (const char* name : {"section.csv", "values.csv", "orbits.csv"}) fs::remove(cut / "out" / name);
  const SweepEnd last = run_nonlinear(again, cut / "out", {});
  EXPECT_EQ(last.count.before, 2u);
  EXPECT_EQ(last.count.done, 4u);
  for (const char* name : {"section.csv", "values.csv", "orbits.csv"}) {
    EXPECT_FALSE(contents(cut / "out" / name).empty()) << name;
    EXPECT_EQ(contents(cut / "out" / name), contents(whole / "out" / name)) << name;
  }
}

TEST(Nonlinear, AnInterruptedStudyShowsWhatIsThere) {
  const SweepFolder folder;
  folder.write("scene.yaml", impact_oscillator);
  folder.write("study.yaml",
               "scene: scene.yaml\nsection: {every: 2*pi/omega, record: [block.x], transient: 2, returns: 3}\n"
               "over: {omega: [2, 2.1, 2.2]}\n");
  const Nonlinear study = read_nonlinear(folder / "study.yaml");
  SweepSettings stopping;
  stopping.progress = [](const SweepCount& c) { return c.done < 1; };
  const ScarceThreads scarce(0);
  const SweepEnd end = run_nonlinear(study, folder / "out", stopping);
  EXPECT_FALSE(end.whole);
  ASSERT_EQ(end.rows.size(), 1u);
  const std::string values = contents(folder / "out/values.csv");
  EXPECT_EQ(std::ranges::count(values, '\n'), 2) << values;
  EXPECT_NE(contents(folder / "out/nonlinear.json").find("\"values missing\": 2"), std::string::npos);
  run_nonlinear(study, folder / "out", {});
  EXPECT_EQ(contents(folder / "out/nonlinear.json").find("values missing"), std::string::npos);
}

TEST(Nonlinear, WarnsOfWhatASceneDoubts) {
  const SweepFolder folder;
  const std::string crank =
      "bodies: {crank: {rigid: {mass: 1 kg, inertia: 1}}}\njoints: {pin: {revolute: [ground, crank]}}\n"
      "start: {crank: {angle: 30}}\nrun: {until: 1 s}\n";
  const Followed done = follow_study(folder, crank, "section: {every: 0.1 s, record: [crank.angle], transient: 0, returns: 2}\n");
  ASSERT_EQ(done.rows.at(0).warnings.size(), 1u);
  EXPECT_NE(done.rows[0].warnings[0].find("30"), std::string::npos) << done.rows[0].warnings[0];
  EXPECT_NE(contents(folder / "out/warnings.csv").find("30"), std::string::npos);
}

// By energy 1/12 a section of Hénon and Heiles' (1964) at x = 0, x' > 0 keeps H.
TEST(Nonlinear, ASectionOfHenonAndHeilesKeepsItsEnergy) {
  const SweepFolder folder;
  const Followed done = follow_study(folder,
                                     "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
                                     "joints: {held: {weld: [ground, plate]}}\n"
                                     "states:\n"
                                     "  x: {rate: u/(1 s), start: 0}\n"
                                     "  y: {rate: w/(1 s), start: 0.1}\n"
                                     "  u: {rate: \"(-x - 2*x*y)/(1 s)\", start: sqrt(1/6 - 0.01 + 0.002/3)}\n"
                                     "  w: {rate: \"(-y - x^2 + y^2)/(1 s)\", start: 0}\n"
                                     "run: {until: 500 s, tolerance: 1e-11, method: verner87}\n",
                                     "section: {when: x > 0, record: [x, y, u, w], transient: 0, returns: 40}\n");
  ASSERT_EQ(done.values.at(0).orbit.signals.size(), 40u);
  for (const std::vector<double>& r : done.values[0].orbit.signals) {
    const double x = r[0], y = r[1], u = r[2], w = r[3];
    EXPECT_NEAR(x, 0, 1e-10);
    EXPECT_GT(u, 0);
    EXPECT_NEAR((u * u + w * w + x * x + y * y) / 2 + x * x * y - y * y * y / 3, 1.0 / 12, 1e-8);
  }
}

/// All that a study is told while it goes on, and what it has come to.
struct Told {
  SweepEnd end;
  std::vector<FollowedValue> values;
  std::vector<double> shares;  ///< of the values that are being followed
};

Told told_of(const SweepFolder& folder, const std::string& scene, const std::string& text) {
  folder.write("scene.yaml", scene);
  folder.write("study.yaml", "scene: scene.yaml\n" + text);
  const Nonlinear study = read_nonlinear(folder / "study.yaml");
  Told out;
  out.end = run_nonlinear(study, folder / "out", {}, [&](const Underway& now) {
    if (now.values > 0) out.shares.push_back(now.share / static_cast<double>(now.values));
  });
  out.values = followed(study, out.end.rows);
  return out;
}

// More than any machine does in the time: a million returns are a thousand million steps.
TEST(Nonlinear, AValueOverItsLimitKeepsWhatCameAndTheNextBegins) {
  const SweepFolder folder;
  const Told told = told_of(folder, lorenz,
                            "section: {every: 100 s, record: X, transient: 0, returns: 1000000}\nover: {rho: [28, 29]}\n"
                            "limit: 0.5 s\n");
  ASSERT_EQ(told.values.size(), 2u);
  for (const FollowedValue& value : told.values) {
    EXPECT_EQ(value.status, "over its limit");
    EXPECT_NE(value.reason.find("of computing, at return"), std::string::npos) << value.reason;
    EXPECT_LT(value.orbit.t.size(), 1'000'000u);
  }
  EXPECT_TRUE(told.end.whole);
}

TEST(Nonlinear, AValueOfTooManyStepsFailsAtThatStep) {
  for (const char* asked :
       {"section: {every: 1 s, record: X}", "section: {when: Z > rho - 1, record: X}", "lyapunov: {every: 1 s, over: 100 s}"}) {
    const SweepFolder folder;
    const Told told = told_of(folder, lorenz, std::string(asked) + "\nmost steps: 50\n");
    ASSERT_EQ(told.values.size(), 1u);
    EXPECT_EQ(told.values[0].status, "failed") << asked;
    EXPECT_EQ(told.end.rows[0].steps, 50) << asked;
  }
}

TEST(Nonlinear, TellsHowFarAValueIs) {
  for (const char* asked :
       {"section: {every: 4 s, record: X, transient: 20, returns: 20}", "section: {when: Z > rho - 1, record: X, returns: 20}",
        "section: {every: 1 s, record: X, transient: 5, returns: 5}\nlyapunov: {every: 1 s, over: 100 s}"}) {
    const SweepFolder folder;
    const Told told = told_of(folder, lorenz, std::string(asked) + "\n");
    EXPECT_EQ(told.values.at(0).status, "finished") << told.values[0].reason;
    double before = 0;
    for (const double share : told.shares) {
      EXPECT_GE(share, before) << asked;
      EXPECT_LE(share, 1) << asked;
      before = share;
    }
  }
}

TEST(Nonlinear, LimitsStandWhereTheirStudyHasThem) {
  const SweepFolder folder;
  folder.write("scene.yaml", lorenz);
  const auto said = [&](const std::string& text, const auto& read) -> std::string {
    folder.write("study.yaml", "scene: scene.yaml\n" + text);
    try {
      read(folder / "study.yaml", Overrides{});
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const std::string of_a_sweep = said("measure: max X\nsweep: {grid: {rho: [28]}}\nlimit: 1 s\n", read_sweep);
  EXPECT_NE(of_a_sweep.find("study.yaml:4"), std::string::npos) << of_a_sweep;
  EXPECT_NE(of_a_sweep.find("under sweep"), std::string::npos) << of_a_sweep;
  const std::string none = said("section: {every: 1 s, record: X}\nlimit: 0 s\n", read_nonlinear);
  EXPECT_NE(none.find("study.yaml:3"), std::string::npos) << none;
  const std::string of_nonlinear = said("section: {every: 1 s, record: X}\n", read_sweep);
  EXPECT_NE(of_nonlinear.find("run pintle nonlinear"), std::string::npos) << of_nonlinear;
  const std::string steps = said("section: {every: 1 s, record: X}\nmost steps: 0\n", read_nonlinear);
  EXPECT_NE(steps.find("most steps"), std::string::npos) << steps;
}

struct Refused {
  const char* study;
  std::vector<std::string> words;
};

TEST(Nonlinear, WhatIsWrongElsewhereIsNotSaidOfTheStudy) {
  const SweepFolder folder;
  folder.write("scene.yaml", lorenz);
  folder.write("study.yaml", "scene: scene.yaml\nlyapunov: {every: 1 s, over: 100 s}\n");
  const auto said = [&](const std::string& file, const Overrides& set) -> std::string {
    try {
      read_nonlinear(folder / file, set);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const std::string parameter = said("study.yaml", {{"ro", "1"}});
  EXPECT_NE(parameter.find("--set ro"), std::string::npos) << parameter;
  EXPECT_EQ(parameter.find("lyapunov"), std::string::npos) << parameter;
  const std::string scene = said("scene.yaml", {});
  EXPECT_NE(scene.find("is a scene, not a study"), std::string::npos) << scene;
  EXPECT_NE(scene.find("section: {"), std::string::npos) << scene;
}

TEST(Nonlinear, WhatIsWrongIsNamedWithItsRemedy) {
  const SweepFolder folder;
  folder.write("scene.yaml", lorenz);
  for (const Refused& one : std::vector<Refused>{
           {"measure: energy lost", {"study.yaml", "neither section nor lyapunov", "add"}},
           {"section: {every: 1 s, when: X > 0, record: X}", {"study.yaml:2", "section"}},
           {"section: {every: 1 s}", {"study.yaml:2", "record"}},
           {"section: {evry: 1 s, record: X}", {"study.yaml:2", "evry", "every"}},
           {"section: {every: 1 m, record: X}", {"study.yaml:2", "section.every", "time"}},
           {"section: {every: 1 s, record: [Q]}", {"study.yaml:2", "section.record", "Q"}},
           {"section: {when: X > , record: [X]}", {"study.yaml:2", "section.when"}},
           {"section: {every: 1 s, record: [X, X]}", {"study.yaml:2", "twice", "leave one out"}},
           {"section: {every: 1 s, record: X, returns: 1}", {"study.yaml:2", "section.returns"}},
           {"section: {every: 1 s, record: X}\ndirection: both", {"study.yaml:3", "direction", "over"}},
           {"section: {every: 1 s, record: X}\nover: {rho: [1, 2], beta: [1]}", {"study.yaml:3", "over", "name one"}},
           {"section: {every: 1 s, record: X}\nover: {ro: [1, 2]}", {"study.yaml:3", "over", "rho"}},
           {"section: {every: 1 s, record: X}\nover: {rho: [1]}\ndirection: up", {"study.yaml:4", "direction", "forwards"}},
           {"orbit: {period: 2}\nlyapunov: {every: 1 s, over: 2 s}", {"study.yaml:2", "orbit", "section", "add"}},
           {"section: {every: 1 s, record: X, returns: 4}\norbit: {period: 4}", {"study.yaml:3", "orbit.period", "4", "record more"}},
           {"section: {every: 1 s, record: X}\norbit: {periods: 4}", {"study.yaml:3", "periods", "period"}},
           {"lyapunov: {every: 1 s}", {"study.yaml:2", "over"}},
           {"set: {bodies.plat.rigid.mass: 2 kg}\nlyapunov: {every: 1 s, over: 2 s}",
            {"study.yaml:2: set.bodies.plat", "Did you mean \"plate\""}},
           {"section: {every: 1 s, record: X}\nbasins: {grid: {start.plat.x: [0 m, 1 m]}}", {"study.yaml:3", "Did you mean \"plate\""}},
           {"lyapunov: {every: 1 s, over: 0.4 s}", {"study.yaml:2", "lyapunov", "over is 0.4 s", "every", "many"}},
           {"lyapunov: {every: 1 s, over: 2 s, distance: 2}", {"study.yaml:2", "lyapunov.distance", "0 and 1"}},
           {"lyapunov: {every: 1 s, over: 2 s}\nsweep: {grid: {rho: [1]}}", {"study.yaml:3", "sweep", "leave it out"}}}) {
    folder.write("study.yaml", std::string("scene: scene.yaml\n") + one.study + "\n");
    try {
      read_nonlinear(folder / "study.yaml");
      ADD_FAILURE() << "accepted: " << one.study;
    } catch (const SceneError& error) {
      for (const std::string& word : one.words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << one.study << "\n  " << error.what() << "\n  lacks " << word;
    }
  }
}

}  // namespace
}  // namespace pintle
