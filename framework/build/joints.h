#pragma once

#include "framework/build/markers.h"
#include "framework/dynamics/model/joint_friction.h"
#include "framework/dynamics/model/joints.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The joint that a scene names, ideal, between markers of its points; its angles include the whole turns in the rough poses.
/// @throws SceneError  points that do not exist or have no direction; an invalid length or ratio
Joint joint_of(const Scene&, const SceneJoint&, Markers&);

/// @param joint  its index in System::joints
/// @throws SceneError  a law that is a curve of the speed; a joint that does not allow friction; an invalid radius or preload
JointFriction friction_of(const Scene&, const SceneJoint&, int joint);

}  // namespace pintle
