#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/flexible.h"
#include "framework/dynamics/model/system.h"
#include "framework/dynamics/solvers/dependent_rows.h"
#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

/// The constraint equations after the accelerations are eliminated,  S μ = r  with  S = Cq M⁻¹ Cqᵀ:
/// symmetric, positive definite while the rows are independent, one block for each pair of joints that
/// share a body. Dense up to `dense_rows`, in parts that share no body, sparse above, its pattern analysed once,
/// here. Where rows are dependent, at this pose or at all, multipliers are those of least norm. Theory:
/// docs/theory/solvers.md.
class Schur {
 public:
  static constexpr int dense_rows = 48;

  explicit Schur(const System&);
  ~Schur();
  Schur(Schur&&) noexcept;

  /// One end of each joint, as System::end_marker counts them: B = L J, m × 3 in a 3 × 3 block.
  using Block = ConstraintRows::Block;

  /// Sums and factors S; pivots not above `least` count as lost. Of rows that are released, which have no entries, μ is what r is. Ends on flexible bodies are given in the metric of M⁻¹ (to_metric). No allocation
  /// when dense or thin (SparseLdl), but at the first dependent rows of a sparse one.
  /// @returns false if S is not finite, or a row has no entries; dependent rows are allowed for
  bool factor(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta, double least = dependent_rows::lost,
              std::span<const int> released = {});
  /// μ ← S⁻¹ μ; of dependent rows the least norm, rows in metres counted over the mechanism's length, of
  /// what misses r by the least sum of squares. @pre factor returned true
  void solve(Eigen::VectorXd& mu);

  bool dependent() const { return lost_ > 0; }  ///< the last factorization met dependent rows
  int lost() const { return lost_; }            ///< how many pivots they left nothing of
  double least() const { return least_; }       ///< pivot over the entry it came from, the smallest
  double kept() const { return kept_; }         ///< the same of those that are not lost: small near a singular pose
  bool weak() const { return least_ < few; }    ///< dependent, not far from it, or of very unlike inertias
  /// Rows beside `permanent` redundant ones are dependent or not far from it, where that can be told.
  bool near_singular(int permanent) const { return lost_ > permanent || ((lost_ == 0 || !sparse()) && kept_ < few); }
  /// Takes from μ, of the last factorization's pose, the part that does no work: Cqᵀμ stays. Of independent rows nothing.
  void take_null_part(Eigen::VectorXd& mu);
  /// Of the last solve: what S μ misses r by, over r, largest entries, rows in metres over the mechanism's
  /// length; 0 of independent rows. Well above rounding: the rows contradict each other.
  double inconsistency() const;

  bool sparse() const;
  const char* solver() const;  ///< how it is factored, in words
  double nonzeros() const;     ///< of the factor

 private:
  /// A product of two rows of ends on one body: three entries of B each, counted through all blocks, by the body's
  /// inverse inertia; and what the modal coordinates of a flexible one add.
  struct Term {
    int to, a, b, w;
  };
  struct ModalTerm {
    int to, i, r, j, c;  ///< row r of end i by row c of end j
  };
  /// Rows of joints that bodies connect, dense: row order_[begin + i] of all is row i of the part.
  struct Part {
    int n, begin, at;  ///< n × n by rows from values_[at], lower half, then its factor
  };
  struct Data;
  std::vector<int> divide(const std::vector<Pattern::Place>& places);
  void sum(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta, std::span<const int> released);
  bool factor_shifted();
  bool factor_by_rank(double least);
  bool factor_dense(double least);
  double smallest_quotient() const;
  void solve_dense(double* mu) const;
  void solve_factored(Eigen::VectorXd& mu);
  void solve_by_rank(Eigen::VectorXd& mu);

  static constexpr double few = 1e-5;  ///< of a pivot

  int n_;
  int lost_ = 0;
  double least_ = 1;             ///< pivot over the entry it came from, the smallest; 0 if some are lost
  double kept_ = 1;              ///< the smallest of those that are not lost
  std::vector<Term> terms_;      ///< first those that begin an entry
  std::size_t first_terms_ = 0;  ///< how many these are
  std::vector<int> zeros_;       ///< entries without any, which the factor fills
  std::vector<ModalTerm> modal_terms_;
  std::vector<double> weights_;  ///< 1/m, 1/m, 1/J of each body; 1 of a flexible one
  std::vector<double> values_;   ///< dense: that of each part; sparse: SparseLdl's
  std::vector<Part> parts_;
  std::vector<int> order_;
  std::vector<int> diagonal_;    ///< where S_ii is among the values
  std::vector<double> inverse_;  ///< of the pivots of the parts, in their order
  std::unique_ptr<Data> data_;   ///< what only sparse or dependent rows need
};

}  // namespace pintle
