#pragma once

#include <concepts>

#include "elements/element.h"

/// Straight elements of two nodes. Element axes: s along from node 1 to node 2, the second to its
/// left. Their centroids lie on the axis; small strain. Theory: docs/theory/elements.md.
namespace pintle {

/// Two-node bar: carries axial force only. Freedoms [u_x u_y] per node, all linear.
struct Bar {
  static constexpr int nodes = 2, dofs_per_node = 2, dofs = 4, points = 2, stress_rows = 3;
  double EA;    ///< axial stiffness [N]
  double rhoA;  ///< mass per length [kg/m]
};

/// Euler–Bernoulli beam of constant section: axial field linear, deflection a Hermite cubic, so
/// that end loads are met exactly at the nodes. Source: [Przemieniecki1968].
struct BeamEuler {
  static constexpr int nodes = 2, dofs_per_node = 3, dofs = 6, points = 2, stress_rows = 3;
  double EA;        ///< axial stiffness [N]
  double EI;        ///< bending stiffness [N m²]
  double rhoA;      ///< mass per length [kg/m]
  double rhoI = 0;  ///< rotary inertia per length [kg m]; 0 leaves it out
};

/// Timoshenko beam of constant section whose deflection and rotation are the exact static solution
/// for end loads, so that it does not lock: with kGA → ∞ it is BeamEuler with rotary inertia.
/// Source: [Przemieniecki1968] (stiffness), [FriedmanKosmatka1993] (shapes, mass).
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

// Defined in line.cpp for the three above. All: @pre the nodes are apart. No allocation.

/// K, exact for end loads. Rank 1 (bar) or 3 (beams): stretch, bending, shear.
template <LineElement E>
Square<E> stiffness(const E&, const Coords<E>&);
/// M = ∫ ρA NᵀN + ρI θᵀθ ds, θ the row `rotation`. RᵀMR holds the sections' own inertia, ∫ρI ds;
/// xᵀMx does not: the axis alone has a position.
template <LineElement E>
Square<E> mass(const E&, const Coords<E>&);
/// Half the mass, and in beams half of ∫ρI ds, at either node. No inertia of the half-span against
/// rotation: with it frequencies would converge at second order, without it at fourth.
template <LineElement E>
Freedoms<E> lumped_mass(const E&, const Coords<E>&);
/// G = ∫ ρA NᵀZᵀN ds. The sections' rotation adds nothing to it.
template <LineElement E>
Square<E> skew_mass(const E&, const Coords<E>&);
/// ξ.x() ∈ [0, 1] along the axis; ξ.y() is not looked at.
template <LineElement E>
ShapeMatrix<E> shape(const E&, const Coords<E>&, const Eigen::Vector2d& xi);
/// [N V M] at both ends, N and V equal there, from nodal freedoms alone: a load between the nodes
/// still has its fixed-end forces, which `line_load` puts on the nodes, to be taken off.
template <LineElement E>
Stress<E> stress(const E&, const Coords<E>&, const Freedoms<E>&);
/// Of N and V, linear between the ends: ½ uᵀK_g u = ∫ ½N w′² − V u′θ ds. So a rigid rotation
/// turns the end forces: K_g R = Z·(K u) for the stress of u. M and pure stretch do no such work.
template <LineElement E>
Square<E> geometric_stiffness(const E&, const Coords<E>&, const Stress<E>&);

/// Rotation of the section at ξ ∈ [0, 1] = row · freedoms.
template <BeamElement E>
Eigen::Matrix<double, 1, 6> rotation(const E&, const Coords<E>&, double xi);

/// Freedoms' share of a uniform force per length q [N/m, body axes], consistent with `shape`.
template <LineElement E>
Freedoms<E> line_load(const E&, const Coords<E>&, const Eigen::Vector2d& q);

}  // namespace pintle
