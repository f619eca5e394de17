// What `pintle check` says a run will cost, against the run itself. Counts are judged, times are not.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "framework/analysis/cost/cost_estimate.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/analysis/cost/simpler.h"
#include "framework/common/processor_time.h"
#include "framework/integration/integrator.h"
#include "framework/mechanism/table.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/worn_slider_crank.h"

namespace pintle {
namespace {

struct Case {
  explicit Case(Scene s) : scene(std::move(s)), model(build(scene)), assembly(assemble(scene, model)) {}
  explicit Case(const std::string& file) : Case(read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/" + file)) {}
  pintle::Run run() const { return simulate(scene, model, assembly); }
  Scene scene;
  Model model;
  Assembly assembly;
};

// Not of the clock on the wall: a listener that waits takes none.
TEST(ComputingTime, IsThatOfTheProcessor) {
  Case c("pendulum.yaml");
  c.scene.run.until = 1e-2;
  Listeners waiting;
  waiting.progress = [](double) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return true;
  };
  const double begin = processor_time();
  const pintle::Run run = simulate(c.scene, c.model, c.assembly, waiting);
  const double spent = processor_time() - begin;
  EXPECT_EQ(run.status, Status::finished) << run.reason;
  EXPECT_GT(run.seconds, 0);
  EXPECT_LE(run.seconds, spent);
}

constexpr double thorough = 20;  // seconds of trials that all runs here end well before
// Steps are guessed from a part of the run; impacts and turning cranks do not come evenly.
constexpr double within = 2;

TEST(CostEstimate, OfAShortRunIsCountedToTheStep) {
  for (const char* file : {"pendulum.yaml", "four_bar_spring.yaml"}) {
    SCOPED_TRACE(file);
    Case c(file);
    c.scene.output.frames = 0;
    const CostEstimate p = estimate_cost(c.scene, c.model, c.assembly, thorough);
    const pintle::Run run = c.run();
    EXPECT_TRUE(p.run.trial.whole);
    EXPECT_EQ(p.run.trial.steps, run.counts.steps);
    EXPECT_EQ(p.run.trial.rejected, run.counts.rejected);
    EXPECT_EQ(p.run.steps.likely, static_cast<double>(run.counts.steps));
    EXPECT_EQ(p.run.steps.low, p.run.steps.high);
    EXPECT_EQ(p.output.rows, static_cast<long>(run.trajectory.rows()));
    EXPECT_EQ(p.output.columns, run.trajectory.columns() + run.ledger.columns());
    const double bytes = static_cast<double>(csv(run.trajectory).size() + csv(run.ledger).size());
    EXPECT_NEAR(p.output.bytes(), bytes, 0.2 * bytes) << "the lengths of numbers differ";
  }
}

TEST(CostEstimate, OfALongRunIsToldFromAPartOfItWithinAFactorOfTwo) {
#if defined(PINTLE_SANITIZED)
  GTEST_SKIP() << "a trial run of a stated time sees too few steps";
#endif
  const std::pair<const char*, double> cases[] = {
      {"slider_crank_clearance.yaml", 0.03}, {"paper/fig12_flexible.yaml", 0.2}, {"paper/table2_100.yaml", 0.03}};
  for (const auto& [file, seconds] : cases) {
    SCOPED_TRACE(file);
    Case c(file);
    c.scene.output.frames = 0;
    const CostEstimate p = estimate_cost(c.scene, c.model, c.assembly, seconds);
    ASSERT_FALSE(p.run.trial.whole) << "nothing was guessed";
    ASSERT_LT(p.run.trial.reached, 0.8 * c.scene.run.until) << "little was guessed";
    const double steps = static_cast<double>(c.run().counts.steps);
    EXPECT_LT(p.run.steps.likely, within * steps);
    EXPECT_GT(p.run.steps.likely, steps / within);
    EXPECT_LE(p.run.steps.low, p.run.steps.likely);
    EXPECT_GE(p.run.steps.high, p.run.steps.likely);
    EXPECT_TRUE(certainty(p).find("estimated from") == 0) << certainty(p);
  }
}

TEST(CostEstimate, HasTheSameCountsEachTime) {
#if defined(PINTLE_SANITIZED)
  GTEST_SKIP() << "a trial run of a stated time sees too few steps";
#endif
  Case c("slider_crank_clearance.yaml");
  c.scene.output.frames = 0;
  const CostEstimate one = estimate_cost(c.scene, c.model, c.assembly, 0.02), two = estimate_cost(c.scene, c.model, c.assembly, 0.02);
  ASSERT_FALSE(one.run.trial.by_clock || two.run.trial.by_clock);
  EXPECT_EQ(one.run.trial.steps, two.run.trial.steps);
  EXPECT_EQ(one.run.trial.evaluations, two.run.trial.evaluations);
  EXPECT_EQ(one.run.trial.reached, two.run.trial.reached);
  EXPECT_EQ(one.run.steps.likely, two.run.steps.likely);
}

TEST(CostEstimate, StepsThatComeEvenlyAreSureAndOthersGiveARange) {
  std::vector<double> even, fading;
  for (int i = 1; i <= 400; ++i) even.push_back(0.001 * i);
  const Estimate sure = steps_of_run(even, 4);
  EXPECT_NEAR(sure.likely, 4000, 40);
  EXPECT_NEAR(sure.low, sure.high, 80) << "one step more or less in a quarter";
  double t = 0;
  while (t < 1) fading.push_back(t += 1e-3 * (1 + 3 * t));  // impacts that die out: a step grows fourfold
  const Estimate range = steps_of_run(fading, 4);
  EXPECT_LT(range.low, 0.7 * range.high);
  EXPECT_LT(range.low, range.likely);
  EXPECT_EQ(steps_of_run(even, 0.4).likely, 400);
}

TEST(CostEstimate, SaysWhyARunThatStopsCannotBeTold) {
  Case c("pendulum.yaml");
  c.scene.output.frames = 0;
  c.scene.run.max_steps = 10;
  c.model = build(c.scene);
  const CostEstimate p = estimate_cost(c.scene, c.model, c.assembly);
  EXPECT_NE(certainty(p).find("max steps reached"), std::string::npos) << certainty(p);
}

std::vector<std::string> names(const std::vector<Saving>& of) {
  std::vector<std::string> out;
  for (const Saving& s : of) out.push_back(s.what);
  std::sort(out.begin(), out.end());
  return out;
}

TEST(CostEstimate, OffersWhatTheSceneHasAndNothingElse) {
#if defined(PINTLE_SANITIZED)
  GTEST_SKIP() << "a trial run of a stated time sees too few steps";
#endif
  Case c("pendulum.yaml");
  c.scene.output.frames = 0;
  const CostEstimate plain = estimate_cost(c.scene, c.model, c.assembly);
  EXPECT_EQ(names(plain.simpler), (std::vector<std::string>{"a tenth of the rows written", "tolerance 1e-09 instead of 1e-11"}));
  EXPECT_EQ(plain.terms, (std::vector<std::string>{"constant inertia of 1 rigid body", "gravity", "1 joint"}));
  EXPECT_EQ(plain.largest_rate, 0);

  Case worn("paper/table3_case3.yaml");
  worn.scene.output.frames = 0;
  const CostEstimate p = estimate_cost(worn.scene, worn.model, worn.assembly, 0.2);
  EXPECT_TRUE(p.untried.empty());
  const std::vector<std::string> offered = names(p.simpler);
  for (const char* what : {"ideal", "rigid", "half its shapes", "no friction", "tolerance"})
    EXPECT_TRUE(std::any_of(offered.begin(), offered.end(), [&](const std::string& s) { return s.find(what) != std::string::npos; }))
        << what;
  EXPECT_TRUE(std::is_sorted(p.simpler.begin(), p.simpler.end(), [](const Saving& a, const Saving& b) { return a.saved > b.saved; }));
}

// ---- the simpler models are those of the simpler scenes -----------------------------------------

const std::string worn_and_flexible = std::string(R"(
gravity: [0, -9.81]
bodies:
  crank: {rigid: {mass: 0.3 kg, inertia: 1e-4}, points: {O: [-25 mm, 0], A: [25 mm, 0]}}
  coupler:
    beam: {from: A, to: B, section: {circle: 10 mm}, elements: 10, young: 207 GPa, poisson: 0.3, mass: 0.2 kg}
    points: {A: [0, 0], B: [120 mm, 0]}
    modes: {frame: chord, count: 4}
    damping: {ratios: 0.02}
    pose: {at: [50 mm, 0]}
  slider: {rigid: {mass: 0.14 kg, inertia: 1e-4}, points: {P: [0, 0]}, pose: {at: [170 mm, 0]}}
)") + worn_joints("1e9") + R"(start: {crank: {angle: 0, speed: 150}}
run: {until: 2 ms, method: dopri5}
)";

const Simpler& find(const std::vector<Simpler>& all, const std::string& what) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Simpler& s) { return s.what.find(what) != std::string::npos; });
  if (found == all.end()) throw std::runtime_error("nothing offered is called " + what);
  return *found;
}
/// @returns the simpler model's steps and those of a run of the scene that says the same
std::pair<long, long> steps(const Simpler& simpler, const Scene& scene) {
  Integrator run(simpler.system, simpler.scheme, simpler.start);
  while (run.state().t < scene.run.until && run.advance(scene.run.until)) {
  }
  EXPECT_EQ(run.failure(), "");
  return {run.counts().steps, Case(scene).run().counts.steps};
}

struct Simplification {
  const char* what;
  void (*in_words)(Scene&);
};
const Simplification simplifications[] = {
    {"\"coupler\" rigid", [](Scene& s) { s.bodies[1].elastic->modes.reset(), s.bodies[1].elastic->damping.reset(); }},
    {"half its shapes", [](Scene& s) { s.bodies[1].elastic->modes->keep.count = 2; }},
    {"\"gudgeon pin\" ideal", [](Scene& s) { s.joints[2].clearance.reset(); }},
    {"no friction", [](Scene& s) { s.joints[2].clearance->friction.reset(); }},
    {"tolerance 1e-06", [](Scene& s) { s.run.tolerance = 1e-6; }}};

TEST(SimplerModel, RunsAsTheSceneThatSaysTheSame) {
  const Case full(read_scene_text(worn_and_flexible, "worn.yaml"));
  const std::vector<Simpler> offered = simpler_models(full.scene, full.model, full.assembly.start);
  EXPECT_EQ(offered.size(), std::size(simplifications));
  for (const Simplification& s : simplifications) {
    SCOPED_TRACE(s.what);
    const Simpler& simpler = find(offered, s.what);
    Scene scene = full.scene;
    s.in_words(scene);
    const Case built(scene);
    EXPECT_EQ(simpler.system.n(), built.model.system.n());
    EXPECT_EQ(simpler.system.n_rows(), built.model.system.n_rows());
    EXPECT_EQ(simpler.system.n_z(), built.model.system.n_z());
    EXPECT_EQ(name(simpler.scheme), name(built.model.scheme));
    EXPECT_EQ(simpler.scheme.tolerance, built.model.scheme.tolerance);
    const auto [tried, run] = steps(simpler, scene);
    EXPECT_NEAR(static_cast<double>(tried), static_cast<double>(run), 0.02 * static_cast<double>(run) + 2);
  }
}

TEST(SimplerModel, MadeIdealAWornPinRunsAsTheIdealOneWhateverModelItHad) {
  for (const ClearanceModel model : {ClearanceModel::contact, ClearanceModel::massless_link, ClearanceModel::spring_damper}) {
    SCOPED_TRACE(static_cast<int>(model));
    Scene scene = read_scene_text(worn_and_flexible, "worn.yaml");
    scene.run.until = 0.5e-3;
    // Two of them, so that the numbers of joints shift where a link goes.
    scene.joints[1].clearance = scene.joints[2].clearance;
    scene.joints[1].clearance->bearing = "coupler";
    for (const std::size_t j : {1u, 2u}) scene.joints[j].clearance->model = model;
    const Case full(scene);
    const std::vector<Simpler> offered = simpler_models(full.scene, full.model, full.assembly.start);
    const auto same = [&](const Simpler& simpler, std::initializer_list<std::size_t> ideal) {
      SCOPED_TRACE(simpler.what);
      Scene said = scene;
      for (const std::size_t j : ideal) said.joints[j].clearance.reset();
      EXPECT_EQ(simpler.system.n_rows(), Case(said).model.system.n_rows());
      const auto [tried, run] = steps(simpler, said);
      EXPECT_NEAR(static_cast<double>(tried), static_cast<double>(run), 0.05 * static_cast<double>(run) + 2);
    };
    same(find(offered, "\"crank pin\" ideal"), {1});
    same(find(offered, "\"gudgeon pin\" ideal"), {2});
    same(find(offered, "every clearance ideal"), {1, 2});
  }
}

}  // namespace
}  // namespace pintle
