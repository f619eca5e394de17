// Gottwald and Melbourne's test on maps whose motion is known.
#include "framework/study/nonlinear/zero_one.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "framework/study/nonlinear/nonlinear.h"
#include "tests/scenes/studies/nonlinear_study.h"

namespace pintle {
namespace {

constexpr std::size_t count = 1000;

std::vector<double> logistic(double r) {
  std::vector<double> out;
  double x = 0.3;
  for (std::size_t k = 0; k < 2000 + count; ++k) {
    x = r * x * (1 - x);
    if (k >= 2000) out.push_back(x);
  }
  return out;
}

// Displacements of a regular motion swing with the frequencies' distances from c: over 100 returns a swing has a correlation with n of
// some 1/(100 d), more than 0.2 only where d < 0.05. A period of 4 or less has frequencies pi/2 and pi, one of two quasi-periods two or
// three of size: less than a fifth of the values of c, and the median is of the others.
TEST(ZeroOne, IsNearZeroWhereMotionIsRegular) {
  EXPECT_NEAR(zero_one_test(logistic(3.2), 1e-6), 0, 0.2);
  EXPECT_NEAR(zero_one_test(logistic(3.5), 1e-6), 0, 0.2);
  std::vector<double> quasi;
  for (std::size_t k = 0; k < count; ++k) quasi.push_back(0.3 + std::cos(static_cast<double>(k) * std::numbers::phi));
  EXPECT_NEAR(zero_one_test(quasi, 1e-6), 0, 0.2);
}

// At r = 4 returns are uncorrelated, so that displacements grow as n times the variance; over 100 of 1000 returns they are known to some
// 30 %, which bends the straight line, but a correlation below 0.9 would need a bend of half its length.
TEST(ZeroOne, IsNearOneWhereMotionIsChaotic) {
  EXPECT_GT(zero_one_test(logistic(4), 1e-6), 0.9);
  EXPECT_GT(zero_one_test(logistic(3.9), 1e-6), 0.9);
}

// What shrinks below the tolerance is no motion, however its remainder grows.
TEST(ZeroOne, IsZeroOfWhatComesToRest) {
  std::vector<double> still(count, 0.7), settling;
  for (std::size_t k = 0; k < count; ++k) settling.push_back(0.7 + 1e-7 * std::exp(-0.001 * static_cast<double>(k)));
  EXPECT_NEAR(zero_one_test(still, 1e-6), 0, 1e-6);
  EXPECT_NEAR(zero_one_test(settling, 1e-5), 0, 0.01);
}

TEST(ZeroOne, IsNotToldOfFewReturns) {
  EXPECT_TRUE(std::isnan(zero_one_test(std::vector<double>(least_of_zero_one - 1, 1.0), 1e-6)));
  std::vector<double> enough(least_of_zero_one, 1.0);
  EXPECT_FALSE(std::isnan(zero_one_test(enough, 1e-6)));
  enough[7] = std::nan("");
  EXPECT_TRUE(std::isnan(zero_one_test(enough, 1e-6)));
}

// One impact a period below the doubling; at 1.74 the greatest exponent is above six times its standard error.
TEST(ZeroOne, OfABouncingBallTellsItsPeriodFromItsChaos) {
  const VibratingTable table;
  for (const double gamma : {1.3, 1.74}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, table.scene(gamma, 1.0), once_a_period(60, 300));
    if (gamma < table.doubling())
      EXPECT_NEAR(done.values.at(0).orbit.zero_one, 0, 0.2);  // still, within the section's tolerance
    else
      EXPECT_GT(done.values.at(0).orbit.zero_one, 0.7);
  }
}

}  // namespace
}  // namespace pintle
