#pragma once

#include <array>
#include <string>

namespace pintle {

using Pair = std::array<double, 2>;

/// Where a thing was written, so that `build` can name it; line 0 for a scene made in C++.
struct Place {
  int line = 0;    ///< 1-based
  std::string key; ///< path of keys, "joints.gudgeon pin.clearance.radial"
};

}  // namespace pintle
