#pragma once

#include <array>
#include <string>
#include <vector>

#include "contact/profile.h"
#include "framework/build/markers.h"
#include "framework/dynamics/model/contact_pair.h"
#include "framework/scene/scene.h"

/// Contacts between profiles of bodies: docs/theory/contact.md.
namespace pintle {

/// The surface that a scene gives a body, in the axes of its carrier: the body's at the point that carries it.
/// @param ref  its point is the profile   @throws SceneError  a path that cannot be
Profile profile_of(const Scene&, const Markers&, const PointRef& ref);

/// A contact of two profiles.
struct BuiltContact {
  std::vector<ContactPair> pairs;  ///< of pieces that may touch
  std::string words;               ///< "stiffness 1e9 N/m^1.5, restitution delivered 0.8, no friction; 8 pairs of pieces"
  std::string warning;             ///< what makes it doubtful; empty: nothing
};
/// The laws of a contact, in a pair of which pieces and markers are left to fill in.
/// @throws SceneError  laws that cannot be; elasticity where a profile has no one radius
ContactPair laws_of(const Scene&, const SceneContact&, const Profile& a, const Profile& b);
/// "stiffness 1e9 N/m^1.5, restitution delivered 0.8, no friction"
std::string laws_text(const ContactPair&);

/// @param markers  that carry the two profiles   @param first  index that its first pair will have in System::contacts
/// @throws SceneError  laws that cannot be; elasticity where a profile has no one radius; bodies that a weld holds together; no two
/// pieces that could touch
BuiltContact build_contact(const Scene&, const SceneContact&, const Profile& a, const Profile& b, const std::array<int, 2>& markers,
                           int first);

/// The same of pieces that all have the laws and markers of one pair. @param c  gives names and place alone
/// @throws SceneError  no two pieces that could touch
BuiltContact build_pairs(const Scene&, const SceneContact& c, const Profile& a, const Profile& b, const ContactPair& like, int first);

/// Of rigid contacts: what rounding leaves of a gap that is closed, and of a corner at the end of what it stands on, as where boxes are
/// stacked flush; it stays there. Once the mechanism's length is known.
void allow_rounding(System&);

}  // namespace pintle
