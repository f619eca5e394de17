#pragma once

#include <Eigen/SparseCore>

#include "eigen_layout.h"

namespace pintle {

/// Starting loads R = M X, n × count. X after Bathe: all degrees of freedom at once; single ones where m_ii/k_ii is largest, one in each of
/// equal ranges of degrees of freedom so that they are spread over the body; and, for the last half, random vectors, so that no mode is
/// orthogonal to all. Differs from [Bathe2014] in the factor M, which keeps the iterates free of massless degrees of freedom, and in the
/// number of random vectors.
Eigen::MatrixXd starting_loads(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, int count, unsigned seed);

/// M times `count` random vectors of entries in [−1, 1].
Eigen::MatrixXd random_loads(const Eigen::SparseMatrix<double>& M, int count, unsigned seed);

}  // namespace pintle
