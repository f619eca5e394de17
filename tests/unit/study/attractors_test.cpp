#include "framework/study/nonlinear/attractors.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pintle {
namespace {

constexpr double tolerance = 0.01;

/// Hénon's map, x' = 1 - 1.4 x² + y, y' = 0.3 x, moved aside.
Returns henon(double x, double y, double aside, int returns) {
  Returns out;
  for (int k = -100; k < returns; ++k) {
    const double next = 1 - 1.4 * x * x + y;
    y = 0.3 * x, x = next;
    if (k >= 0) out.push_back({x + aside, y});
  }
  return out;
}

TEST(Attractors, OfPeriodsAreToldApartByTheirReturnsAtWhicheverTheyBegin) {
  const Returns two{{0, 1}, {2, 0}, {0, 1}, {2, 0}}, later{{2, 0}, {0, 1}, {2, 0}, {0, 1}}, one{{2, 0}, {2, 0}, {2, 0}, {2, 0}};
  EXPECT_EQ(attractors({one, two, later, {}}, tolerance), (std::vector<std::size_t>{2, 1, 1, 0}));
}

TEST(Attractors, OfChaosAreOneFromAllStartsAndTwoWhereTheyLieApart) {
  const int returns = 300;
  const std::vector<Returns> motions{henon(0, 0, 0, returns), henon(0.3, 0.1, 5, returns), henon(0.1, 0.1, 0, returns),
                                     henon(-0.4, 0.2, 0, returns)};
  EXPECT_EQ(attractors(motions, tolerance), (std::vector<std::size_t>{1, 2, 1, 1}));
}

TEST(Attractors, AreTheSameWhateverTheUnits) {
  for (const double scale : {1e-9, 1.0, 1e9})
    EXPECT_EQ(attractors({{{0}, {0}}, {{scale}, {scale}}, {{1.005 * scale}, {1.005 * scale}}}, tolerance),
              (std::vector<std::size_t>{2, 1, 1}));
}

TEST(Attractors, OfASignalThatIsOnlyRoundingAreOne) {
  EXPECT_EQ(attractors({{{1}}, {{1 + 2e-16}}, {{1 - 1e-16}}}, tolerance), (std::vector<std::size_t>{1, 1, 1}));
}

// Wilson's interval holds the shares p that differ from k/n by at most 1.96 of their own standard deviations.
TEST(Attractors, HaveSharesWithinTheBoundsOfARandomSample) {
  for (const auto& [k, n] : {std::pair{0, 10}, {3, 10}, {10, 10}, {700, 1000}}) {
    const ShareBounds bounds = share_bounds(static_cast<std::size_t>(k), static_cast<std::size_t>(n));
    const double share = static_cast<double>(k) / n;
    for (const double p : {bounds.least, bounds.most})
      if (p > 0 && p < 1) {
        EXPECT_NEAR(std::abs(share - p), 1.959963984540054 * std::sqrt(p * (1 - p) / n), 1e-12);
      }
    EXPECT_LE(bounds.least, share);
    EXPECT_GE(bounds.most, share);
    EXPECT_EQ(bounds.least == 0, k == 0);
    EXPECT_EQ(bounds.most == 1, k == n);
  }
}

}  // namespace
}  // namespace pintle
