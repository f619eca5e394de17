#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// Shapes of cells. Nodes: corners counter-clockwise, then middles of the sides 12, 23, …, then the centre; for a line its ends, then its
/// middle. This is the order of VTK and Gmsh.
enum class CellShape { line2, line3, triangle3, triangle6, quadrilateral4, quadrilateral8, quadrilateral9 };
int nodes_of(CellShape);    ///< 2, 3, 3, 6, 4, 8, 9
int corners_of(CellShape);  ///< 2, 2, 3, 3, 4, 4, 4
const char* name_of(CellShape);

/// Cells of one shape.
struct Cells {
  CellShape shape;
  std::vector<int> nodes;     ///< nodes_of(shape) per cell, columns of Mesh::x
  std::vector<long> numbers;  ///< numbers of the cells in the file or from the mesher, for messages
  std::size_t size() const { return numbers.size(); }
};

/// A named part: a point, an edge or hole, a region, or a set of nodes.
struct Group {
  std::string name;
  std::vector<int> nodes;    ///< ascending, each once
  std::vector<Cells> sides;  ///< line cells along it, with the body to their left; empty for points and regions
};

/// Nodes and cells of one body in its own axes. Every node belongs to a cell.
struct Mesh {
  Eigen::Matrix2Xd x;              ///< [m]
  std::vector<long> node_numbers;  ///< numbers in the file, for messages
  std::vector<Cells> cells;        ///< all lines or all plane
  std::vector<Group> groups;
  bool plane() const;                               ///< cells are triangles and quadrilaterals, not lines
  const Group* group(std::string_view name) const;  ///< nullptr: there is none
  std::size_t cell_count() const;
};

/// Sides of plane cells that belong to a single cell, with the body to their left.
std::vector<Cells> outline(const Mesh&);
/// Those sides of the outline with all nodes in `nodes` (ascending).
std::vector<Cells> sides_within(const Mesh&, const std::vector<int>& nodes);
/// The nearest node within `reach` of a point, or −1.
int nearest_node(const Mesh&, const Eigen::Vector2d& at, double reach);
/// Number of unconnected pieces; pieces[i] is that of node i, from 0.
int pieces(const Mesh&, std::vector<int>& piece_of_node);
/// Removes nodes that no cell uses and renumbers the rest.
void drop_unused_nodes(Mesh&);

}  // namespace pintle
