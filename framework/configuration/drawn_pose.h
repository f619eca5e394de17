#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/configuration/redundancy.h"
#include "framework/scene/scene.h"

/// What the pose that a scene draws says of the start, and where the start does not follow it.
namespace pintle {

/// Where journals lie in their bearings as the scene draws them, world axes [m]; in the middle where it does not, or not inside.
/// @param y  the drawn pose   @param doubts  gets journals that are drawn outside their bearings
std::vector<Eigen::Vector2d> drawn_journals(const Scene&, const System&, const Eigen::VectorXd& y, std::vector<std::string>& doubts);

/// Bodies that closing the joints has taken far from where they are drawn, as into another branch.
void doubt_moves(const Scene&, const System&, const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                 std::vector<std::string>& doubts);

/// Drivers that move one freedom in the same way, in words; empty: there are none.
std::string driven_twice(const System&, const Redundancy&);

}  // namespace pintle
