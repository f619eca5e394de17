#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/yaml/yaml_node.h"

/// The vocabulary of a scene file, in one table: the reader refuses what is not in it, and a test
/// holds docs/scene.schema.json against it.
namespace pintle {

namespace presence {
inline constexpr bool required = true, optional = false;
}

struct Key {
  std::string name;
  bool required = false;
  std::string example = {};               ///< shown when the key is missing: "0.3 kg"
  std::vector<std::string> choices = {};  ///< the words its value may be; empty: any value
};

/// The keys of one group. A path names them from the top; * stands for a name the user gives, or
/// for an entry of a list.
struct KeyTable {
  std::string path;  ///< "bodies.*.rigid"
  std::vector<Key> keys;
};

std::span<const KeyTable> key_tables();
/// The vocabulary of study files, paths beginning with "study": study_keys.cpp. Not part of the scene's schema.
std::span<const KeyTable> study_tables();

/// What words `path` allows for `key`. @pre both are in the table
std::span<const std::string> choices(std::string_view path, std::string_view key);

/// Judges the keys of a group: none unknown, none missing.
/// @throws SceneError  with the nearest known key, or an example of the missing one
void check_keys(const Node& group, std::string_view path);

/// Of several keys that say one thing, the one that is there. `what`: "its material".
/// @throws SceneError  none or several are there
std::string which_key(const Node& group, std::span<const std::string> keys, const std::string& what);

/// Of several keys that say what a thing is, the one that is there; and no key that belongs to the
/// others. `kinds` lists for each such key what may stand beside it.
struct KindKeys {
  std::string kind;
  std::vector<std::string> beside;
};
/// @throws SceneError  none or several are there, or a key beside it does not belong to it
std::size_t which_kind(const Node& group, std::span<const KindKeys> kinds);

}  // namespace pintle
