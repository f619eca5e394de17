#pragma once

#include <span>

#include "meshes/mesh.h"

/// Meshes that do not need Gmsh.
namespace pintle {

/// A beam's axis: straight pieces through `corners`, each divided into `cells` (one number for all, or one per piece) equal two-node lines.
/// @throws std::invalid_argument  fewer than two corners, two that coincide, cells < 1
Mesh line_mesh(std::span<const Eigen::Vector2d> corners, std::span<const int> cells);

/// Four corners, counter-clockwise, mapped bilinearly and divided into nx × ny cells of `shape` (a plane one; triangles are halves of the
/// quadrilaterals). Groups "bottom" (corner 1 to 2), "right", "top", "left".
/// @throws std::invalid_argument  nx or ny < 1, or corners that do not form a convex counter-clockwise quadrilateral
Mesh grid_mesh(std::span<const Eigen::Vector2d, 4> corners, int nx, int ny, CellShape shape);

}  // namespace pintle
