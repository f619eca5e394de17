#pragma once

#include <array>

#include "contact/profile.h"
#include "framework/dynamics/model/joints.h"
#include "framework/scene/scene.h"

namespace pintle {

/// A joint with play as two profiles in the axes of its points, a's first: the guide and the block in it, the slot and its pin,
/// the circles between which the end of a rod is, and that end.
/// @throws SceneError  lengths that cannot be
std::array<Profile, 2> profiles_of(const Scene&, const SceneJoint&);

/// The contact that these two make.
SceneContact contact_with_play(const SceneJoint&);

/// An open bearing in the axes of its point, its journal first. @pre is_open
/// @throws SceneError  an arc, a wall or edges that cannot be
std::array<Profile, 2> open_bearing(const Scene&, const SceneJoint&);

}  // namespace pintle
