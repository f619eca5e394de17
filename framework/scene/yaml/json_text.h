#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace pintle {

struct Scene;

/// JSON as text. Bytes that are not UTF-8 (in paths, in names in meshes) become U+FFFD.
/// @param indent  of each level; -1: on one line
std::string json_text(const nlohmann::ordered_json&, int indent = 2);
std::string json_text(const nlohmann::json&, int indent = 2);
/// The object as text with "scene" as its last entry: the scene with all defaults filled in, null if it was made in C++. The scene is
/// inserted as text because an ordered object compares each new key with all others, which is slow for many bodies.
std::string text_with_scene(const nlohmann::ordered_json& object, const Scene&);

}  // namespace pintle
