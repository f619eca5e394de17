#include "framework/study/nonlinear/differences.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "framework/study/sweep/sampling.h"

namespace pintle {
namespace {

/// A derivative of 2 by differences at 1e-6, 1e-5 …: noise/d and curvature d^2 off it.
std::vector<Eigen::MatrixXd> differences(double noise, double curvature, int n = 4) {
  std::vector<Eigen::MatrixXd> out;
  double d = 1e-6;
  for (int k = 0; k < n; ++k, d *= 10) out.emplace_back(Eigen::MatrixXd::Constant(1, 1, 2 + noise / d + curvature * d * d));
  return out;
}

// What is taken is off by no more than it is said to be, and by no more than a few times the best of all.
TEST(BestOfDistances, BalancesNoiseAgainstCurvature) {
  for (const double noise : {1e-15, 1e-12, -1e-10, 1e-9})
    for (const double curvature : {1e-2, -1.0, 1e3, 1e6}) {
      const std::vector<Eigen::MatrixXd> all = differences(noise, curvature);
      const BoundedDerivative found = best_of_distances(all, 1e-12);
      double least = 1;
      for (double d = 1e-6; d < 2e-3; d *= 10) least = std::min(least, std::abs(noise) / d + std::abs(curvature) * d * d);
      const double off = std::abs(found.value(0, 0) - 2);
      EXPECT_LE(off, 1.2 * found.error(0, 0)) << noise << " " << curvature;
      EXPECT_LE(off, 20 * least + 1e-11) << noise << " " << curvature;
    }
}

// Noise of another size at each distance: the error of a single entry exceeds what is stated in at most one case of ten.
TEST(BestOfDistances, StatesAnErrorThatRandomNoiseSeldomExceeds) {
  Stream stream(1, "noise");
  const auto within = [&](double from, double to) { return from + (to - from) * stream.uniform(); };
  int beyond = 0;
  constexpr int all_cases = 4000;
  for (int k = 0; k < all_cases; ++k) {
    const double noise = std::pow(10, within(-15, -9)), curvature = std::pow(10, within(-2, 6));
    std::vector<Eigen::MatrixXd> all;
    for (double d = 1e-6; d < 2e-3; d *= 10)
      all.emplace_back(Eigen::MatrixXd::Constant(1, 1, 2 + noise * within(-1, 1) / d + curvature * d * d));
    const BoundedDerivative found = best_of_distances(all, 1e-12);
    beyond += std::abs(found.value(0, 0) - 2) > found.error(0, 0);
  }
  EXPECT_LE(beyond, all_cases / 10);
}

TEST(BestOfDistances, KnowsNoErrorOfOneAlone) { EXPECT_TRUE(std::isnan(best_of_distances(differences(0, 0, 1), 0).error(0, 0))); }

}  // namespace
}  // namespace pintle
