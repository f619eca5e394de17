#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "eigen_layout.h"

namespace pintle {

/// Columns of a matrix and the factor of each.
using Weights = std::vector<std::pair<int, double>>;

/// Rank of A by a QR decomposition, and for each dependent column of A the weights with which it and the others cancel. Which of several
/// columns count as the dependent ones is not fixed. A small A is treated as dense.
/// @param tolerance  a column whose remainder is shorter counts as dependent   @param idle  the dependences are appended to it
int column_rank(const Eigen::SparseMatrix<double>& A, double tolerance, std::vector<Weights>& idle);

/// The same for a large A, by SPQR; with PINTLE_GPL=OFF by Eigen.
int sparse_column_rank(const Eigen::SparseMatrix<double>& A, double tolerance, std::vector<Weights>& idle);

/// The dependence of column c of A P = Q R, where original[k] is the column of A that P puts in place k.
/// @param x  the factors with which the first columns of R, which are independent, give column c
Weights dependence(const Eigen::VectorXi& original, Eigen::Index c, const Eigen::VectorXd& x);

}  // namespace pintle
