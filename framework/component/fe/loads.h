#pragma once

#include <vector>

#include "framework/component/fe/fe_model.h"
#include "meshes/mesh.h"

/// Loads as forces on dofs. A load over a length, side or body is nodal, N, and consistent: its work on any displacement of the
/// elements equals that of the load itself. `independent_load` converts it to independent dofs, which `solve_static` needs. Loads can
/// be added.
namespace pintle {

/// A force f [N] and a torque [N m] at a port, added to `independent`, n.
/// @throws std::invalid_argument  a torque on a port without rotation
void add_force(Eigen::VectorXd& independent, const Port&, const Eigen::Vector2d& f, double torque);

/// Force per area [Pa], body axes, on sides of plane cells; thickness in m.
/// @throws std::invalid_argument  a side's nodes are not those of the model
Eigen::VectorXd traction_load(const FeModel&, const std::vector<Cells>& sides, const Eigen::Vector2d& traction, double thickness);
/// Pressure [Pa] on sides with the body to their left: it pushes into the body.
Eigen::VectorXd pressure_load(const FeModel&, const std::vector<Cells>& sides, double pressure, double thickness);

/// M T a: load of an acceleration field a [m/s²], such as gravity, on the body; M: N × N.
Eigen::VectorXd acceleration_load(const FeModel&, const Sparse& M, const Eigen::Vector2d& a);
/// ω² M (x − x_about): the centrifugal force in the axes of a body that rotates steadily at w [rad/s] about a point [m]. It points outward,
/// independently of the sign of w.
Eigen::VectorXd spin_load(const FeModel&, const Sparse& M, double w, const Eigen::Vector2d& about);

/// Force per length q [N/m], body axes, along all line elements.
/// @throws std::invalid_argument  the model has no line elements
Eigen::VectorXd line_load(const FeModel&, const Eigen::Vector2d& q);

}  // namespace pintle
