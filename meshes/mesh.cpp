#include "meshes/mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace pintle {

namespace {

struct ShapeFacts {
  int nodes, corners;
  const char* name;
};
constexpr std::array<ShapeFacts, 7> facts{{{2, 2, "line2"},
                                           {3, 2, "line3"},
                                           {3, 3, "triangle3"},
                                           {6, 3, "triangle6"},
                                           {4, 4, "quadrilateral4"},
                                           {8, 4, "quadrilateral8"},
                                           {9, 4, "quadrilateral9"}}};
const ShapeFacts& facts_of(CellShape shape) { return facts[static_cast<std::size_t>(shape)]; }

bool is_line(CellShape shape) { return corners_of(shape) == 2; }

/// A side by its corners, in the direction of its cell, and its origin.
struct Side {
  int a, b;
  std::size_t block, cell;
  int side;
};

// All sides of plane cells, those with the same lower corner adjacent.
std::vector<Side> sides_by_lower_corner(const Mesh& mesh, std::vector<std::size_t>& begin) {
  const auto for_each = [&](auto&& f) {
    for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
      const Cells& cells = mesh.cells[k];
      const std::size_t n = static_cast<std::size_t>(nodes_of(cells.shape));
      const int corners = corners_of(cells.shape);
      if (is_line(cells.shape)) continue;
      for (std::size_t c = 0; c < cells.size(); ++c)
        for (int s = 0; s < corners; ++s) {
          const int* node = &cells.nodes[c * n];
          f(Side{node[s], node[(s + 1) % corners], k, c, s});
        }
    }
  };
  begin.assign(static_cast<std::size_t>(mesh.x.cols()) + 1, 0);
  for_each([&](const Side& s) { ++begin[static_cast<std::size_t>(std::min(s.a, s.b)) + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Side> sides(begin.back());
  std::vector<std::size_t> at(begin.begin(), begin.end() - 1);
  for_each([&](const Side& s) { sides[at[static_cast<std::size_t>(std::min(s.a, s.b))]++] = s; });
  return sides;
}

std::vector<Cells> as_cells(const Mesh& mesh, const std::vector<Side>& sides) {
  Cells straight{CellShape::line2, {}, {}}, curved{CellShape::line3, {}, {}};
  for (const Side& s : sides) {
    const Cells& from = mesh.cells[s.block];
    const int n = nodes_of(from.shape), corners = corners_of(from.shape);
    Cells& to = n == corners ? straight : curved;
    to.nodes.insert(to.nodes.end(), {s.a, s.b});
    if (n != corners) to.nodes.push_back(from.nodes[s.cell * static_cast<std::size_t>(n) + static_cast<std::size_t>(corners + s.side)]);
    to.numbers.push_back(from.numbers[s.cell]);
  }
  std::vector<Cells> out;
  if (straight.size() > 0) out.push_back(std::move(straight));
  if (curved.size() > 0) out.push_back(std::move(curved));
  return out;
}

}  // namespace

int nodes_of(CellShape shape) { return facts_of(shape).nodes; }
int corners_of(CellShape shape) { return facts_of(shape).corners; }
const char* name_of(CellShape shape) { return facts_of(shape).name; }

bool Mesh::plane() const {
  return std::any_of(cells.begin(), cells.end(), [](const Cells& c) { return !is_line(c.shape); });
}

const Group* Mesh::group(std::string_view name) const {
  const auto at = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == name; });
  return at == groups.end() ? nullptr : &*at;
}

std::size_t Mesh::cell_count() const {
  std::size_t n = 0;
  for (const Cells& c : cells) n += c.size();
  return n;
}

std::vector<Cells> outline(const Mesh& mesh) {
  std::vector<std::size_t> begin;
  const std::vector<Side> sides = sides_by_lower_corner(mesh, begin);
  std::vector<Side> lone;
  for (std::size_t node = 0; node + 1 < begin.size(); ++node)
    for (std::size_t i = begin[node]; i < begin[node + 1]; ++i) {
      const auto same = [&](const Side& other) { return std::max(other.a, other.b) == std::max(sides[i].a, sides[i].b); };
      if (std::count_if(sides.begin() + static_cast<std::ptrdiff_t>(begin[node]),
                        sides.begin() + static_cast<std::ptrdiff_t>(begin[node + 1]), same) == 1)
        lone.push_back(sides[i]);
    }
  std::sort(lone.begin(), lone.end(),
            [](const Side& p, const Side& q) { return std::tie(p.block, p.cell, p.side) < std::tie(q.block, q.cell, q.side); });
  return as_cells(mesh, lone);
}

std::vector<Cells> sides_within(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<char> in(static_cast<std::size_t>(mesh.x.cols()), 0);
  for (const int node : nodes) in[static_cast<std::size_t>(node)] = 1;
  std::vector<Cells> all = outline(mesh);
  for (Cells& cells : all) {
    const std::size_t n = static_cast<std::size_t>(nodes_of(cells.shape));
    std::size_t kept = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto from = cells.nodes.begin() + static_cast<std::ptrdiff_t>(c * n);
      if (!std::all_of(from, from + static_cast<std::ptrdiff_t>(n), [&](int node) { return in[static_cast<std::size_t>(node)] != 0; }))
        continue;
      std::copy_n(from, n, cells.nodes.begin() + static_cast<std::ptrdiff_t>(kept * n));
      cells.numbers[kept++] = cells.numbers[c];
    }
    cells.nodes.resize(kept * n);
    cells.numbers.resize(kept);
  }
  std::erase_if(all, [](const Cells& c) { return c.size() == 0; });
  return all;
}

int nearest_node(const Mesh& mesh, const Eigen::Vector2d& at, double reach) {
  if (mesh.x.cols() == 0) return -1;
  Eigen::Index node = 0;
  const double least = (mesh.x.colwise() - at).colwise().squaredNorm().minCoeff(&node);
  return least <= reach * reach ? static_cast<int>(node) : -1;
}

int pieces(const Mesh& mesh, std::vector<int>& piece_of_node) {
  std::vector<int> parent(static_cast<std::size_t>(mesh.x.cols()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int node) {
    std::size_t i = static_cast<std::size_t>(node);
    while (parent[i] != static_cast<int>(i)) {
      parent[i] = parent[static_cast<std::size_t>(parent[i])];
      i = static_cast<std::size_t>(parent[i]);
    }
    return static_cast<int>(i);
  };
  for (const Cells& cells : mesh.cells) {
    const std::size_t n = static_cast<std::size_t>(nodes_of(cells.shape));
    for (std::size_t i = 0; i < cells.nodes.size(); ++i) {
      const int a = root(cells.nodes[i - i % n]), b = root(cells.nodes[i]);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  piece_of_node.assign(parent.size(), 0);
  int count = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    const int r = root(static_cast<int>(i));
    piece_of_node[i] = r == static_cast<int>(i) ? count++ : piece_of_node[static_cast<std::size_t>(r)];
  }
  return count;
}

void drop_unused_nodes(Mesh& mesh) {
  std::vector<int> to(static_cast<std::size_t>(mesh.x.cols()), -1);
  for (const Cells& cells : mesh.cells)
    for (const int node : cells.nodes) to[static_cast<std::size_t>(node)] = 0;
  int kept = 0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (to[i] < 0) continue;
    mesh.x.col(kept) = mesh.x.col(static_cast<Eigen::Index>(i)).eval();
    mesh.node_numbers[static_cast<std::size_t>(kept)] = mesh.node_numbers[i];
    to[i] = kept++;
  }
  mesh.x.conservativeResize(2, kept);
  mesh.node_numbers.resize(static_cast<std::size_t>(kept));
  const auto renumber = [&](std::vector<int>& nodes) {
    for (int& node : nodes) node = to[static_cast<std::size_t>(node)];
  };
  for (Cells& cells : mesh.cells) renumber(cells.nodes);
  for (Group& group : mesh.groups) {
    renumber(group.nodes);
    std::erase(group.nodes, -1);
    for (Cells& cells : group.sides) renumber(cells.nodes);
  }
}

}  // namespace pintle
