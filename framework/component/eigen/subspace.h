#pragma once

#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "framework/component/eigen/factor.h"

namespace pintle {

/// The subspace that Bathe's iteration works in, with all turning vectors kept: an M-orthonormal
/// basis Q = [older | current block] of iterates of A⁻¹M, and T = QᵀMA⁻¹MQ over the older ones. A
/// step solves for the current block; what the old basis cannot say of the answer, its turning, is
/// the next block:
///   A⁻¹M Q_old = Q_old T + Q_current C.
/// Theory: docs/theory/modes.md. Sources: [Bathe2013], [KimBathe2017].
class Subspace {
 public:
  /// @param A  the factor of K − μM   @param capacity  most columns of Q; Q takes n × capacity
  /// numbers
  Subspace(const Factor& A, const Eigen::SparseMatrix<double>& M, Eigen::Index capacity);

  void reserve(Eigen::Index capacity);  ///< never less than it is
  /// Widens the current block by the directions of A⁻¹R, n × any, that are new. @pre R is in the
  /// range of M
  void add_loads(const Eigen::MatrixXd& R);
  /// One iteration: solves for the current block, which becomes old.
  void step();
  /// Ritz values and vectors of T, and how far each is from being a pair.
  void project();
  /// Only the first `keep` Ritz vectors stay of the old ones. @pre project
  void restart(Eigen::Index keep);

  Eigen::Index capacity() const { return Q_.cols(); }
  bool room() const { return used_ + width() <= Q_.cols(); }  ///< for another step
  Eigen::Index old() const { return old_; }
  Eigen::Index width() const { return used_ - old_; }  ///< of the current block
  long solves() const { return solves_; }

  // Of the last `project`, by descending theta:
  const Eigen::VectorXd& theta() const { return theta_; }  ///< estimates of 1/(λ − μ)
  /// ‖x − A⁻¹Mx/θ‖_M of each: also ‖Kz − λMz‖ in the norm of M⁻¹ over λ − μ, z = A⁻¹Mx/θ
  const Eigen::VectorXd& defect() const { return defect_; }
  /// z = A⁻¹Mx/θ of the first `count`, n × count: one iteration better than x, at no solve
  Eigen::MatrixXd iterated(Eigen::Index count) const;

 private:
  Eigen::MatrixXd clear(Eigen::MatrixXd& Z, Eigen::MatrixXd& E);
  Eigen::MatrixXd append(const Eigen::MatrixXd& Z, const Eigen::MatrixXd& V, const Eigen::VectorXd& length);
  Eigen::MatrixXd absorb(Eigen::MatrixXd& Z);

  const Factor& A_;
  const Eigen::SparseMatrix<double>& M_;
  Eigen::MatrixXd Q_, T_, C_;                      ///< n × capacity; capacity × capacity; width × old
  Eigen::MatrixXd MQ_, Z_;                         ///< M times the current block; what is solved for
  Eigen::MatrixXd MZ_, lanes_;                     ///< scratch, kept: fresh pages cost more than the sums in them
  Eigen::Index filled_ = 0;                        ///< columns of MQ that hold
  Eigen::Index old_ = 0, used_ = 0, coupled_ = 0;  ///< C is zero left of column `coupled_`
  Eigen::VectorXd theta_, defect_;
  Eigen::MatrixXd S_;  ///< old × old, columns as theta
  long solves_ = 0;
};

}  // namespace pintle
