#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "framework/configuration/closure.h"

/// The start in a singular configuration, where motions branch: docs/theory/constraints.md. W is the metric of `least_step`, y the state.
namespace pintle {

/// Near such a configuration C grows with the square of the distance. A configuration accepted as closed may therefore be a million
/// roundings away, too far to choose a branch. Applies Newton's steps, doubled as a double root requires, while they reduce C. Elsewhere it
/// does nothing.
/// @param C, J  at y, scaled as in `Closure::violation`
void close_in(Closure&, const System&, const Eigen::VectorXd& W, Eigen::VectorXd& y, Eigen::VectorXd& C, Eigen::SparseMatrix<double>& J);

/// Changes speeds that satisfy Ċ = 0 to those of a branch: Nᵀ dĊ/dt = 0 for every dependence N that holds only in this configuration. With
/// H = Σ N ∂²C this is sᵀH s − Nᵀ∂²law/∂t² = 0; 2 sᵀH is the change of Nᵀ Cq along s.
/// @returns false if no branch is found near these speeds
bool choose_branch(Closure&, const System&, const Eigen::SparseMatrix<double>& J, const std::vector<Dependence>& singular,
                   const Eigen::VectorXd& W, Eigen::VectorXd& y);

}  // namespace pintle
