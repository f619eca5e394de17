#pragma once

#include "meshes/mesh.h"

namespace pintle {

/// Of one plane cell. The scaled Jacobian at a node is det J over the product of the lengths of its two
/// columns, scaled so that an equilateral triangle and a square have 1; ≤ 0 means turned inside out there.
struct CellQuality {
  double jacobian = 1;  ///< least scaled Jacobian over the nodes (not only the integration points)
  double aspect = 1;    ///< longest side over shortest
  double angle_min = 0, angle_max = 0;  ///< at the corners [rad]
};

struct WorstCell {
  long number;         ///< as the mesh numbers it
  CellShape shape;
  Eigen::Vector2d at;  ///< its centre [m]
  CellQuality quality;
};

struct MeshQuality {
  std::vector<CellQuality> cells;     ///< in the order of Mesh::cells
  double least_jacobian = 1, mean_jacobian = 1, greatest_aspect = 1, least_angle = 0, greatest_angle = 0;
  std::vector<WorstCell> inverted;    ///< Jacobian ≤ 0 at a node, worst first
  std::vector<WorstCell> bad;         ///< Jacobian below `bad_jacobian`, worst first
};
inline constexpr double bad_jacobian = 0.1;

MeshQuality quality(const Mesh&);
/// Turns over cells that run clockwise as a whole (allowed in files), so that what stays inverted is.
void orient(Mesh&);

}  // namespace pintle
