#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

#include "framework/drawing/vtk.h"

namespace pintle {

/// A flexible body as triangles between some of its drawn points.
struct DrawnMesh {
  std::vector<int> points;  ///< of all points that could be drawn
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> rim;  ///< sides of a single triangle
};

/// @param size  diagonal of the body [m]   @param most  points; of a finer mesh, one point is kept in each square of a grid, and triangles within one or two squares are removed
DrawnMesh drawn_mesh(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, double size, std::size_t most);

}  // namespace pintle
