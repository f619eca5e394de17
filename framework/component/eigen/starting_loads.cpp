#include "framework/component/eigen/starting_loads.h"

#include <random>

#include "framework/component/eigen/tall_products.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

MatrixXd random_vectors(Index n, Index count, unsigned seed) {
  std::mt19937 draw(seed);  // its numbers are the same on every platform; the standard's distributions are not
  MatrixXd X(n, count);
  for (Index j = 0; j < count; ++j)
    for (Index i = 0; i < n; ++i) X(i, j) = static_cast<double>(draw()) / 2147483647.5 - 1;
  return X;
}

}  // namespace

MatrixXd random_loads(const Eigen::SparseMatrix<double>& M, int count, unsigned seed) {
  return product(M, random_vectors(M.rows(), count, seed));
}

MatrixXd starting_loads(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, int count, unsigned seed) {
  const Index n = K.rows(), single = (count - 1) / 2, drawn = count - 1 - single;
  const Eigen::VectorXd k = K.diagonal(), m = M.diagonal();
  MatrixXd X = MatrixXd::Zero(n, count);
  X.col(0).setOnes();
  for (Index j = 0; j < single; ++j) {
    const Index first = j * n / single, last = (j + 1) * n / single;
    Index best = first;
    for (Index i = first; i < last; ++i)
      if (m[i] * k[best] > m[best] * k[i]) best = i;
    X(best, 1 + j) = 1;
  }
  X.rightCols(drawn) = random_vectors(n, drawn, seed);
  return product(M, X);
}

}  // namespace pintle
