#include "framework/component/eigen/pencil.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/common/dense.h"
#include "framework/component/eigen/tall_products.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double rounding = 1e-13;  // relative to the terms of a sum
constexpr Index spare = 8;          // vectors in addition to those wanted, in the last projection

// |K||φ|: the size of the terms summed in Kφ.
VectorXd summed_from(const Sparse& K, const VectorXd& phi) {
  VectorXd sum = VectorXd::Zero(phi.size());
  for (int j = 0; j < K.outerSize(); ++j)
    for (Sparse::InnerIterator a(K, j); a; ++a) sum[j] += std::abs(a.value() * phi[a.row()]);
  return sum;
}

// Counts the rigid motions, which come first, and computes residuals.
void measure(const Sparse& K, const MatrixXd& KX, const MatrixXd& MX, EigenPairs& pairs) {
  const Index count = pairs.lambda.size();
  pairs.residual.resize(count);
  pairs.zero = 0;
  for (Index j = 0; j < count; ++j) {
    const double lambda = pairs.lambda[j], off = (KX.col(j) - lambda * MX.col(j)).norm();
    pairs.residual[j] = off / (std::abs(lambda) * MX.col(j).norm());
    if (pairs.zero < j) continue;
    const VectorXd terms = summed_from(K, pairs.shapes.col(j));
    if (std::abs(lambda) > rounding * terms.dot(pairs.shapes.col(j).cwiseAbs())) continue;
    pairs.residual[j] = KX.col(j).norm() / std::max(terms.norm(), std::numeric_limits<double>::min());
    ++pairs.zero;
  }
}

void make_largest_positive(MatrixXd& X) {
  for (Index j = 0; j < X.cols(); ++j) {
    Index at = 0;
    X.col(j).cwiseAbs().maxCoeff(&at);
    if (X(at, j) < 0) X.col(j) *= -1;
  }
}

}  // namespace

std::string too_many(int asked, Index there) {
  return std::to_string(asked) + (asked == 1 ? " mode" : " modes") + " asked for, the body has " + std::to_string(there);
}

std::string not_definite(double mu) {
  return "K - mu M is not positive definite with mu = " + std::to_string(mu) +
         ": a part of the body has neither stiffness nor mass, or K is not semidefinite";
}

double stiffness_over_mass(const Sparse& K, const Sparse& M) {
  const double k = K.diagonal().sum(), m = M.diagonal().sum();
  if (!(m > 0))
    throw std::invalid_argument("the body's mass matrix has the trace " + std::to_string(m) +
                                ", must be > 0: give it a density or point masses");
  return k > 0 ? k / m : 1;
}

Sparse shifted(const Sparse& K, const Sparse& M, double mu) {
  Sparse A = K;  // NOLINT(performance-unnecessary-copy-initialization): its entries are changed
  for (int j = 0; j < K.outerSize(); ++j) {
    Sparse::InnerIterator a(A, j);
    for (Sparse::InnerIterator m(M, j); m; ++m) {
      while (a && a.row() < m.row()) ++a;
      if (!a || a.row() != m.row()) return K - mu * M;  // an entry missing in K
      a.valueRef() -= mu * m.value();
    }
  }
  return A;
}

void refine(const Sparse& K, const Sparse& M, MatrixXd X, int count, EigenPairs& out) {
  const Index q = X.cols();
  MatrixXd KX = product(K, X), MX = product(M, X);
  const Eigen::LLT<MatrixXd> mass(inner(X, MX));
  const MatrixXd inverse = mass.matrixU().solve(MatrixXd::Identity(q, q));
  const MatrixXd k = inverse.transpose() * inner(X, KX) * inverse;
  const Spectrum pairs = spectrum(0.5 * (k + k.transpose()));
  const MatrixXd C = inverse * pairs.vectors.leftCols(count);
  for (MatrixXd* Y : {&X, &KX, &MX}) turn(*Y, C);
  X.conservativeResize(Eigen::NoChange, count);
  out.lambda = pairs.values.head(count);
  out.shapes = std::move(X);
  make_largest_positive(out.shapes);
  // K and M times the shapes, except the sign, which does not matter here.
  measure(K, KX, MX, out);
}

EigenPairs eigen_dense(const Sparse& K, const Sparse& M, int count, double mu) {
  const MatrixXd mass(M);
  const Eigen::LLT<MatrixXd> factor(MatrixXd(K) - mu * mass);
  if (factor.info() != Eigen::Success) throw std::runtime_error(not_definite(mu));
  const MatrixXd half = factor.matrixL().solve(mass);
  const MatrixXd C = factor.matrixL().solve(half.transpose());
  const Spectrum reciprocal = spectrum(0.5 * (C + C.transpose()));
  const Index n = mass.rows();
  const double least = 10 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * reciprocal.values[n - 1];
  Index finite = 0;
  while (finite < n && reciprocal.values[n - 1 - finite] > least) ++finite;
  if (count > finite) throw std::invalid_argument(too_many(count, finite));

  EigenPairs out;
  const Index q = std::min<Index>(finite, count + spare);
  refine(K, M, factor.matrixU().solve(reciprocal.vectors.rightCols(q)), count, out);
  out.converged = out.checked = true;
  return out;
}

}  // namespace pintle
