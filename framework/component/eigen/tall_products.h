#pragma once

#include <Eigen/SparseCore>

#include "eigen_layout.h"

namespace pintle {

// Products of tall matrices, n × a few, which Eigen would take column by column. By BLAS.

/// A B for A symmetric with both triangles stored: eight columns of B at a time, which are packed
/// into `scratch`, 8 × n, whose storage is kept.
void product(const Eigen::SparseMatrix<double>& A, const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> out,
             Eigen::MatrixXd& scratch);
Eigen::MatrixXd product(const Eigen::SparseMatrix<double>& A, const Eigen::Ref<const Eigen::MatrixXd>& B);

/// AᵀB, small.
Eigen::MatrixXd inner(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::MatrixXd>& B);

/// Y += factor · A C, C small.
void add(double factor, const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::MatrixXd>& C,
         Eigen::Ref<Eigen::MatrixXd> Y);

/// The first columns of A become A C, panel by panel: no second tall matrix.
void turn(Eigen::Ref<Eigen::MatrixXd> A, const Eigen::Ref<const Eigen::MatrixXd>& C);

/// Eigenvalues of a small symmetric matrix, ascending, and its eigenvectors, column by column.
struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// @throws std::runtime_error  an entry is not a number
Spectrum spectrum(Eigen::MatrixXd A);

}  // namespace pintle
