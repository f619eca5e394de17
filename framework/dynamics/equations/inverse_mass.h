#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// v = M⁻¹ f, which may be the same vector. After factor.
void multiply_inverse_mass(const System&, Equations&, const Eigen::VectorXd& f, Eigen::VectorXd& v);

}  // namespace pintle
