#pragma once

#include <string>

#include "framework/scene/scene.h"

namespace pintle {

/// The place in a scene that defines a joint, driver, body at the start, or contact; the element itself where no file was read.
Place named_place(const Scene&, const std::string& name);

}  // namespace pintle
