#pragma once

#include <nlohmann/json_fwd.hpp>

#include "framework/analysis/simulate/simulate.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The entries with which every description of a run begins.
nlohmann::ordered_json run_head(const Scene&, const Run&);

}  // namespace pintle
