#pragma once

#include "framework/build/contacts.h"
#include "framework/dynamics/model/joints.h"

namespace pintle {

/// The two flanks of a gear or rack with backlash, not yet complete.
/// @param ideal  the joint that it would be without   @throws SceneError  laws or a backlash that cannot be
BuiltContact build_flanks(const Scene&, const SceneJoint&, const Joint& ideal);

/// From tooth to tooth along the pitch circles, of flanks that are complete; 0: the scene says no `teeth` [m].
double pitch_of(const SceneJoint&, const Flank&);

/// Gives flanks what the start has made of the ideal joint.
/// @param first  the first of the two in the system
/// @throws SceneError  backlash as wide as a tooth and its gap
void complete_flanks(const Scene&, const SceneJoint&, const Joint& ideal, std::size_t first, System&);

}  // namespace pintle
