#pragma once

#include <string>
#include <vector>

#include "framework/integration/scheme.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Sets the times at which steps must end because of laws of drivers and loads: changes and pieces; and max_step, from the scene or where a
/// law is unknown, which may have no effect for long and then act, or changes its course too often to be listed.
/// @returns warnings of such laws
/// @throws SceneError  a law is not finite, a driver's law jumps, or its speed does
std::vector<std::string> follow_laws(const Scene&, Scheme&);

/// Describes a law that makes a run fail at t, where this was not visible before: it is not finite there, or grows much faster than before.
/// Empty: none.
std::string explain_laws(const Scene&, double t);

}  // namespace pintle
