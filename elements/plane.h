#pragma once

#include "elements/element.h"
#include "elements/material.h"

/// Plane-stress and plane-strain elements, isoparametric; freedoms [u_x u_y] per node. Nodes run
/// counter-clockwise, corners first, then the middles of the sides 12, 23, …, then the centre: VTK's
/// and Gmsh's order. Theory: docs/theory/elements.md.
namespace pintle {

/// Constant over an element.
struct PlaneProperties {
  PlaneMaterial material;
  double density = 0;    ///< ρ [kg/m³]
  double thickness = 0;  ///< [m]
};

/// The kinds; N nodes, P integration points of the stiffness.
enum class PlaneKind {
  triangle3,            ///< constant strain: stiff in bending, for comparison
  triangle6,            ///< quadratic
  quadrilateral4,       ///< bilinear with incompatible modes that pass the patch test [TaylorBeresfordWilson1976]
  quadrilateral4_plain, ///< bilinear: locks in bending, for comparison
  quadrilateral8,       ///< serendipity, 3 × 3 points
  quadrilateral8_reduced,  ///< serendipity, 2 × 2 points
  quadrilateral9,       ///< biquadratic, 3 × 3 points
};

template <PlaneKind kind, int N, int P>
struct PlaneElement {
  static constexpr PlaneKind plane_kind = kind;
  static constexpr int nodes = N, dofs_per_node = 2, dofs = 2 * N, points = P, stress_rows = 4;
  PlaneProperties p;
};
using Triangle3 = PlaneElement<PlaneKind::triangle3, 3, 1>;
using Triangle6 = PlaneElement<PlaneKind::triangle6, 6, 3>;
using Quadrilateral4 = PlaneElement<PlaneKind::quadrilateral4, 4, 4>;
using Quadrilateral4Plain = PlaneElement<PlaneKind::quadrilateral4_plain, 4, 4>;
using Quadrilateral8 = PlaneElement<PlaneKind::quadrilateral8, 8, 9>;
using Quadrilateral8Reduced = PlaneElement<PlaneKind::quadrilateral8_reduced, 8, 4>;
using Quadrilateral9 = PlaneElement<PlaneKind::quadrilateral9, 9, 9>;

// Defined in plane.cpp for the seven kinds above.
template <PlaneKind k, int N, int P> Square<PlaneElement<k, N, P>> stiffness(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&);
template <PlaneKind k, int N, int P> Square<PlaneElement<k, N, P>> mass(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&);
template <PlaneKind k, int N, int P> Freedoms<PlaneElement<k, N, P>> lumped_mass(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&);
template <PlaneKind k, int N, int P> Square<PlaneElement<k, N, P>> skew_mass(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&);
template <PlaneKind k, int N, int P> ShapeMatrix<PlaneElement<k, N, P>> shape(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&, const Eigen::Vector2d& xi);
template <PlaneKind k, int N, int P> Stress<PlaneElement<k, N, P>> stress(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&, const Eigen::Matrix<double, 2 * N, 1>&);
template <PlaneKind k, int N, int P> Square<PlaneElement<k, N, P>> geometric_stiffness(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&, const Eigen::Matrix<double, 4, P>&);

/// Where `stress` is told, reference cell and body axes.
template <PlaneKind k, int N, int P> Eigen::Matrix<double, 2, P> stress_points(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&);
/// Stress at the nodes, extrapolated from the points where it is best: 4 × N.
template <PlaneKind k, int N, int P> Eigen::Matrix<double, 4, N> nodal_stress(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 4, P>&);

/// Determinant of the Jacobian at each node [m²]: ≤ 0 there makes stress, if not stiffness, meaningless.
template <PlaneKind k, int N, int P> Eigen::Matrix<double, 1, N> nodal_jacobians(const PlaneElement<k, N, P>&, const Eigen::Matrix<double, 2, N>&);

/// A side's share of a traction, force per area [Pa, body axes], constant along it: nodes in order
/// along the side (ends, then middle), two values for each. 2 or 3 nodes.
Eigen::VectorXd side_load(const Eigen::Matrix2Xd& side, const Eigen::Vector2d& traction, double thickness);
/// The same of a pressure [Pa] pushing against the side's right, which is into a body that lies on
/// its left turned about: a body's outline runs counter-clockwise, so pressure pushes to its left.
Eigen::VectorXd side_pressure(const Eigen::Matrix2Xd& side, double pressure, double thickness);

/// [σx σy τxy σz] → what is read off. [Pa]
double von_mises(const Eigen::Vector4d&);
/// The two principal stresses in the plane, larger first, and the angle of the first [Pa, Pa, rad].
Eigen::Vector3d principal(const Eigen::Vector4d&);

}  // namespace pintle
