#pragma once

#include <nlohmann/json.hpp>

#include "framework/analysis/simulate/simulate.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The scene with all defaults filled in; null if it was made in C++.
inline nlohmann::ordered_json scene_json(const Scene& scene) {
  if (scene.filled_in.empty()) return nullptr;
  return nlohmann::ordered_json::parse(scene.filled_in, nullptr, false);
}

/// The beginning of every description of a run.
nlohmann::ordered_json run_head(const Scene&, const Run&);

}  // namespace pintle
