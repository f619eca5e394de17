// Study files, and cases that do not know of each other.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <thread>

#include "framework/common/processor_time.h"
#include "framework/scene/yaml/override.h"
#include "framework/study/study.h"
#include "tests/unit/scene_text.h"
#include "tests/unit/worn_slider_crank.h"
#include "tests/refusal.h"

namespace pintle::study_test {
namespace {

const std::string knocking = worn_slider_crank + R"(start: {crank: {angle: 0 deg, speed: speed}}
run: {until: 2 ms, tolerance: 1e-8}
output: {every: 20 us}
)";

/// The coupler of a plate with two eyes: meshed by Gmsh, reduced.
const Overrides meshed{{"bodies.coupler",
                        "{plate: {link: {eye bar: {length: 120 mm, width: 14 mm, eyes: [{bore: 16 mm, outer: 30 mm}, {bore: 16 mm, "
                        "outer: 30 mm}]}}, thickness: 6 mm, "
                        "size: 10 mm, young: 70 GPa, poisson: 0.33, density: 2700 kg/m^3}, points: {A: {hole: eye 1, coupling: rigid}, "
                        "B: {hole: eye 2, coupling: rigid}}, "
                        "modes: {frame: {chord: [A, B]}, craig-bampton: {count: 2}}, damping: {ratios: 0.01}}"},
                       {"run.until", "0.2 ms"}};

std::vector<Measure> some_measures() {
  std::vector<Measure> out;
  for (const char* words : {"force at gudgeon pin at the end", "energy lost", "x of slider at the end", "speed of crank at 0.1 ms",
                            "deflection of coupler at the end"})
    out.push_back({words, words});
  return out;
}

std::string refusal(const fs::path& study) {
  return pintle_test::refusal_by([&] { read_study(study); });
}

TEST(Study, IsReadWithItsSceneItsOverridesAndItsMeasures) {
  const Folder folder;
  fs::create_directories(folder.path / "scenes");
  folder.write("scenes/knocking.yaml", knocking);
  const StudyFile file = read_study(folder.write(
      "study.yaml",
      "title: A study\nscene: scenes/knocking.yaml\nset: {run.until: 3 ms, clearance: 0.2 mm, joints.gudgeon pin.clearance.friction: "
      "{ambrosio: {coefficient: 0.1}}}\nmeasure: {peak: peak force at gudgeon pin, lost: energy lost}\nsweep: {grid: {speed: [1, "
      "2]}}\n"));
  EXPECT_EQ(file.study.title, "A study");
  EXPECT_EQ(file.study.scene.text, knocking);
  ASSERT_EQ(file.study.measures.size(), 2u);
  EXPECT_EQ(file.study.measures[0].name, "peak");
  EXPECT_EQ(file.study.measures[0].words, "peak force at gudgeon pin");
  EXPECT_EQ(file.study.measures[1].place.line, 4);
  EXPECT_TRUE(file.root().has("sweep"));
  const Scene scene = common_scene(file.study.scene);
  EXPECT_EQ(scene.run.until, 3e-3);
  EXPECT_EQ(scene.joints[2].clearance->radial, 2e-4);
  EXPECT_EQ(scene.joints[2].clearance->friction->coefficient, 0.1);
  for (const char* measure : {"[energy lost, impacts]", "energy lost"})
    EXPECT_EQ(read_study(folder.write("short.yaml", std::string("scene: scenes/knocking.yaml\nmeasure: ") + measure + "\n"))
                  .study.measures[0]
                  .name,
              "energy lost");
}

TEST(Study, ThatIsWrongSaysWhereAndWhatToDo) {
  const Folder folder;
  folder.write("knocking.yaml", knocking);
  const std::string good = "scene: knocking.yaml\nset: {run.until: 3 ms}\nmeasure: {peak: peak force at gudgeon pin}\nsweep: {}\n";
  ASSERT_EQ(refusal(folder.write("good.yaml", good)), "accepted");
  struct Bad {
    std::string from, to, place;
    std::vector<std::string> says;
  };
  for (const Bad& b : std::vector<Bad>{
           {"scene: k", "scen: k", "study.yaml:1: scen: ", {"Did you mean \"scene\"?"}},
           {"scene: knocking", "scene: knockin", "study.yaml:1: scene: ", {"there is no file", "relative to the study"}},
           {good, "# nothing\n", "study.yaml: ", {"is empty", "docs/studies.md"}},
           {good,
            knocking,
            "study.yaml: ",
            {"is a scene, not a study", "scene: study.yaml", "peak force at main bearing", "clearance: [0.1 mm, …]"}},
           {"{peak:", "{\"peak [kN]\":", "study.yaml:3: measure.peak [kN]: ", {"the unit kN", "measured in N", "leave the unit out"}},
           {"{peak: peak force at gudgeon pin}",
            "{a: energy lost, \"a [J]\": final kinetic energy}",
            "study.yaml:3: measure: ",
            {"\"a\" twice"}},
           {"measure: {peak: peak force at gudgeon pin}\n", "", "study.yaml:1: ", {"lacks a required key", "measure: {"}},
           {"gudgeon pin}", "gudgin pin}", "study.yaml:3: measure.peak: ", {"Did you mean \"gudgeon pin\"?"}},
           {"{peak: peak force at gudgeon pin}", "[energy lost, energy lost]", "study.yaml:3: measure: ", {"twice"}},
           {"{peak: peak force at gudgeon pin}", "{}", "study.yaml:3: measure: ", {"measures nothing"}},
           {"peak force at gudgeon pin", "x of slider at 4 ms", "study.yaml:3: measure.peak: ", {"after the end of the run"}},
           {"run.until: 3 ms", "run.untl: 3 ms", "study.yaml:2: set.run.untl: ", {"Did you mean \"until\"?"}},
           {"set: {run.until: 3 ms}", "set: 3 ms", "study.yaml:2: set: ", {"overrides of the scene"}},
           {"run.until: 3 ms", "run: null", "knocking.yaml: run: ", {"run: {until: 1 s}"}}}) {
    SCOPED_TRACE(b.to);
    std::string text = good;
    text.replace(text.find(b.from), b.from.size(), b.to);
    const std::string said = refusal(folder.write("study.yaml", text));
    EXPECT_NE(said.find("/" + b.place), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    expect_says(said, b.says);
  }
}

TEST(Study, MeasureNamedWithItsUnitHasItOnce) {
  const Folder folder;
  folder.write("knocking.yaml", knocking);
  const Study study = read_study(folder.write("study.yaml",
                                              "scene: knocking.yaml\nmeasure: {\"peak [N]\": peak force at gudgeon pin, \"[N]\": "
                                              "least force x at guide, \"first [run 1]\": energy lost, \"hits [ ]\": impacts}\n"))
                          .study;
  std::vector<std::string> names;
  for (const Measure& m : study.measures) names.push_back(m.name);
  EXPECT_EQ(names, (std::vector<std::string>{"peak", "[N]", "first [run 1]", "hits [ ]"}));
}

TEST(Study, MeasureThatOnlyAFlexibleBodyHasIsRefusedWhereNoCaseHasOne) {
  Scene scene = read_scene_text(knocking, "knocking.yaml");
  for (const char* words : {"peak stress at coupler.B", "deflection of coupler at 1 ms", "peak displacement of coupler.B",
                            "rms coupler.B.ux", "mean coupler.mode 1"}) {
    SCOPED_TRACE(words);
    std::vector<Measure> measures(1);
    measures[0].name = measures[0].words = words;
    measures[0].place = {7, "measure.it"}, measures[0].file = "study.yaml";
    const auto rejected = [&](const std::vector<std::string>& varied) {
      return pintle_test::refusal_by([&] { validate_flexible(measures, scene, varied); });
    };
    expect_says(rejected({"clearance", "bodies.slider.rigid.mass"}),
                {"study.yaml:7: measure.it: ", "\"coupler\" is rigid in every case", "every body of the scene is rigid"});
    for (const char* path : {"bodies", "bodies.coupler", "bodies.coupler.modes"}) EXPECT_EQ(rejected({path}), "accepted") << path;
  }
  EXPECT_NO_THROW(validate_flexible({{"x", "x of coupler.B at 1 ms"}, {"f", "peak force at gudgeon pin"}}, scene, {}));
}

TEST(Case, EndsWithAStatusAndAReasonInOneLine) {
  struct Way {
    Overrides overrides;
    std::string status, reason;
    CaseLimits limits = {};
  };
  CaseLimits brief, stopped;
  brief.seconds = 1e-6;
  stopped.go_on = [] { return false; };
  for (const Way& w :
       std::vector<Way>{{{}, "finished", ""},
                        {{{"bodies.slider.rigid.mass", "-1 kg"}}, "refused", "--set bodies.slider.rigid.mass: \"-1 kg\" must"},
                        {{{"nonsense", "1"}}, "refused", "--set nonsense"},
                        {{{"run", "null"}}, "refused", "has no duration of the run"},
                        {{{"bodies.coupler.points.B.1", "0.4 m"}, {"start.slider", "{x: 0.1 m}"}}, "not assembled", "joints."},
                        {{{"run.max steps", "10"}}, "failed", "max steps reached"},
                        {{{"run.ledger bound", "1e-15"}}, "ledger over its bound", "unexplained"},
                        {{}, "over its limit", "stopped after", brief},
                        {{}, "interrupted", "stopped by the user", stopped}}) {
    SCOPED_TRACE(w.status);
    const std::vector<Measure> measures{{"final x of slider", "final x of slider"}, {"energy lost", "energy lost"}};
    const Outcome out = run_case({"knocking.yaml", knocking}, w.overrides, measures, w.limits);
    EXPECT_EQ(out.status, w.status) << out.reason;
    EXPECT_NE(out.reason.find(w.reason), std::string::npos) << out.reason;
    EXPECT_EQ(out.reason.find('\n'), std::string::npos);
    ASSERT_EQ(out.values.size(), measures.size());
    const bool measured = w.status == "finished" || w.status == "ledger over its bound";
    for (const double v : out.values) EXPECT_EQ(std::isnan(v), !measured);
  }
}

TEST(Case, TakesTheProcessorTimeOfItsThread) {
  CaseLimits waiting;
  waiting.go_on = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return true;
  };
  const double begin = processor_time();
  const Outcome out = run_case({"knocking.yaml", knocking, {{"run.until", "1 ms"}}}, {}, {}, waiting);
  const double spent = processor_time() - begin;
  EXPECT_EQ(out.status, "finished") << out.reason;
  EXPECT_TRUE(out.build_seconds > 0 && out.run_seconds > 0);
  EXPECT_LE(out.build_seconds + out.run_seconds, spent);
}

TEST(Case, TakesItsOwnOverridesAfterTheCommonOnes) {
  const Outcome out = run_case({"knocking.yaml", knocking, {{"run.until", "1 ms"}, {"speed", "10"}}}, {{"speed", "20 rad/s"}},
                               {{"speed", "speed of crank at the start"}});
  EXPECT_EQ(out.values[0], 20);
  EXPECT_EQ(out.t_end, 1e-3);
}

TEST(Case, OfAMeasureThatNoCaseCanHaveIsRefused) {
  const Outcome out = run_case({"knocking.yaml", knocking}, {}, {{"wrong", "peak force at gudgin pin"}});
  EXPECT_EQ(out.status, "refused");
  EXPECT_NE(out.reason.find("Did you mean \"gudgeon pin\"?"), std::string::npos) << out.reason;
}

/// All bits of what a case found, times aside.
std::vector<std::uint64_t> bits(const Outcome& out) {
  std::vector<std::uint64_t> all;
  const auto add = [&](double x) { all.push_back(std::bit_cast<std::uint64_t>(x)); };
  for (const double v : out.values) add(v);
  add(out.t_end), add(out.unexplained_share);
  for (const long n :
       {out.counts.steps, out.counts.rejected, out.counts.evaluations, out.counts.factorizations, out.counts.events, out.impacts})
    all.push_back(static_cast<std::uint64_t>(n));
  if (out.run)
    for (const Table* table : {&out.run->trajectory, &out.run->ledger})
      for (const double v : table->data) add(v);
  return all;
}

// Rigid and meshed bodies, explicit and implicit schemes, wrong scenes: whatever could share something hidden.
std::vector<Overrides> twenty_cases() {
  std::vector<Overrides> cases;
  for (int k = 0; k < 20; ++k) {
    Overrides o{{"clearance", std::to_string(0.02 * (k + 1)) + " mm"}, {"speed", std::to_string(100 + 10 * k) + " rad/s"}};
    if (k % 10 == 1 || k % 10 == 2) o.insert(o.end(), meshed.begin(), meshed.end());
    if (k % 10 == 7) o.emplace_back("joints.gudgeon pin.clearance", "null");
    if (k % 5 == 3) o.emplace_back("run.method", "generalized-alpha"), o.emplace_back("run.tolerance", "1e-5");
    if (k % 10 == 4) o.emplace_back("bodies.slider.rigid.mass", "-1 kg");
    if (k == 6)
      o.emplace_back("drivers", "{motor: {angle: [ground, crank], law: \"speed*t + 0.1*sin(100 rad/s*t)\"}}"),
          o.emplace_back("start", "null");
    cases.push_back(std::move(o));
  }
  return cases;
}

std::vector<Outcome> run_all(const std::vector<Overrides>& cases, int threads) {
  const CaseSource source{"knocking.yaml", knocking};
  CaseLimits keep;
  keep.keep_run = true;
  std::vector<Outcome> out(cases.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < cases.size(); k = next++) out[k] = run_case(source, cases[k], some_measures(), keep);
  };
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i) workers.emplace_back(work);
  for (std::thread& t : workers) t.join();
  return out;
}

TEST(Case, OutcomeDoesNotDependOnTheNumberOfThreadsToTheBit) {
  const std::vector<Overrides> cases = twenty_cases();
  const std::vector<Outcome> alone = run_all(cases, 1), together = run_all(cases, 4);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    EXPECT_EQ(alone[k].status, k % 10 == 4 ? "refused" : "finished") << k << ": " << alone[k].reason;
    EXPECT_EQ(alone[k].status, together[k].status) << k;
    EXPECT_EQ(alone[k].reason, together[k].reason) << k;
    EXPECT_EQ(bits(alone[k]), bits(together[k])) << k;
  }
  EXPECT_GT(alone[1].values[4], 0) << "the meshed coupler bends";
}

}  // namespace
}  // namespace pintle::study_test
