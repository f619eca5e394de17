// Roots of (λ² M + λ D + K) x = 0 against those that the matrices were made of.
#include "framework/analysis/linearize/quadratic_roots.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pintle::quadratic_roots_test {
namespace {

/// VᵀV, drag VᵀV and VᵀΩ²V: the roots are −drag/2 ± i√(ω² − drag²/4), whatever V is.
SmallMotion made_of(const Eigen::Vector3d& omega, double drag) {
  Eigen::Matrix3d V;
  V << 1, 0.3, -0.2, 0.1, 1, 0.4, -0.3, 0.2, 1;
  const Eigen::Matrix3d M = V.transpose() * V, K = V.transpose() * omega.cwiseAbs2().asDiagonal() * V;
  return {M, drag * M, (K + K.transpose()) / 2};
}
SmallMotion sizes(const SmallMotion& s) { return {s.M.cwiseAbs(), s.D.cwiseAbs(), s.K.cwiseAbs()}; }

TEST(QuadraticRoots, SlowOnesStayExactBesideFastOnes) {
  for (const double drag : {0.0, 1e-3}) {
    const Eigen::Vector3d omega(1, 300, 3e5);
    const SmallMotion s = made_of(omega, drag);
    const auto roots = roots_of(s, sizes(s));
    ASSERT_EQ(roots.size(), 6U);
    for (int k = 0; k < 3; ++k) {
      const QuadraticRoot& r = roots[static_cast<std::size_t>(2 * k)];
      // K holds the slow square as a difference of fast ones: of 9e10, 1e-16 is rounded away.
      EXPECT_NEAR(std::abs(r.lambda.imag()), std::sqrt(omega[k] * omega[k] - drag * drag / 4), 1e-4 * omega[k]) << drag;
      EXPECT_NEAR(r.lambda.real(), -drag / 2, 1e-5 + r.uncertainty) << drag;
      EXPECT_FALSE(r.zero);
    }
  }
}

TEST(QuadraticRoots, WithoutDragNoneIsDamped) {
  const SmallMotion s = made_of({2, 2, 7}, 0);
  for (const QuadraticRoot& r : roots_of(s, sizes(s))) EXPECT_EQ(r.lambda.real(), 0);
}

TEST(QuadraticRoots, OfDragAloneOneOfEachPairIsZero) {
  const SmallMotion s = made_of({0, 0, 0}, 3);
  int zeros = 0;
  for (const QuadraticRoot& r : roots_of(s, sizes(s))) {
    zeros += r.zero;
    if (!r.zero) {
      EXPECT_NEAR(std::abs(r.lambda + 3.0), 0, 1e-12);
    }
  }
  EXPECT_EQ(zeros, 3);
}

TEST(QuadraticRoots, NegativeStiffnessGivesAPairOnTheRealAxis) {
  SmallMotion s = made_of({1, 1, 1}, 0);
  s.K = -4 * s.M;
  for (const QuadraticRoot& r : roots_of(s, sizes(s))) EXPECT_NEAR(std::abs(r.lambda.real()), 2, 1e-12);
}

TEST(QuadraticRoots, MotionWithoutMassIsRefused) {
  SmallMotion s = made_of({1, 1, 1}, 0);
  s.M.row(0).setZero(), s.M.col(0).setZero();
  EXPECT_THROW(roots_of(s, sizes(s)), std::runtime_error);
}

}  // namespace
}  // namespace pintle::quadratic_roots_test
