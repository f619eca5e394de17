#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// Whether plane cells make one sheet: neighbours share a whole side with all its nodes, and no place is covered twice.
/// Each entry names cells, nodes and the place, and says what to do.
struct Soundness {
  std::vector<std::string> faults;       ///< another body than meant: cells twice, overlaps, nodes on a side that it lacks
  std::vector<std::string> warnings_of;  ///< may be meant: slits, cells that meet at one node alone
};
/// Lengths are compared with those of the sides at hand: what is nearer than 1e-6 of a side lies on it, what is nearer than 1e-3 of it
/// is doubted. Overlaps are found where a tenth of a cell or more lies under another. @pre cells run counter-clockwise and are not inverted
Soundness soundness(const Mesh&);

/// Two nodes at one place that belong to different pieces; `piece` as `pieces` gives it.
std::optional<std::pair<int, int>> unjoined(const Mesh&, const std::vector<int>& piece);

}  // namespace pintle
