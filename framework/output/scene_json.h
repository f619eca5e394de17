#pragma once

#include <nlohmann/json.hpp>

#include "framework/analysis/simulate/simulate.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The scene as it was filled in; null if it was made in C++.
inline nlohmann::ordered_json scene_json(const Scene& scene) {
  if (scene.filled_in.empty()) return nullptr;
  return nlohmann::ordered_json::parse(scene.filled_in, nullptr, false);
}

/// What every description of a run begins with.
nlohmann::ordered_json run_head(const Scene&, const Run&);

}  // namespace pintle
