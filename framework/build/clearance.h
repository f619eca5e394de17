#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/dynamics/model/contact_pair.h"
#include "framework/dynamics/model/system.h"
#include "framework/scene/scene.h"

namespace pintle {

/// A clearance joint's gap, of a whole bearing, and laws; its markers and, of a massless link, its joint are left to fill in, of a spring and
/// damper what the scene does not give (complete_clearances).
/// @throws SceneError  another kind of joint; radii, restitution, law or stiffness that cannot be
ContactPair contact_of(const Scene&, const SceneJoint&);

/// The law that a scene names. @param stiffness  of a law of impact [N/mⁿ]   @param radii  of a law of cylinders, < 0 of a hole [m]
/// @throws SceneError  restitution, law, stiffness, length or table that cannot be
NormalLaw normal_law(const Scene&, const SceneNormal&, double stiffness, const std::array<double, 2>& radii);
/// It is one of cylinders, which asks for radii.
bool is_of_cylinders(const SceneNormal&);
/// The theory of the pressure under it; nothing where it is no law of cylinders. Parameters and errors as above.
std::optional<PressureTheory> pressure_of(const Scene&, const SceneNormal&, const std::array<double, 2>& radii);

/// @throws SceneError  restitution that cannot be
RigidImpact rigid_impact(const Scene&, const SceneImpact&, const Place&);
/// "impact, restitution 0.8 of speeds"
std::string impact_text(const RigidImpact&);
/// @throws SceneError  friction of rigid bodies that is not dry
void check_rigid_friction(const Scene&, const SceneFriction&);

/// The law that a scene names.
/// @throws SceneError  a law or a static coefficient that cannot be
FrictionLaw friction_law(const Scene&, const SceneFriction&);
/// It is more than none.
bool rubs(const SceneFriction&);
/// ", dry friction 0.2, static 0.3"
std::string friction_text(const ContactPair&);

/// Gives springs and dampers what the scene leaves to its contact law: docs/theory/contact.md.
/// @param system    all but numbered
/// @param warnings  gets what a model leaves out of the scene and a result would miss
/// @returns  how each clearance joint is modelled, in words
/// @throws AssemblyError  as assemble, where a spring and damper have to be found
std::vector<std::string> complete_clearances(const Scene&, System& system, std::vector<std::string>& warnings);

/// @throws SceneError  a start of a journal that is in no clearance joint, or deep in the wall
void validate_start_journals(const Scene&, const System&);

/// Contact stiffness as the scene's words give it [N/mⁿ].
double contact_stiffness(const SceneClearance&);

/// Where rounding of places in a mechanism of this length [m] is more than a millionth of a radial clearance: a
/// warning that says so; else empty.
/// @throws SceneError  it is more than a thousandth
std::string rounding_warning(const Scene&, const SceneJoint&, double length);

}  // namespace pintle
