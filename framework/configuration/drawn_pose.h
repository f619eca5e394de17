#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/configuration/redundancy.h"
#include "framework/scene/scene.h"

/// What the pose drawn in a scene implies for the start, and where the start deviates from it.
namespace pintle {

/// Positions of journals in their bearings as drawn in the scene, world axes [m]; in the middle where it draws none, or not inside.
/// @param y  the drawn pose   @param doubts  receives journals drawn outside their bearings
std::vector<Eigen::Vector2d> drawn_journals(const Scene&, const System&, const Eigen::VectorXd& y, std::vector<std::string>& doubts);

/// Reports bodies that closing the joints has moved far from where they are drawn, for example to another branch.
void doubt_moves(const Scene&, const System&, const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                 std::vector<std::string>& doubts);

/// Drivers that impose the same degree of freedom, in words; empty: none.
std::string driven_twice(const System&, const Redundancy&);

}  // namespace pintle
