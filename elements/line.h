#pragma once

#include "elements/element.h"

/// Straight elements of two nodes. Element axes: x from node 1 to node 2, y to its left.
/// Theory: docs/theory/elements.md.
namespace pintle {

/// Two-node bar: carries axial force only. Freedoms [u_x u_y] per node, all linear.
struct Bar {
  static constexpr int nodes = 2, dofs_per_node = 2, dofs = 4, points = 2, stress_rows = 3;
  double EA;    ///< axial stiffness [N]
  double rhoA;  ///< mass per length [kg/m]
};

/// Euler–Bernoulli beam of constant section: axial field linear, deflection a Hermite cubic, so that
/// end loads are met exactly at the nodes. Source: [Przemieniecki1968].
struct BeamEuler {
  static constexpr int nodes = 2, dofs_per_node = 3, dofs = 6, points = 2, stress_rows = 3;
  double EA;        ///< axial stiffness [N]
  double EI;        ///< bending stiffness [N m²]
  double rhoA;      ///< mass per length [kg/m]
  double rhoI = 0;  ///< rotary inertia per length [kg m]; 0 leaves it out
};

/// Timoshenko beam of constant section whose deflection and rotation are the exact static solution
/// for end loads, so that it does not lock: with GkA → ∞ it is BeamEuler with rotary inertia.
struct BeamTimoshenko {
  static constexpr int nodes = 2, dofs_per_node = 3, dofs = 6, points = 2, stress_rows = 3;
  double EA;    ///< axial stiffness [N]
  double EI;    ///< bending stiffness [N m²]
  double kGA;   ///< shear stiffness κGA [N]
  double rhoA;  ///< mass per length [kg/m]
  double rhoI;  ///< rotary inertia per length [kg m]
};

Square<Bar> stiffness(const Bar&, const Coords<Bar>&);
Square<Bar> mass(const Bar&, const Coords<Bar>&);
Freedoms<Bar> lumped_mass(const Bar&, const Coords<Bar>&);
Square<Bar> skew_mass(const Bar&, const Coords<Bar>&);
ShapeMatrix<Bar> shape(const Bar&, const Coords<Bar>&, const Eigen::Vector2d& xi);
Stress<Bar> stress(const Bar&, const Coords<Bar>&, const Freedoms<Bar>&);
Square<Bar> geometric_stiffness(const Bar&, const Coords<Bar>&, const Stress<Bar>&);

Square<BeamEuler> stiffness(const BeamEuler&, const Coords<BeamEuler>&);
Square<BeamEuler> mass(const BeamEuler&, const Coords<BeamEuler>&);
Freedoms<BeamEuler> lumped_mass(const BeamEuler&, const Coords<BeamEuler>&);
Square<BeamEuler> skew_mass(const BeamEuler&, const Coords<BeamEuler>&);
ShapeMatrix<BeamEuler> shape(const BeamEuler&, const Coords<BeamEuler>&, const Eigen::Vector2d& xi);
Stress<BeamEuler> stress(const BeamEuler&, const Coords<BeamEuler>&, const Freedoms<BeamEuler>&);
Square<BeamEuler> geometric_stiffness(const BeamEuler&, const Coords<BeamEuler>&, const Stress<BeamEuler>&);

Square<BeamTimoshenko> stiffness(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
Square<BeamTimoshenko> mass(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
Freedoms<BeamTimoshenko> lumped_mass(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
Square<BeamTimoshenko> skew_mass(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
ShapeMatrix<BeamTimoshenko> shape(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Eigen::Vector2d& xi);
Stress<BeamTimoshenko> stress(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Freedoms<BeamTimoshenko>&);
Square<BeamTimoshenko> geometric_stiffness(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Stress<BeamTimoshenko>&);

/// Rotation of the section at ξ ∈ [0, 1] = row · freedoms.
Eigen::Matrix<double, 1, 6> rotation(const BeamEuler&, const Coords<BeamEuler>&, double xi);
Eigen::Matrix<double, 1, 6> rotation(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, double xi);

/// Freedoms' share of a uniform force per length q [N/m, body axes], consistent with `shape`.
Freedoms<Bar> line_load(const Bar&, const Coords<Bar>&, const Eigen::Vector2d& q);
Freedoms<BeamEuler> line_load(const BeamEuler&, const Coords<BeamEuler>&, const Eigen::Vector2d& q);
Freedoms<BeamTimoshenko> line_load(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Eigen::Vector2d& q);

}  // namespace pintle
