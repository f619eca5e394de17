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

/// The constraint equations after elimination of the accelerations,  S μ = r  with  S = Cq M⁻¹ Cqᵀ: symmetric, positive definite while the
/// rows are independent, one block for each pair of joints that share a body. Dense up to `dense_rows`, in parts that share no body; sparse
/// above, with the pattern analysed once, here. Where rows are dependent, in this configuration or permanently, the multipliers are those
/// of least norm. Theory: docs/theory/solvers.md.
class Schur {
 public:
  static constexpr int dense_rows = 48;

  explicit Schur(const System&);
  ~Schur();
  Schur(Schur&&) noexcept;

  /// One end of each joint, in the order of System::end_marker: B = L J, m × 3 in a 3 × 3 block.
  using Block = ConstraintRows::Block;

  /// Sums and factors S; pivots not above `least` count as lost. Released rows have no entries: for them μ = r. Ends on flexible bodies are
  /// given in the metric of M⁻¹ (to_metric). No allocation when dense or thin (SparseLdl), except at the first dependent rows of a sparse
  /// one.
  /// @returns false if S is not finite, or a row that is not released has no entries; dependent rows are allowed for
  bool factor(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta, double least = dependent_rows::lost,
              std::span<const int> released = {});
  /// μ ← S⁻¹ μ; for dependent rows the least-squares solution of least norm, with rows in metres scaled by the mechanism's length. @pre
  /// factor returned true
  void solve(Eigen::VectorXd& mu);

  bool dependent() const { return lost_ > 0; }  ///< the last factorization found dependent rows
  int lost() const { return lost_; }            ///< number of lost pivots
  double least() const { return least_; }       ///< smallest ratio of a pivot to its original entry
  double kept() const { return kept_; }         ///< the same for pivots that are not lost: small near a singular configuration
  bool weak() const { return least_ < few; }    ///< dependent, nearly dependent, or very different inertias
  /// Whether rows other than the `permanent` redundant ones are dependent or nearly so, if this can be detected.
  bool near_singular(int permanent) const { return lost_ > permanent || ((lost_ == 0 || !sparse()) && kept_ < few); }
  /// Removes from μ, for the configuration of the last factorization, the part that does no work: Cqᵀμ is unchanged. No effect for
  /// independent rows.
  void take_null_part(Eigen::VectorXd& mu);
  /// For the last solve: largest entry of S μ − r relative to that of r, with rows in metres scaled by the mechanism's length; 0 for
  /// independent rows. Well above rounding: the rows contradict each other.
  double inconsistency() const;

  bool sparse() const;
  const char* solver() const;  ///< name of the solver
  double nonzeros() const;     ///< of the factor

 private:
  /// A product of two rows of ends on one body: three entries of B each, numbered over all blocks, times the body's inverse inertia; and
  /// the contribution of the modal coordinates of a flexible body.
  struct Term {
    int to, a, b, w;
  };
  struct ModalTerm {
    int to, i, r, j, c;  ///< row r of end i by row c of end j
  };
  /// Rows of connected joints, dense: row order_[begin + i] of all is row i of the part.
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
  double bound(double least) const;
  void solve_dense(double* mu) const;
  void solve_factored(Eigen::VectorXd& mu);
  void solve_by_rank(Eigen::VectorXd& mu);

  static constexpr double few = 1e-5;  ///< ratio of a pivot to its original entry

  int n_;
  int lost_ = 0;
  double least_ = 1;             ///< smallest ratio of a pivot to its original entry; 0 if some are lost
  double kept_ = 1;              ///< the smallest of those that are not lost
  std::vector<Term> terms_;      ///< first those that start an entry
  std::size_t first_terms_ = 0;  ///< number of these
  std::vector<int> zeros_;       ///< entries without terms, which the factor fills
  std::vector<ModalTerm> modal_terms_;
  std::vector<double> weights_;  ///< 1/m, 1/m, 1/J of each body; 1 of a flexible one
  std::vector<double> values_;   ///< dense: that of each part; sparse: SparseLdl's
  std::vector<Part> parts_;
  std::vector<int> order_;
  std::vector<int> diagonal_;    ///< index of S_ii among the values
  std::vector<double> inverse_;  ///< of the pivots of the parts, in their order
  std::unique_ptr<Data> data_;   ///< needed only when sparse or for dependent rows
};

}  // namespace pintle
