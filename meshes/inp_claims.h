#pragma once

#include <functional>
#include <string>
#include <vector>

#include "meshes/inp.h"
#include "meshes/inp_deck.h"

namespace pintle {

/// Element data that the mesh builder of a deck provides.
struct InpElements {
  std::function<std::vector<int>(const std::string& set)> of_set;  ///< indices into InpDeck::elements; empty if there is no such set
  std::function<bool(int element)> along_side;                     ///< a line is along a side of a plane element
};

/// Evaluates the cards that do not define the mesh: the data about the body, and the ignored ones.
/// @throws std::invalid_argument  a card that ties nodes or changes the body, plane strain mixed with plane stress, lines with a section
/// together with plane elements
InpClaims inp_claims(const InpDeck&, const InpElements&);

}  // namespace pintle
