#pragma once

#include <optional>
#include <vector>

#include "framework/component/fe/fe_model.h"
#include "framework/component/reduction/damping.h"
#include "framework/component/reduction/inertia.h"

/// Reduction of a finite-element body to a few shapes in a floating frame.
/// Theory: docs/theory/reduction.md.
namespace pintle {

/// The three reference conditions that fix the floating frame to the material, that is, define "no rigid motion". The choice is a gauge:
/// with the same shapes up to rigid motions it does not affect the motion in the world.
struct ReferenceConditions {
  enum Kind {
    tangent,    ///< frame at port a, rotating with it: shapes look clamped there
    chord,      ///< frame's line runs from port a to b: shapes look pinned at a, sliding along it at b
    mean_axes,  ///< shapes carry no momentum: they look free–free
  } kind = mean_axes;
  int a = -1, b = -1;  ///< indices into FeModel::ports
};

/// Input of a reduction: the matrices of a model in independent dofs (n × n, both triangles).
struct Component {
  const FeModel& model;  ///< must outlive the component
  Sparse K, M;
};
Component component(const FeModel&, bool lumped = false);

/// B with B ũ = 0 where the reference conditions hold, 3 × n, of rank 3 on rigid motions. Tangent, chord: rows are orthonormal. Mean axes:
/// momentum along x and y and angular momentum about the mass centre.
/// @throws std::invalid_argument  a port does not exist, has no rotation (tangent), or the two coincide
Eigen::MatrixXd reference_condition_rows(const Component&, const ReferenceConditions&);

/// How many modes are computed. Exactly one member is set. The result may be none: then there are only static shapes.
struct Keep {
  std::optional<int> count = {};     ///< ≥ 0
  std::optional<double> below = {};  ///< [Hz]
  /// In (0, 1): the smallest number of modes whose effective masses in x, in y and in rotation about the mass centre all exceed this share
  /// of the body's mass and inertia. For modes of a supported body; those of a free one have no effective mass.
  std::optional<double> effective_mass = {};
  /// All modes: as many as the body has dofs, minus the fixed ones and those without mass, which follow statically. Rejected above
  /// `most_for_all` dofs.
  bool all = false;
};

/// A complete basis is a dense n × n matrix, computed by a dense eigenproblem of about 10 n³ operations, and each time step then uses full
/// n × n matrices: at 3000, a minute to compute and 72 MB each.
inline constexpr int most_for_all = 3000;

/// A flexible body after reduction. Guaranteed, and tested: ΦᵀMΦ = I and ΦᵀKΦ = diag(ω²); ω > 0, ascending; every shape satisfies the
/// reference conditions, so rank [T R Φ] = 3 + k. The sign of a shape is fixed: its first component that reaches half of its largest is
/// positive. k = 0 is a rigid body.
struct ModalModel {
  Eigen::MatrixXd shapes;  ///< Φ, nodal dofs N × k [kg^−½]
  Eigen::MatrixXd ports;   ///< [u_x u_y φ] of each port, φ = 0 where it has no rotation: 3·ports × k
  Eigen::VectorXd omega;   ///< [rad/s], k
  /// ‖Kφ − ω²Mφ − reactions of the reference conditions‖/‖Kφ‖, k: near 0 for true modes, not for static shapes. Tangent and chord
  /// conditions have reactions at their ports; mean axes have none.
  Eigen::VectorXd residual;
  /// Number of eigenvalues that the computed modes should include, by Sturm count: equal to their number if none was missed. For the
  /// supported body (Craig–Bampton: with its interface fixed) or for the free one without rigid motions.
  std::optional<int> sturm;
};

/// Natural modes under the reference conditions: of the body held at its ports (tangent, chord) or of the free body.
/// @throws std::invalid_argument  as reference_condition_rows; `keep` contradicts itself or asks for too much:
///         "9 modes asked for, the body has 6"
/// @throws std::runtime_error     no convergence; parts of the body are not joined
ModalModel normal_modes(const Component&, const ReferenceConditions&, const Keep&);

/// Craig–Bampton: the static shape of each dof of the interface ports and the lowest modes with these fixed (`keep` counts those),
/// transformed to the reference conditions and made diagonal. This gives 3 shapes fewer than static shapes and modes together, since three
/// combinations are rigid motions. The response to static loads at the ports, in equilibrium or held by the reference conditions at these
/// ports, is exact. Source: [CraigBampton1968].
/// @throws as normal_modes, and std::invalid_argument  a port is named twice; the body can still move rigidly with the ports fixed
ModalModel craig_bampton(const Component&, const std::vector<int>& ports, const ReferenceConditions&, const Keep&);

/// The modes that Craig–Bampton adds to the static shapes, transformed to the reference conditions: natural modes with the ports fixed.
/// ΦᵀMΦ = I therefore holds only before the transformation, ΦᵀKΦ = diag(ω²) always. Used to judge which of them a motion needs.
/// @throws as normal_modes, and std::invalid_argument  a port is named twice
ModalModel fixed_interface_modes(const Component&, const std::vector<int>& ports, const ReferenceConditions&, const Keep&);

/// Modes of the free body (`keep` counts those) and, for each dof of the ports, the residual attachment shape: the part of the static
/// response of the freely accelerating body that the kept modes do not represent. A residual shape that the others represent to 1e-10 is
/// omitted. The static response at the ports, in equilibrium with other loads there or with the body's inertia, is exact. Source:
/// [CraigChang1977].
/// @throws as normal_modes, and std::invalid_argument  a port is named twice
ModalModel free_modes(const Component&, const std::vector<int>& ports, const ReferenceConditions&, const Keep&);

/// J = RᵀMR: includes the rotary inertia of beam sections, which xᵀMx would not.
/// @param M  nodal, N × N
RigidInertia rigid_inertia(const FeModel&, const Sparse& M);
/// S = TᵀMΦ, j = xᵀMΦ, h = RᵀMΦ, G = ΦᵀGΦ: everything a floating frame needs; zeta is zero until a damping is chosen. Exact if the
/// displacement of each fibre of a section is linear in the shapes.
/// @param M, G  nodal, N × N
FlexInertia flex_inertia(const FeModel&, const Sparse& M, const Sparse& G, const ModalModel&);

/// Effective mass of each shape along x, y and in rotation about the mass centre: (TᵀMφ)², (RᵀMφ)²; 3 × k [kg, kg, kg m²]. Their sum over
/// all modes of a body held by B ũ = 0 is
///   rᵀMr − (Br)ᵀ(BM⁻¹Bᵀ)⁻¹Br,   r = T and R:
/// the body's mass and inertia, minus the part that moves only with the fixed dofs, which vanishes as the mesh is refined. Zero with
/// mean axes.
/// @param M  nodal, N × N
Eigen::Matrix3Xd effective_mass(const FeModel&, const Sparse& M, const ModalModel&);

}  // namespace pintle
