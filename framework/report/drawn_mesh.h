#pragma once

#include <array>
#include <vector>

#include "framework/drawing/flexible_drawing.h"

namespace pintle {

/// A flexible body as triangles between some of its drawn points.
struct DrawnMesh {
  std::vector<int> points;  ///< columns of FlexibleDrawing::points
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> rim;  ///< sides of triangles that belong to one alone
};

/// @param most  points; of a finer body one stays in each square of a grid, and triangles that lie in one or two squares go
DrawnMesh drawn_mesh(const FlexibleDrawing&, std::size_t most);

}  // namespace pintle
