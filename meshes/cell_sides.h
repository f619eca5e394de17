#pragma once

#include <vector>

#include "meshes/mesh.h"

/// Cells and their sides, one list each, for those who compare them.
namespace pintle {

struct CellView {
  const int* nodes;
  CellShape shape;
  long number;  ///< as the mesh numbers it
};
std::vector<CellView> cell_views(const Mesh&);

/// A side as its cell runs it.
struct SideView {
  int a, b, middle;  ///< nodes; middle −1: there is none
  int cell;          ///< into cell_views
};
SideView side_of(const CellView&, int cell, int side);
/// All sides of plane cells; those between the same two corners stand together.
std::vector<SideView> paired_sides(const std::vector<CellView>&);

/// A place on a side, t from 0 at a to 1 at b.
Eigen::Vector2d on_side(const Mesh&, const SideView&, double t);
/// How far p lies from the side [m], and where that is on it.
double distance(const Mesh&, const SideView&, const Eigen::Vector2d& p, double& t);
/// Whether p lies within the cell, its curved sides as they are.
bool covers(const Mesh&, const CellView&, const Eigen::Vector2d& p);

}  // namespace pintle
