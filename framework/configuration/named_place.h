#pragma once

#include <string>

#include "framework/scene/scene.h"

namespace pintle {

/// Where the scene has a joint, driver, body's start or contact of that name; where it was not read from a file, the name itself.
Place named_place(const Scene&, const std::string& name);

}  // namespace pintle
