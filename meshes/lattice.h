#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// Lines u = const and v = const drawn in the plane.
struct Lattice {
  std::vector<double> u, v;                           ///< ascending, two or more each
  std::function<Eigen::Vector2d(double, double)> at;  ///< keeps the sense of rotation
  bool closed = false;                                ///< the last u is the first again
  std::array<std::string, 4> sides;                   ///< groups along v low, u high, v high, u low; empty: none
};

/// The lattice's fields as cells of `shape` (triangles: halves, cut along the shorter diagonal).
/// Nodes in the middle of sides and cells are drawn from the middle values of u and v, so they
/// follow its curves.
Mesh lattice_mesh(const Lattice&, CellShape shape);

/// Values from `first` to `last` that contain `through`, between them as evenly spaced as may be
/// and not farther apart than `step`. Values of `through` closer than 1e-9 (last − first) are one.
std::vector<double> breaks(double first, double last, std::vector<double> through, double step);

}  // namespace pintle
