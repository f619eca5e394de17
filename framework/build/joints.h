#pragma once

#include "framework/build/markers.h"
#include "framework/dynamics/model/joint_friction.h"
#include "framework/dynamics/model/joints.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The joint that a scene names, ideal, between markers of its points; its angles with the whole turns that rough poses show.
/// @throws SceneError  points that are not there or have no direction; a length or ratio that cannot be
Joint joint_of(const Scene&, const SceneJoint&, Markers&);

/// @param joint  its index in System::joints
/// @throws SceneError  a law that is a curve of the speed; a joint that takes no friction; a radius or preload that cannot be
JointFriction friction_of(const Scene&, const SceneJoint&, int joint);

}  // namespace pintle
