#pragma once

#include <concepts>

#include "elements/element.h"

/// Straight elements with two nodes. Element axes: s from node 1 to node 2, the second axis to its left. Their centroids lie on the axis;
/// small strain. Theory: docs/theory/elements.md.
namespace pintle {

/// Two-node bar: carries axial force only. Degrees of freedom [u_x u_y] per node, linear interpolation.
struct Bar {
  static constexpr int nodes = 2, dofs_per_node = 2, dofs = 4, points = 2, stress_rows = 3;
  double EA;    ///< axial stiffness [N]
  double rhoA;  ///< mass per length [kg/m]
};

/// Euler–Bernoulli beam of constant section: axial displacement linear, deflection a Hermite cubic, so that nodal displacements under end
/// loads are exact. Source: [Przemieniecki1968].
struct BeamEuler {
  static constexpr int nodes = 2, dofs_per_node = 3, dofs = 6, points = 2, stress_rows = 3;
  double EA;        ///< axial stiffness [N]
  double EI;        ///< bending stiffness [N m²]
  double rhoA;      ///< mass per length [kg/m]
  double rhoI = 0;  ///< rotary inertia per length [kg m]; 0 neglects it
};

/// Timoshenko beam of constant section whose deflection and rotation are the exact static solution for end loads, so that it does not lock:
/// for kGA → ∞ it is BeamEuler with rotary inertia. Source: [Przemieniecki1968] (stiffness), [FriedmanKosmatka1993] (shapes, mass).
struct BeamTimoshenko {
  static constexpr int nodes = 2, dofs_per_node = 3, dofs = 6, points = 2, stress_rows = 3;
  double EA;    ///< axial stiffness [N]
  double EI;    ///< bending stiffness [N m²]
  double kGA;   ///< shear stiffness κGA [N]
  double rhoA;  ///< mass per length [kg/m]
  double rhoI;  ///< rotary inertia per length [kg m]
};

template <class E>
concept BeamElement = std::same_as<E, BeamEuler> || std::same_as<E, BeamTimoshenko>;
template <class E>
concept LineElement = std::same_as<E, Bar> || BeamElement<E>;

// Defined in line.cpp for the three above. All: @pre the nodes do not coincide. No allocation.

/// K, exact for end loads. Rank 1 (bar) or 3 (beams): stretch, bending, shear.
template <LineElement E>
Square<E> stiffness(const E&, const Coords<E>&);
/// M = ∫ ρA NᵀN + ρI θᵀθ ds, with θ the row `rotation`. RᵀMR includes the sections' own inertia, ∫ρI ds; xᵀMx does not, because only the
/// axis has a position.
template <LineElement E>
Square<E> mass(const E&, const Coords<E>&);
/// Half of the mass, and in beams half of ∫ρI ds, at each node. The rotary inertia of each half of the span is omitted: without it
/// frequencies converge at fourth order, with it at second.
template <LineElement E>
NodalVector<E> lumped_mass(const E&, const Coords<E>&);
/// G = ∫ ρA NᵀZᵀN ds. The rotation of the sections does not contribute.
template <LineElement E>
Square<E> skew_mass(const E&, const Coords<E>&);
/// ξ.x() ∈ [0, 1] along the axis; ξ.y() is ignored.
template <LineElement E>
ShapeMatrix<E> shape(const E&, const Coords<E>&, const Eigen::Vector2d& xi);
/// [N V M] at both ends, with N and V equal at both, from nodal dofs alone: the fixed-end forces of a load between the nodes, which
/// `line_load` applies to the nodes, still have to be subtracted.
template <LineElement E>
Stress<E> stress(const E&, const Coords<E>&, const NodalVector<E>&);
/// For N and V, linear between the ends: ½ uᵀK_g u = ∫ ½N w′² − V u′θ ds. So a rigid rotation rotates the end forces: K_g R = Z·(K u) for
/// the stress of u. M and pure extension do no such work.
template <LineElement E>
Square<E> geometric_stiffness(const E&, const Coords<E>&, const Stress<E>&);

/// Rotation of the section at ξ ∈ [0, 1] = row · dofs.
template <BeamElement E>
Eigen::Matrix<double, 1, 6> rotation(const E&, const Coords<E>&, double xi);

/// Nodal forces of a uniform force per length q [N/m, body axes], consistent with `shape`.
template <LineElement E>
NodalVector<E> line_load(const E&, const Coords<E>&, const Eigen::Vector2d& q);

}  // namespace pintle
