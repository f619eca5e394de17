#pragma once

#include <concepts>

#include <Eigen/Core>

#include "eigen_layout.h"

/// The interface of every element. All matrices are in body axes; the nodal dofs of a node are [u_x u_y] or, in beams, [u_x u_y φ] (m,
/// m, rad), node after node.
///
/// T, x, R are the nodal values of a unit translation, of position and of a unit rotation. With these, M and G alone give all invariants of
/// a floating frame: docs/theory/elements.md.
namespace pintle {

template <class E>
using Coords = Eigen::Matrix<double, 2, E::nodes>;  ///< [m]
template <class E>
using NodalVector = Eigen::Matrix<double, E::dofs, 1>;
template <class E>
using Square = Eigen::Matrix<double, E::dofs, E::dofs>;
template <class E>
using ShapeMatrix = Eigen::Matrix<double, 2, E::dofs>;
/// Stress at the element's own points, one column per point. Plane: [σx σy τxy σz] in Pa, body axes, at the integration points. Line: [N V
/// M] in N, N, N m, at the two ends, element axes: N > 0 is tension, M > 0 stretches the side to the right of the axis (−y of the element),
/// V = −dM/ds.
template <class E>
using Stress = Eigen::Matrix<double, E::stress_rows, E::points>;

template <class E>
concept Element = requires(const E& e, const Coords<E>& x, const NodalVector<E>& u, const Stress<E>& s, const Eigen::Vector2d& xi) {
  requires E::dofs == E::nodes* E::dofs_per_node;
  /// K = ∫ BᵀDB. Symmetric; its null space is the three rigid motions of the plane.
  { stiffness(e, x) } -> std::same_as<Square<E>>;
  /// M = ∫ ρ NᵀN, consistent. Symmetric; TᵀMT is the mass.
  { mass(e, x) } -> std::same_as<Square<E>>;
  /// Diagonal of a lumped mass matrix: non-negative, with the mass of the element.
  { lumped_mass(e, x) } -> std::same_as<NodalVector<E>>;
  /// G = ∫ ρ NᵀZᵀN, Z = [0 −1; 1 0]. Skew-symmetric.
  { skew_mass(e, x) } -> std::same_as<Square<E>>;
  /// Displacement = shape · dofs. Plane: ξ in the reference cell; line: ξ.x() ∈ [0, 1] along the axis.
  { shape(e, x, xi) } -> std::same_as<ShapeMatrix<E>>;
  /// The stress caused by dofs u.
  { stress(e, x, u) } -> std::same_as<Stress<E>>;
  /// K_g of a given stress: ½ uᵀ K_g u is the work of that stress on the quadratic part of the strain.
  { geometric_stiffness(e, x, s) } -> std::same_as<Square<E>>;
};

}  // namespace pintle
