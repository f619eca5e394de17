#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include "eigen_layout.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/common/members.h"

namespace pintle {

/// Generalised coordinate partitioning [Wehage1982]: as many coordinates as there are independent rows
/// follow from the others. The dependent ones are those that a pivoted QR of Cq finds best determined.
class Partition {
 public:
  /// Chooses the sets at the pose in `eq`.
  void choose(const System&, const Equations&);
  /// Puts the dependent part of y on C = 0, Ċ = 0, the independent part untouched.
  /// @returns false if it does not converge
  bool correct(const System&, double t, Eigen::VectorXd& y, Equations&);
  /// It was chosen for the rows that are there at the pose in `eq`.
  bool suits(const Equations& eq) const { return !dependent_.empty() && released_ == eq.released; }
  /// The chosen set has become so ill determined that it should be chosen again.
  bool worn() const { return quality_ < 0.3 * chosen_quality_; }

  void take_set(const Partition& other) {
    if (dependent_ != other.dependent_) dependent_ = other.dependent_;
    if (released_ != other.released_) released_ = other.released_;
  }

  /// Its set is one of coordinates of the system.
  bool fits(const System&) const;

  int choices() const { return choices_; }
  const std::vector<int>& dependent() const { return dependent_; }
  /// What the next corrections depend on.
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(dependent_, released_, quality_, chosen_quality_, choices_));
  }

 private:
  void assemble(const System&, const Equations&);
  void factor();
  double subtract(const System&, const Eigen::VectorXd& violation, double* y);

  Eigen::MatrixXd Cq_, block_;  ///< free of units: rows by row_scale, x and y by the length
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;  ///< where rows are redundant: fewer columns than rows
  Eigen::VectorXd step_;
  std::vector<int> dependent_, released_;    ///< rows that were released as it was chosen
  double quality_ = 1, chosen_quality_ = 1;  ///< smallest pivot of the scaled block
  int choices_ = 0;
};

}  // namespace pintle
