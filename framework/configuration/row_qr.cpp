#include "framework/configuration/row_qr.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "framework/dynamics/solvers/sparse_ldl.h"

namespace pintle {

namespace {

using Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

constexpr Index few = SparseLdl::few;  ///< rows and columns of a small matrix; SPQR takes time to load

int dense_column_rank(const Sparse& A, double tolerance, std::vector<Weights>& idle) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr{Eigen::MatrixXd(A)};
  const auto& R = qr.matrixQR();
  const Index most = std::min(R.rows(), R.cols());
  Index rank = 0;
  while (rank < most && std::abs(R(rank, rank)) > tolerance) ++rank;
  const auto independent = R.topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
  for (Index c = rank; c < A.cols(); ++c)
    idle.push_back(dependence(qr.colsPermutation().indices(), c, independent.solve(R.col(c).head(rank))));
  return static_cast<int>(rank);
}

}  // namespace

Weights dependence(const Eigen::VectorXi& original, Index c, const Eigen::VectorXd& x) {
  Weights weights{{original[c], 1.0}};
  for (Index r = 0; r < x.size(); ++r)
    if (x[r] != 0) weights.emplace_back(original[r], -x[r]);
  return weights;
}

int column_rank(const Sparse& A, double tolerance, std::vector<Weights>& idle) {
  const bool small = A.rows() <= few && A.cols() <= few;
  return small ? dense_column_rank(A, tolerance, idle) : sparse_column_rank(A, tolerance, idle);
}

}  // namespace pintle
