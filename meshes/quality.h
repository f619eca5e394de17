#pragma once

#include "meshes/mesh.h"

namespace pintle {

/// Quality of one plane cell. The scaled Jacobian at a node is det J divided by the product of the lengths of its two columns, the
/// directions of the sides that meet there; in a triangle, which has three directions, the two longest are used. It is scaled to 1 for an
/// equilateral triangle and a square; independent of size, position, rotation and first corner. A value ≤ 0 means that the cell is inverted
/// there; it is 0 at a straight corner. A middle node within a quarter of the side's length of an end turns the side back on itself, which
/// also gives a negative value.
struct CellQuality {
  double jacobian = 1;                  ///< least scaled Jacobian over the nodes (not only the integration points)
  double aspect = 1;                    ///< ratio of longest to shortest side, corner to corner
  double angle_min = 0, angle_max = 0;  ///< between tangents at the corners [rad], 0 to 2π
};

struct WorstCell {
  long number;  ///< number in the mesh
  CellShape shape;
  Eigen::Vector2d at;  ///< mean of its corners [m]
  CellQuality quality;
};

struct MeshQuality {
  std::vector<CellQuality> cells;  ///< in the order of Mesh::cells; a line has the default values
  double least_jacobian = 1, mean_jacobian = 1, greatest_aspect = 1;
  double least_angle = 0, greatest_angle = 0;
  std::vector<WorstCell> inverted;  ///< Jacobian ≤ 0 (within rounding) at a node, worst first
  std::vector<WorstCell> bad;       ///< below `bad_jacobian`, including inverted ones, worst first
};
inline constexpr double bad_jacobian = 0.1;

/// Cannot fail. A cell with two coinciding nodes has Jacobian 0.
MeshQuality quality(const Mesh&);
/// Reverses cells that run clockwise as a whole (allowed in files), so that only faulty cells are left inverted; reverses the groups' sides
/// with them.
void orient(Mesh&);

}  // namespace pintle
