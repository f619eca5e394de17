#include "framework/component/fe/from_mesh.h"

#include "meshes/reject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pintle {

namespace {

template <class E>
AnyBlock block(const Cells& cells, int first_cell, const PlaneProperties& p) {
  Block<E> made{{E{p}}, cells.nodes, std::vector<int>(cells.size())};
  for (std::size_t i = 0; i < cells.size(); ++i) made.cells[i] = first_cell + static_cast<int>(i);
  return made;
}

struct Kind {
  std::string name;
  CellShape shape;
  AnyBlock (*make)(const Cells&, int, const PlaneProperties&);
};
// The first kind of a shape is its default.
const std::array<Kind, 7> kinds{{
    {"triangle3", CellShape::triangle3, block<Triangle3>},
    {"triangle6", CellShape::triangle6, block<Triangle6>},
    {"quadrilateral4", CellShape::quadrilateral4, block<Quadrilateral4>},
    {"quadrilateral4-plain", CellShape::quadrilateral4, block<Quadrilateral4Plain>},
    {"quadrilateral8", CellShape::quadrilateral8, block<Quadrilateral8>},
    {"quadrilateral8-reduced", CellShape::quadrilateral8, block<Quadrilateral8Reduced>},
    {"quadrilateral9", CellShape::quadrilateral9, block<Quadrilateral9>},
}};

bool may_stand_among(CellShape shape, CellShape named) {
  switch (named) {
    case CellShape::quadrilateral4: return shape == CellShape::triangle3;
    case CellShape::quadrilateral8:
    case CellShape::quadrilateral9: return shape == CellShape::triangle6;
    default: return false;
  }
}

// ∫ N_i ds of a side's nodes: their share of a unit traction along x.
Eigen::VectorXd shares(const Eigen::Matrix2Xd& x) {
  const Eigen::VectorXd load = side_load(x, {1, 0}, 1);
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(load.data(), x.cols());
}

}  // namespace

const std::vector<std::string>& element_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kinds) all.push_back(kind.name);
    return all;
  }();
  return names;
}

std::vector<AnyBlock> plane_blocks(const Mesh& mesh, const PlaneProperties& p, std::string_view element) {
  if (!(p.density > 0)) reject("density ", p.density, " kg/m³, must be > 0");
  if (!(p.thickness > 0)) reject("thickness ", p.thickness, " m, must be > 0");
  const auto by_name = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == element; });
  const Kind* named = by_name == kinds.end() ? nullptr : &*by_name;
  if (!element.empty() && !named) {
    std::string known;
    for (const Kind& kind : kinds) known += (known.empty() ? "" : ", ") + kind.name;
    reject("element \"", element, "\" is unknown; the elements are ", known);
  }
  std::vector<AnyBlock> blocks;
  int first_cell = 0;
  bool used = false;
  for (const Cells& cells : mesh.cells) {
    if (cells.size() == 0) continue;
    const auto by_shape = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.shape == cells.shape; });
    if (by_shape == kinds.end()) reject("the mesh has ", name_of(cells.shape), " cells; a plane body needs plane ones");
    const bool is_named = named && named->shape == cells.shape;
    if (named && !is_named && !may_stand_among(cells.shape, named->shape))
      reject("element \"", element, "\": the mesh has ", name_of(cells.shape), " cells; mesh with ", name_of(named->shape),
             " cells or name no element");
    used = used || is_named;
    blocks.push_back((is_named ? *named : *by_shape).make(cells, first_cell, p));
    first_cell += static_cast<int>(cells.size());
  }
  if (blocks.empty()) reject("the mesh is empty; a body needs at least one cell");
  if (named && !used) reject("element \"", element, "\": the mesh has no ", name_of(named->shape), " cell");
  return blocks;
}

std::vector<double> rim_weights(const Mesh& mesh, const Group& rim) {
  if (rim.sides.empty())
    reject("group \"", rim.name, "\" has no sides; a rim is an edge of the body, not ", rim.nodes.size(), " loose nodes");
  std::vector<double> weights(rim.nodes.size(), 0);
  for (const Cells& cells : rim.sides) {
    const auto nodes = static_cast<std::size_t>(nodes_of(cells.shape));
    Eigen::Matrix2Xd x(2, static_cast<Eigen::Index>(nodes));
    for (std::size_t first = 0; first + nodes <= cells.nodes.size(); first += nodes) {
      for (std::size_t k = 0; k < nodes; ++k) x.col(static_cast<Eigen::Index>(k)) = mesh.x.col(cells.nodes[first + k]);
      const Eigen::VectorXd share = shares(x);
      for (std::size_t k = 0; k < nodes; ++k) {
        const auto at = std::lower_bound(rim.nodes.begin(), rim.nodes.end(), cells.nodes[first + k]);
        if (at != rim.nodes.end() && *at == cells.nodes[first + k])
          weights[static_cast<std::size_t>(at - rim.nodes.begin())] += share[static_cast<Eigen::Index>(k)];
      }
    }
  }
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!(weights[i] > 0)) reject("group \"", rim.name, "\": node ", rim.nodes[i], " is on none of its sides; leave it out of the group");
  return weights;
}

}  // namespace pintle
