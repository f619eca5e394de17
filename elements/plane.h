#pragma once

#include "elements/element.h"
#include "elements/material.h"

/// Plane-stress and plane-strain elements, isoparametric; dofs [u_x u_y] per node. Nodes are ordered counter-clockwise, corners first,
/// then the middles of the sides 12, 23, …, then the centre, as in VTK and Gmsh. Reference cell: [−1, 1]² with node 1 at (−1, −1), or the
/// triangle (0, 0) (1, 0) (0, 1). Small strain; material and thickness constant. Theory: docs/theory/plane.md.
namespace pintle {

/// Constant over an element.
struct PlaneProperties {
  PlaneMaterial material;
  double density = 0;    ///< ρ [kg/m³]
  double thickness = 0;  ///< [m]
};

/// The kinds of elements. Displacement converges with order p + 1 in L2, energy and frequency with order 2p; p = 1 for three and four
/// nodes, 2 for the others.
enum class PlaneKind {
  triangle3,               ///< constant strain: stiff in bending, for comparison
  triangle6,               ///< quadratic, 3 points
  quadrilateral4,          ///< bilinear with incompatible modes, exact for a rectangle in pure bending;
                           ///< passes the patch test in any shape [TaylorBeresfordWilson1976]
  quadrilateral4_plain,    ///< bilinear: locks in bending, for comparison
  quadrilateral8,          ///< serendipity, 3 × 3 points
  quadrilateral8_reduced,  ///< serendipity, 2 × 2 points
  quadrilateral9,          ///< biquadratic, 3 × 3 points
};

/// One kind with its constants: N nodes, and the P integration points of its stiffness, at which its stress is evaluated. Variable data are
/// in `p`.
template <PlaneKind kind, int N, int P>
struct PlaneElement {
  static constexpr PlaneKind plane_kind = kind;
  static constexpr int nodes = N, dofs_per_node = 2, dofs = 2 * N, points = P, stress_rows = 4;

  /// Number of deformation modes of a single element without strain energy. The serendipity element with 2 × 2 points has one, (ξ(1 − 3η²),
  /// −η(1 − 3ξ²)) if it is square: rank dofs − 4. Two elements with a common side cannot both have it, so a mesh of two elements has none.
  static constexpr int spurious_modes = kind == PlaneKind::quadrilateral8_reduced ? 1 : 0;
  /// Whether displacement stays accurate in plane strain as ν → ½: to 2 % at ν = 0.4999 with four elements across the wall of a thick
  /// cylinder. The others have more incompressibility conditions than their dofs can satisfy: with 3 × 3 points this delays convergence
  /// by one level of refinement; with three and four nodes (without incompatible modes) they lock permanently.
  static constexpr bool near_incompressible =
      kind == PlaneKind::triangle6 || kind == PlaneKind::quadrilateral4 || kind == PlaneKind::quadrilateral8_reduced;

  PlaneProperties p;
};
using Triangle3 = PlaneElement<PlaneKind::triangle3, 3, 1>;
using Triangle6 = PlaneElement<PlaneKind::triangle6, 6, 3>;
using Quadrilateral4 = PlaneElement<PlaneKind::quadrilateral4, 4, 4>;
using Quadrilateral4Plain = PlaneElement<PlaneKind::quadrilateral4_plain, 4, 4>;
using Quadrilateral8 = PlaneElement<PlaneKind::quadrilateral8, 8, 9>;
using Quadrilateral8Reduced = PlaneElement<PlaneKind::quadrilateral8_reduced, 8, 4>;
using Quadrilateral9 = PlaneElement<PlaneKind::quadrilateral9, 9, 9>;

template <class E>
concept PlaneElementType = requires {
  { E::plane_kind } -> std::convertible_to<PlaneKind>;
};

// Defined in plane.cpp and plane_stress.cpp for the seven kinds above. @pre for all functions of x: the Jacobian is positive at the
// integration points; `nodal_jacobians` checks a mesh beforehand.

/// Symmetric positive semidefinite; its null space is the rigid motions and the spurious modes.
template <PlaneElementType E>
Square<E> stiffness(const E&, const Coords<E>& x);
/// Consistent; exact to rounding, including curved sides. Incompatible modes carry no mass.
template <PlaneElementType E>
Square<E> mass(const E&, const Coords<E>& x);
/// Positive, with exact total mass. Three and four nodes: row sums, which also preserve the mass centre; the others: the consistent
/// diagonal, scaled [HintonRockZienkiewicz1976].
template <PlaneElementType E>
NodalVector<E> lumped_mass(const E&, const Coords<E>& x);
/// Skew-symmetric; as exact as `mass`.
template <PlaneElementType E>
Square<E> skew_mass(const E&, const Coords<E>& x);
/// N at ξ in the reference cell, without the incompatible modes, which do not affect the nodes.
template <PlaneElementType E>
ShapeMatrix<E> shape(const E&, const Coords<E>& x, const Eigen::Vector2d& xi);
/// [σx σy τxy σz] at the integration points [Pa], including the strain of the incompatible modes.
template <PlaneElementType E>
Stress<E> stress(const E&, const Coords<E>& x, const NodalVector<E>& u);
/// For in-plane s: ½uᵀK_g u = t ∫ s : ½(HᵀH − ε²) dA, H = ∇u, ε = sym H; without σz and incompatible modes.
template <PlaneElementType E>
Square<E> geometric_stiffness(const E&, const Coords<E>& x, const Stress<E>& s);

/// The points of `stress` in the reference cell: 2 × P [–].
template <PlaneElementType E>
Eigen::Matrix<double, 2, E::points> reference_points(const E&);
/// The same in body axes: 2 × P [m].
template <PlaneElementType E>
Eigen::Matrix<double, 2, E::points> stress_points(const E&, const Coords<E>& x);
/// Stress at the nodes, 4 × N [Pa], from stress at the points: the (bi)linear least-squares field, which for nine points is the one through
/// the values at the 2 × 2 Gauss points, where stress is most accurate. Three nodes: constant. Exact for stress linear in the reference
/// coordinates.
template <PlaneElementType E>
Eigen::Matrix<double, 4, E::nodes> nodal_stress(const E&, const Stress<E>& s);

/// Determinant of the Jacobian at each node [m²]. Zero at a corner of 180°, negative at a larger angle or for clockwise nodes. Where it is
/// ≤ 0, the stress is meaningless, and possibly the stiffness.
template <PlaneElementType E>
Eigen::Matrix<double, 1, E::nodes> nodal_jacobians(const E&, const Coords<E>& x);

/// Nodal forces of a traction on a side, force per area [Pa, body axes], constant along it: [f_x f_y] of each node [N]. A side has 2 or 3
/// nodes, columns of `side` [m]: ends, then middle. Resultant and moment equal those of the traction on the (parabolic) side, to rounding
/// for arcs up to 90°.
/// @throws std::invalid_argument  a side with another number of nodes
Eigen::VectorXd side_load(const Eigen::Matrix2Xd& side, const Eigen::Vector2d& traction, double thickness);
/// The same for a pressure [Pa], which pushes to the side's left: into the body, since an outline runs counter-clockwise with the body to
/// its left (and a hole's rim clockwise). Exact to rounding, so that a uniform pressure on a closed outline has neither resultant nor
/// moment.
/// @throws std::invalid_argument  a side with another number of nodes
Eigen::VectorXd side_pressure(const Eigen::Matrix2Xd& side, double pressure, double thickness);

/// Von Mises stress of [σx σy τxy σz]. [Pa]
double von_mises(const Eigen::Vector4d&);
/// The two principal stresses in the plane, larger first [Pa], and the angle of the first from the
/// x axis, in (−π/2, π/2] [rad].
Eigen::Vector3d principal(const Eigen::Vector4d&);

}  // namespace pintle
