#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/system.h"

namespace pintle {

/// Rows on modal coordinates, at most three.
using RowBlock = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;

/// Inertia of a flexible body at a pose, in world axes. With s = [ṙ θ̇ η̇] its mass matrix is
///   [ M    B   ]
///   [ Bᵀ 1 + E ],   M 3 × 3, B = [A S; h + ηᵀG] 3 × n, E = 0.
/// For a body with geometric stiffness, S and h have a part linear in η, and E = BᵀM⁻¹B − B₁ᵀM₁⁻¹B₁, where M₁ and B₁ are without
/// foreshortening. So 1 + E − BᵀM⁻¹B, the inertia of the shapes with the frame free, is that without foreshortening, which keeps the mass
/// matrix positive definite. Theory: docs/theory/motion.md, Eqs. (6)–(12) of Ebrahimi, Salahshoor, Moradi (2017).
struct FlexibleInertia {
  explicit FlexibleInertia(const System&, int body);

  int body, begin, n;  ///< index, first modal coordinate in q, how many
  bool stiffens;
  Eigen::Vector2d arm = Eigen::Vector2d::Zero();  ///< A w, w = ∫ρ (x + u): first moment [kg m]
  struct Part {
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
    Eigen::Matrix3Xd B;
    Eigen::RowVectorXd j;  ///< ½ ∂J/∂η
  } whole, linear;         ///< linear: without foreshortening, only for a body with geometric stiffness
  struct Inverse {         ///< with its root: inverse = root rootᵀ
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero(), root = Eigen::Matrix3d::Zero();
  } frame,    ///< (M − BBᵀ)⁻¹ without foreshortening: of the frame, with the shapes free
      rigid;  ///< M⁻¹, only for a body with geometric stiffness
  Eigen::VectorXd work, other;
};

/// Fills everything except the inverses. No allocation here or in the functions below.
void evaluate_inertia(const System&, const Eigen::VectorXd& q, double cos, double sin, FlexibleInertia&);
/// Fills the inverses. @returns false if M − BBᵀ is not positive definite
bool invert(FlexibleInertia&);
/// v ← (mass matrix)⁻¹ v for the body's part of v, n_q. @pre invert returned true
void solve(FlexibleInertia&, double* v);
/// Converts rows [L_r L_η] (m × 3, m × n) to B̂, B̂_η such that the products of the rows in the metric of the inverse mass matrix are B̂B̂ᵀ
/// + B̂_ηB̂_ηᵀ. B̂_η: 3 × n, or 3 × (n + 3) for a body with geometric stiffness.
void to_metric(const FlexibleInertia&, const Eigen::Matrix3d& L_r, const Eigen::Ref<const RowBlock>& L_eta, Eigen::Matrix3d& B_hat,
               RowBlock& B_eta_hat);
/// out += (mass matrix) v, for the body's part of both, n_q.
void add_mass_times(const FlexibleInertia&, const double* v, double* out);
/// The complete mass matrix, (3 + n) × (3 + n); slow.
Eigen::MatrixXd mass_matrix(const FlexibleInertia&);

/// f += the body's part: gravity, velocity-dependent inertia, elastic and damping forces.
void add_forces(const System&, const Eigen::VectorXd& y, FlexibleInertia&, Eigen::VectorXd& f);

/// ½ sᵀ M s, ½ Σ ω²η² and Σ 2ζωη̇² of body i. y as in State.
double kinetic_energy(const System&, const Eigen::VectorXd& y, int body);
double strain_energy(const System&, const Eigen::VectorXd& y, int body);
double damping_loss(const System&, const Eigen::VectorXd& y, int body);
/// World position of ∫ρ (x + u) over m: the current mass centre.
Eigen::Vector2d mass_centre(const System&, const Eigen::VectorXd& y, int body);

}  // namespace pintle
