#pragma once

#include <Eigen/Core>

/// All that the online side keeps of a body's finite elements.
namespace pintle {

/// Inertia of the undeformed body about the origin of its axes.
struct RigidInertia {
  double m = 0;                                ///< ∫ρ      [kg]
  Eigen::Vector2d c = Eigen::Vector2d::Zero(); ///< ∫ρ x    [kg m]
  double J = 0;                                ///< ∫ρ x·x  [kg m²]
};

/// What flexibility adds, for mass-normalised shapes φ: constant, O(n²) numbers.
struct FlexInertia {
  Eigen::Matrix2Xd S;           ///< ∫ρ φ           2 × n
  Eigen::RowVectorXd j, h;      ///< ∫ρ xᵀφ, ∫ρ xᵀZᵀφ   1 × n, Z the quarter turn
  Eigen::MatrixXd G;            ///< ∫ρ φᵀZᵀφ       n × n, skew
  Eigen::VectorXd omega, zeta;  ///< frequency [rad/s] and damping ratio of each shape, n
};

}  // namespace pintle
