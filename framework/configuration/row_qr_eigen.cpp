// column_rank with PINTLE_GPL=OFF: without SPQR, which is under the GPL.
#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include "framework/configuration/row_qr.h"

namespace pintle {

int column_rank(const Eigen::SparseMatrix<double>& A, double tolerance, std::vector<Weights>& idle) {
  Eigen::SparseMatrix<double> compressed = A;
  compressed.makeCompressed();
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(tolerance);
  qr.compute(compressed);
  const Eigen::Index rank = qr.rank();
  const auto& original = qr.colsPermutation().indices();                                             // A P = Q R, independent columns first
  const Eigen::SparseMatrix<double> R = Eigen::SparseMatrix<double, Eigen::RowMajor>(qr.matrixR());  // which sorts the rows
  const Eigen::SparseMatrix<double> independent = R.topLeftCorner(rank, rank);
  for (Eigen::Index c = rank; c < A.cols(); ++c) {
    Eigen::VectorXd x = Eigen::VectorXd(R.col(c)).head(rank);
    independent.triangularView<Eigen::Upper>().solveInPlace(x);
    Weights weights{{original[c], 1.0}};
    for (Eigen::Index r = 0; r < rank; ++r)
      if (x[r] != 0) weights.emplace_back(original[r], -x[r]);
    idle.push_back(std::move(weights));
  }
  return static_cast<int>(rank);
}

}  // namespace pintle
