#pragma once

#include <array>
#include <string>

namespace pintle {

using Pair = std::array<double, 2>;

/// Instead of a line: the value came from `--set PATH=VALUE`.
inline constexpr int set_by_override = -1;

/// Where a thing was written, so that `build` can name it; line 0 for a scene made in C++.
struct Place {
  int line = 0;           ///< 1-based, or set_by_override
  std::string key;        ///< path of keys, "joints.gudgeon pin.clearance.radial"
  std::string file = {};  ///< an included one; empty: the scene's
};

}  // namespace pintle
