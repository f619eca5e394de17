#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// S = L D Lᵀ of a dense symmetric positive semidefinite matrix with its diagonal scaled to 1. The largest remaining pivot is always taken
/// next, so the pivots show the rank for any order of the rows: no rounding error is divided by a pivot smaller than its own.
/// docs/theory/solvers.md. Allocates only where n is larger than before.
class RankLdl {
 public:
  /// @param S      n × n by rows, lower half
  /// @param least  pivots at or below this count as zero
  /// @returns false if a number is not finite or a diagonal entry not positive
  bool factor(int n, const double* S, double least);

  int lost() const { return n_ - rank_; }
  double kept() const { return kept_; }  ///< the smallest nonzero pivot; 1 if there is none
  /// Solves S x = x for x[rows[0]], … x[rows[n − 1]], with zeros in the dependent rows. @pre consistent
  void solve(const int* rows, double* x);
  /// out[rows[k]] ← the i-th null vector, i < lost().
  void null_vector(int i, const int* rows, double* out);

 private:
  void substitute_back();

  int n_ = 0, rank_ = 0;
  double kept_ = 1;
  std::vector<int> order_;    ///< of the pivots
  Eigen::VectorXd root_, x_;  ///< 1/√S_ii; work in the order of the pivots
  Eigen::MatrixXd L_;         ///< in the order of the pivots, D on the diagonal
};

}  // namespace pintle
