#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "eigen_layout.h"

namespace pintle {

/// x of J x = r with the least |x| in the metric W⁻¹, W a diagonal ≥ 0:  x = W Jᵀ (J W Jᵀ + μ)⁻¹ r, refined.
/// Coordinates with W = 0 stay. Where rows depend on each other and r agrees with that, J x = r still holds.
/// @param mu      over the mean diagonal of J W Jᵀ: damps the step where rows are nearly dependent
/// @param sweeps  the first solution and refinements, which take the damping away where r allows
Eigen::VectorXd least_step(const Eigen::SparseMatrix<double>& J, const Eigen::VectorXd& W, const Eigen::VectorXd& r, double mu, int sweeps);

}  // namespace pintle
