#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/yaml/yaml_node.h"

/// The vocabulary of a scene file, in one table: the reader rejects any other key, and a test compares docs/scene.schema.json with it.
namespace pintle {

namespace presence {
inline constexpr bool required = true, optional = false;
}

struct Key {
  std::string name;
  bool required = false;
  std::string example = {};               ///< shown if the key is missing: "0.3 kg"
  std::vector<std::string> choices = {};  ///< the allowed words; empty: any value
};

/// The keys of one group. The path starts at the top; * stands for a user-defined name, or for an entry of a list.
struct KeyTable {
  std::string path;  ///< "bodies.*.rigid"
  std::vector<Key> keys;
};

std::span<const KeyTable> key_tables();
/// The vocabulary of study files, paths beginning with "study": study_keys.cpp. Not part of the scene's schema.
std::span<const KeyTable> study_tables();

/// The words allowed at `path` for `key`. @pre both are in the table
std::span<const std::string> choices(std::string_view path, std::string_view key);

/// Checks the keys of a group: none unknown, none missing.
/// @throws SceneError  with the nearest known key, or an example of the missing one
void check_keys(const Node& group, std::string_view path);

/// Of several alternative keys, the one present. `what`: "its material".
/// @throws SceneError  none or several are present
std::string which_key(const Node& group, std::span<const std::string> keys, const std::string& what);

/// Of several keys that define the kind of an element, the one present; keys that belong to other kinds are not allowed. `kinds` lists the
/// keys allowed with each.
struct KindKeys {
  std::string kind;
  std::vector<std::string> beside;
};
/// @throws SceneError  none or several are present, or a key does not belong to the kind
std::size_t which_kind(const Node& group, std::span<const KindKeys> kinds);

}  // namespace pintle
