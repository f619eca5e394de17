#include "meshes/generate.h"

#include <array>
#include <numeric>

#include "meshes/lattice.h"
#include "meshes/reject.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

}  // namespace

Mesh line_mesh(std::span<const Vector2d> corners, std::span<const int> cells) {
  const std::size_t parts = corners.empty() ? 0 : corners.size() - 1;
  if (parts < 1) reject("line mesh: ", corners.size(), " corner(s); an axis needs two or more");
  if (cells.size() != 1 && cells.size() != parts)
    reject("line mesh: ", cells.size(), " numbers of cells for ", parts, " pieces; give one for all or one a piece");
  std::vector<Vector2d> x{corners[0]};
  for (std::size_t p = 0; p < parts; ++p) {
    const Vector2d &a = corners[p], &b = corners[p + 1];
    const int n = cells[cells.size() == 1 ? 0 : p];
    if (n < 1) reject("line mesh: ", n, " cells on piece ", p + 1, "; a piece needs one or more");
    if (!a.allFinite() || !b.allFinite()) reject("line mesh: a corner of piece ", p + 1, " is not finite");
    if (a == b)
      reject("line mesh: corners ", p + 1, " and ", p + 2, " are both at (", a.x(), ", ", a.y(),
             ") m; a piece needs a length: leave one out");
    for (int k = 1; k < n; ++k) x.push_back(a + (b - a) * (static_cast<double>(k) / n));
    x.push_back(b);
  }
  Mesh mesh;
  mesh.x.resize(2, static_cast<Eigen::Index>(x.size()));
  mesh.node_numbers.resize(x.size());
  std::iota(mesh.node_numbers.begin(), mesh.node_numbers.end(), 1L);
  Cells lines{CellShape::line2, {}, {}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    mesh.x.col(static_cast<Eigen::Index>(i)) = x[i];
    if (i == 0) continue;
    lines.nodes.insert(lines.nodes.end(), {static_cast<int>(i) - 1, static_cast<int>(i)});
    lines.numbers.push_back(static_cast<long>(i));
  }
  mesh.cells.push_back(std::move(lines));
  return mesh;
}

Mesh grid_mesh(std::span<const Vector2d, 4> corners, int nx, int ny, CellShape shape) {
  if (nx < 1 || ny < 1) reject("grid mesh: ", nx, " by ", ny, " cells; there must be one or more each way");
  if (corners_of(shape) == 2) reject("grid mesh: cells of shape ", name_of(shape), "; a grid is made of triangles or quadrilaterals");
  const std::array<Vector2d, 4> c{corners[0], corners[1], corners[2], corners[3]};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d a = c[(i + 1) % 4] - c[i], b = c[(i + 2) % 4] - c[(i + 1) % 4];
    if (!(a.x() * b.y() - a.y() * b.x() > 1e-12 * a.norm() * b.norm()))
      reject("grid mesh: no left turn at corner ", (i + 1) % 4 + 1, ", (", c[(i + 1) % 4].x(), ", ", c[(i + 1) % 4].y(),
             ") m; the four corners must go counter-clockwise round a convex shape");
  }
  const auto even = [](int n) {
    std::vector<double> values(static_cast<std::size_t>(n) + 1);
    for (int k = 0; k <= n; ++k) values[static_cast<std::size_t>(k)] = static_cast<double>(k) / n;
    return values;
  };
  const auto at = [c](double u, double v) -> Vector2d { return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]); };
  return lattice_mesh({even(nx), even(ny), at, false, {"bottom", "right", "top", "left"}}, shape);
}

}  // namespace pintle
