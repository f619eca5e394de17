#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/mechanism_body.h"

namespace pintle {

/// What makes flexible bodies doubtful in the way joints hold them, in words: normal modes of a body that a
/// weld or guide clamps where its frame does not; `stiffening: rotation` of a body that is held elsewhere
/// than at its frame's tie.
std::vector<std::string> holding_warnings(const Scene&, const std::vector<std::optional<MechanismBody>>&);

}  // namespace pintle
