#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Cq as a dense matrix, n_rows × n. After pose.
void fill_jacobian(const System&, const Equations&, Eigen::MatrixXd& Cq);
Eigen::MatrixXd dense_jacobian(const System&, const Equations&);

}  // namespace pintle
