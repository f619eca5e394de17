#pragma once

#include "framework/scene/scene.h"

/// Scenes for questions that do not need all that a run needs.
namespace pintle {

/// For statics: a rigid body without inertia gets one, and without mass too where there is no gravity; neither
/// changes where a mechanism rests. Where gravity acts a body without mass stays so, and `build` refuses it.
Scene ready_for_statics(Scene);

/// For kinematics: rigid bodies without mass or inertia get some, which changes nothing of a motion that drivers
/// impose, and bodies with modes stay rigid.
Scene ready_for_kinematics(Scene);

}  // namespace pintle
