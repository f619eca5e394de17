#pragma once

#include <string>
#include <utility>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// The outline of a plane mesh, to be searched by its sides' ends.
class Rim {
 public:
  explicit Rim(const Mesh&);
  const std::vector<Cells>& cells() const { return cells_; }
  /// The side between two corners, counted through the blocks; −1: there is none on the outline.
  int find(int a, int b) const;
  /// Puts sides, by such numbers, into a group, and their nodes. Sides named twice count once.
  void add_to(Group&, std::vector<int> sides) const;

 private:
  std::vector<Cells> cells_;
  std::vector<std::pair<std::pair<int, int>, int>> sorted_;  // corners, the lower first; side
};

/// Makes groups of the closed loops of the outline that no group's side touches: "outline" for one
/// that goes round the body, "hole 1", "hole 2", … for the others, by their centres from left to
/// right, then from below. A name that is taken is passed over.
void name_loops(Mesh&, const Rim&);

/// Each once, ascending.
void sort_nodes(Group&);

}  // namespace pintle
