#pragma once

#include "framework/integration/integrator.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Fills the times that steps owe to the laws of drivers and loads: changes and pieces; and max_step, as the scene says, or where
/// nothing is known of a law, which may do nothing for long and then act.
/// @throws SceneError  a driver's law jumps, or its speed does
void follow_laws(const Scene&, Scheme&);

}  // namespace pintle
