#pragma once

#include <string>

#include "framework/integration/integrator.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Why an integrator could not go on, where laws of time, the pose or its numbers show it; else empty.
std::string explain_failure(const Scene&, const System&, Integrator&);

}  // namespace pintle
