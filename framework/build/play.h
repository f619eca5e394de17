#pragma once

#include <array>

#include "contact/profile.h"
#include "framework/dynamics/model/joints.h"
#include "framework/scene/scene.h"

namespace pintle {

/// A joint with clearance as two profiles in the axes of its points, a's first: the guide and its block, the slot and its pin, or the
/// circles between which the end of a rod moves, and that end.
/// @throws SceneError  invalid lengths
std::array<Profile, 2> profiles_of(const Scene&, const SceneJoint&);

/// The contact between these two.
SceneContact contact_with_play(const SceneJoint&);

/// An open bearing in the axes of its point, its journal first. @pre is_open
/// @throws SceneError  invalid arc, wall or edges
std::array<Profile, 2> open_bearing(const Scene&, const SceneJoint&);

}  // namespace pintle
