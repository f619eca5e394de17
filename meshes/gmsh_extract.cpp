#include "meshes/gmsh_extract.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "meshes/gmsh_figure.h"
#include "meshes/quality.h"
#include "meshes/reject.h"
#include "meshes/rim.h"

namespace pintle {

namespace {

using std::size_t;
using Tags = std::vector<int>;
namespace model = gmsh::model;

std::optional<CellShape> shape_of(int gmsh_type) {
  switch (gmsh_type) {
    case 1: return CellShape::line2;
    case 8: return CellShape::line3;
    case 2: return CellShape::triangle3;
    case 9: return CellShape::triangle6;
    case 3: return CellShape::quadrilateral4;
    case 16: return CellShape::quadrilateral8;
    case 10: return CellShape::quadrilateral9;
    default: return std::nullopt;
  }
}

/// Extracts the mesh of the current model.
struct Extract {
  const std::string& name;
  Mesh mesh{};
  std::vector<size_t> sorted{};  // Gmsh's numbers, by column

  int column(size_t number) const {  // −1: none
    if (sorted.empty() || number < sorted.front() || number > sorted.back()) return -1;
    const size_t guess = number - sorted.front();  // the numbers usually have no gaps
    if (guess < sorted.size() && sorted[guess] == number) return static_cast<int>(guess);
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), number);
    return *at == number ? static_cast<int>(at - sorted.begin()) : -1;
  }

  void nodes(double scale) {
    std::vector<size_t> numbers;
    std::vector<double> x, u;
    model::mesh::getNodes(numbers, x, u, -1, -1, false, false);
    if (numbers.empty()) return;
    std::vector<size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return numbers[a] < numbers[b]; });
    mesh.x.resize(2, static_cast<Eigen::Index>(numbers.size()));
    for (size_t i = 0; i < order.size(); ++i) {
      const double* p = &x[3 * order[i]];
      if (std::abs(p[2]) > 1e-6 * std::max(1e-3, std::hypot(p[0], p[1])))
        reject(name, ": node ", numbers[order[i]], " is at z = ", p[2], "; the mesh of a body must lie in the plane z = 0");
      mesh.x.col(static_cast<Eigen::Index>(i)) << scale * p[0], scale * p[1];
      sorted.push_back(numbers[order[i]]);
      mesh.node_numbers.push_back(static_cast<long>(numbers[order[i]]));
    }
  }

  // Cells of one entity, shape by shape.
  std::vector<Cells> cells(int dim, int tag) const {
    std::vector<int> types;
    std::vector<std::vector<size_t>> numbers, nodes;
    model::mesh::getElements(types, numbers, nodes, dim, tag);
    std::vector<Cells> out;
    for (size_t k = 0; k < types.size(); ++k) {
      const auto shape = shape_of(types[k]);
      if (!shape)
        reject(name, ": cell ", numbers[k].at(0), " is of Gmsh's type ", types[k],
               "; lines, triangles and quadrilaterals of first and second order can be used: mesh "
               "with order 1 or 2");
      Cells block{*shape, {}, {}};
      for (const size_t n : numbers[k]) block.numbers.push_back(static_cast<long>(n));
      for (const size_t n : nodes[k]) {
        if (column(n) < 0) reject(name, ": a cell names node ", n, ", which does not exist");
        block.nodes.push_back(column(n));
      }
      out.push_back(std::move(block));
    }
    return out;
  }

  void add_cells(int dim, const Tags& entities) {
    for (const int tag : entities)
      for (Cells& block : cells(dim, tag)) {
        const auto same = std::find_if(mesh.cells.begin(), mesh.cells.end(), [&](const Cells& c) { return c.shape == block.shape; });
        if (same == mesh.cells.end()) {
          mesh.cells.push_back(std::move(block));
          continue;
        }
        same->nodes.insert(same->nodes.end(), block.nodes.begin(), block.nodes.end());
        same->numbers.insert(same->numbers.end(), block.numbers.begin(), block.numbers.end());
      }
  }

  void add_groups() {
    const Rim rim(mesh);
    gmsh::vectorpair physical;
    model::getPhysicalGroups(physical);
    for (const auto& [dim, tag] : physical) {
      std::string label;
      model::getPhysicalName(dim, tag, label);
      if (label.empty()) label = std::to_string(tag);
      auto group = std::find_if(mesh.groups.begin(), mesh.groups.end(), [&](const Group& g) { return g.name == label; });
      if (group == mesh.groups.end()) group = mesh.groups.insert(group, Group{label, {}, {}});
      std::vector<size_t> numbers;
      std::vector<double> x;
      model::mesh::getNodesForPhysicalGroup(dim, tag, numbers, x);
      for (const size_t n : numbers)
        if (column(n) >= 0) group->nodes.push_back(column(n));
      std::vector<int> sides, entities;
      if (dim == 1) model::getEntitiesForPhysicalGroup(dim, tag, entities);
      for (const int entity : entities)
        for (const Cells& lines : cells(1, entity))
          for (size_t i = 0; i < lines.nodes.size(); i += static_cast<size_t>(nodes_of(lines.shape)))
            if (const int side = rim.find(lines.nodes[i], lines.nodes[i + 1]); side >= 0) sides.push_back(side);
      rim.add_to(*group, std::move(sides));
    }
    name_loops(mesh, rim);
  }
};

}  // namespace

Mesh gmsh_extract(const std::string& name, double scale) {
  Extract out{name};
  out.nodes(scale);
  out.add_cells(2, gmsh_body(2));
  if (out.mesh.cell_count() == 0) out.add_cells(1, gmsh_body(1));
  orient(out.mesh);
  out.add_groups();
  drop_unused_nodes(out.mesh);
  std::erase_if(out.mesh.groups, [](const Group& g) { return g.nodes.empty(); });
  return std::move(out.mesh);
}

}  // namespace pintle
