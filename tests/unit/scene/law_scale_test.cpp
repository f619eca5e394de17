#include "framework/scene/units/law_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "framework/scene/units/expression.h"
#include "framework/scene/units/table.h"

namespace pintle::law_scale_test {
namespace {

LawScale scale(const std::string& text, double until = 1) { return scale_of(read_law(text, dimension::number).at, until); }
// Of the piece that holds t.
double length_of_piece(const LawScale& s, double t) {
  const auto end = std::upper_bound(s.pieces.begin(), s.pieces.end(), t);
  return *end - (end == s.pieces.begin() ? 0 : *(end - 1));
}

TEST(LawScale, FindsTheBreaksOfEveryFunctionThatHasThem) {
  struct Case {
    std::string law;
    std::vector<double> breaks;
  };
  for (const Case& c : std::vector<Case>{{"abs(t - 0.3)", {0.3}},
                                         {"max(t, 0.25)", {0.25}},
                                         {"min(3*t, 1 - t, 0.6)", {0.2, 0.4}},
                                         {"if(t < 0.125, 0, 1)", {0.125}},
                                         {"if(t >= 0.125 && t < 0.5, 1, 0)", {0.125, 0.5}},
                                         {"if(t > 0, 1, 0)", {0}},
                                         {"step(t, 0.25, 0.5)", {0.25, 0.5}},
                                         {"sqrt((t - 0.4)^2)", {0.4}},
                                         {"abs(sin(2*pi*t))", {0.5}},
                                         {"atan2(t - 0.7, -1)", {0.7}},
                                         {"if((t - 0.5)^2 < 1e-20, 1, 0)", {0.5 - 1e-10, 0.5 + 1e-10}},
                                         {"if(abs(t - 0.3) < 1e-9, 1, 0)", {0.3 - 1e-9, 0.3 + 1e-9}},
                                         {"max(t, 2*t)", {0}},                   // at 0 the first of the two
                                         {"if(t < 2, 0, 1)", {}},                // after the end
                                         {"if(t < 0.5, max(t, 0.7), 0.7)", {}},  // a kink that is not taken
                                         {"abs(t - 0.3)^3", {}},                 // twice differentiable
                                         {"abs(if(t < 0.5, 0, t - 0.5))", {0.5}}}) {
    const LawScale s = scale(c.law);
    ASSERT_TRUE(s.known) << c.law;
    ASSERT_EQ(s.breaks.size(), c.breaks.size()) << c.law;
    for (std::size_t i = 0; i < s.breaks.size(); ++i) {
      EXPECT_NEAR(s.breaks[i].before, c.breaks[i], 2e-13) << c.law;
      EXPECT_NEAR(s.breaks[i].after, c.breaks[i], 2e-13) << c.law;
      EXPECT_LE(s.breaks[i].before, s.breaks[i].after);
    }
  }
}

TEST(LawScale, TellsWhatALawDoesOnBothSidesOfABreak) {
  const LawScale kink = scale("if(t < 0.5, 2*t, 1 + 5*(t - 0.5))");
  ASSERT_EQ(kink.breaks.size(), 1u);
  EXPECT_EQ(kink.breaks[0].left.rate, 2);
  EXPECT_EQ(kink.breaks[0].right.rate, 5);
  EXPECT_TRUE(speed_jumps(kink.breaks[0], 0));
  EXPECT_FALSE(value_jumps(kink.breaks[0]));
  const LawScale jump = scale("if(t < 0.5, 0, 1e-3)");
  ASSERT_EQ(jump.breaks.size(), 1u);
  EXPECT_TRUE(value_jumps(jump.breaks[0]));
  EXPECT_FALSE(speed_jumps(jump.breaks[0], 0));
  const LawScale bend = scale("if(t < 0.5, 0, (t - 0.5)^2)");
  ASSERT_EQ(bend.breaks.size(), 1u);
  EXPECT_FALSE(value_jumps(bend.breaks[0]) || speed_jumps(bend.breaks[0], 1));
}

TEST(LawScale, OfAPolynomialIsOnePiece) {
  for (const char* law : {"150*t", "3 + 2*t + t^2", "t^5", "0.5*t*(1 - t)"}) {
    const LawScale s = scale(law);
    EXPECT_TRUE(s.known);
    EXPECT_EQ(s.pieces, std::vector<double>{1}) << law;
  }
}

// A quintic through the ends of h of a sine errs by (h ω)⁶/46080: a thousandth of twice its amplitude at h ω = 2.1.
TEST(LawScale, OfASineFollowsItsPeriod) {
  const double omega = 1000;
  const LawScale s = scale("sin(1000*t)");
  ASSERT_TRUE(s.known);
  EXPECT_TRUE(s.breaks.empty());
  double begin = 0;
  for (const double end : s.pieces) {
    EXPECT_LT((end - begin) * omega, 2 * 2.2);
    begin = end;
  }
  EXPECT_LT(s.pieces.size(), 2 * omega);
  EXPECT_EQ(s.pieces.back(), 1);
}

TEST(LawScale, ShortensTowardsASmoothPulseHoweverNarrowAndLate) {
  for (const double width : {1e-3, 1e-5, 1e-7, 1e-9})
    for (const char* base : {"", "1000*t + ", "5*t^2 + "}) {
      const LawScale s = scale(base + std::string("10*exp(-((t - 0.7)/") + std::to_string(width * 1e9) + "e-9)^2)");
      ASSERT_TRUE(s.known) << width;
      EXPECT_LT(length_of_piece(s, 0.7), 4 * width) << base << width;
      EXPECT_LT(length_of_piece(s, 0.7 + width), 4 * width) << base << width;
      EXPECT_GT(length_of_piece(s, 0.2), 0.05) << base << width;
      EXPECT_LT(s.pieces.size(), 150u) << base << width;
    }
}

TEST(LawScale, OfATableKnowsItsKinksAndNarrowParts) {
  const Samples pulse{{0, 0.5, 0.5 + 1e-7, 0.5 + 2e-7, 1}, {0, 0, 10, 0, 0}};
  const LawScale line = scale_of(Polyline(pulse), 1);
  ASSERT_TRUE(line.known);
  ASSERT_EQ(line.breaks.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(line.breaks[i].after, pulse.t[i + 1], 1e-14);
  Samples bump{{}, {}};
  for (int i = 0; i <= 1000; ++i) bump.t.push_back(1e-3 * i), bump.value.push_back(std::abs(i - 500) < 5 ? 1 : 0);
  const LawScale spline = scale_of(Spline(bump), 1);
  ASSERT_TRUE(spline.known);
  EXPECT_LT(length_of_piece(spline, 0.4955), 4e-3);
  Samples sine{{}, {}};
  for (int i = 0; i <= 10000; ++i) sine.t.push_back(1e-4 * i), sine.value.push_back(std::sin(6 * sine.t.back()));
  EXPECT_LT(scale_of(Spline(sine), 1).pieces.size(), 10u);
  EXPECT_TRUE(scale_of(Polyline(sine), 1).breaks.empty());
}

TEST(LawScale, IsNotKnownOfAFunctionOfTheHost) {
  EXPECT_FALSE(scale_of([](double t) { return Jet{t, 1, 0}; }, 1).known);
}

TEST(LawScale, GivesUpOnWhatHasTooManyRootsToFind) {
  const LawScale s = scale("abs(sin(1e7*t))");
  EXPECT_FALSE(s.known);
  EXPECT_TRUE(s.breaks.empty() && s.pieces.empty());
}

}  // namespace
}  // namespace pintle::law_scale_test
