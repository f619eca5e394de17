// What becomes of nonlinear studies: threads, interruption, limits, progress and messages.
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
