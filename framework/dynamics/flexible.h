#pragma once

#include <Eigen/Core>

#include "framework/dynamics/system.h"

namespace pintle {

/// Inertia of a flexible body at a pose: with s = [ṙ θ̇ η̇] its mass matrix is
///   [ M  B ]
///   [ Bᵀ 1 ],   M 3 × 3, B = [A S(η); h(η) + ηᵀG] 3 × n,
/// and S(η), h(η) are S, h unless the body stiffens. Theory: docs/theory/motion.md, Eqs. (6)–(12) of
/// Ebrahimi, Salahshoor, Moradi (2017).
struct FlexibleInertia {
  int body = 0, begin = 0, n = 0;  ///< index, first modal coordinate in q, how many
  Eigen::Vector2d arm = Eigen::Vector2d::Zero();  ///< A w, w = ∫ρ (x + u): first moment, world axes [kg m]
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  Eigen::Matrix3Xd B;
  /// (M − BBᵀ)⁻¹ = root rootᵀ
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero(), root = Eigen::Matrix3d::Zero();
  Eigen::RowVectorXd j;            ///< ½ ∂J/∂η = j(η) + ηᵀ
  Eigen::VectorXd work;
};

/// Fills all but the inverse. No allocation after the first call.
void evaluate_inertia(const System&, const Eigen::VectorXd& q, double cos, double sin, FlexibleInertia&);
/// Fills inverse and root. @returns false if M − BBᵀ, the inertia of the frame when the shapes are free
/// to follow, is not positive
bool invert(FlexibleInertia&);
/// v ← M⁻¹ v for the body's part of v, n_q. @pre invert returned true
void solve(const FlexibleInertia&, double* v);
/// f += the body's part: gravity, velocity-dependent inertia, elastic and damping forces.
void add_forces(const System&, const Eigen::VectorXd& y, FlexibleInertia&, Eigen::VectorXd& f);

/// ½ sᵀ M s, ½ Σ ω²η² and Σ 2ζωη̇² of body i. y as in State.
double kinetic_energy(const System&, const Eigen::VectorXd& y, int body);
double strain_energy(const System&, const Eigen::VectorXd& y, int body);
double damping_loss(const System&, const Eigen::VectorXd& y, int body);
/// World place of ∫ρ (x + u) over m: the mass centre as it is now.
Eigen::Vector2d mass_centre(const System&, const Eigen::VectorXd& y, int body);

}  // namespace pintle
