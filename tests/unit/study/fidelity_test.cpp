// What trades stand on: axes, refinements, estimates of error, wishes as users write them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/study/tradeoff/convergence.h"
#include "framework/study/tradeoff/refinement.h"
#include "framework/study/tradeoff/share_and_duration.h"

namespace pintle::fidelity_test {
namespace {

FidelityAxis axis(const std::string& name, const std::string& path, const std::vector<std::string>& values) {
  FidelityAxis a{.name = name, .values = {}};
  for (const std::string& v : values) a.values.push_back({v, {{path, v}}});
  validate_axis(a);
  return a;
}

TEST(Fidelity, AxesAreSortedFromCoarseToFine) {
  const FidelityAxis t = axis("tolerance", "run.tolerance", {"1e-8", "1e-2", "1e-4"});
  EXPECT_EQ(t.values.front().label, "1e-2");
  EXPECT_EQ(t.finest, 2U);
  EXPECT_TRUE(t.numerical && t.ordered);
  const FidelityAxis size = axis("mesh", "bodies.a.plate.size", {"2 mm", "1 cm"});
  EXPECT_EQ(size.values.front().label, "1 cm");
  EXPECT_FALSE(size.numerical);
  const FidelityAxis scheme = axis("scheme", "run.method", {"dopri5", "verner87", "generalized-alpha"});
  EXPECT_FALSE(scheme.ordered);
  EXPECT_EQ(scheme.finest, 1U);
}

TEST(Fidelity, CountsAreDoubledAndSizesHalvedToRefineAModel) {
  EXPECT_EQ(refined("bodies.a.beam.elements", "3"), "6");
  EXPECT_EQ(refined("bodies.a.modes", "{frame: chord, craig-bampton: {count: 2}}"), "{frame: chord, craig-bampton: {count: 4}}");
  EXPECT_EQ(refined("bodies.a.plate.size", "4 mm"), "0.5*(4 mm)");
  EXPECT_EQ(refined("bodies.a.modes", "{below: 8 kHz}"), "{below: 2*(8 kHz)}");
  EXPECT_EQ(refined("bodies.a.modes", "{keep: all}"), std::nullopt);
  EXPECT_EQ(refined("joints.a.clearance.model", "contact"), std::nullopt);
  EXPECT_EQ(refined(Overrides{{"run.tolerance", "1e-3"}}), std::nullopt);
}

TEST(Fidelity, ALaddersErrorIsNotLessThanTheTrueOne) {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) / 9007199254740992.0; };
  int honest = 0;
  const int all = 2000;
  for (int k = 0; k < all; ++k) {
    const double fall = 3 + 17 * uniform();
    std::vector<double> v;
    double size = 1e-3;
    for (int i = 0; i < 4; ++i, size /= fall) v.push_back(1 + size * (uniform() < 0.5 ? -1 : 1) * (0.3 + 0.7 * uniform()));
    honest += validate_ladder(v, 10, 1).error >= std::abs(v.back() - 1);
  }
  EXPECT_GE(honest, 0.97 * all);
  EXPECT_FALSE(validate_ladder({1, 2, 1.5, 2.5}, 10, 1).falling);
  EXPECT_GE(validate_ladder({1, 2, 1.5, 2.5}, 10, 1).error, 1.0);
}

TEST(Fidelity, SharesAndTimesOfComputingAreRead) {
  EXPECT_DOUBLE_EQ(read_share("1%"), 0.01);
  EXPECT_DOUBLE_EQ(read_share("2.5 %"), 0.025);
  EXPECT_DOUBLE_EQ(read_share("1e-3"), 1e-3);
  EXPECT_THROW(read_share("0"), ExpressionError);
  EXPECT_DOUBLE_EQ(read_duration("10 min"), 600);
  EXPECT_DOUBLE_EQ(read_duration("0.5s"), 0.5);
  EXPECT_DOUBLE_EQ(read_duration("2h"), 7200);
  EXPECT_THROW(read_duration("3 m"), ExpressionError);
}

}  // namespace
}  // namespace pintle::fidelity_test
