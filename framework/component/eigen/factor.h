#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <string>

#include "eigen_layout.h"

namespace pintle {

/// Division of a factor L into supernodes: runs of columns with one pattern, children before parents. All arrays belong to the factor. Rows
/// and columns are numbered in the fill-reducing order.
struct Supernodes {
  int n;                 ///< degrees of freedom
  int count;             ///< supernodes
  const int* first;      ///< first column of each, one past: count + 1
  const int* row_begin;  ///< start of its rows in `row`, count + 1
  const int* row;        ///< ascending; its own columns first
  const int* order;      ///< order[k]: the degree of freedom that is eliminated k-th, n
};

/// A = LLᵀ of a symmetric positive definite sparse matrix, by CHOLMOD: fill-reducing order, supernodes (without GPL parts: columns), all
/// right-hand sides at once. The order is kept, so that for another matrix of the same pattern only the numbers are recomputed. Order: AMD,
/// or nested dissection where AMD gives much fill (benchmarks/modes.cpp). Not thread-safe: solving uses a permanent workspace.
class Factor {
 public:
  Factor();
  ~Factor();
  Factor(Factor&&) noexcept;
  Factor& operator=(Factor&&) noexcept;
  /// Finds order and supernodes, unless A has the pattern of the last matrix.
  /// @throws  as compute
  void analyse(const Eigen::SparseMatrix<double>& A);
  /// Both triangles may be stored; the lower is read.
  /// @returns false  A is not positive definite (`pivot`: the column where it failed). A pivot that cancellation has reduced to less than
  /// `nothing` of the diagonal entry counts as zero.
  /// @throws std::invalid_argument  A is not square
  /// @throws std::runtime_error     out of memory
  bool compute(const Eigen::SparseMatrix<double>& A);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;  ///< @pre computed
  void solve_into(const Eigen::MatrixXd& B,
                  Eigen::MatrixXd& X) const;  ///< reuses X's storage and CHOLMOD's
  int pivot() const;                          ///< −1 after a success
  double nonzeros() const;                    ///< of L
  Supernodes supernodes() const;              ///< @pre analysed

  static constexpr double nothing = 4e-16;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Number of negative eigenvalues of a symmetric sparse matrix: the signs of the pivots of its LDLᵀ (Sylvester; Haynsworth's additivity
/// over supernodes, pivoting inside each). Both triangles may be stored; the lower is read. The cost is that of a Cholesky factorisation; L
/// is not kept.
/// @throws std::runtime_error  a supernode is singular to rounding: the matrix, or a part eliminated first, has an eigenvalue at zero.
/// Shift it slightly.
int negative_eigenvalues(const Eigen::SparseMatrix<double>& A);
/// The same, using the order of a factor of a matrix with A's pattern, which saves computing one.
int negative_eigenvalues(const Eigen::SparseMatrix<double>& A, const Supernodes&);

}  // namespace pintle
