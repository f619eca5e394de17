#pragma once

#include <Eigen/Core>

namespace pintle {

/// A lump at a node: freedoms [u_x u_y φ]. It has no stiffness.
struct PointMass {
  double m = 0;  ///< [kg]
  double J = 0;  ///< about the node [kg m²]
};
Eigen::Matrix3d mass(const PointMass&);
Eigen::Matrix3d skew_mass(const PointMass&);

}  // namespace pintle
