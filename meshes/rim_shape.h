#pragma once

#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// Connectivity of sides of the outline, and the circle that fits their nodes best (least squares).
struct RimShape {
  int loops = 0;                                     ///< closed loops
  int open = 0;                                      ///< chains with two ends
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]; infinite for a straight edge
  double misfit = 0;                                 ///< largest distance of a corner from the circle, relative to its radius
  double angle = 0;                                  ///< angle about the centre covered by all sides together [rad]
};
/// @pre there is a side
RimShape rim_shape(const Mesh&, const std::vector<Cells>& sides);

}  // namespace pintle
