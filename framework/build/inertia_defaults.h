#pragma once

#include <optional>

#include "framework/scene/scene.h"

/// Scenes for analyses that need less data than a run.
namespace pintle {

/// For statics: a rigid body without inertia gets a default one, and also a default mass where there is no gravity; neither changes where a
/// mechanism rests. With gravity, a body without mass is unchanged, and `build` rejects it.
Scene ready_for_statics(Scene);

/// For kinematics: rigid bodies without mass or inertia get defaults, which do not change a motion imposed by drivers, and bodies with
/// modes stay rigid.
Scene ready_for_kinematics(Scene);

/// If bodies lack mass or inertia, so that forces cannot be computed: the scene ready for kinematics, with a warning. Otherwise nothing.
std::optional<Scene> for_kinematics_alone(const Scene&);

}  // namespace pintle
