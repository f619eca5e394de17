#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "framework/dynamics/flexible.h"
#include "framework/dynamics/system.h"

namespace pintle {

/// The constraint equations after the accelerations are eliminated,  S μ = r  with  S = Cq M⁻¹ Cqᵀ:
/// symmetric, positive definite while the rows are independent, one block for each pair of joints that
/// share a body. Dense and free of allocation up to `dense_rows`, CHOLMOD above; its pattern is
/// analysed once, here.
class Schur {
 public:
  static constexpr int dense_rows = 48;

  explicit Schur(const System&);
  ~Schur();
  Schur(Schur&&) noexcept;

  /// One side of each joint: B = L J, m × 3 in a 3 × 3 block; index 2·joint + (0 for a, 1 for b).
  using Block = ConstraintRows::Block;

  /// Sums and factors S. Sides on flexible bodies are given in the metric of M⁻¹ (to_metric).
  /// @returns false if S is singular to working precision
  bool factor(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta);
  /// μ ← S⁻¹ μ. @pre factor returned true
  void solve(Eigen::VectorXd& mu);

  bool sparse() const { return sparse_ != nullptr; }

 private:
  struct Sparse;
  struct Pair {
    int i, j;        ///< sides, row_begin of i's joint ≥ that of j's
    int mi, mj;      ///< their rows
    Eigen::Vector3d w;  ///< inverse inertia of the body they share; 1 of a flexible one
    bool flexible;
    bool same;       ///< i == j: lower triangle only
  };
  bool factor_dense();

  int n_;
  std::vector<Pair> pairs_;
  std::vector<int> where_;      ///< value index of each summand, in the order of summation
  std::vector<double> values_;  ///< dense: n × n row-major, lower; sparse: CHOLMOD's values
  std::vector<double> diagonal_;
  std::unique_ptr<Sparse> sparse_;
};

}  // namespace pintle
