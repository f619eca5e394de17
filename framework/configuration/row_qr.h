#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "eigen_layout.h"

namespace pintle {

/// Columns of a matrix and the factor of each.
using Weights = std::vector<std::pair<int, double>>;

/// Rank of A by a sparse QR decomposition, and for each dependent column of A the weights with which it and the others cancel. By SPQR;
/// with PINTLE_GPL=OFF by Eigen, which may choose other columns as the dependent ones.
/// @param tolerance  a column whose remainder is shorter counts as dependent   @param idle  the dependences are appended to it
int column_rank(const Eigen::SparseMatrix<double>& A, double tolerance, std::vector<Weights>& idle);

}  // namespace pintle
