#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// Lines u = const and v = const in the plane.
struct Lattice {
  std::vector<double> u, v;                           ///< ascending, two or more each
  std::function<Eigen::Vector2d(double, double)> at;  ///< preserves orientation
  bool closed = false;                                ///< the last u coincides with the first
  std::array<std::string, 4> sides;                   ///< groups along low v, high u, high v, low u; empty: none
};

/// The lattice's fields as cells of `shape` (triangles: halves, divided along the shorter diagonal). Middle nodes of sides and cells are at
/// the middle values of u and v, so they follow its curves.
Mesh lattice_mesh(const Lattice&, CellShape shape);

/// Values from `first` to `last` that include `through`, otherwise as evenly spaced as possible and not farther apart than `step`. Values
/// of `through` closer than 1e-9 (last − first) count as one.
std::vector<double> breaks(double first, double last, std::vector<double> through, double step);

}  // namespace pintle
