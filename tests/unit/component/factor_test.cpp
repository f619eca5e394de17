#include "framework/component/eigen/factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "framework/component/eigen/symbolic.h"

namespace pintle::factor_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

// Backward error of a sparse Cholesky solve over that of one product: some tens of roundings.
constexpr double rounding = 1e-13;

/// Five-point Laplacian of nx × ny points between walls, plus random symmetric couplings of
/// `noise`.
Sparse grid(int nx, int ny, double noise = 0, unsigned seed = 1) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> in(-noise, noise);
  std::vector<Eigen::Triplet<double>> t;
  const auto id = [&](int i, int j) { return i * ny + j; };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      t.emplace_back(id(i, j), id(i, j), 4.0 + in(draw));
      const auto couple = [&](int k) {
        const double x = -1 + in(draw);
        t.emplace_back(id(i, j), k, x);
        t.emplace_back(k, id(i, j), x);
      };
      if (i + 1 < nx) couple(id(i + 1, j));
      if (j + 1 < ny) couple(id(i, j + 1));
    }
  Sparse A(nx * ny, nx * ny);
  A.setFromTriplets(t.begin(), t.end());
  return A;
}

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> in(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return in(draw); });
}

int dense_count(const Sparse& A) {
  return static_cast<int>((Eigen::SelfAdjointEigenSolver<MatrixXd>(MatrixXd(A)).eigenvalues().array() < 0).count());
}

TEST(Factor, SolvesForAnyNumberOfRightHandSides) {
  const Sparse A = grid(40, 25);
  Factor factor;
  ASSERT_TRUE(factor.compute(A));
  for (int columns : {1, 3, 64, 65, 130}) {
    const MatrixXd B = random_matrix(A.rows(), columns, 2);
    MatrixXd X;
    factor.solve_into(B, X);
    EXPECT_LT((A * X - B).norm(), rounding * B.norm() * 1e3) << columns;  // condition number 4e2
    EXPECT_EQ((factor.solve(B) - X).norm(), 0) << columns;
  }
}

TEST(Factor, ReadsTheLowerTriangleOnly) {
  const Sparse A = grid(9, 8), lower = A.triangularView<Eigen::Lower>();
  Factor both, half;
  ASSERT_TRUE(both.compute(A));
  ASSERT_TRUE(half.compute(lower));
  const MatrixXd b = random_matrix(A.rows(), 2, 3);
  EXPECT_LT((both.solve(b) - half.solve(b)).norm(), rounding * both.solve(b).norm());
}

TEST(Factor, TakesNewValuesAndNewPatterns) {
  Factor factor;
  for (const Sparse& A : {grid(12, 10), Sparse(3 * grid(12, 10)), grid(7, 5), grid(10, 12)}) {
    ASSERT_TRUE(factor.compute(A));
    const MatrixXd b = random_matrix(A.rows(), 1, 4);
    EXPECT_LT((A * factor.solve(b) - b).norm(), rounding * 1e2 * b.norm());
  }
}

// Ones on the diagonal, and below the first of them four entries. Their rows are such that FNV-1a, taken over sizes and rows
// as 32-bit words from the basis 1469598103934665603, is the same for both.
TEST(Factor, TellsPatternsOfOneHashApart) {
  const int n = 1 << 17;
  Factor factor;
  for (const std::vector<int>& rows : {std::vector{2132, 23829, 63832, 65536}, {15581, 29664, 56486, 100028}}) {
    std::vector<Eigen::Triplet<double>> t;
    for (int i = 0; i < n; ++i) t.emplace_back(i, i, 1.0);
    for (const int i : rows) t.emplace_back(i, 0, 0.25);
    Sparse lower(n, n);
    lower.setFromTriplets(t.begin(), t.end());
    ASSERT_TRUE(factor.compute(lower));
    const VectorXd b = VectorXd::LinSpaced(n, 1, 2);
    EXPECT_LT((lower.selfadjointView<Eigen::Lower>() * factor.solve(b) - b).norm(), rounding * 1e2 * b.norm());
  }
}

TEST(Factor, SurvivesBeingMoved) {
  const Sparse A = grid(6, 6);
  Factor factor;
  ASSERT_TRUE(factor.compute(A));
  const Factor moved = std::move(factor);
  const MatrixXd b = random_matrix(A.rows(), 1, 5);
  EXPECT_LT((A * moved.solve(b) - b).norm(), rounding * 1e2 * b.norm());
}

TEST(Factor, NamesTheColumnThatIsNotPositive) {
  Sparse A = grid(5, 5);
  A.coeffRef(13, 13) = -1;
  Factor factor;
  EXPECT_FALSE(factor.compute(A));
  EXPECT_GE(factor.pivot(), 0);
  A.coeffRef(13, 13) = 4;
  EXPECT_TRUE(factor.compute(A));
  EXPECT_EQ(factor.pivot(), -1);
}

TEST(Factor, RefusesARectangle) { EXPECT_THROW(Factor().compute(Sparse(3, 4)), std::invalid_argument); }

TEST(NegativeEigenvalues, AreCountedAsDenseAlgebraCounts) {
  // 15 × 12 points fit a few supernodes, 60 × 8 a long chain of them.
  for (const auto& [nx, ny] : {std::pair{3, 1}, {15, 12}, {60, 8}, {18, 17}}) {
    const Sparse A = grid(nx, ny, 0.5, 7);
    Sparse one(A.rows(), A.rows());
    one.setIdentity();
    for (double shift : {-0.5, 0.31, 1.07, 2.213, 3.9717, 5.01, 7.7, 20.0})
      EXPECT_EQ(negative_eigenvalues(A - shift * one), dense_count(A - shift * one)) << nx << " by " << ny << ", " << shift;
  }
}

TEST(NegativeEigenvalues, OfAMatrixWithNothingOnItsDiagonal) {
  // A path of an even number of points has eigenvalues 2 cos(kπ/(n+1)): half of them are negative.
  Sparse A(500, 500);
  for (int i = 0; i + 1 < 500; ++i) A.insert(i, i + 1) = A.insert(i + 1, i) = 1;
  // Pivoting stays inside supernodes, so a zero pivot block may stand in the way; never a wrong
  // count.
  try {
    EXPECT_EQ(negative_eigenvalues(A), 250);
  } catch (const std::runtime_error&) {
  }
}

TEST(NegativeEigenvalues, RefuseASingularMatrix) {
  Sparse A(4, 4);
  for (int i = 0; i < 4; ++i) A.insert(i, i) = i == 2 ? 0 : 1;
  EXPECT_THROW(negative_eigenvalues(A), std::runtime_error);
}

TEST(NegativeEigenvalues, AreTheSameInABorrowedOrder) {
  const Sparse A = grid(40, 21, 0.2, 9);
  Sparse one(A.rows(), A.rows());
  one.setIdentity();
  Factor factor;
  ASSERT_TRUE(factor.compute(A + 2 * one));
  EXPECT_EQ(negative_eigenvalues(A - 1.234 * one, factor.supernodes()), negative_eigenvalues(A - 1.234 * one));
}

TEST(NegativeEigenvalues, AreTheSameBySupernodesFoundFromThePatternAlone) {
  for (const auto& [nx, ny] : {std::pair{40, 21}, {1, 30}, {7, 7}, {90, 2}}) {
    const Sparse A = grid(nx, ny, 0.2, 11);
    Factor factor;
    factor.analyse(A);
    const Symbolic symbolic(A, factor.supernodes().order);
    Sparse one(A.rows(), A.rows());
    one.setIdentity();
    for (const double shift : {-1.0, 1.234, 3.21, 6.5}) {
      const Sparse shifted = A - shift * one;
      EXPECT_EQ(negative_eigenvalues(shifted, symbolic.supernodes()), dense_count(shifted)) << nx << " by " << ny << ", shift " << shift;
    }
  }
}

TEST(Symbolic, HasEveryRowThatFillsInAndNoOther) {
  const Sparse A = grid(12, 9);
  Factor factor;
  factor.analyse(A);
  const Symbolic symbolic(A, factor.supernodes().order);
  const Supernodes s = symbolic.supernodes();
  MatrixXd filled = MatrixXd::Zero(s.n, s.n);  // elimination on paper: what is left of A where an entry may stand
  for (int i = 0; i < s.n; ++i)
    for (int j = 0; j < s.n; ++j) filled(i, j) = A.coeff(s.order[i], s.order[j]) != 0 ? 1 : 0;
  for (int k = 0; k < s.n; ++k)
    for (int i = k + 1; i < s.n; ++i)
      for (int j = k + 1; j < s.n; ++j)
        if (filled(i, k) > 0 && filled(k, j) > 0) filled(i, j) = 1;
  for (int node = 0; node < s.count; ++node)
    for (int c = s.first[node]; c < s.first[node + 1]; ++c) {
      std::vector<int> expected;
      for (int i = c; i < s.n; ++i)
        if (filled(i, c) > 0) expected.push_back(i);
      const std::vector<int> found(s.row + s.row_begin[node] + (c - s.first[node]), s.row + s.row_begin[node + 1]);
      EXPECT_EQ(found, expected) << "column " << c;
    }
  EXPECT_EQ(s.first[s.count], s.n);
}

}  // namespace
}  // namespace pintle::factor_test
