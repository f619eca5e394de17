#pragma once

#include <vector>

#include "framework/component/fe/assembly.h"

/// Static answers of a held body. Theory: docs/theory/couplings.md.
namespace pintle {

/// Independent freedoms held at zero.
struct Supports {
  std::vector<int> freedoms;
};
/// @throws std::invalid_argument  the node or port is not there or has no rotation to hold; a
/// coupling
///         gives the node's motion, so that only its port can be held
void hold(Supports&, const FeModel&, int node, bool x, bool y, bool turn);
void hold(Supports&, const FeModel&, const Port&, bool x, bool y, bool turn);
/// Freedoms that stay free, ascending.
std::vector<int> free_freedoms(const FeModel&, const Supports&);
/// Rigid motions of the whole body that the supports leave, 0 to 3.
int rigid_motions_left(const FeModel&, const Supports&);

/// A static answer, in nodal freedoms or nodes where not said otherwise.
struct StaticSolution {
  Eigen::VectorXd u;            ///< N [m, rad]
  Eigen::VectorXd independent;  ///< ũ, n, with u = L ũ
  Eigen::VectorXd reactions;    ///< forces of the supports on the body, independent freedoms, n; zero
                                ///< where free [N, N m]
  double strain_energy = 0;     ///< ½ uᵀKu [J]
  double residual = 0;          ///< ‖Ku − f‖/‖f‖ over free freedoms, f with its reactions; 0 without load
};
/// K u = f with supports, by CHOLMOD, refined until rounding is all that is left. K: N × N, nodal.
/// Whether the supports hold every rigid motion of each connected part is judged by rank, whatever
/// the factor says of it; what else may move (hinged bars) by the least eigenvalue of K.
/// @throws std::runtime_error     the supports leave a motion free: which (x, y or rotation, of the
///         body or a part), or where the motion is greatest; the load or K is not finite
/// @throws std::invalid_argument  K or the load is not of the model's size
StaticSolution solve_static(const FeModel&, const Sparse& K, const Supports&, const Eigen::VectorXd& independent_load);

/// For lines: area, second moment and fibre distance of an element's section.
struct Fibre {
  double A, I, distance;  ///< [m²], [m⁴], [m]
};

/// Stress of a nodal displacement field. Elements count block by block.
struct StressField {
  /// Plane: [σx σy τxy σz] at nodes, 4 × nodes [Pa]; empty without plane elements. The mean over
  /// all elements of one material and thickness that meet there; where such sheets meet, the one of
  /// larger von Mises stress.
  Eigen::Matrix4Xd nodal;
  /// Per node [Pa]. Plane: of `nodal`. Lines: |N|/A + |M| distance/I, the largest that meets there;
  /// empty without fibres.
  Eigen::VectorXd von_mises;
  /// Plane: largest difference of an element's own von Mises stress at a node from that of the
  /// mean, over the largest of the field: a sign of mesh error –
  double jump = 0;
  /// Lines: [N V M] at both ends, 3 × 2 an element [N, N, N m]. From u alone: of a load between the
  /// nodes they miss the fixed-end forces.
  Eigen::Matrix3Xd section_forces;
  Eigen::Matrix4Xd at_points;  ///< plane: at the integration points, element by element [Pa]
  Eigen::Matrix2Xd points;     ///< where those are, body axes [m]
};
/// @param fibres  one per line element, or none
/// @throws std::invalid_argument  u is not of the model's size, or the count of fibres is another
StressField stress_field(const FeModel&, const Eigen::VectorXd& u, const std::vector<Fibre>& fibres = {});

}  // namespace pintle
