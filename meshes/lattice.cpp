#include "meshes/lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pintle {

namespace {

/// The lattice refined by middle lines: 2 nx by 2 ny cells, or nx by ny for straight cells.
struct Grid {
  int nx, ny;     // cells
  int per_field;  // lines per cell
  bool closed;
  int columns() const { return per_field * nx + (closed ? 0 : 1); }
  int rows() const { return per_field * ny + 1; }
  int node(int i, int j) const { return j * columns() + (closed ? i % columns() : i); }
};

double line(const std::vector<double>& values, int index, int per_field) {
  const std::size_t k = static_cast<std::size_t>(index / per_field);
  return index % per_field == 0 ? values[k] : (values[k] + values[k + 1]) / 2;
}

void add_field(const Grid& g, Mesh& mesh, int i, int j, Cells& cells) {
  const int p = g.per_field, h = p / 2;
  i *= p, j *= p;
  const int c[] = {g.node(i, j), g.node(i + p, j), g.node(i + p, j + p), g.node(i, j + p)};
  const auto add = [&](std::initializer_list<int> nodes) {
    cells.nodes.insert(cells.nodes.end(), nodes);
    cells.numbers.push_back(static_cast<long>(cells.size()) + 1);
  };
  if (h == 0 && corners_of(cells.shape) == 4) return add({c[0], c[1], c[2], c[3]});
  const bool falls = (mesh.x.col(c[1]) - mesh.x.col(c[3])).norm() < (1 - 1e-9) * (mesh.x.col(c[0]) - mesh.x.col(c[2])).norm();
  if (h == 0) {
    add({c[0], c[1], falls ? c[3] : c[2]});
    return add({c[2], c[3], falls ? c[1] : c[0]});
  }
  const int m[] = {g.node(i + h, j), g.node(i + p, j + h), g.node(i + h, j + p), g.node(i, j + h)};
  const int centre = g.node(i + h, j + h);
  if (cells.shape == CellShape::quadrilateral8) return add({c[0], c[1], c[2], c[3], m[0], m[1], m[2], m[3]});
  if (cells.shape == CellShape::quadrilateral9) return add({c[0], c[1], c[2], c[3], m[0], m[1], m[2], m[3], centre});
  const int a = falls ? 1 : 0;
  mesh.x.col(centre) = (mesh.x.col(c[a]) + mesh.x.col(c[a + 2])) / 2;  // the dividing line is straight
  if (falls) {
    add({c[0], c[1], c[3], m[0], centre, m[3]});
    return add({c[2], c[3], c[1], m[2], centre, m[1]});
  }
  add({c[0], c[1], c[2], m[0], m[1], centre});
  return add({c[2], c[3], c[0], m[2], m[3], centre});
}

void add_groups(const Grid& g, const std::array<std::string, 4>& names, Mesh& mesh) {
  const int last_column = g.per_field * g.nx, last_row = g.rows() - 1;
  for (std::size_t s = 0; s < 4; ++s) {
    if (names[s].empty()) continue;
    Group group{names[s], {}, {}};
    const int n = s % 2 == 0 ? last_column : last_row;
    for (int k = 0; k <= n; ++k)
      group.nodes.push_back(s == 0 ? g.node(k, 0) : s == 1 ? g.node(last_column, k) : s == 2 ? g.node(k, last_row) : g.node(0, k));
    std::sort(group.nodes.begin(), group.nodes.end());
    group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
    group.sides = sides_within(mesh, group.nodes);
    mesh.groups.push_back(std::move(group));
  }
}

}  // namespace

Mesh lattice_mesh(const Lattice& lattice, CellShape shape) {
  const int nx = static_cast<int>(lattice.u.size()) - 1, ny = static_cast<int>(lattice.v.size()) - 1;
  const Grid g{nx, ny, nodes_of(shape) > corners_of(shape) ? 2 : 1, lattice.closed};
  Mesh mesh;
  mesh.x.resize(2, g.columns() * g.rows());
  for (int j = 0; j < g.rows(); ++j)
    for (int i = 0; i < g.columns(); ++i)
      mesh.x.col(g.node(i, j)) = lattice.at(line(lattice.u, i, g.per_field), line(lattice.v, j, g.per_field));
  mesh.node_numbers.resize(static_cast<std::size_t>(mesh.x.cols()));
  std::iota(mesh.node_numbers.begin(), mesh.node_numbers.end(), 1L);
  Cells cells{shape, {}, {}};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) add_field(g, mesh, i, j, cells);
  mesh.cells.push_back(std::move(cells));
  add_groups(g, lattice.sides, mesh);
  if (shape == CellShape::quadrilateral8) drop_unused_nodes(mesh);
  return mesh;
}

std::vector<double> breaks(double first, double last, std::vector<double> through, double step) {
  through.insert(through.end(), {first, last});
  std::sort(through.begin(), through.end());
  std::vector<double> out{first};
  for (const double value : through) {
    const double from = out.back(), gap = value - from;
    if (gap <= 1e-9 * (last - first)) continue;
    const int n = std::max(1, static_cast<int>(std::ceil(gap / step - 1e-9)));
    for (int k = 1; k < n; ++k) out.push_back(from + gap * k / n);
    out.push_back(value);
  }
  out.back() = last;
  return out;
}

}  // namespace pintle
