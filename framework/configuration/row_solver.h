#pragma once

#include <Eigen/QR>
#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Solves with the rows of Cq without masses: rows are scaled by `row_scale`, coordinates by `scale`. Dense, with the rank found by
/// pivoting, up to `dense_size` coordinates; sparse least squares above.
class RowSolver {
 public:
  static constexpr int dense_size = 150;

  /// Factors the rows. @pre pose
  void factor(const System&, const Equations&);
  /// x of least norm that minimises |Cq x − r|. @pre factor
  Eigen::VectorXd solve(const System&, const Eigen::VectorXd& r) const;
  /// λ of least norm with Cqᵀλ = g, g in the span of the rows; in the norm, couples are divided by the mechanism's length.
  Eigen::VectorXd reactions(const System&, const Eigen::VectorXd& g) const;
  /// Cq x
  Eigen::VectorXd times(const System&, const Eigen::VectorXd& x) const;
  /// The rows have lost rank in this configuration, to `singular`. Dense only: a sparse system always counts as regular.
  bool deficient() const { return dense_ && rank_ < cod_.cols(); }

  static constexpr double singular = 1e-8;  ///< pivot relative to the largest

 private:
  bool dense_ = true;
  Eigen::Index rank_ = 0;
  Eigen::SparseMatrix<double> A_, At_;  ///< scaled rows of a large system
  Eigen::MatrixXd D_;                   ///< the same of a small one
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod_;
};

}  // namespace pintle
