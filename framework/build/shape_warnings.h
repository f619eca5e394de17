#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/attachments.h"
#include "framework/bodies/mechanism_body.h"
#include "framework/mechanism/model.h"

/// Where the shapes that were kept leave out what a mechanism asks of a body.
namespace pintle {

/// Share of the compliance that contacts and inertia meet below which shapes are doubted. Shapes that span a linear strain hold a
/// quarter or less of it less than they should: 75 % and more are left of a straight bar's.
inline constexpr double least_covered = 0.5;

/// Contacts on flexible bodies whose shapes hold less than `least_covered` of what the body yields to a blow there, where
/// that is not little beside the contact's own depth. In words.
/// @param bodies  one a body of the scene; of rigid ones none
/// @pre the system's contacts are complete
std::vector<std::string> contact_warnings(const Scene&, const System&, const BuiltOrder&,
                                          const std::vector<std::optional<MechanismBody>>& bodies);

/// Parts of the body that Craig–Bampton shapes leave stiff, in words; empty if there are none.
std::string stiff_parts_warning(const MechanismBody&);

/// Beams of which a section force is recorded while no shape stretches: N is rounding, and its part of the stress is lacking. Once a body.
std::vector<std::string> stress_warnings(const System&, const std::vector<RecordedStress>&,
                                         const std::vector<std::optional<MechanismBody>>& bodies);

}  // namespace pintle
