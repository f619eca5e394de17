// Pairs of K φ = λ M φ against closed forms, dense algebra and Spectra's Lanczos iteration.

#include "framework/component/eigen/eigen_lowest.h"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SymShiftInvert.h>
#include <Spectra/SymGEigsShiftSolver.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/component/eigen/factor.h"
#include "framework/component/eigen/starting_loads.h"
#include "framework/component/eigen/subspace.h"
#include "tests/unit/component/eigen_bodies.h"
#include "tests/refusal.h"

namespace pintle::eigen_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace bodies;

// ΦᵀMΦ: p² sums of n products of entries that Cholesky made orthonormal.
constexpr double orthogonal = 1e-12;
// Two methods to residuals of 1e-9 have eigenvalues good to its square, and rounding of 1e-16
// λmax/λ.
constexpr double same = 1e-9;

EigenPairs lowest(const Pencil& a, int count) {
  EigenOptions options;
  options.count = count;
  return eigen_lowest(a.K, a.M, options);
}

struct Named {
  const char* name;
  Pencil pencil;
  int count, zero;
};
std::vector<Named> named_bodies() {
  return {{"clamped strip", strip(true), 12, 0},     {"free strip", strip(false), 15, 3},
          {"free square", square(20, false), 20, 3}, {"ring", ring(60, 5), 25, 3},
          {"free beam", beam(250, false), 8, 2},     {"clamped beam", beam(250, true), 8, 0},
          {"membrane", membrane(25), 30, 0},         {"two squares", both(square(15, false), square(15, false)), 20, 6}};
}

double gap_from_identity(const MatrixXd& A) { return (A - MatrixXd::Identity(A.rows(), A.cols())).cwiseAbs().maxCoeff(); }

TEST(EigenLowest, PairsAreOrthonormalAscendingAndSmallInResidual) {
  for (const Named& b : named_bodies()) {
    const EigenPairs pairs = lowest(b.pencil, b.count);
    ASSERT_TRUE(pairs.converged) << b.name << ": " << pairs.reason;
    EXPECT_EQ(pairs.missed, 0) << b.name;
    EXPECT_TRUE(pairs.checked) << b.name;
    EXPECT_EQ(pairs.zero, b.zero) << b.name;
    EXPECT_LT(gap_from_identity(pairs.shapes.transpose() * b.pencil.M * pairs.shapes), orthogonal) << b.name;
    for (Index j = 0; j < b.count; ++j) {
      EXPECT_LE(pairs.lambda[std::max<Index>(j - 1, 0)], pairs.lambda[j]) << b.name;
      const VectorXd phi = pairs.shapes.col(j), load = b.pencil.M * phi;
      const double off = (b.pencil.K * phi - pairs.lambda[j] * load).norm();
      // Rounding of Kφ, some eps λmax/λ, lies above 1e-9 for fine beams only: λmax/λ = 1e10.
      const double rounding = 2e-16 * b.pencil.K.diagonal().cwiseQuotient(b.pencil.M.diagonal()).maxCoeff();
      EXPECT_LT(off, (2e-9 * std::abs(pairs.lambda[j]) + 10 * rounding) * load.norm()) << b.name << " " << j;
      Index at = 0;
      phi.cwiseAbs().maxCoeff(&at);
      EXPECT_GT(phi[at], 0) << b.name;
    }
  }
}

TEST(EigenLowest, MeetsSpectraOnClampedFreeAndSymmetricBodies) {
  for (const Named& b : named_bodies()) {
    const Index n = b.pencil.K.rows();
    const EigenPairs pairs = lowest(b.pencil, b.count);
    const double largest = b.pencil.K.diagonal().sum() / b.pencil.M.diagonal().sum(), mu = -1e-6 * largest;
    using Solve = Spectra::SymShiftInvert<double, Eigen::Sparse, Eigen::Sparse>;
    using Product = Spectra::SparseSymMatProd<double>;
    Solve solve(b.pencil.K, b.pencil.M);
    Product product(b.pencil.M);
    const int more = b.count + 3;  // so that Lanczos sees all of a cluster at the end
    Spectra::SymGEigsShiftSolver<Solve, Product, Spectra::GEigsMode::ShiftInvert> spectra(
        solve, product, more, static_cast<int>(std::min<Index>(n, 4 * more)), mu);
    spectra.init();
    ASSERT_EQ(spectra.compute(Spectra::SortRule::LargestMagn, 1000, 1e-14, Spectra::SortRule::SmallestAlge), more) << b.name;
    const VectorXd theirs = spectra.eigenvalues().head(b.count);
    for (Index j = 0; j < b.count; ++j)
      EXPECT_NEAR(pairs.lambda[j], theirs[j], same * std::max(std::abs(theirs[j]), 1e-6 * largest)) << b.name << " " << j;
    // Their vectors lie in the span of ours, as far as the last cluster is complete in both.
    Index whole = b.count - 1;
    while (whole > 0 && pairs.lambda[whole] - pairs.lambda[whole - 1] < 1e-3 * pairs.lambda[whole]) --whole;
    const MatrixXd V = spectra.eigenvectors().leftCols(whole);
    const MatrixXd inside = pairs.shapes.leftCols(whole).transpose() * b.pencil.M * V;
    EXPECT_LT(gap_from_identity(inside.transpose() * inside), 1e-8) << b.name;
  }
}

TEST(EigenLowest, MeetsClosedForms) {
  for (int n : {3, 60, 900})
    for (bool walls : {true, false})
      for (int p : {1, 3, 9}) {
        if (p > n) continue;
        const EigenPairs pairs = lowest(chain(n, walls), p);
        const VectorXd exact = chain_lambda(n, walls);
        for (Index j = 0; j < p; ++j) EXPECT_NEAR(pairs.lambda[j], exact[j], same * exact[j] + 1e-14) << n << " " << p;
      }
  const EigenPairs doubles = lowest(membrane(22), 40);
  EXPECT_LT((doubles.lambda - membrane_lambda(22).head(40)).cwiseAbs().maxCoeff(), same * 0.02);
}

TEST(EigenLowest, FindsEveryPairOfASmallBody) {
  for (int n : {3, 4, 40, 200}) {
    const EigenPairs pairs = lowest(chain(n, false), n);
    EXPECT_LT((pairs.lambda - chain_lambda(n, false)).cwiseAbs().maxCoeff(), 1e-12) << n;
    EXPECT_EQ(pairs.zero, 1);
  }
}

TEST(EigenLowest, SolvesForAQuarterOfAMiddlingBody) {
  const EigenPairs pairs = lowest(chain(600, true), 200);
  EXPECT_LT(((pairs.lambda - chain_lambda(600, true).head(200)).array() / chain_lambda(600, true).head(200).array()).abs().maxCoeff(),
            same);
}

TEST(EigenLowest, DegreesOfFreedomWithoutMassFollowStatically) {
  // Every second mass removed: the springs on either side act in series, a chain of half the
  // stiffness.
  for (int n : {41, 1601}) {
    Pencil a = chain(n, true);
    for (int i = 0; i < n; i += 2) a.M.coeffRef(i, i) = 0;
    const int masses = n / 2;
    const EigenPairs pairs = lowest(a, 7);
    const VectorXd exact = 0.5 * chain_lambda(masses, true).head(7);
    for (Index j = 0; j < 7; ++j) EXPECT_NEAR(pairs.lambda[j], exact[j], same * exact[j]) << n;
    EXPECT_LT(gap_from_identity(pairs.shapes.transpose() * a.M * pairs.shapes), orthogonal);
  }
}

TEST(EigenLowest, FewMassesOnALargeBodyHaveAsManyModes) {
  Pencil a = chain(1001, true);
  for (int i = 0; i < 1001; ++i) a.M.coeffRef(i, i) = i == 250 || i == 500 || i == 750 ? 1 : 0;
  const EigenPairs pairs = lowest(a, 3);
  ASSERT_TRUE(pairs.converged) << pairs.reason;
  EXPECT_GT(pairs.lambda[0], 0);
  EXPECT_THROW(lowest(a, 4), std::invalid_argument);
}

TEST(EigenLowest, AGivenShiftChangesNothing) {
  const Pencil a = strip(false);
  const EigenPairs chosen = lowest(a, 8);
  for (double shift : {-1e-6, -1e-3, -1.0}) {
    EigenOptions options;
    options.count = 8;
    options.shift = shift;
    const EigenPairs pairs = eigen_lowest(a.K, a.M, options);
    ASSERT_TRUE(pairs.converged) << shift;
    for (Index j = 3; j < 8; ++j) EXPECT_NEAR(pairs.lambda[j], chosen.lambda[j], same * chosen.lambda[j]) << shift;
  }
}

TEST(EigenLowest, GivesTheSameBitsTwice) {
  const Pencil a = ring(60, 5);
  const EigenPairs first = lowest(a, 12), second = lowest(a, 12);
  EXPECT_TRUE(first.lambda == second.lambda);
  EXPECT_TRUE(first.shapes == second.shapes);
}

TEST(EigenLowest, ScalesWithTheUnits) {
  const Pencil a = strip(false);
  const EigenPairs one = lowest(a, 8);
  for (double factor : {1e-9, 1e9}) {
    const EigenPairs other = lowest({factor * a.K, a.M / factor}, 8);
    EXPECT_EQ(other.zero, 3);
    for (Index j = 3; j < 8; ++j) EXPECT_NEAR(other.lambda[j] / (factor * factor), one.lambda[j], same * one.lambda[j]);
  }
}

/// The refusal's text.
std::string refusal(const Pencil& a, const EigenOptions& options) {
  return pintle_test::refusal_by<std::invalid_argument>([&] { eigen_lowest(a.K, a.M, options); });
}

TEST(EigenLowest, RefusesMoreModesThanThereAre) {
  EigenOptions options;
  options.count = 9;
  EXPECT_EQ(refusal(chain(6, true), options), "9 modes asked for, the body has 6");
  Pencil a = chain(9, true);
  for (int i : {0, 4, 8}) a.M.coeffRef(i, i) = 0;
  EXPECT_EQ(refusal(a, options), "9 modes asked for, the body has 6");
  options.count = 0;
  EXPECT_EQ(refusal(a, options), "0 modes asked for, must be at least 1");
  options.count = 1;
  options.shift = 2;
  EXPECT_NE(refusal(a, options), "");
  options.shift = 0;
  a.M *= 0;
  EXPECT_NE(refusal(a, options), "");
  a.M.resize(4, 4);
  EXPECT_NE(refusal(a, options), "");
}

TEST(EigenLowest, RefusesAFreedomWithNeitherStiffnessNorMass) {
  for (int n : {9, 900}) {
    Pencil a = chain(n, true);
    a.K.coeffRef(3, 3) = a.K.coeffRef(3, 2) = a.K.coeffRef(2, 3) = a.K.coeffRef(3, 4) = a.K.coeffRef(4, 3) = 0;
    a.M.coeffRef(3, 3) = 0;
    EXPECT_THROW(lowest(a, 2), std::runtime_error) << n;
  }
}

TEST(EigenLowest, ReportsWhenItDoesNotGetThere) {
  const Pencil a = strip(false);
  EigenOptions options;
  options.count = 12;
  for (int iterations : {1, 3}) {
    options.max_iterations = iterations;
    const EigenPairs pairs = eigen_lowest(a.K, a.M, options);
    EXPECT_FALSE(pairs.converged);
    EXPECT_NE(pairs.reason, "");
    EXPECT_EQ(pairs.lambda.size(), pairs.shapes.cols());
  }
}

TEST(EigenBelow, FindsThoseBelowAndNoOther) {
  for (const auto& [c, limit] : {std::pair{5, 1.3}, {25, 0.35}, {25, 1e-3}}) {
    const Pencil a = membrane(c);
    const VectorXd exact = membrane_lambda(c);
    const Index below = (exact.array() < limit).count();
    const EigenPairs pairs = eigen_below(a.K, a.M, limit);
    ASSERT_EQ(pairs.lambda.size(), below) << c << " " << limit;
    EXPECT_TRUE(pairs.converged);
    for (Index j = 0; j < below; ++j) EXPECT_NEAR(pairs.lambda[j], exact[j], same * exact[j]);
  }
}

TEST(Sturm, CountsWhatDenseAlgebraFinds) {
  std::mt19937 draw(11);
  for (const Pencil& a : {square(9, false), ring(24, 3), beam(60, true), membrane(14)}) {
    const VectorXd all = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(MatrixXd(a.K), MatrixXd(a.M)).eigenvalues();
    std::uniform_real_distribution<double> in(0, 1);
    for (int i = 0; i < 12; ++i) {
      const double at = all[all.size() - 1] * std::pow(in(draw), 3);
      EXPECT_EQ(negative_eigenvalues(a.K - at * a.M), (all.array() < at).count()) << at;
    }
  }
}

// A body of two equal halves that do not touch has each mode twice; started in one half, the
// iteration finds one of each two.
TEST(Subspace, StartedClearOfModesMissesThem) {
  const Pencil a = both(chain(500, true), chain(500, true));
  Factor factor;
  ASSERT_TRUE(factor.compute(a.K + 1e-9 * a.M));
  Subspace space(factor, a.M, 200);
  MatrixXd R = MatrixXd::Zero(1000, 4);
  R.topRows(500) = starting_loads(chain(500, true).K, chain(500, true).M, 4, 1);
  space.add_loads(R);
  for (int i = 0; i < 20; ++i) space.step();
  space.project();
  const VectorXd exact = chain_lambda(500, true);
  for (Index j = 0; j < 4; ++j) EXPECT_NEAR(1 / space.theta()[j], exact[j] + 1e-9, same * exact[j] + 1e-15);
  EXPECT_EQ(negative_eigenvalues(a.K - 0.5 * (exact[3] + exact[4]) * a.M), 8);
  // Other loads mend it.
  space.restart(8);
  space.add_loads(random_loads(a.M, 4, 2));
  for (int i = 0; i < 12; ++i) space.step();
  space.project();
  for (Index j = 0; j < 8; ++j) EXPECT_NEAR(1 / space.theta()[j], exact[j / 2] + 1e-9, same * exact[j / 2] + 1e-15);
}

// Sixteen equal squares: each eigenvalue sixteen times, more than a block is wide.
TEST(EigenLowest, FindsEigenvaluesRepeatedMoreOftenThanABlockIsWide) {
  Pencil a = square(5, true);
  for (int i = 0; i < 4; ++i) a = both(a, a);
  const VectorXd one =
      Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(MatrixXd(square(5, true).K), MatrixXd(square(5, true).M)).eigenvalues();
  for (int p : {6, 20, 32}) {
    const EigenPairs pairs = lowest(a, p);
    ASSERT_TRUE(pairs.converged) << pairs.reason;
    for (Index j = 0; j < p; ++j) EXPECT_NEAR(pairs.lambda[j], one[j / 16], same * one[j / 16]) << p << " " << j;
  }
}

}  // namespace
}  // namespace pintle::eigen_test
