#pragma once

#include <array>
#include <vector>

#include "framework/drawing/flexible_drawing.h"

namespace pintle {

/// A flexible body as triangles between some of its drawn points.
struct DrawnMesh {
  std::vector<int> points;  ///< columns of FlexibleDrawing::points
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> rim;  ///< sides of a single triangle
};

/// @param most  points; of a finer mesh, one point is kept in each square of a grid, and triangles within one or two squares are removed
DrawnMesh drawn_mesh(const FlexibleDrawing&, std::size_t most);

}  // namespace pintle
