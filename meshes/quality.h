#pragma once

#include "meshes/mesh.h"

namespace pintle {

/// Of one plane cell. The scaled Jacobian at a node is det J over the product of the lengths of its
/// two columns, the directions of the sides that meet there; in a triangle, which has three, the
/// two longest count. Scaled so that an equilateral triangle and a square have 1; independent of
/// size, place, turn and of the corner that is named first. ≤ 0 means turned inside out there; it
/// is 0 at a straight corner. A middle node nearer to an end than a quarter of the side turns the
/// side back on itself: less than 0 too.
struct CellQuality {
  double jacobian = 1;                  ///< least scaled Jacobian over the nodes (not only the integration points)
  double aspect = 1;                    ///< longest side over shortest, corner to corner
  double angle_min = 0, angle_max = 0;  ///< between tangents at the corners [rad], 0 to 2π
};

struct WorstCell {
  long number;  ///< as the mesh numbers it
  CellShape shape;
  Eigen::Vector2d at;  ///< mean of its corners [m]
  CellQuality quality;
};

struct MeshQuality {
  std::vector<CellQuality> cells;  ///< in the order of Mesh::cells; a line has the values above
  double least_jacobian = 1, mean_jacobian = 1, greatest_aspect = 1;
  double least_angle = 0, greatest_angle = 0;
  std::vector<WorstCell> inverted;  ///< Jacobian ≤ 0 (within rounding) at a node, worst first
  std::vector<WorstCell> bad;       ///< below `bad_jacobian`, the inverted too, worst first
};
inline constexpr double bad_jacobian = 0.1;

/// Cannot fail. A cell with two nodes in one place has Jacobian 0.
MeshQuality quality(const Mesh&);
/// Turns over cells that run clockwise as a whole (allowed in files), so that what stays inverted
/// is; the groups' sides turn with them.
void orient(Mesh&);

}  // namespace pintle
