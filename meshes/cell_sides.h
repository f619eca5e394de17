#pragma once

#include <vector>

#include "meshes/mesh.h"

/// Cells and their sides, each as one list, for comparing them.
namespace pintle {

struct CellView {
  const int* nodes;
  CellShape shape;
  long number;  ///< number in the mesh
};
std::vector<CellView> cell_views(const Mesh&);

/// A side in the direction of its cell.
struct SideView {
  int a, b, middle;  ///< nodes; middle is −1 if there is none
  int cell;          ///< index into cell_views
};
SideView side_of(const CellView&, int cell, int side);
/// All sides of plane cells; those between the same two corners are adjacent.
std::vector<SideView> paired_sides(const std::vector<CellView>&);

/// A point on a side, t from 0 at a to 1 at b.
Eigen::Vector2d on_side(const Mesh&, const SideView&, double t);
/// Distance of p from the side [m], and the nearest point t on it.
double distance(const Mesh&, const SideView&, const Eigen::Vector2d& p, double& t);
/// Whether p is inside the cell, including its curved sides.
bool covers(const Mesh&, const CellView&, const Eigen::Vector2d& p);

}  // namespace pintle
