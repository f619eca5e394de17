#pragma once

#include <string>

#include "framework/scene/scene.h"

namespace pintle {

/// Where a scene says what it says of a joint, driver, body at the start, or contact; the thing itself where no file was read.
Place named_place(const Scene&, const std::string& name);

}  // namespace pintle
