#pragma once

#include <nlohmann/json.hpp>

#include "framework/analysis/simulate/simulate.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The beginning of every description of a run.
nlohmann::ordered_json run_head(const Scene&, const Run&);

}  // namespace pintle
