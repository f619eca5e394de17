#pragma once

#include "framework/scene/scene.h"

namespace pintle {

/// Bodies of elements that the scene lets be rigid (no `modes`) get their mass, inertia, centre and the places of
/// their holes from their mesh; what else makes them elastic stays for the commands on one body.
/// @throws SceneError  a body asks for modes: mechanisms of flexible bodies do not run yet
void fill_rigid_bodies(Scene&);

}  // namespace pintle
