#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "eigen_layout.h"
#include "framework/component/eigen/eigen_lowest.h"

namespace pintle {

/// ΣK_ii/ΣM_ii [rad²/s²]: the scale of large λ in K φ = λ M φ. @throws std::invalid_argument  M's is not positive
double stiffness_over_mass(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M);

/// K − μM. The pattern is the union of both, so it is the same for every μ.
Eigen::SparseMatrix<double> shifted(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, double mu);

/// Rayleigh–Ritz of K and M themselves on span(X), X n × q with XᵀMX well conditioned: stores the lowest `count` pairs in `out`, with the
/// signs of their shapes, residuals and the number of rigid motions.
void refine(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, Eigen::MatrixXd X, int count, EigenPairs& out);

/// All finite pairs by dense algebra, the lowest `count` returned: M v = ν (K − μM) v, λ = μ + 1/ν.
/// Memory 4 n² numbers.
/// @throws std::invalid_argument  there are fewer   @throws std::runtime_error  K − μM is not
/// positive definite
EigenPairs eigen_dense(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, int count, double mu);

/// "9 modes asked for, the body has 6"
std::string too_many(int asked, Eigen::Index there);
/// Message for a K − μM that cannot be factored.
std::string not_definite(double mu);

}  // namespace pintle
