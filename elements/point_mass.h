#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// A lump at a node: dofs [u_x u_y φ]. It has no stiffness. The two blocks correspond to `mass` and `skew_mass` of an element with one
/// node; on a node without rotation, their upper left 2 × 2 is used.
struct PointMass {
  double m = 0;  ///< [kg]
  double J = 0;  ///< about the node [kg m²]
};
/// diag(m, m, J).
Eigen::Matrix3d mass(const PointMass&);
/// m NᵀZᵀN, N = [1 0 0; 0 1 0]. Skew-symmetric; J does not contribute: docs/theory/elements.md.
Eigen::Matrix3d skew_mass(const PointMass&);

}  // namespace pintle
