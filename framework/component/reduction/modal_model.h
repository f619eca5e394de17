#pragma once

#include <optional>
#include <vector>

#include "framework/component/fe/fe_model.h"
#include "framework/component/reduction/damping.h"
#include "framework/component/reduction/inertia.h"

/// From a finite-element body to a few shapes in a floating frame.
/// Theory: docs/theory/reduction.md.
namespace pintle {

/// Which three conditions tie the floating frame to the material, i.e. what "no rigid motion"
/// means. The choice is a gauge: with the same shapes up to rigid motions it changes no motion in
/// the world.
struct ReferenceConditions {
  enum Kind {
    tangent,    ///< frame sits on port a and turns with it: shapes look clamped there
    chord,      ///< frame's line runs from port a to b: shapes look pinned at a, sliding on it at b
    mean_axes,  ///< shapes carry no momentum: they look free–free
  } kind = mean_axes;
  int a = -1, b = -1;  ///< indices into FeModel::ports
};

/// What is reduced: the matrices of a model in independent freedoms (n × n, both triangles).
struct Component {
  const FeModel& model;  ///< must outlive the component
  Sparse K, M;
};
Component component(const FeModel&, bool lumped = false);

/// B with B ũ = 0 where the tie holds, 3 × n, of rank 3 on rigid motions. Tangent, chord: rows are
/// orthonormal. Mean axes: momentum along x and y and moment of momentum about the mass centre.
/// @throws std::invalid_argument  there is no such port, it cannot turn (tangent), the two coincide
Eigen::MatrixXd reference_condition_rows(const Component&, const ReferenceConditions&);

/// How many modes are computed. Exactly one is set. None may come of it: then only static shapes
/// are left.
struct Keep {
  std::optional<int> count = {};     ///< ≥ 0
  std::optional<double> below = {};  ///< [Hz]
  /// In (0, 1): the fewest whose effective masses in x, in y and in rotation about the mass centre
  /// all exceed this share of the body's mass and inertia. For modes of a held body; those of a
  /// free one have none.
  std::optional<double> effective_mass = {};
  /// As many as the body has freedoms, less the held ones and those without mass, which follow
  /// statically. Refused above `most_for_all` freedoms.
  bool all = false;
};

/// A complete basis is a dense n × n matrix, found by a dense eigenproblem of some 10 n³
/// operations, and makes each time step carry full n × n matrices: at 3000, a minute to find and 72
/// MB each.
inline constexpr int most_for_all = 3000;

/// A flexible body after reduction. Promises, each a test: ΦᵀMΦ = I and ΦᵀKΦ = diag(ω²); ω > 0,
/// ascending; every shape meets the frame tie, so rank [T R Φ] = 3 + k. The sign of a shape is
/// fixed: its first component that reaches half of its largest is positive. k = 0 is a rigid body.
struct ModalModel {
  Eigen::MatrixXd shapes;  ///< Φ, nodal freedoms N × k [kg^−½]
  Eigen::MatrixXd ports;   ///< [u_x u_y φ] of each port, φ 0 where it cannot turn: 3·ports × k
  Eigen::VectorXd omega;   ///< [rad/s], k
  /// ‖Kφ − ω²Mφ − the tie's reactions‖/‖Kφ‖, k: near 0 for true modes, not for static shapes.
  /// Tangent and chord ties react at their ports; mean axes do not.
  Eigen::VectorXd residual;
  /// How many eigenvalues the computed modes must have found, by Sturm count: as many as there are
  /// when none was missed. Of the held body (Craig–Bampton: its interface) or of the free one
  /// without rigid motions.
  std::optional<int> sturm;
};

/// Natural modes under the tie: of the body held at its ports (tangent, chord) or of the free body.
/// @throws std::invalid_argument  as reference_condition_rows; `keep` contradicts itself or asks for too much:
///         "9 modes asked for, the body has 6"
/// @throws std::runtime_error     no convergence; parts of the body are not joined
ModalModel normal_modes(const Component&, const ReferenceConditions&, const Keep&);

/// Craig–Bampton: the static shape of each freedom of the interface ports and the lowest modes with
/// these held (`keep` counts those), brought to the tie, then made diagonal: 3 shapes fewer than
/// static shapes and modes together, for three combinations are rigid motions. The response to
/// static loads at the ports, in equilibrium or held by the tie at these ports, stays exact.
/// Source: [CraigBampton1968].
/// @throws as normal_modes, and std::invalid_argument  a port is named twice; with the ports held
///         the body can still move as a rigid one
ModalModel craig_bampton(const Component&, const std::vector<int>& ports, const ReferenceConditions&, const Keep&);

/// The modes that Craig–Bampton adds to static shapes, brought to the tie: natural with the ports
/// held, so that ΦᵀMΦ = I only before they are tied, and ΦᵀKΦ = diag(ω²) always. For judging which
/// of them a motion needs.
/// @throws as normal_modes, and std::invalid_argument  a port is named twice
ModalModel fixed_interface_modes(const Component&, const std::vector<int>& ports, const ReferenceConditions&, const Keep&);

/// Modes of the free body (`keep` counts those) and, for each freedom of the ports, the residual
/// attachment shape: the static response of the freely accelerating body that the kept modes leave
/// out. One that the others make up to 1e-10 is left out. Static response at the ports, in
/// equilibrium with other loads there or with the body's inertia, stays exact.
/// Source: [CraigChang1977].
/// @throws as normal_modes, and std::invalid_argument  a port is named twice
ModalModel free_modes(const Component&, const std::vector<int>& ports, const ReferenceConditions&, const Keep&);

/// J = RᵀMR: a beam section's own rotary inertia counts, which xᵀMx would miss.
/// @param M  nodal, N × N
RigidInertia rigid_inertia(const FeModel&, const Sparse& M);
/// S = TᵀMΦ, j = xᵀMΦ, h = RᵀMΦ, G = ΦᵀGΦ: everything a floating frame needs; zeta is zero until a
/// damping is chosen. Exact where each fibre of a section is displaced linearly in the shapes.
/// @param M, G  nodal, N × N
FlexInertia flex_inertia(const FeModel&, const Sparse& M, const Sparse& G, const ModalModel&);

/// Effective mass of each shape along x, y and in rotation about the mass centre: (TᵀMφ)², (RᵀMφ)²;
/// 3 × k [kg, kg, kg m²]. Summed over all modes of a body held by B ũ = 0 they make
///   rᵀMr − (Br)ᵀ(BM⁻¹Bᵀ)⁻¹Br,   r = T and R:
/// the body's mass and inertia, less what moves with the held freedoms alone, which vanishes as the
/// mesh is refined. Zero under mean axes.
/// @param M  nodal, N × N
Eigen::Matrix3Xd effective_mass(const FeModel&, const Sparse& M, const ModalModel&);

}  // namespace pintle
