#pragma once

#include <nlohmann/json.hpp>

#include "framework/scene/scene.h"

namespace pintle {

/// The scene as it was filled in; null if it was made in C++.
inline nlohmann::ordered_json scene_json(const Scene& scene) {
  if (scene.filled_in.empty()) return nullptr;
  return nlohmann::ordered_json::parse(scene.filled_in, nullptr, false);
}

}  // namespace pintle
