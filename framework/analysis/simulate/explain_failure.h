#pragma once

#include <string>

#include "framework/integration/integrator.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// What an integrator failed with, and why where cams, laws, the pose or its numbers show it: what a law has done comes first.
/// @param otherwise  to add where none of them does; may be empty
std::string explained_failure(const Scene&, const Model&, const State& start, Integrator&, const std::string& otherwise = {});

}  // namespace pintle
