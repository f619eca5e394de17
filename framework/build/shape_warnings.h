#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/attachments.h"
#include "framework/bodies/mechanism_body.h"
#include "framework/mechanism/model.h"

/// Warnings where the retained shapes lack a response that the mechanism needs from a body.
namespace pintle {

/// Share of the compliance to contacts and inertia below which shapes are doubted. Shapes that represent a linear strain lack at most a
/// quarter of the compliance: for a straight bar, 75 % or more is represented.
inline constexpr double least_covered = 0.5;

/// Contacts on flexible bodies whose shapes represent less than `least_covered` of the body's compliance to an impact there, where that
/// compliance is not small compared with the contact's own depth. In words.
/// @param bodies  one per body of the scene; empty for rigid ones
/// @pre the system's contacts are complete
std::vector<std::string> contact_warnings(const Scene&, const System&, const BuiltOrder&,
                                          const std::vector<std::optional<MechanismBody>>& bodies);

/// Parts of the body that Craig–Bampton shapes leave rigid, in words; empty if there are none.
std::string stiff_parts_warning(const MechanismBody&);

/// Beams with a recorded section force but no axial shape: N is rounding, and its part of the stress is missing. Those without a fibre.
/// Once per body.
std::vector<std::string> stress_warnings(const System&, const std::vector<RecordedStress>&,
                                         const std::vector<std::optional<MechanismBody>>& bodies);

}  // namespace pintle
