#pragma once

#include "framework/dynamics/model/flexible.h"

/// How the inertia and elasticity of a flexible body depend on its motion: docs/theory/tangent.md.
namespace pintle {

/// x: weight of ẋ for internal states that follow the motion, x = base + w.x ẋ; 0: they are held.
struct TangentWeights {
  double q = 0, s = 0, a = 0, x = 0;
};

/// Scratch for a body of n modes.
struct FlexibleScratch {
  explicit FlexibleScratch(Eigen::Index n = 0) : G_rate(n), G_accel(n), j_rate(n), bent_rate(3, n), bent_accel(3, n), B(n, 3) {}
  Eigen::VectorXd G_rate, G_accel, j_rate;  ///< Gη̇, Gη̈, ∂(j(η)η̇)/∂η
  Eigen::Matrix3Xd bent_rate, bent_accel;   ///< ∂(Bη̇)/∂η, ∂(Bη̈)/∂η at constant η̇, η̈
  Eigen::MatrixX3d B;                       ///< Bᵀ
};

/// K += w.q ∂/∂q + w.s ∂/∂s + w.a ∂/∂a of the body's share of M a − f: inertia, gravity, elastic and damping
/// forces. K is (3 + n) × (3 + n) on [x y θ η]. No allocation.
/// @param y  as in State   @param a  accelerations, n_q   @pre update_mass was called at y; scratch is for e.n modes
void add_inertia_tangent(const System&, const FlexibleInertia& e, const Eigen::VectorXd& y, const Eigen::VectorXd& a, const TangentWeights&,
                         FlexibleScratch&, Eigen::Ref<Eigen::MatrixXd> K);

}  // namespace pintle
