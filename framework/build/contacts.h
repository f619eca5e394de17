#pragma once

#include <string>
#include <vector>

#include "contact/profile.h"
#include "framework/dynamics/model/contact_pair.h"
#include "framework/scene/scene.h"

/// Contacts between profiles of bodies: docs/theory/contact.md.
namespace pintle {

/// The surface that a scene gives a body, in the body's axes. @param ref  its point is the profile
/// @throws SceneError  a path that cannot be
Profile profile_of(const Scene&, const PointRef& ref);

/// A contact's laws; its markers and pieces are left to fill in.
/// @throws SceneError  laws that cannot be; elasticity where the profiles have no one radius
ContactPair contact_of(const Scene&, const SceneContact&);

/// The pairs of pieces by which two profiles may touch, each as `like`; what lies beyond their ends by number among them.
/// @throws SceneError  there is none
std::vector<ContactPair> pairs_between(const Scene&, const SceneContact&, const Profile& a, const Profile& b, const ContactPair& like);

/// It has corners without an arc, beside the ends of an open path.
bool has_sharp_corners(const Profile&);

/// "stiffness 1e9 N/m^1.5, restitution delivered 0.8, no friction; 8 pairs of pieces"
std::string contact_text(const ContactPair&, std::size_t pairs);

}  // namespace pintle
