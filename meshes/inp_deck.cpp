#include "meshes/inp_deck.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace pintle {

namespace {

// Cards that generate or move nodes: without them the mesh would not be the intended one.
constexpr std::array generators{"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};

struct Parser {
  InpDeck& queue;
  const std::vector<InpText::Line>& lines;
  std::size_t at = 0;
  std::map<std::pair<std::string, InpDeck::SetKind>, std::size_t> index;
  InpPlace part;  // of the part or instance seen
  bool has_part = false, has_instance = false;

  bool data() const { return at < lines.size() && !lines[at].text.starts_with('*'); }

  InpDeck::Set& set(const std::string& name, InpDeck::SetKind kind, InpPlace place) {
    if (name.empty()) queue.text.reject(place, "a set without a name; give it one");
    const auto [found, is_new] = index.try_emplace({upper(name), kind}, queue.sets.size());
    if (is_new) queue.sets.push_back({name, kind, {}, place});
    return queue.sets[found->second];
  }

  const std::string& required(const InpCard& card, const char* name) {
    const std::string* value = card.find(name);
    if (!value || value->empty()) queue.text.reject(card.place, "*", card.keyword, " without ", name, "=; add it");
    return *value;
  }

  long whole(std::string_view field, InpPlace place, const char* what) {
    long value = 0;
    if (!to_number(field, value) || value < 1) queue.text.reject(place, "\"", field, "\" is no ", what, "; write a whole number from 1");
    return value;
  }

  void nodes(const InpCard& card) {
    for (const char* unread : {"INPUT", "SYSTEM"})
      if (const std::string* value = card.find(unread); value && *value != "R")
        queue.text.reject(card.place, "*NODE with ", unread, "=", *value, " is not read; write the nodes here, in rectangular coordinates");
    const std::string* name = card.find("NSET");
    for (; data(); ++at) {
      const auto& [text, place] = lines[at];
      std::string_view rest = text, field;
      next_field(rest, field);
      const long number = whole(field, place, "node number");
      std::array<double, 3> x{};
      for (double& value : x) {
        if (!next_field(rest, field)) break;
        if (!field.empty() && (!to_number(field, value) || !std::isfinite(value)))
          queue.text.reject(place, "node ", number, ": \"", field, "\" is no coordinate");
      }
      if (std::abs(x[2]) > 1e-6 * std::max({1e-6, std::abs(x[0]), std::abs(x[1])}))
        queue.text.reject(place, "node ", number, " is at z = ", x[2], "; the mesh must lie in the plane z = 0");
      queue.node_numbers.push_back(number);
      queue.node_places.push_back(place);
      queue.x.push_back(x[0]), queue.y.push_back(x[1]);
      if (name) set(*name, InpDeck::SetKind::node, card.place).items.push_back({number, {}, place, 0, 0, {}});
    }
  }

  void elements(const InpCard& card) {
    const std::string type = upper(required(card, "TYPE"));
    std::string reason;
    const std::optional<InpKind> kind = inp_kind(type, reason);
    if (!kind) queue.text.reject(card.place, "element type ", type, " ", reason);
    const int n = nodes_of(kind->shape);
    const std::string* name = card.find("ELSET");
    while (data()) {
      const InpPlace place = lines[at].place;
      std::string_view rest = lines[at].text, field;
      next_field(rest, field);
      const long number = whole(field, place, "element number");
      const std::size_t first = queue.element_nodes.size();
      for (int k = 0; k < n;) {
        if (next_field(rest, field)) {
          queue.element_nodes.push_back(whole(field, lines[at].place, "node number"));
          ++k;
        } else if (++at; !data()) {
          queue.text.reject(place, "element ", number, " of type ", type, " has ", k, " nodes, must have ", n);
        } else {
          rest = lines[at].text;
        }
      }
      if (next_field(rest, field)) queue.text.reject(place, "element ", number, " of type ", type, " has more than its ", n, " nodes");
      ++at;
      queue.element_numbers.push_back(number);
      queue.elements.push_back({*kind, first, place});
      if (name) set(*name, InpDeck::SetKind::element, card.place).items.push_back({number, {}, place, 0, 0, {}});
    }
  }

  void generate(InpDeck::Set& s) {
    const auto& [text, place] = lines[at];
    std::string_view rest = text, field;
    std::array<long, 3> range{0, 0, 1};
    std::size_t k = 0;
    for (; k < 3 && next_field(rest, field); ++k) range[k] = whole(field, place, "number");
    if (k < 2 || range[1] < range[0]) queue.text.reject(place, "GENERATE needs first, last and step, with last not less than first");
    s.items.push_back({range[0], {}, place, range[1], range[2], {}});
  }

  void set_card(const InpCard& card, InpDeck::SetKind kind) {
    const bool node = kind == InpDeck::SetKind::node;
    InpDeck::Set& s = set(required(card, node ? "NSET" : "ELSET"), kind, card.place);
    if (const std::string* of = node ? card.find("ELSET") : nullptr) s.items.push_back({0, *of, card.place, 0, 0, "ELSET"});
    for (; data(); ++at) {
      if (card.find("GENERATE")) {
        generate(s);
        continue;
      }
      std::string_view rest = lines[at].text, field;
      while (next_field(rest, field)) {
        if (field.empty()) continue;
        InpDeck::Item item{0, {}, lines[at].place, 0, 0, {}};
        if (!to_number(field, item.number)) item.name = field;
        s.items.push_back(std::move(item));
      }
    }
  }

  void surface(const InpCard& card) {
    const std::string* type = card.find("TYPE");
    const std::string kind = type ? upper(*type) : "ELEMENT";
    if (kind != "ELEMENT" && kind != "NODE") {  // cutting and analytical surfaces are not part of the mesh
      while (data()) ++at;
      return;
    }
    const std::string& name = required(card, "NAME");
    InpDeck::Set& s = set(name, kind == "NODE" ? InpDeck::SetKind::node : InpDeck::SetKind::surface, card.place);
    for (; data(); ++at) {
      std::string_view rest = lines[at].text, field;
      next_field(rest, field);
      InpDeck::Item item{0, {}, lines[at].place, 0, 0, {}};
      if (!to_number(field, item.number)) item.name = field;
      if (kind == "ELEMENT" && next_field(rest, field)) item.label = upper(field);
      s.items.push_back(std::move(item));
    }
  }

  void other(const InpCard& card) {
    const std::size_t first = at;
    while (data()) ++at;
    queue.others.push_back({card, first, at});
  }

  // Accepts only a single part that is not moved or rotated.
  void part_card(const InpCard& card, bool& seen) {
    if (seen)
      queue.text.reject(card.place, "a second *", card.keyword, " after that of line ", part.line,
                        "; a body is one part: write each to a separate file");
    seen = true, part = card.place;
    if (card.keyword == "INSTANCE" && data())
      queue.text.reject(lines[at].place,
                        "this *INSTANCE is moved or turned, but the axes of a body are those of its part: remove the line and place the "
                        "body in the scene");
  }

  void run() {
    while (at < lines.size()) {
      const InpPlace place = lines[at].place;
      if (data()) {  // belongs to an ignored card
        ++at;
        continue;
      }
      std::string joined(lines[at].text);
      for (++at; joined.ends_with(',') && data(); ++at) joined += lines[at].text;
      const InpCard card = inp_card(joined, place);
      const std::string& key = card.keyword;
      if (std::find(generators.begin(), generators.end(), key) != generators.end())
        queue.text.reject(place, "*", key, " is not read; write nodes and elements out");
      if (key == "NODE")
        nodes(card);
      else if (key == "ELEMENT")
        elements(card);
      else if (key == "NSET")
        set_card(card, InpDeck::SetKind::node);
      else if (key == "ELSET")
        set_card(card, InpDeck::SetKind::element);
      else if (key == "SURFACE")
        surface(card);
      else if (key == "PART")
        part_card(card, has_part);
      else if (key == "INSTANCE")
        part_card(card, has_instance);
      else
        other(card);
    }
  }
};

std::optional<CellShape> plane_shape(int nodes) {
  switch (nodes) {
    case 3: return CellShape::triangle3;
    case 4: return CellShape::quadrilateral4;
    case 6: return CellShape::triangle6;
    case 8: return CellShape::quadrilateral8;
    case 9: return CellShape::quadrilateral9;
    default: return std::nullopt;
  }
}

int digit(const std::string& text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) ? text[at] - '0' : -1;
}

}  // namespace

std::optional<InpKind> inp_kind(const std::string& type, std::string& reason) {
  const auto starts = [&](std::string_view head) { return type.starts_with(head); };
  if (starts("STRI")) return InpKind{type == "STRI65" ? CellShape::triangle6 : CellShape::triangle3, true};
  for (const char* head : {"CPS", "CPE", "C2D", "M3D"})
    if (starts(head))
      if (const auto shape = plane_shape(digit(type, 3))) return InpKind{*shape, false, starts("CPE")};
  if (starts("S"))
    if (const auto shape = plane_shape(digit(type, 1))) return InpKind{*shape, true};
  if ((starts("T2D") || starts("T3D")) && (digit(type, 3) == 2 || digit(type, 3) == 3))
    return InpKind{digit(type, 3) == 2 ? CellShape::line2 : CellShape::line3, false};
  if (starts("B") && (digit(type, 1) == 2 || digit(type, 1) == 3) && digit(type, 2) >= 1 && digit(type, 2) <= 3)
    return InpKind{digit(type, 2) == 2 ? CellShape::line3 : CellShape::line2, false};
  if (starts("CAX") || starts("SAX") || starts("MAX") || starts("CGAX"))
    reason = "is axisymmetric: a ring, not a plane body; mesh it with CPS or CPE elements";
  else if (starts("CPEG"))
    reason = "is for generalised plane strain, which has a degree of freedom out of the plane; use CPE";
  else if (starts("C3D") || starts("SC") || starts("CCL"))
    reason = "is solid; a body here is plane: mesh its mid-plane with CPS, CPE or S elements";
  else
    reason =
        "is not known; plane bodies are made of CPS3, CPS4, CPS6, CPS8, CPE…, S…, M3D…, beams of "
        "B21, B31, B32, T2D2 …; define masses, springs and couplings in the scene";
  return std::nullopt;
}

InpDeck read_inp_deck(const std::filesystem::path& path, const std::filesystem::path& folder) {
  InpDeck queue;
  queue.text = read_inp_text(path, folder);
  Parser{queue, queue.text.lines, 0, {}, {}}.run();
  return queue;
}

}  // namespace pintle
