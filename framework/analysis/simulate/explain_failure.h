#pragma once

#include <string>

#include "framework/integration/integrator.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Describes a failure of an integrator and, if they show it, its cause: first cams and laws, then the configuration, then very large or
/// unequal numbers.
/// @param otherwise  added if none of them is the cause; may be empty
std::string explained_failure(const Scene&, const Model&, const State& start, Integrator&, const std::string& otherwise = {});

}  // namespace pintle
