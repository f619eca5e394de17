#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/component/assembly.h"

namespace pintle {

/// Independent freedoms held at zero.
struct Supports { std::vector<int> freedoms; };
void hold(Supports&, const FeModel&, int node, bool x, bool y, bool turn);
void hold(Supports&, const FeModel&, const Port&, bool x, bool y, bool turn);
/// Freedoms that stay free, ascending, and the principal submatrix over them.
std::vector<int> free_freedoms(const FeModel&, const Supports&);
Sparse restricted(const Sparse& A, const std::vector<int>& keep);

/// A static answer, all in nodal freedoms or nodes.
struct StaticSolution {
  Eigen::VectorXd u;          ///< N [m, rad]
  Eigen::VectorXd reactions;  ///< forces of the supports, independent freedoms, n; zero where free [N, N m]
  double strain_energy = 0;   ///< ½ uᵀKu [J]
  double residual = 0;        ///< ‖Ku − f‖/‖f‖ over free freedoms
};
/// @throws std::runtime_error  the supports leave a motion free: which (x, y or rotation, of the body or a part)
StaticSolution solve_static(const FeModel&, const Sparse& K, const Supports&, const Eigen::VectorXd& independent_load);

/// Stress of a nodal displacement field. Plane models: [σx σy τxy σz] at nodes, the mean over the elements that
/// meet there (of one block), 4 × nodes, and the largest difference between an element's own value and that mean as
/// a sign of mesh error. Line models: section forces [N V M] at both ends of each element.
struct StressField {
  Eigen::Matrix4Xd nodal;           ///< plane [Pa]; empty for lines
  Eigen::VectorXd von_mises;        ///< per node [Pa]; lines: at the outermost fibre, from `fibres`
  double jump = 0;                  ///< largest element-to-mean difference of von Mises over its largest value –
  Eigen::Matrix3Xd section_forces;  ///< lines: 3 × 2 per element [N, N, N m]
  Eigen::Matrix4Xd at_points;       ///< plane: at the integration points, element by element [Pa]
  Eigen::Matrix2Xd points;          ///< where those are [m]
};
/// `fibres`: for lines, area A, second moment I and fibre distance per element, as sections give them.
struct Fibre { double A, I, distance; };
StressField stress_field(const FeModel&, const Eigen::VectorXd& u, const std::vector<Fibre>& fibres = {});

}  // namespace pintle
