#pragma once

#include "framework/build/contacts.h"
#include "framework/dynamics/model/joints.h"

namespace pintle {

/// The two flanks of a gear or rack with backlash, not yet complete.
/// @param ideal  the joint without backlash   @throws SceneError  invalid laws or backlash
BuiltContact build_flanks(const Scene&, const SceneJoint&, const Joint& ideal);

/// Pitch along the pitch circles, of complete flanks; 0: the scene gives no `teeth` [m].
double pitch_of(const SceneJoint&, const Flank&);

/// Sets in the flanks what the start has determined for the ideal joint.
/// @param first  index of the first of the two in the system
/// @throws SceneError  backlash as wide as a tooth and its gap
void complete_flanks(const Scene&, const SceneJoint&, const Joint& ideal, std::size_t first, System&);

}  // namespace pintle
