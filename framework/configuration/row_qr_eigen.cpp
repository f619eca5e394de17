// sparse_column_rank with PINTLE_GPL=OFF: without SPQR, which is under the GPL.
#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include "framework/configuration/row_qr.h"

namespace pintle {

int sparse_column_rank(const Eigen::SparseMatrix<double>& A, double tolerance, std::vector<Weights>& idle) {
  Eigen::SparseMatrix<double> compressed = A;
  compressed.makeCompressed();
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(tolerance);
  qr.compute(compressed);
  const Eigen::Index rank = qr.rank();
  const Eigen::SparseMatrix<double> R = Eigen::SparseMatrix<double, Eigen::RowMajor>(qr.matrixR());  // which sorts the rows
  const Eigen::SparseMatrix<double> independent = R.topLeftCorner(rank, rank);
  for (Eigen::Index c = rank; c < A.cols(); ++c) {  // A P = Q R, independent columns first
    Eigen::VectorXd x = Eigen::VectorXd(R.col(c)).head(rank);
    independent.triangularView<Eigen::Upper>().solveInPlace(x);
    idle.push_back(dependence(qr.colsPermutation().indices(), c, x));
  }
  return static_cast<int>(rank);
}

}  // namespace pintle
