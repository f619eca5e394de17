#pragma once

#include <vector>

#include <Eigen/Core>

namespace pintle {

/// A circle given as a regular polygon of many corners, in pixels, divided so finely that no chord is visible. Other lines are unchanged.
std::vector<Eigen::Vector2d> rounded(std::vector<Eigen::Vector2d>);

}  // namespace pintle
