#pragma once

#include <cstddef>
#include <vector>

#include "meshes/mesh.h"

/// What tests of meshes ask of a run of sides.
namespace pintle {

/// ∮ x dy along sides: the area on their left, by Simpson's rule: exact for straight and for
/// parabolic sides.
inline double area_left_of(const Mesh& mesh, const std::vector<Cells>& sides) {
  double sum = 0;
  for (const Cells& c : sides)
    for (std::size_t s = 0; s < c.size(); ++s) {
      const std::size_t n = static_cast<std::size_t>(nodes_of(c.shape));
      const Eigen::Vector2d a = mesh.x.col(c.nodes[s * n]), b = mesh.x.col(c.nodes[s * n + 1]);
      const Eigen::Vector2d m = n == 3 ? Eigen::Vector2d(mesh.x.col(c.nodes[s * n + 2])) : Eigen::Vector2d((a + b) / 2);
      const auto rate = [&](double t) -> Eigen::Vector2d { return (4 * t - 3) * a + (4 * t - 1) * b + (4 - 8 * t) * m; };
      sum += (a.x() * rate(0).y() + 4 * m.x() * rate(0.5).y() + b.x() * rate(1).y()) / 6;
    }
  return sum;
}

inline std::size_t count(const std::vector<Cells>& blocks) {
  std::size_t n = 0;
  for (const Cells& c : blocks) n += c.size();
  return n;
}

}  // namespace pintle
