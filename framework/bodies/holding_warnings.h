#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/mechanism_body.h"

namespace pintle {

/// Warnings about how joints hold flexible bodies, in words: normal modes of a body that a weld or guide clamps where its frame is not
/// clamped; `stiffening: rotation` of a body that is held at other points than its reference conditions.
std::vector<std::string> holding_warnings(const Scene&, const std::vector<std::optional<MechanismBody>>&);

}  // namespace pintle
