#pragma once

#include <memory>
#include <string>

#include <Eigen/SparseCore>

namespace pintle {

/// A = LLᵀ of a symmetric positive definite sparse matrix, by CHOLMOD: fill-reducing order, supernodes,
/// all right-hand sides at once. The order is kept, so that a second matrix of the same pattern costs the
/// numbers alone.
class Factor {
 public:
  Factor();
  ~Factor();
  Factor(Factor&&) noexcept;
  Factor& operator=(Factor&&) noexcept;
  /// Both triangles may be stored; the lower is read.
  /// @returns false  A is not positive definite (`pivot`: the column where it failed)
  bool compute(const Eigen::SparseMatrix<double>& A);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;  ///< @pre computed
  void solve_into(const Eigen::MatrixXd& B, Eigen::MatrixXd& X) const;  ///< reuses X's storage and CHOLMOD's
  int pivot() const;
  double nonzeros() const;  ///< of L
  double flops() const;     ///< of the numerical factorisation

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Number of negative eigenvalues of a symmetric sparse matrix: the signs of the pivots of its LDLᵀ
/// (Sylvester; Haynsworth's additivity over supernodes, pivoting inside each).
/// @throws std::runtime_error  a supernode is singular to rounding: the matrix has an eigenvalue at zero
int negative_eigenvalues(const Eigen::SparseMatrix<double>& A);

}  // namespace pintle
