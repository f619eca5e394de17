#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/mechanism_body.h"
#include "framework/dynamics/model/contact_pair.h"
#include "framework/dynamics/model/system.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Gap and laws of a clearance joint with a complete bearing. Still to be added: its markers; for a massless link its joint; for a spring
/// and damper, values that the scene does not give (complete_clearances).
/// @throws SceneError  another kind of joint; invalid radii, restitution, law or stiffness
ContactPair contact_of(const Scene&, const SceneJoint&);

/// The residual flexibility of its bodies with a massless boundary; nothing without. @param a, b  nullptr: not made of elements
/// @throws SceneError  its friction or its damping does not allow for a massless boundary
std::optional<ResidualFlexibility> residual_flexibility(const Scene&, const SceneJoint&, const MechanismBody* a, const MechanismBody* b);

/// The law that a scene names. @param stiffness  of an impact law [N/mⁿ]   @param radii  of a law of cylinders, negative for a hole [m]
/// @throws SceneError  invalid restitution, law, stiffness, length or table
NormalLaw normal_law(const Scene&, const SceneNormal&, double stiffness, const std::array<double, 2>& radii);
/// Whether it is a law of cylinders, which needs radii.
bool is_of_cylinders(const SceneNormal&);
/// The theory of its contact pressure; nothing where it is not a law of cylinders. Parameters and errors as above.
std::optional<PressureTheory> pressure_of(const Scene&, const SceneNormal&, const std::array<double, 2>& radii);

/// @throws SceneError  invalid restitution
RigidImpact rigid_impact(const Scene&, const SceneImpact&, const Place&);
/// "impact, restitution 0.8 of speeds"
std::string impact_text(const RigidImpact&);
/// @throws SceneError  friction of rigid bodies that is not dry
void check_rigid_friction(const Scene&, const SceneFriction&);

/// The law that a scene names.
/// @throws SceneError  an invalid law or static coefficient
FrictionLaw friction_law(const Scene&, const SceneFriction&);
/// Whether there is friction.
bool rubs(const SceneFriction&);
/// ", dry friction 0.2, static 0.3"
std::string friction_text(const ContactPair&);

/// Completes springs and dampers from their contact law: docs/theory/contact.md.
/// @param system    complete except for its numbering
/// @param warnings  receives a warning where friction is ignored, with a massless link
/// @returns  how each clearance joint is modelled, in words
/// @throws AssemblyError  as assemble, where a spring and damper must be computed
std::vector<std::string> complete_clearances(const Scene&, System& system, std::vector<std::string>& warnings);

/// @throws SceneError  a start of a journal that is not in a clearance joint, or is deep in the wall
void validate_start_journals(const Scene&, const System&);

/// Contact stiffness as given in the scene [N/mⁿ].
double contact_stiffness(const SceneClearance&);

/// A warning where the rounding of positions in a mechanism of this length [m] exceeds a millionth of a radial clearance; otherwise empty.
/// @throws SceneError  it exceeds a thousandth
std::string rounding_warning(const Scene&, const SceneJoint&, double length);

}  // namespace pintle
