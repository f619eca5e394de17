// What a trade may say: nothing that its reference and the settings that ran do not support, and nothing before a study is read whole.
#include <algorithm>

#include "tests/scenes/studies/known_trade.h"
#include "tests/refusal.h"

namespace pintle::tradeoff_advice_test {
namespace {

std::string all_said(const TradeReport& r) {
  std::string s;
  for (const std::string& line : r.said) s += line + "\n";
  return s;
}

bool says(const TradeReport& r, const std::string& words) { return all_said(r).find(words) != std::string::npos; }

std::string rejected(const fs::path& study) {
  return pintle_test::refusal_by([&] { read_tradeoff(read_study(study)); });
}

/// The value jumps by a tenth, up and down, however often the elements are doubled.
Outcome never_still(const Overrides& set, const std::vector<Measure>& m, const CaseLimits&) {
  const double n = number_of(set, "bodies.rod.beam.elements", 4), t = number_of(set, "run.tolerance", 1e-8);
  const double jump = std::lround(std::log2(n)) % 2 == 0 ? 0.1 : -0.1;
  return finished(std::vector<double>(m.size(), 2 * (1 + t + jump)), n * std::pow(t, -0.2));
}

TEST(TradeAdvice, AnErrorIsShownOrExcludedOnlyBeyondTheDoubt) {
  EXPECT_EQ(verdict(point(1, 0.004, 0.005), 0.01), Verdict::meets);
  EXPECT_EQ(verdict(point(1, 0.004, 0.007), 0.01), Verdict::unknown);
  EXPECT_EQ(verdict(point(1, 0.012, 0.005), 0.01), Verdict::unknown);
  EXPECT_EQ(verdict(point(1, 0.02, 0.005), 0.01), Verdict::misses);
  TradePoint two = point(1, 0.009, 0.008);  // the largest error and the largest doubt are of different quantities
  two.errors = {0.009, 0.001}, two.warnings_of = {0, 0.008};
  EXPECT_EQ(verdict(two, 0.01), Verdict::meets);
}

TEST(TradeAdvice, ASettingIsNotMoreAccurateThanTheSameAtAFinerTolerance) {
  TradePlan plan;
  plan.error = 0.01;
  plan.axes = {axis("tolerance", "run.tolerance", {"1e-3", "1e-4", "1e-6"}), axis("elements", "bodies.rod.beam.elements", {"1", "2"})};
  ASSERT_TRUE(plan.axes[0].numerical && plan.axes[0].ordered);
  TradeReport r;
  r.plan = plan, r.quantities = {"value"}, r.units = {"N"};
  r.reference.of = {QuantityReference{.value = 1, .error = 1e-5, .converged = true}};
  // With one element the model errs by 2.6 %, which errors of computing happen to cancel at 1e-4.
  r.points = {point(20, 0.026, 1e-5), point(1, 0.54, 1e-5),  point(2, 0.006, 1e-5), point(4, 0.026, 1e-5),
              point(3, 0.2, 1e-5),    point(5, 0.009, 1e-5), point(8, 0.004, 1e-5)};
  for (std::size_t i = 1; i < 7; ++i) r.points[i].at = {(i - 1) % 3, (i - 1) / 3};
  answer(r);
  ASSERT_TRUE(r.recommended);
  EXPECT_EQ(setting_text(plan, r.points[*r.recommended]), "tolerance 1e-4, elements 2") << all_said(r);
  EXPECT_TRUE(says(r, "1 setting has a smaller error than the same at a finer tolerance")) << all_said(r);
  EXPECT_TRUE(says(r, "tolerance 1e-4, elements 1 gives 0.6 % and counts as 2.6 %")) << all_said(r);
}

TEST(TradeAdvice, OfAReferenceThatIsKnownBadlyNothingIsRecommendedAndNoSettingIsCalledTheMostAccurate) {
  TradePlan plan = known_plan();
  plan.error = 0.01;
  const TradeReport r = run_tradeoff(plan, one, never_still);
  ASSERT_GT(r.warning(), 0.1);
  EXPECT_FALSE(r.recommended || r.cheapest);
  EXPECT_EQ(r.said[0].find("Nothing is recommended: the reference determines value to"), 0U) << r.said[0];
  EXPECT_TRUE(says(r, "an error of 1 % was requested") && says(r, "What would help"));
  for (const char* claim : {"Cheapest", "ost accurate", "Errors of the models", "Not worth", "front"})
    EXPECT_FALSE(says(r, claim)) << claim << "\n" << all_said(r);

  const Folder folder;
  write(folder.path / "p.yaml", pendulum);
  write_tradeoff(folder.path, folder.path, read_case_source(folder.path / "p.yaml"), r);
  EXPECT_TRUE(fs::exists(folder.path / "tradeoff.csv"));
  EXPECT_FALSE(fs::exists(folder.path / "recommended.yaml"));
  // Without a wish a tenth is the bound: neither is the knee of such a front worth anything.
  EXPECT_FALSE(run_tradeoff(known_plan(), one, never_still).recommended);
}

TEST(TradeAdvice, WhereNoSettingIsAccurateEnoughTheBestAreNamedOnlyIfTheyCanBeToldApart) {
  TradePlan plan;
  plan.error = 0.01;
  plan.axes = {axis("elements", "bodies.rod.beam.elements", {"1", "2", "4"})};
  TradeReport r;
  r.plan = plan, r.quantities = {"value"}, r.units = {"N"};
  r.reference.of = {QuantityReference{.value = 1, .error = 0.004, .converged = true}};
  r.points = {point(9, 0.3, 0.004), point(1, 0.2, 0.004), point(2, 0.030, 0.004), point(3, 0.029, 0.004)};
  for (std::size_t i = 1; i < 4; ++i) r.points[i].at = {i - 1};
  answer(r);
  EXPECT_FALSE(r.recommended);
  EXPECT_TRUE(says(r, "The 2 most accurate ones cannot be distinguished: the error of each is at most 3.4 %")) << all_said(r);
  r.points[3].error = 0.015;
  answer(r);
  EXPECT_TRUE(says(r, "The most accurate is elements 4")) << all_said(r);
  r.points[3].error = 0.009;  // between 0.5 % and 1.3 %
  answer(r);
  EXPECT_FALSE(r.recommended);
  EXPECT_TRUE(says(r, "For 1 setting this is unknown")) << all_said(r);
}

TEST(TradeAdvice, AQuantityThatIsTheSameInEveryRunTellsNothing) {
  TradePlan plan = known_plan();
  plan.error = 0.01;
  const std::vector<Measure> two{{"value", "value"}, {"lost", "lost"}};
  const CaseRunner with_zero = [](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) {
    Outcome o = known(set, m, l);
    if (!o.values.empty()) o.values.back() = 0;  // timed runs measure nothing
    return o;
  };
  const TradeReport beside = run_tradeoff(plan, two, with_zero);
  EXPECT_TRUE(says(beside, "lost is 0 in every run")) << all_said(beside);
  ASSERT_TRUE(beside.recommended);
  EXPECT_EQ(setting_text(plan, beside.points[*beside.recommended]), "tolerance 1e-4, elements 4") << "by the other quantity";

  const TradeReport alone = run_tradeoff(plan, {{"lost", "lost"}}, with_zero);
  EXPECT_FALSE(alone.recommended);
  EXPECT_TRUE(says(alone, "lost is 0 in every run, for any setting, so it cannot rank the settings")) << all_said(alone);
  for (const TradePoint& p : alone.points) EXPECT_TRUE(p.times.empty()) << "no time is spent on it";
}

TEST(TradeAdvice, WhereTheReferenceAloneIsZeroErrorsAreSharesOfTheLargestValue) {
  TradePlan plan;
  plan.repeats = 1;
  plan.axes = {axis("model", "joints.pin.clearance.model", {"spring-damper", "contact"})};
  const TradeReport r = run_tradeoff(plan, one, [](const Overrides& set, const std::vector<Measure>&, const CaseLimits&) {
    const bool other = std::ranges::any_of(set, [](const auto& s) { return s.second == "spring-damper"; });
    return finished({other ? 0.25 : 0}, 1);
  });
  EXPECT_EQ(r.points[1].error, 1);
  EXPECT_EQ(r.points[2].error, 0);
}

TEST(TradeAdvice, ItSaysOfHowManySettingsAndNothingOfValuesThatHardlyRan) {
  TradeReport r;
  r.plan.error = 0.01, r.plan.budget = 60;
  r.plan.axes = {axis("tolerance", "run.tolerance", {"1e-2", "1e-4", "1e-6"}),
                 axis("elements", "bodies.rod.beam.elements", {"1", "2", "4", "8"})};
  r.quantities = {"value"}, r.units = {"N"};
  r.reference.of = {QuantityReference{.value = 1, .error = 1e-4, .converged = true}};
  r.points.assign(13, TradePoint{});
  for (std::size_t i = 1; i < 13; ++i) r.points[i].at = {(i - 1) / 4, (i - 1) % 4};
  const auto ran = [&](std::size_t t, std::size_t e, double time, double error) {
    TradePoint& p = r.points[1 + 4 * t + e];
    const std::vector<std::size_t> at = p.at;
    p = point(time, error, 1e-4), p.at = at;
  };
  ran(0, 0, 1, 0.5), ran(0, 1, 2, 0.2), ran(0, 2, 4, 0.2), ran(0, 3, 8, 0.2);  // of 1e-2 all
  ran(1, 2, 5, 0.008), ran(1, 3, 9, 0.0085), ran(2, 2, 7, 0.003);              // of 1e-6 one of four
  r.cut = true;
  answer(r);
  EXPECT_EQ(r.said[0].find("The budget of 60 s was spent when 7 of 13 settings had run"), 0U) << r.said[0];
  EXPECT_TRUE(says(r, "Cheapest of the 7 of 13 settings that ran for an error of 1 %: tolerance 1e-4, elements 4")) << all_said(r);
  EXPECT_TRUE(says(
      r, "To decrease the error, refine tolerance first: from 1e-4 to 1e-6 changes the error from 0.8 % to 0.3 % for 1.4 times the time"))
      << all_said(r);
  EXPECT_TRUE(says(r, "elements beyond 4 changes nothing")) << all_said(r);
  // Of 8 elements two of three ran, of 1e-6 one of four: too few to call either a waste.
  EXPECT_FALSE(says(r, "Not worth")) << all_said(r);
  for (std::size_t t = 0; t < 3; ++t) ran(t, 3, 9, 0.2);
  answer(r);
  EXPECT_TRUE(says(r, "Not worth their time here, because another setting is always better: elements 8.")) << all_said(r);
}

TEST(TradeAdvice, ATradeThatWasStoppedSaysSoFirst) {
  int runs = 0;
  TradeListener listener;
  listener.go_on = [&] { return ++runs < 20; };
  const TradeReport r = run_tradeoff(known_plan(), one, known, listener);
  ASSERT_TRUE(r.stopped);
  EXPECT_EQ(r.said[0].find("Stopped by the user after"), 0U) << r.said[0];
  EXPECT_NE(r.said[0].find(std::to_string(r.ran()) + " of 13 settings had run"), std::string::npos) << r.said[0];
  EXPECT_NE(tradeoff_json(r).find("\"status\": \"stopped by the user\""), std::string::npos);
  runs = 18;
  const TradeReport early = run_tradeoff(known_plan(), one, known, listener);
  EXPECT_NE(early.said[0].find("the reference was not found"), std::string::npos) << early.said[0];
  EXPECT_EQ(early.ran(), 0U);
}

TEST(TradeAdvice, AxesThatNobodyNamedAreListed) {
  TradePlan plan = known_plan();
  plan.suggested = true;
  EXPECT_TRUE(says(run_tradeoff(plan, one, known),
                   "Axes chosen from the scene, because no study names any: tolerance 1e-2 … 1e-6; elements 1 … 8."));
  plan.suggested = false;
  EXPECT_FALSE(says(run_tradeoff(plan, one, known), "Axes chosen"));
}

TEST(TradeAdvice, WithinABudgetTheReferenceBeginsWithWhatIsCheapAndStandsForTheErrorWanted) {
  // Below a tolerance of 1e-7 a run takes longer than all there is; the study's finest is 1e-8.
  const CaseRunner expensive = [](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) {
    Outcome o = known(set, m, l);
    o.run_seconds = number_of(set, "run.tolerance", 1e-8) < 0.9e-7 ? 1e6 : 1e-3;
    return o;
  };
  TradePlan plan = known_plan();
  plan.axes[0] = axis("tolerance", "run.tolerance", {"1e-4", "1e-8"});
  plan.error = 0.01;
  const Reference r = find_reference(plan, one, expensive, 20, 40);
  ASSERT_EQ(r.trouble, "");
  EXPECT_TRUE(r.of[0].converged) << r.of[0].words;
  EXPECT_GE(r.of[0].error, std::abs(r.of[0].value - 2));
  EXPECT_LE(r.of[0].warning(), plan.error / 3) << r.of[0].words;
}

TEST(TradeAdvice, EverySettingIsReadBeforeAnythingRuns) {
  const Folder folder;
  write(folder.path / "p.yaml", pendulum);
  const auto said = [&](const std::string& axes) {
    write(folder.path / "s.yaml", "scene: p.yaml\nmeasure: {a: energy lost}\ntradeoff:\n  axes:\n" + axes);
    return rejected(folder.path / "s.yaml");
  };
  EXPECT_NE(said("    t: {run.tolerance: [1e-3, 1e-4]}\n    s:\n      a: {run.tolerence: 1e-3}\n")
                .find("s.yaml:7: tradeoff.axes.s: run.tolerence: unknown key \"tolerence\". Did you mean \"tolerance\""),
            std::string::npos);
  EXPECT_NE(said("    t: {run.tolerance: [1e-3, 5]}\n").find("s.yaml:5: tradeoff.axes.t: run.tolerance: \"5\" must lie between"),
            std::string::npos);
  EXPECT_NE(said("    s: {run.method: [dopri5, euler]}\n").find("tradeoff.axes.s: run.method: \"euler\" must be"), std::string::npos);
  EXPECT_NE(said("    s: {run.method: []}\n").find("s.yaml:5: tradeoff.axes.s.run.method: is an empty list"), std::string::npos);
  EXPECT_NE(said("    t: {run.tolerance: [1e-3]}\n  reference: {run.methd: auto}\n").find("Did you mean \"method\""), std::string::npos);
  for (const char* axes : {"    t: {run.tolerance: [5]}\n", "    s: {run.method: [euler]}\n"})
    EXPECT_EQ(said(axes).find("--set"), std::string::npos) << said(axes);
  // What the reader takes beside other values alone, or the builder refuses, makes rows with a reason.
  EXPECT_EQ(said("    s: {run.method: [dopri5, generalized-alpha]}\n    c: {run.constraints: [projection, partitioning]}\n"), "accepted");
  const std::string given = "    p: {plain: {run.until: 1 s}, given: {parameters: {half: 0.2 m, full: 0.4 m}}}\n",
                    at = "    o: {full: {\"bodies.rod.points.O\": [-full/2, 0]}}\n";
  EXPECT_EQ(said(given + at), "accepted");
  EXPECT_NE(said(at).find("s.yaml:5: tradeoff.axes.o: bodies.rod.points.O"), std::string::npos) << said(at);
}

TEST(TradeAdvice, AStudyOfASweepAndAMeasureThatNothingCanHaveAreRefused) {
  const Folder folder;
  write(folder.path / "p.yaml", pendulum);
  write(folder.path / "sweep.yaml", "scene: p.yaml\nmeasure: {a: energy lost}\nsweep: {grid: {half: [0.1 m, 0.2 m]}}\n");
  EXPECT_NE(rejected(folder.path / "sweep.yaml").find("has a sweep and no tradeoff; run it with pintle sweep"), std::string::npos);
  write(folder.path / "stress.yaml",
        "scene: p.yaml\nmeasure: {s: peak stress at rod.O}\ntradeoff: {axes: {t: {run.tolerance: [1e-3, 1e-4]}}}\n");
  EXPECT_NE(rejected(folder.path / "stress.yaml").find("\"rod\" is rigid"), std::string::npos) << rejected(folder.path / "stress.yaml");
}

}  // namespace
}  // namespace pintle::tradeoff_advice_test
