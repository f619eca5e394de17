#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "framework/configuration/closure.h"

/// The start in a singular pose, where motions branch: docs/theory/constraints.md. W is the metric of `least_step`, y the state.
namespace pintle {

/// Near such a pose C grows with the square of the distance, so what passes for closed may be a million roundings away, too far to
/// choose a branch: Newton's steps, doubled as a double root asks, while they lessen C. Elsewhere it does nothing.
/// @param C, J  at y, scaled as `Closure::violation` does
void close_in(Closure&, const System&, const Eigen::VectorXd& W, Eigen::VectorXd& y, Eigen::VectorXd& C, Eigen::SparseMatrix<double>& J);

/// Brings speeds that meet Ċ = 0 to a branch, Nᵀ dĊ/dt = 0 for every dependence N that holds at this pose only.
/// With H = Σ N ∂²C that is sᵀH s − Nᵀ∂²law/∂t² = 0; 2 sᵀH is the change of Nᵀ Cq along s.
/// @returns false if no branch is found near these speeds
bool choose_branch(Closure&, const System&, const Eigen::SparseMatrix<double>& J, const std::vector<Dependence>& singular,
                   const Eigen::VectorXd& W, Eigen::VectorXd& y);

}  // namespace pintle
