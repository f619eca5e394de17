#pragma once

#include <vector>

#include "framework/component/fe/assembly.h"

/// Static solutions of a supported body. Theory: docs/theory/couplings.md.
namespace pintle {

/// Independent dofs fixed at zero.
struct Supports {
  std::vector<int> dofs;
};
/// @throws std::invalid_argument  the node or port does not exist or has no rotation to fix; a coupling determines the node's motion, so
/// that only its port can be fixed
void hold(Supports&, const FeModel&, int node, bool x, bool y, bool turn);
void hold(Supports&, const FeModel&, const Port&, bool x, bool y, bool turn);
/// Degrees of freedom that remain free, ascending.
std::vector<int> free_dofs(const FeModel&, const Supports&);
/// Number of rigid motions of the whole body that the supports allow, 0 to 3.
int rigid_motions_left(const FeModel&, const Supports&);

/// A static solution, in nodal dofs or nodes unless stated otherwise.
struct StaticSolution {
  Eigen::VectorXd u;            ///< N [m, rad]
  Eigen::VectorXd independent;  ///< ũ, n, with u = L ũ
  Eigen::VectorXd reactions;    ///< forces of the supports on the body, independent dofs, n; zero
                                ///< where free [N, N m]
  double strain_energy = 0;     ///< ½ uᵀKu [J]
  double residual = 0;          ///< ‖Ku − f‖/‖f‖ over free dofs, with f including reactions; 0 without load
};
/// Solves K u = f with supports, by CHOLMOD, refined until only rounding is left. K: N × N, nodal. Whether the supports restrain every
/// rigid motion of each connected part is judged by rank, independently of the factor; other possible motions (hinged bars) by the smallest
/// eigenvalue of K.
/// @throws std::runtime_error     the supports leave a motion free: which (x, y or rotation, of the body or a part), or where the motion is
/// largest; the load or K is not finite
/// @throws std::invalid_argument  K or the load does not have the model's size
StaticSolution solve_static(const FeModel&, const Sparse& K, const Supports&, const Eigen::VectorXd& independent_load);

/// For line elements: area, second moment and fibre distance of an element's section.
struct Fibre {
  double A, I, distance;  ///< [m²], [m⁴], [m]
};

/// Stress of a nodal displacement field. Elements are numbered block by block.
struct StressField {
  /// Plane: [σx σy τxy σz] at nodes, 4 × nodes [Pa]; empty without plane elements. The mean over all elements of the same material and
  /// thickness at a node; where different sheets meet, the one of larger von Mises stress.
  Eigen::Matrix4Xd nodal;
  /// Per node [Pa]. Plane: from `nodal`. Lines: |N|/A + |M| distance/I, the largest value at the node; empty without fibres.
  Eigen::VectorXd von_mises;
  /// Plane: largest difference between an element's own von Mises stress at a node and that of the mean, relative to the largest of the
  /// field: an indicator of mesh error, –
  double jump = 0;
  /// Lines: [N V M] at both ends, 3 × 2 per element [N, N, N m]. From u alone: the fixed-end forces of loads between the nodes are not
  /// included.
  Eigen::Matrix3Xd section_forces;
  Eigen::Matrix4Xd at_points;  ///< plane: at the integration points, element by element [Pa]
  Eigen::Matrix2Xd points;     ///< positions of these, body axes [m]
};
/// @param fibres  one per line element, or none
/// @throws std::invalid_argument  u does not have the model's size, or the number of fibres is wrong
StressField stress_field(const FeModel&, const Eigen::VectorXd& u, const std::vector<Fibre>& fibres = {});

}  // namespace pintle
