#pragma once

#include <vector>

#include "framework/build/markers.h"
#include "framework/dynamics/model/forces.h"
#include "framework/dynamics/model/joints.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Joined by wheels, a curve or a linear relation: what complete_couplings derives from the start.
bool is_coupling(const SceneJoint&);

/// The joint of a coupling, not yet complete.
/// @throws SceneError  sizes or ratios that cannot be; points that are not there or have no direction
Joint coupling_of(const Scene&, const SceneJoint&, Markers&);

/// The spans of an elastic belt in order, not yet complete.
/// @throws SceneError  likewise
std::vector<BeltSpan> spans_of(const Scene&, const SceneLoad&, const SceneBelt&, Markers&);

/// Completes what follows from where the mechanism is at the start, assembled without it: the phases of couplings, radii from teeth,
/// the side on which a wheel runs, belts' tensions, and lengths and laws that add to `present`. Costs nothing where there are none.
/// @throws SceneError  wheels whose centres are not as far apart as their radii ask   @throws AssemblyError  as assemble
void complete_couplings(const Scene&, Model&);

}  // namespace pintle
