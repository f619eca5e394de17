#pragma once

#include <vector>

#include "framework/build/markers.h"
#include "framework/dynamics/model/forces.h"
#include "framework/dynamics/model/joints.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Whether wheels, a curve or a linear relation join the bodies: complete_couplings computes missing data from the start.
bool is_coupling(const SceneJoint&);

/// The joint of a coupling, not yet complete.
/// @throws SceneError  invalid sizes or ratios; points that do not exist or have no direction
Joint coupling_of(const Scene&, const SceneJoint&, Markers&);

/// The spans of an elastic belt in order, not yet complete.
/// @throws SceneError  likewise
std::vector<BeltSpan> spans_of(const Scene&, const SceneLoad&, const SceneBelt&, Markers&);

/// Computes what depends on the start configuration, which is assembled without it: the phases of couplings, radii from teeth, the side on
/// which a wheel runs, belt tensions, and lengths and laws relative to `present`. Costs nothing where there are none.
/// @throws SceneError  wheels whose centre distance does not match their radii   @throws AssemblyError  as assemble
void complete_couplings(const Scene&, Model&);

}  // namespace pintle
