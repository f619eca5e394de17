#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "eigen_layout.h"

/// The data that the simulation keeps of a body's finite-element model.
namespace pintle {

/// Inertia of the undeformed body about the origin of its axes.
struct RigidInertia {
  double m = 0;                                 ///< ∫ρ      [kg]
  Eigen::Vector2d c = Eigen::Vector2d::Zero();  ///< ∫ρ x    [kg m]
  double J = 0;                                 ///< ∫ρ x·x  [kg m²]
};

/// Inertia of the second-order displacement due to bending, u = Φη + ½ Σ ψ_ij η_i η_j; symmetric, n × n each. Theory:
/// docs/theory/motion.md.
struct Foreshortening {
  std::array<Eigen::MatrixXd, 2> S;  ///< ∫ρ ψ along x, along y
  Eigen::MatrixXd j, h;              ///< ∫ρ xᵀψ, ∫ρ xᵀZᵀψ
};

/// Inertia added by flexibility, for mass-normalised shapes φ: constant, O(n²) numbers.
struct FlexInertia {
  Eigen::Matrix2Xd S;                    ///< ∫ρ φ           2 × n
  Eigen::RowVectorXd j, h;               ///< ∫ρ xᵀφ, ∫ρ xᵀZᵀφ   1 × n, Z the quarter turn
  Eigen::MatrixXd G;                     ///< ∫ρ φᵀZᵀφ       n × n, skew
  Eigen::VectorXd omega, zeta;           ///< frequency [rad/s] and damping ratio of each shape, n
  std::optional<Foreshortening> second;  ///< of a body with geometric stiffness
};

}  // namespace pintle
