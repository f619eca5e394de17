#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include "eigen_layout.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/common/members.h"

namespace pintle {

/// Generalised coordinate partitioning [Wehage1982]: as many dependent coordinates as there are independent rows are computed from the
/// others. A pivoted QR of Cq selects the dependent coordinates that are best determined.
class Partition {
 public:
  /// Chooses the sets in the configuration of `eq`.
  void choose(const System&, const Equations&);
  /// Projects the dependent part of y onto C = 0, Ċ = 0, without changing the independent part.
  /// @returns false if it does not converge
  bool correct(const System&, double t, Eigen::VectorXd& y, Equations&);
  /// Whether it was chosen for the rows present in `eq`.
  bool suits(const Equations& eq) const { return !dependent_.empty() && released_ == eq.released; }
  /// Whether the chosen set is so ill conditioned that it should be chosen again.
  bool worn() const { return quality_ < 0.3 * chosen_quality_; }

  void take_set(const Partition& other) {
    if (dependent_ != other.dependent_) dependent_ = other.dependent_;
    if (released_ != other.released_) released_ = other.released_;
  }

  /// Whether its set is a valid set of coordinates of the system.
  bool fits(const System&) const;

  int choices() const { return choices_; }
  const std::vector<int>& dependent() const { return dependent_; }
  /// The data that the next corrections depend on.
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(dependent_, released_, quality_, chosen_quality_, choices_));
  }

 private:
  void assemble(const System&, const Equations&);
  void factor();
  double subtract(const System&, const Eigen::VectorXd& violation, double* y);

  Eigen::MatrixXd Cq_, block_;  ///< dimensionless: rows by row_scale, x and y by the length
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;  ///< for redundant rows: fewer columns than rows
  Eigen::VectorXd step_;
  std::vector<int> dependent_, released_;    ///< rows that were released when it was chosen
  double quality_ = 1, chosen_quality_ = 1;  ///< smallest pivot of the scaled block
  int choices_ = 0;
};

}  // namespace pintle
