#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshes/inp_text.h"
#include "meshes/mesh.h"

namespace pintle {

/// The shape given by an element's name.
struct InpKind {
  CellShape shape;
  bool shell = false;   ///< S1 and S2 are its faces; its sides have other labels
  bool strain = false;  ///< plane strain
};
/// @param reason  why it is not supported: the meaning of the name, and the remedy
std::optional<InpKind> inp_kind(const std::string& type, std::string& reason);

/// An input file in parsed form: references are not resolved, but every card and field is well formed.
struct InpDeck {
  struct Element {
    InpKind kind;
    std::size_t first;  ///< index into element_nodes
    InpPlace place;
  };
  struct Item {  ///< of a set: a number, a range, or the name of another set
    long number = 0;
    std::string name;
    InpPlace place;
    long last = 0, step = 0;  ///< for GENERATE, whose range may have gaps; step 0: not a range
    std::string label;        ///< for a surface: the side
  };
  enum class SetKind { node, element, surface };
  struct Set {
    std::string name;  ///< as first written
    SetKind kind;
    std::vector<Item> items;
    InpPlace place;
  };
  /// A card other than nodes, elements and sets, with its data.
  struct Other {
    InpCard card;
    std::size_t first, last;  ///< lines of `text`
  };
  InpText text;
  std::vector<Other> others;
  std::vector<long> node_numbers, element_numbers, element_nodes;
  std::vector<double> x, y;
  std::vector<InpPlace> node_places;
  std::vector<Element> elements;
  std::vector<Set> sets;
};
/// @throws as read_inp
InpDeck read_inp_deck(const std::filesystem::path&, const std::filesystem::path& folder);

}  // namespace pintle
