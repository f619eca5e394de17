#pragma once

#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// How sides of the outline hang together, and the circle that fits their nodes best (least squares).
struct RimShape {
  int loops = 0;                                     ///< closed runs
  int open = 0;                                      ///< runs with two ends
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]; infinite for a straight edge
  double misfit = 0;                                 ///< greatest distance of a corner from the circle, over its radius
  double angle = 0;                                  ///< that all sides together cover about the centre [rad]
};
/// @pre there is a side
RimShape rim_shape(const Mesh&, const std::vector<Cells>& sides);

}  // namespace pintle
