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

/// The surface of a body in a scene, in the axes of its carrier: those of the body at the carrying point.
/// @param ref  its point is the profile   @throws SceneError  an invalid path
Profile profile_of(const Scene&, const Markers&, const PointRef& ref);

/// A contact of two profiles.
struct BuiltContact {
  std::vector<ContactPair> pairs;          ///< of pieces that may touch
  std::string words;                       ///< "stiffness 1e9 N/m^1.5, restitution delivered 0.8, no friction; 8 pairs of pieces"
  std::vector<std::string> warnings = {};  ///< why it is doubtful
};
/// The laws of a contact, as a pair without pieces and markers.
/// @throws SceneError  invalid laws; elasticity where a profile has no single radius
ContactPair laws_of(const Scene&, const SceneContact&, const Profile& a, const Profile& b);
/// "stiffness 1e9 N/m^1.5, restitution delivered 0.8, no friction"
std::string laws_text(const ContactPair&);

/// @param markers  that carry the two profiles   @param first  index of its first pair in System::contacts
/// @throws SceneError  invalid laws; elasticity where a profile has no single radius; bodies joined by a weld; no two pieces that could
/// touch
BuiltContact build_contact(const Scene&, const SceneContact&, const Profile& a, const Profile& b, const std::array<int, 2>& markers,
                           int first);

/// The same for pieces that all have the laws and markers of one pair. @param c  only for names and place
/// @throws SceneError  no two pieces that could touch
BuiltContact build_pairs(const Scene&, const SceneContact& c, const Profile& a, const Profile& b, const ContactPair& like, int first);

/// For rigid contacts: allows for rounding of a closed gap, and of a corner that stays at the end of its support, as when boxes are stacked
/// flush. Called once the mechanism's length is known.
void allow_rounding(System&);

}  // namespace pintle
