#pragma once

#include <functional>
#include <string>
#include <vector>

#include "meshes/inp.h"
#include "meshes/inp_deck.h"

namespace pintle {

/// What the Builder of a deck's mesh knows of its elements.
struct InpElements {
  std::function<std::vector<int>(const std::string& set)> of_set;  ///< places in InpDeck::elements; empty if there is no such set
  std::function<bool(int element)> along_side;                     ///< a line lies along a side of a plane element
};

/// Goes through the cards that are no mesh: what they say of the body, what is passed over.
/// @throws std::invalid_argument  a card that ties nodes or makes another body, plane strain mixed with plane stress, lines with a section
///     beside plane elements
InpClaims inp_claims(const InpDeck&, const InpElements&);

}  // namespace pintle
