#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace pintle {

/// JSON as text. Bytes that are not UTF-8 (in paths, in names in meshes) become U+FFFD.
/// @param indent  of each level; -1: on one line
std::string json_text(const nlohmann::ordered_json&, int indent = 2);
std::string json_text(const nlohmann::json&, int indent = 2);

}  // namespace pintle
