#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "eigen_layout.h"

namespace pintle {

/// x of J x = r with the least |x| in the metric W⁻¹, where W is a diagonal ≥ 0:  x = W Jᵀ (J W Jᵀ + μ)⁻¹ r, refined. Coordinates with W =
/// 0 are not changed. Dependent rows are satisfied too, if r is consistent with them.
/// @param mu      relative to the mean diagonal of J W Jᵀ: damps the step where rows are nearly dependent
/// @param sweeps  the first solution and refinements, which remove the effect of damping where r allows
Eigen::VectorXd least_step(const Eigen::SparseMatrix<double>& J, const Eigen::VectorXd& W, const Eigen::VectorXd& r, double mu, int sweeps);

}  // namespace pintle
