#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "framework/common/text.h"
#include "framework/scene/yaml/placing.h"

/// Shared by the files that place the parts of an instance.
namespace pintle::placing_parts {

/// A changeable value with its reader.
struct Spot {
  Yaml& yaml;
  Node node;

  bool has(std::string_view key) const { return node.has(key); }
  Spot at(std::string_view key) const { return {*std::ranges::find(yaml.items, key, &Yaml::key), node.at(key)}; }
  std::vector<Spot> list(const char* remedy) const {
    std::vector<Spot> out;
    const std::vector<Node> nodes = node.list(0, remedy);
    for (std::size_t i = 0; i < nodes.size(); ++i) out.push_back({yaml.items[i], nodes[i]});
    return out;
  }
  std::vector<Spot> entries(const char* remedy) const {
    std::vector<Spot> out;
    const std::vector<Node> nodes = node.entries(remedy);
    for (std::size_t i = 0; i < nodes.size(); ++i) out.push_back({yaml.items[i], nodes[i]});
    return out;
  }
};

inline Yaml scalar_like(const Yaml& like, const std::string& key, const std::string& text) {
  return {Yaml::Kind::scalar, like.line, key, text, {}, like.file, like.scope};
}
inline Yaml number_like(const Yaml& like, const std::string& key, double value) {
  std::string text;
  append_number(text, value);
  return scalar_like(like, key, text);
}
inline Yaml pair_like(const Yaml& like, const std::string& key, const Pair& p) {
  Yaml out{Yaml::Kind::list, like.line, key, {}, {}, like.file, like.scope};
  out.items = {number_like(like, "", p[0]), number_like(like, "", p[1])};
  return out;
}
inline Yaml angle_like(const Yaml& like, const std::string& key, double value) {
  Yaml out = number_like(like, key, value);
  out.text += " rad";
  return out;
}
inline void set_angle(const Spot& spot, double value) { spot.yaml = angle_like(spot.yaml, spot.yaml.key, value); }
inline void set(const Spot& spot, double value) { spot.yaml = number_like(spot.yaml, spot.yaml.key, value); }
inline void set(const Spot& spot, const Pair& p) { spot.yaml = pair_like(spot.yaml, spot.yaml.key, p); }
inline void set_text(const Spot& spot, const std::string& text) { spot.yaml.text = text; }

inline void put(Yaml& map, Yaml entry) {
  const auto there = std::ranges::find(map.items, entry.key, &Yaml::key);
  if (there == map.items.end())
    map.items.push_back(std::move(entry));
  else
    *there = std::move(entry);
}

[[noreturn]] inline void cannot_mirror(const Node& node, const std::string& remedy) { node.fail("cannot be mirrored; " + remedy); }

inline void negate(const Spot& owner, std::string_view key, const Dimension& of) {
  if (!owner.has(key)) return;
  const double opposite = -owner.at(key).node.quantity(of);
  of.angle == 1 && of.time == 0 ? set_angle(owner.at(key), opposite) : set(owner.at(key), opposite);
}

/// Reverses the sign of a law of time or a table.
inline void negate_law(const Spot& law, const char* unit) {
  if (!law.node.is_map()) return set_text(law, "-(" + law.node.text("a law of time") + ")");
  const std::string of = law.has("value unit") ? law.at("value unit").node.text("a unit") : unit;
  put(law.yaml, scalar_like(law.yaml, "value unit", "-1*(" + of + ")"));
}

/// Places a joint, a force or a driver of a rotated or mirrored instance.
void place_joint(const Spot&, const Placing&);
void place_force(const Spot&, const Placing&);
void mirror_driver(const Spot&);

}  // namespace pintle::placing_parts
