// The trade of error against time: fronts, references, chaos, what is recommended.
#include "files/trust.h"
#include "framework/plots/tradeoff_plot.h"
#include "framework/study/tradeoff/tradeoff.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "framework/study/tradeoff/refinement.h"
#include "tests/scenes/studies/known_trade.h"
#include "tests/refusal.h"

namespace pintle::tradeoff_test {
namespace {

TEST(Tradeoff, TheFrontOfATableIsWhatNothingElseBeats) {
  std::vector<TradePoint> points{point(1, 0.5), point(2, 0.6), point(2, 0.1), point(3, 0.1), point(4, 0.01), point(1, 0.7)};
  points.push_back(point(0.1, 1e-9));
  points.back().usable = false;
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 2, 4}));
  for (const std::size_t i : {1, 3, 5}) EXPECT_TRUE(points[i].dominated) << i;
  EXPECT_FALSE(points[6].dominated || points[6].front);
}

TEST(Tradeoff, WhatTheReferenceCannotTellApartIsDecidedByTime) {
  std::vector<TradePoint> points{point(3, 1e-6, 1e-3), point(1, 9e-4, 1e-3), point(2, 1e-5, 1e-3)};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1}));
  EXPECT_EQ(points[0].claimed(), 1e-3);
}

TEST(Tradeoff, TheReferenceFindsTheOrdersAndBoundsItsOwnError) {
  const TradePlan plan = known_plan();
  const Reference r = find_reference(plan, one, known);
  ASSERT_EQ(r.trouble, "");
  EXPECT_TRUE(r.of[0].converged);
  EXPECT_FALSE(r.of[0].chaotic);
  EXPECT_NEAR(r.of[0].ratio, 10, 0.1);
  EXPECT_NEAR(r.of[0].order, 2, 0.01);
  EXPECT_GE(r.of[0].error, std::abs(r.of[0].value - 2));
  EXPECT_LE(r.of[0].error, 20 * std::abs(r.of[0].value - 2)) << "an estimate, not a wide bound";
}

TEST(Tradeoff, WithoutTimeToRefineTheModelItsErrorIsStillCountedIn) {
  // Each refinement of the model is foreseen to take three times the last run: past what there is to spend.
  const CaseRunner slow = [](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) {
    Outcome o = known(set, m, l);
    o.run_seconds = tolerance_of(known_plan(), set) < 2e-7 ? 1e6 : 0.001;
    return o;
  };
  const Reference r = find_reference(known_plan(), one, slow, 60);
  ASSERT_EQ(r.trouble, "");
  EXPECT_FALSE(r.of[0].converged);
  EXPECT_NEAR(r.of[0].value, 2 * (1 + 0.125 / 64), 1e-6) << "of 8 elements";
  EXPECT_GE(r.of[0].error, std::abs(r.of[0].value - 2));
}

TEST(Tradeoff, TheCheapestSettingForAnErrorIsRecommendedWithItsBottleneck) {
  TradePlan plan = known_plan();
  plan.error = 0.01;
  const TradeReport r = run_tradeoff(plan, one, known);
  ASSERT_TRUE(r.recommended);
  // Errors: 1e-2 alone is over; h = 1/4 gives 0.125/16 = 0.78 %, with tolerance 1e-4 0.79 %.
  EXPECT_EQ(setting_text(plan, r.points[*r.recommended]), "tolerance 1e-4, elements 4");
  EXPECT_EQ(r.points.size(), 13U);
  EXPECT_EQ(r.points[*r.recommended].times.size(), 3U);
  EXPECT_NEAR(r.points[*r.recommended].error, 1e-4 + 0.125 / 16, 2e-4);
  EXPECT_NEAR(r.points[*r.recommended].model[0], 0.125 / 16, 2e-4) << "the model's share";
  const auto b = bottleneck(r, *r.recommended);
  ASSERT_TRUE(b);
  EXPECT_EQ(plan.axes[b->axis].name, "elements");
  // From 1e-6 to 1e-4 the error of the elements, 0.195 %, becomes 0.205 %; a tenth of it counts as no loss.
  const std::size_t finest = r.points.size() - 1;
  const auto free = free_coarsenings(r, finest);
  ASSERT_EQ(free.size(), 1U);
  EXPECT_EQ(plan.axes[free[0].axis].name, "tolerance");
  EXPECT_EQ(plan.axes[0].values[free[0].to].label, "1e-4");
}

TEST(Tradeoff, TheMostAccurateSettingWithinATimeIsFound) {
  TradePlan plan = known_plan();
  plan.time = 26;  // 4 elements at 1e-4 take 25.2, at 1e-6 63.4, 8 elements at 1e-2 20.1
  const TradeReport r = run_tradeoff(plan, one, known);
  ASSERT_TRUE(r.best_in_time);
  EXPECT_EQ(setting_text(plan, r.points[*r.best_in_time]), "tolerance 1e-4, elements 4");
}

TEST(Tradeoff, ASettingThatIsRefusedIsARowWithItsReason) {
  TradePlan plan = known_plan();
  const TradeReport r = run_tradeoff(plan, one, [](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) {
    Outcome o = known(set, m, l);
    if (number_of(set, "bodies.rod.beam.elements", 4) == 2) o = Outcome{}, o.status = "refused", o.reason = "two, is never, right";
    return o;
  });
  int rejected = 0;
  for (const TradePoint& p : r.points) rejected += p.status == "refused" && !p.usable && p.reason == "two, is never, right";
  EXPECT_EQ(rejected, 3);
  EXPECT_TRUE(r.recommended);
  const std::string csv = tradeoff_csv(r);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 14);
  EXPECT_NE(csv.find("\"two, is never, right\""), std::string::npos);
}

TEST(Tradeoff, WithoutAReferenceNothingIsRecommendedAndTheReasonIsSaid) {
  const TradeReport r = run_tradeoff(known_plan(), one, [](const Overrides&, const std::vector<Measure>&, const CaseLimits&) {
    Outcome o;
    o.status = "not assembled", o.reason = "it stays open";
    return o;
  });
  EXPECT_FALSE(r.recommended);
  ASSERT_EQ(r.said.size(), 1U);
  EXPECT_NE(r.said[0].find("it stays open"), std::string::npos);
}

TEST(Tradeoff, ABudgetIsKept) {
  TradePlan plan;
  std::vector<std::string> many;
  for (int i = 1; i <= 40; ++i) many.push_back(std::to_string(i));
  plan.axes = {axis("tolerance", "run.tolerance", {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6"}),
               axis("elements", "bodies.rod.beam.elements", many)};
  plan.budget = 1;
  plan.error = 0.01;
  int runs = 0;
  const TradeReport r = run_tradeoff(plan, one, [&](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) {
    ++runs;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    Outcome o = known(set, m, l);
    o.run_seconds = 0.01;
    return o;
  });
  EXPECT_LT(runs, 200);  // at most 100 fit the budget; 200 settings, each run at least twice, would be 400
  EXPECT_TRUE(r.recommended);
  int unrun = 0;
  for (const TradePoint& p : r.points) unrun += !p.usable && !p.reason.empty();
  EXPECT_GT(unrun, 0) << "what was not run says why";
}

/// x' = 4 x (1 − x) a tenth of a second, from 0.3 with a disturbance: doubles any difference each step, on average.
Outcome logistic(const Overrides& set, const std::vector<Measure>&, const CaseLimits& limits) {
  const double t = number_of(set, "run.tolerance", 1e-8);
  auto run = std::make_shared<Run>();
  run->trajectory.header = {"t [s]", "x [m]"};
  double x = 0.3 + t;
  for (int i = 0; i < 120; ++i, x = 4 * x * (1 - x)) run->trajectory.data.insert(run->trajectory.data.end(), {0.1 * i, x});
  Outcome o = finished({x, 1 + t}, 0.01);
  if (limits.keep_run) o.run = run;
  return o;
}

TEST(Tradeoff, AChaoticQuantityIsJudgedByItsStatisticsAndARegularOneBesideItIsNot) {
  TradePlan plan;
  plan.axes = {axis("tolerance", "run.tolerance", {"1e-4", "1e-6"})};
  plan.ensemble = 40;
  const std::vector<Measure> two{{"end", "end"}, {"regular", "regular"}};
  const Reference r = find_reference(plan, two, logistic);
  ASSERT_EQ(r.trouble, "");
  EXPECT_TRUE(r.of[0].chaotic);
  EXPECT_FALSE(r.of[1].chaotic);
  EXPECT_TRUE(r.of[1].converged);
  // The invariant density 1/(π√(x(1 − x))) has mean 1/2 and deviation 1/√8; a step doubles a difference: rate 10 ln 2.
  EXPECT_NEAR(r.of[0].value, 0.5, 4 * r.of[0].error);
  EXPECT_NEAR(r.of[0].spread, 1 / std::sqrt(8), 0.1);
  EXPECT_NEAR(r.of[0].rate, 10 * std::log(2), 0.3 * 10 * std::log(2));
  EXPECT_NE(r.of[0].words.find("chaotic"), std::string::npos);
}

TEST(Tradeoff, OfAPendulumTheReferenceAndEveryErrorAreHonestAgainstTheClosedForm) {
  // From the horizontal it hangs straight down after K(sin 45°) √(L/g), L = (J + m l²)/(m l): there the angle is −π/2.
  const double length = (0.01 + 0.5 * 0.04) / (0.5 * 0.2), quarter = std::comp_ellint_1(std::sqrt(0.5)) * std::sqrt(length / 9.81),
               exact = -std::acos(0.0);
  const CaseSource source{"pendulum.yaml", pendulum, {}};
  const std::string at = "angle of rod at " + std::to_string(quarter) + " s";
  const double given = std::stod(std::to_string(quarter)), speed = std::sqrt(2 * 9.81 / length);
  const double there = exact - speed * (given - quarter);  // the instant is written to a microsecond; the rate is at its peak there
  const std::vector<Measure> angle{{"angle", at}};
  TradePlan plan;
  plan.axes = {axis("tolerance", "run.tolerance", {"1e-3", "1e-5", "1e-7"}), axis("scheme", "run.method", {"rkf45", "generalized-alpha"}),
               axis("constraints", "run.constraints", {"projection", "partitioning"})};
  plan.tolerance = 1e-6;
  plan.repeats = 1;
  const TradeReport r = run_tradeoff(plan, angle, runner(source));
  ASSERT_EQ(r.reference.trouble, "");
  const QuantityReference& q = r.reference.of[0];
  EXPECT_FALSE(q.chaotic);
  EXPECT_TRUE(q.converged) << q.words;
  EXPECT_LE(std::abs(q.value - there), q.error) << q.words;
  int rejected = 0, usable = 0;
  for (const TradePoint& p : r.points) {
    rejected += p.status == "refused";
    if (!p.usable) continue;
    ++usable;
    EXPECT_NEAR(p.errors[0], std::abs(p.values[0] - there) / std::abs(there), p.warnings_of[0]) << setting_text(plan, p);
  }
  EXPECT_EQ(rejected, 3) << "partitioning with an implicit scheme";
  EXPECT_EQ(usable, 10);
}

// The third natural frequency of a clamped ruler by its number of elements, cubic ones: (7.8547574/L)² √(EI/ρA)/2π.
TEST(Tradeoff, OfModesTheModelAloneErrsAndTheReferenceIsTheClosedForm) {
  CaseSource source{"ruler.yaml",
                    R"yaml(
materials: {steel: {young: 207 GPa, poisson: 0.3, density: 7850 kg/m^3}}
bodies:
  ruler:
    beam: {from: root, to: tip, section: {rectangle: [1 mm, 25 mm]}, material: steel, elements: 20, theory: euler}
    points: {root: [0, 0], tip: [300 mm, 0]}
    supports: {root: fixed}
)yaml",
                    {}};
  source.question.analysis = Analysis::modes;
  std::vector<Measure> third{{"third", "frequency of mode 3"}};
  third.front().question = source.question;
  TradePlan plan;
  plan.integrates = false, plan.error = 1e-3, plan.repeats = 1;
  plan.axes = {axis("elements", "bodies.ruler.beam.elements", {"2", "4", "8"})};
  const TradeReport r = run_tradeoff(plan, third, runner(source));
  ASSERT_EQ(r.reference.trouble, "");
  const double h = 1e-3, exact = std::pow(7.854757438 / 0.3, 2) * std::sqrt(207e9 * h * h / 12 / 7850) / (2 * M_PI);
  EXPECT_NEAR(r.reference.of[0].value, exact, std::max(r.reference.of[0].error, 1e-8 * exact));
  EXPECT_NEAR(r.reference.of[0].order, 4, 0.2) << "of the frequency in the size of cubic elements";
  for (const TradePoint& p : r.points) {
    ASSERT_TRUE(p.usable) << p.reason;
    EXPECT_NEAR(p.errors[0], std::abs(p.values[0] / exact - 1), 2 * r.warning() + 1e-8);
  }
  ASSERT_TRUE(r.recommended);
  EXPECT_LE(r.points[*r.recommended].claimed(), plan.error);
}

TEST(Tradeoff, ADoublePendulumIsFoundChaoticAfterAWhileAndRegularBefore) {
  const CaseSource source{"double.yaml",
                          R"(
gravity: [0, -9.81]
bodies:
  upper: {rigid: {mass: 1 kg, inertia: 0.02 kg m^2}, points: {A: [-0.25, 0], B: [0.25, 0]}}
  lower: {rigid: {mass: 1 kg, inertia: 0.02 kg m^2}, points: {B: [-0.25, 0], C: [0.25, 0]}}
joints:
  hinge: {revolute: [ground, upper.A]}
  elbow: {revolute: [upper.B, lower.B]}
start: {upper: {angle: 120 deg}, lower: {angle: 100 deg}}
run: {until: 25 s}
)",
                          {}};
  TradePlan plan;
  plan.axes = {axis("tolerance", "run.tolerance", {"1e-7"})};
  plan.ensemble = 4;
  const Reference r = find_reference(plan, {{"late", "x of lower at 25 s"}, {"early", "x of lower at 2 s"}}, runner(source));
  ASSERT_EQ(r.trouble, "");
  EXPECT_TRUE(r.of[0].chaotic) << r.of[0].words;
  EXPECT_FALSE(r.of[1].chaotic) << r.of[1].words;
  EXPECT_LT(r.of[1].error, 1e-6);
}

TEST(Tradeoff, TheRecommendedSceneReadsFromItsOwnFolderAndGivesTheRecommendedValues) {
  const Folder folder;
  write(folder.path / "scenes/tables/motion.csv", "0 0\n0.1 1\n0.2 3\n0.3 5\n");
  write(folder.path / "scenes/crank.yaml", R"(
title: "A crank: driven"
parameters: {mass: 2 kg, arm: 0.1 m}
bodies:
  crank: {rigid: {mass: mass, inertia: 0.01 kg m^2}, points: {O: [-arm, 0]}}
joints:
  bearing: {revolute: [ground, crank.O]}
drivers:
  motor: {angle: [ground, crank], law: {table: tables/motion.csv}}
run: {until: 0.3 s}
)");
  write(folder.path / "study.yaml", R"(
scene: scenes/crank.yaml
set: {mass: 3}
measure: {torque: peak torque of motor}
tradeoff:
  error: 1%
  repeats: 1
  axes:
    tolerance: {run.tolerance: [1e-4, 1e-6]}
    gravity:
      "off": {gravity: null}
      "on": {gravity: [0, -9.81], run.max step: 1 ms}
)");
  const StudyFile study = read_study(folder.path / "study.yaml");
  const TradePlan plan = read_tradeoff(study);
  ASSERT_EQ(plan.axes.size(), 2U);
  EXPECT_EQ(plan.error, 0.01);
  const TradeReport r = run_tradeoff(plan, study.study.measures, runner(study.study.scene));
  ASSERT_TRUE(r.recommended) << tradeoff_text(r);
  const TradePoint& best = r.points[*r.recommended];
  ASSERT_EQ(best.at.size(), 2U);
  EXPECT_EQ(plan.axes[1].values[best.at[1]].label, "on") << "without its weight the crank's torque is another";

  const fs::path out = folder.path / "runs/one";
  fs::create_directories(out);
  write_tradeoff(out, out, study.study.scene, r);
  const CaseSource recommended = read_case_source(out / "recommended.yaml");
  EXPECT_NE(recommended.text.find("--allow-path"), std::string::npos) << "its table stays where it is";
  set_trust({{folder.path / "scenes"}, false});
  const Outcome again = run_case(recommended, {}, study.study.measures);
  EXPECT_EQ(again.status, "finished") << again.reason;
  EXPECT_EQ(again.values, best.values);
  EXPECT_EQ(common_scene(recommended).run.tolerance, tolerance_of(plan, best.set));
  set_trust({});
  for (const char* file : {"tradeoff.csv", "tradeoff.json", "tradeoff.md"}) EXPECT_GT(fs::file_size(out / file), 100U) << file;
  EXPECT_NE(tradeoff_svg(r).find("recommended"), std::string::npos);
}

TEST(Tradeoff, WhatIsWrongInAStudyIsNamed) {
  const Folder folder;
  write(folder.path / "p.yaml", pendulum);
  const auto said = [&](const std::string& section) {
    write(folder.path / "s.yaml", "scene: p.yaml\nmeasure: {a: energy lost}\n" + section);
    return pintle_test::refusal_by([&] { read_tradeoff(read_study(folder.path / "s.yaml")); });
  };
  EXPECT_NE(said("title: none\n").find("has no section tradeoff"), std::string::npos);
  EXPECT_NE(said("tradeoff: {error: 1%}\n").find("axes"), std::string::npos);
  EXPECT_NE(said("tradeoff: {eror: 1%, axes: {t: {run.tolerance: [1e-3]}}}\n").find("Did you mean \"error\""), std::string::npos);
  EXPECT_NE(said("tradeoff: {error: 200%, axes: {t: {run.tolerance: [1e-3]}}}\n").find("at most 100 %"), std::string::npos);
  EXPECT_NE(said("tradeoff: {axes: {t: {run.tolerance: [1e-3, 1e-3]}}}\n").find("two settings called"), std::string::npos);
  EXPECT_NE(said("tradeoff: {axes: {t: {run.tolerance: [1e-3, 1e-4], run.method: [rkf45]}}}\n").find("combined one by one"),
            std::string::npos);
  EXPECT_EQ(said("tradeoff: {axes: {t: {run.tolerance: [1e-3, 1e-4]}}}\n"), "accepted");
}

TEST(Tradeoff, ASceneAloneSuggestsItsAxes) {
  const TradePlan plain = suggested_plan({"pendulum.yaml", pendulum, {}});
  ASSERT_EQ(plain.axes.size(), 2U);
  EXPECT_EQ(plain.axes[0].values.size(), 7U);
  EXPECT_EQ(plain.tolerance, 1e-6);
  EXPECT_GT(plain.budget, 0);
  const CaseSource flexible = read_case_source(fs::path(PINTLE_SOURCE_DIR) / "examples/paper/fig12_flexible.yaml");
  const TradePlan plan = suggested_plan(flexible);
  const auto coupler = std::ranges::find(plan.axes, "coupler", &FidelityAxis::name);
  ASSERT_NE(coupler, plan.axes.end());
  EXPECT_EQ(coupler->values.front().label, "rigid");
  EXPECT_EQ(coupler->values.back().label, "as written, 3 shapes");
  // Two modes and the static shapes of its ties as written: no axis value keeps more than that and stands before it.
  const TradePlan pump = suggested_plan(read_case_source(fs::path(PINTLE_SOURCE_DIR) / "examples/plunger_pump.yaml"));
  const auto rod = std::ranges::find(pump.axes, "rod", &FidelityAxis::name);
  ASSERT_NE(rod, pump.axes.end());
  ASSERT_EQ(rod->values.size(), 3U);
  EXPECT_EQ(rod->values[1].label, "1 mode");
  for (const AxisValue& v : coupler->values) {
    Overrides set = v.set;
    set.insert(set.end(), {{"run.until", "1 us"}, {"output.every", "1 us"}});
    EXPECT_EQ(run_case(flexible, set, {}).status, "finished") << v.label;
  }
}

}  // namespace
}  // namespace pintle::tradeoff_test
