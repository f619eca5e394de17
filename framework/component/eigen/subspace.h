#pragma once

#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "framework/component/eigen/factor.h"

namespace pintle {

/// The subspace of Bathe's iteration, with all turning vectors kept: an M-orthonormal basis Q = [older | current block] of iterates of
/// A⁻¹M, and T = QᵀMA⁻¹MQ over the older ones. A step solves for the current block; the part of the solution outside the old basis, its
/// turning, is the next block:
///   A⁻¹M Q_old = Q_old T + Q_current C.
/// Theory: docs/theory/modes.md. Sources: [Bathe2013], [KimBathe2017].
class Subspace {
 public:
  /// @param A  the factor of K − μM   @param capacity  largest number of columns of Q, which takes n × capacity numbers
  Subspace(const Factor& A, const Eigen::SparseMatrix<double>& M, Eigen::Index capacity);

  void reserve(Eigen::Index capacity);  ///< never reduces it
  /// Widens the current block by the new directions of A⁻¹R, n × any. @pre R is in the range of M
  void add_loads(const Eigen::MatrixXd& R);
  /// One iteration: solves for the current block, which becomes old.
  void step();
  /// Ritz values and vectors of T, and the error of each as a pair.
  void project();
  /// Keeps only the first `keep` Ritz vectors of the old ones. @pre project
  void restart(Eigen::Index keep);

  Eigen::Index capacity() const { return Q_.cols(); }
  bool room() const { return used_ + width() <= Q_.cols(); }  ///< for another step
  Eigen::Index old() const { return old_; }
  Eigen::Index width() const { return used_ - old_; }  ///< of the current block
  long solves() const { return solves_; }

  // Results of the last `project`, by descending theta:
  const Eigen::VectorXd& theta() const { return theta_; }  ///< estimates of 1/(λ − μ)
  /// ‖x − A⁻¹Mx/θ‖_M of each: also ‖Kz − λMz‖ in the norm of M⁻¹ over λ − μ, z = A⁻¹Mx/θ
  const Eigen::VectorXd& defect() const { return defect_; }
  /// z = A⁻¹Mx/θ of the first `count`, n × count: one iteration better than x, without another solve
  Eigen::MatrixXd iterated(Eigen::Index count) const;

 private:
  Eigen::MatrixXd clear(Eigen::MatrixXd& Z, Eigen::MatrixXd& E);
  Eigen::MatrixXd append(const Eigen::MatrixXd& Z, const Eigen::MatrixXd& V, const Eigen::VectorXd& length);
  Eigen::MatrixXd absorb(Eigen::MatrixXd& Z);

  const Factor& A_;
  const Eigen::SparseMatrix<double>& M_;
  Eigen::MatrixXd Q_, T_, C_;                      ///< n × capacity; capacity × capacity; width × old
  Eigen::MatrixXd MQ_, Z_;                         ///< M times the current block; the right-hand sides and solutions
  Eigen::MatrixXd MZ_, lanes_;                     ///< scratch, kept because fresh memory pages cost more than the sums in them
  Eigen::Index filled_ = 0;                        ///< number of valid columns of MQ
  Eigen::Index old_ = 0, used_ = 0, coupled_ = 0;  ///< C is zero left of column `coupled_`
  Eigen::VectorXd theta_, defect_;
  Eigen::MatrixXd S_;  ///< old × old, columns in the order of theta
  long solves_ = 0;
};

}  // namespace pintle
