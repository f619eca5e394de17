#include "framework/study/nonlinear/attractors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pintle {
namespace {

/// The attractors of motions whose largest magnitudes are those of their returns, or as given.
std::vector<std::size_t> of(const std::vector<Returns>& all, const std::vector<double>& largest = {}) {
  std::vector<SettledMotion> motions;
  for (const Returns& returns : all) {
    SettledMotion& motion = motions.emplace_back(SettledMotion{returns, largest});
    motion.largest.resize(returns.empty() ? 0 : returns[0].size(), 0.0);
    for (const std::vector<double>& one : returns)
      for (std::size_t i = 0; i < one.size(); ++i) motion.largest[i] = std::max(motion.largest[i], std::abs(one[i]));
  }
  return attractors(motions, {});
}

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
  EXPECT_EQ(of({one, two, later, {}}), (std::vector<std::size_t>{2, 1, 1, 0}));
}

TEST(Attractors, OfChaosAreOneFromAllStartsAndTwoWhereTheyLieApart) {
  const int returns = 300;
  const std::vector<Returns> motions{henon(0, 0, 0, returns), henon(0.3, 0.1, 5, returns), henon(0.1, 0.1, 0, returns),
                                     henon(-0.4, 0.2, 0, returns)};
  EXPECT_EQ(of(motions), (std::vector<std::size_t>{1, 2, 1, 1}));
}

TEST(Attractors, AreTheSameWhateverTheUnits) {
  for (const double scale : {1e-6, 1.0, 1e9})
    EXPECT_EQ(of({{{0}, {0}}, {{scale}, {scale}}, {{1.005 * scale}, {1.005 * scale}}}), (std::vector<std::size_t>{2, 1, 1}));
}

TEST(Attractors, AreOneWhereAllEndAlikeButForTheToleranceOfTheRun) {
  EXPECT_EQ(of({{{1}}, {{1 + 2e-16}}, {{1 - 1e-16}}}), (std::vector<std::size_t>{1, 1, 1}));
  EXPECT_EQ(of({{{3.9e-3}, {3.9e-3}}, {{3.9e-3 + 1e-10}, {3.9e-3 + 1e-10}}, {{3.9e-3 - 2e-10}, {3.9e-3}}}),
            (std::vector<std::size_t>{1, 1, 1}));
}

TEST(Attractors, AtRestAreOneThoughTheirSpeedsAreNoise) {
  const std::vector<Returns> noise{{{0.6, 1e-8}}, {{0.6, -6e-7}}, {{-0.7, 3e-7}}, {{0.6, 0}}};
  EXPECT_EQ(of(noise, {1, 2}), (std::vector<std::size_t>{1, 1, 2, 1}));                                // they have moved
  EXPECT_EQ(of({{{0.6, 1e-22}}, {{0.6, -3e-22}}, {{-0.7, 0}}}), (std::vector<std::size_t>{1, 1, 2}));  // they never have
}

TEST(Attractors, AreNotMergedByAMotionThatEscapes) {
  EXPECT_EQ(of({{{0.1}}, {{-0.1}}, {{1e4}}, {{0.1}}}), (std::vector<std::size_t>{1, 2, 3, 1}));
}

TEST(Attractors, AreToldApartFarFromTheOrigin) { EXPECT_EQ(of({{{10.002}}, {{10}}, {{10.002}}}, {}), (std::vector<std::size_t>{1, 2, 1})); }

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
