#pragma once

#include <Eigen/SparseCore>

#include "eigen_layout.h"

namespace pintle {

// Products of tall matrices, n × a few, by BLAS; Eigen would compute them column by column.

/// A B for A symmetric with both triangles stored: eight columns of B at a time, packed into `scratch`, 8 × n, whose storage is reused.
void product(const Eigen::SparseMatrix<double>& A, const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> out,
             Eigen::MatrixXd& scratch);
Eigen::MatrixXd product(const Eigen::SparseMatrix<double>& A, const Eigen::Ref<const Eigen::MatrixXd>& B);

/// AᵀB, a small matrix.
Eigen::MatrixXd inner(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::MatrixXd>& B);

/// Y += factor · A C, with C small.
void add(double factor, const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::MatrixXd>& C,
         Eigen::Ref<Eigen::MatrixXd> Y);

/// Replaces the first columns of A by A C, panel by panel, without a second tall matrix.
void turn(Eigen::Ref<Eigen::MatrixXd> A, const Eigen::Ref<const Eigen::MatrixXd>& C);

/// Eigenvalues of a small symmetric matrix, ascending, and its eigenvectors, column by column.
struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// @throws std::runtime_error  an entry is not finite
Spectrum spectrum(Eigen::MatrixXd A);

}  // namespace pintle
