#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// Checks that plane cells form one sheet: neighbours share a complete side with all its nodes, and no point is covered twice. Each entry
/// names cells, nodes and the position, and gives a remedy.
struct Soundness {
  std::vector<std::string> faults;       ///< not the intended body: duplicate cells, overlaps, nodes on a side that lacks them
  std::vector<std::string> warnings_of;  ///< possibly intended: slits, cells that share only a node
};
/// Lengths are relative to those of the sides concerned: a point nearer than 1e-6 of a side lies on it, one nearer than 1e-3 is suspicious.
/// Overlaps of a tenth of a cell or more are found. @pre cells are counter-clockwise and not inverted
Soundness soundness(const Mesh&);

/// Two coinciding nodes that belong to different pieces; `piece` is from `pieces`.
std::optional<std::pair<int, int>> unjoined(const Mesh&, const std::vector<int>& piece);

}  // namespace pintle
