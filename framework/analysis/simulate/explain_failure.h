#pragma once

#include <string>

#include "framework/integration/integrator.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Describes a failure of an integrator, and its cause where cams, laws, the configuration or its numbers show it; the effects of laws come
/// first.
/// @param otherwise  added where none of them is the cause; may be empty
std::string explained_failure(const Scene&, const Model&, const State& start, Integrator&, const std::string& otherwise = {});

}  // namespace pintle
