// The step-size controller, and where laws of time have steps end.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "framework/integration/law_changes.h"
#include "framework/integration/step_control.h"
#include "framework/integration/stepper.h"

namespace pintle::step_control_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

StepControl wishing(double h, double max_step = infinite) {
  StepControl out(max_step);
  out.wish_for(h);
  return out;
}

StepperTraits of_order(int order) { return {.order = order, .implicit = false, .follows_impacts = true, .ends_evaluated = true}; }

TEST(StepControl, LeavesNoRestThatIsTooShortToBeAStep) {
  const StepControl control = wishing(1);
  EXPECT_FALSE(control.next(2).last);
  EXPECT_EQ(control.next(2).h, 1);
  EXPECT_TRUE(control.next(1 + 0.5 * short_part).last);
  EXPECT_EQ(control.next(1 + 0.5 * short_part).h, 1 + 0.5 * short_part);
  EXPECT_FALSE(control.next(1 + 2 * short_part).last);
  EXPECT_EQ(control.next(0.3).h, 0.3);
}

// With an error of (h/h₁)ᵖ the next try is at 0.9 h₁, but no shorter than the least part.
TEST(StepControl, ARejectedStepComesToWhereTheErrorIsTheTolerance) {
  for (const int order : {3, 5, 8})
    for (const double h : {1.5, 2.0, 4.0}) {
      StepControl control = wishing(h);
      control.rejected(h, std::pow(h, order), order, 0.2);
      EXPECT_NEAR(control.wish(), 0.9, 1e-15 * 8) << order << " " << h;
      control.rejected(h, std::pow(1e3 * h, order), order, 0.2);
      EXPECT_EQ(control.wish(), h * 0.2);
      control.rejected(h, std::pow(1e3 * h, order), order, 0.7);
      EXPECT_EQ(control.wish(), h * 0.7) << "where a stage strayed near a singular configuration";
      control.rejected(h, std::nan(""), order, 0.2);
      EXPECT_EQ(control.wish(), h * 0.2) << "not a number is no error";
    }
}

TEST(StepControl, StepsGrowFiveTimesAtMostAndNotBeyondTheLongest) {
  StepControl control = wishing(1);
  control.accepted(control.next(100), 1e-10, of_order(5));
  EXPECT_EQ(control.wish(), 5);
  StepControl bounded = wishing(1, 2);
  bounded.accepted(bounded.next(100), 1e-10, of_order(5));
  EXPECT_EQ(bounded.wish(), 2);
}

// The wish from before stands where the growth of the short step would allow more.
TEST(StepControl, AfterAStepCutShortTheNextIsFiveTimesAsLongAtMost) {
  StepControl cut = wishing(1), nearly_whole = wishing(1);
  cut.accepted(cut.next(1e-3), 1e-10, of_order(5));
  EXPECT_EQ(cut.wish(), 5e-3);
  nearly_whole.accepted(nearly_whole.next(0.5), 1e-10, of_order(5));
  EXPECT_EQ(nearly_whole.wish(), 1);
}

TEST(StepControl, AStepIsKeptWhereAnotherIsNotWorthAFactorization) {
  StepperTraits implicit = of_order(3);
  implicit.least_change = 0.9, implicit.least_growth = 1.2;
  const double error = std::pow(0.9, 3 / 0.7);  // asks for the same step, times (error before)^(0.4/3) = 1
  for (const double ask : {0.95, 1.1}) {
    StepControl control = wishing(1), free = wishing(1);
    control.accepted(control.next(100), error * std::pow(ask, -3 / 0.7), implicit);
    free.accepted(free.next(100), error * std::pow(ask, -3 / 0.7), of_order(3));
    EXPECT_EQ(control.wish(), 1);
    EXPECT_NEAR(free.wish(), ask, 1e-14);
  }
}

// A step of one digit would be too small for any tolerance.
TEST(LawChanges, ABendThatBeginsOneDigitAheadHasBegun) {
  Scheme scheme;
  scheme.bends = {{{0, 9}, {9, 18}}};
  for (const double t : {std::nextafter(9, 0), 9.0, std::nextafter(9, 10)}) EXPECT_NEAR(law_end(scheme, t, true), 10.5, 1e-12) << t - 9;
}

TEST(LawChanges, AStepEndsBeforeTheNextChangeAndPassesOneWholePieceAtMost) {
  Scheme scheme;
  EXPECT_EQ(law_end(scheme, 0), infinite);
  scheme.changes = {{1, 1.5, true}, {3, 3.5, false}};
  EXPECT_EQ(law_end(scheme, 0), 1);
  EXPECT_EQ(law_end(scheme, 1), 3);
  EXPECT_EQ(law_end(scheme, 3), infinite);
  scheme.pieces = {{0, 0.2, 0.4, 2, 2.2}};
  EXPECT_EQ(law_end(scheme, 0.1), 0.4) << "the piece that it is in, and one more";
  EXPECT_EQ(law_end(scheme, 1.7), 2.2);
}

TEST(LawChanges, AMethodThatSeesEndsAloneTakesSixStepsThroughEachBend) {
  Scheme scheme;
  scheme.bends = {{LawBend{0, 6}, LawBend{6, 7.5}, LawBend{20, 32}}, {LawBend{28, 40}}};
  double t = 0;
  for (const double end : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.25, 6.5, 6.75, 7.0, 7.25, 7.5, 20.0, 22.0, 24.0, 26.0, 28.0, 30.0, 32.0, 34.0}) {
    EXPECT_DOUBLE_EQ(law_end(scheme, t, true), end) << t;
    t = law_end(scheme, t, true);
  }
  EXPECT_EQ(law_end(scheme, 5 + 5e-3, true), 6) << "what is left is no step of its own";
  EXPECT_EQ(law_end(scheme, 0, false), infinite);
  EXPECT_EQ(law_end(scheme, 40, true), infinite);
}

TEST(LawChanges, AChangeIsThereUntilItIsPassed) {
  Scheme scheme;
  scheme.changes = {{1, 1.5, true}, {3, 3.5, false}};
  EXPECT_EQ(change_at(scheme, 0.5), nullptr);
  EXPECT_EQ(change_at(scheme, 1), &scheme.changes[0]);
  EXPECT_EQ(change_at(scheme, 1.5), nullptr);
  EXPECT_EQ(change_at(scheme, 3.2), &scheme.changes[1]);
}

}  // namespace
}  // namespace pintle::step_control_test
