#pragma once

#include <string>

#include "framework/configuration/assemble.h"

namespace pintle {

/// A sum over all that the motion follows from: the numbers of the system that was built (masses, shapes, joints, laws …),
/// where it starts, the scene's words but for `title`, `run.until` and `output`, and the files that they name. Of laws made in
/// C++ it sees samples. The same for the same program on the same machine.
std::string identity(const Scene&, const Model&, const Assembly&);

}  // namespace pintle
