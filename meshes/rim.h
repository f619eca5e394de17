#pragma once

#include <string>
#include <utility>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// The outline of a plane mesh, searchable by the ends of its sides.
class Rim {
 public:
  explicit Rim(const Mesh&);
  const std::vector<Cells>& cells() const { return cells_; }
  /// The index, over all blocks, of the side between two corners; −1: it is not on the outline.
  int find(int a, int b) const;
  /// Adds sides, by these indices, to a group, with their nodes. Sides listed twice count once.
  void add_to(Group&, std::vector<int> sides) const;

 private:
  std::vector<Cells> cells_;
  std::vector<std::pair<std::pair<int, int>, int>> sorted_;  // corners, the lower first; side
};

/// Makes groups of the closed loops of the outline that no group's side touches: "outline" for one around the body, "hole 1", "hole 2", …
/// for the others, ordered by their centres from left to right, then from below. Names already in use are skipped.
void name_loops(Mesh&, const Rim&);

/// Each once, ascending.
void sort_nodes(Group&);

}  // namespace pintle
