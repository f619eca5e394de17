#pragma once

#include "framework/dynamics/contact_pair.h"
#include "framework/scene/scene.h"

namespace pintle {

/// A clearance joint's gap and laws; its markers are left to fill in.
/// @throws SceneError  another kind of joint; radii, restitution, law or stiffness that cannot be
ContactPair contact_of(const Scene&, const SceneJoint&);

/// Contact stiffness as the scene's words give it [N/mⁿ].
double contact_stiffness(const SceneClearance&);

}  // namespace pintle
