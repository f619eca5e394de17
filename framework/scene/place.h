#pragma once

#include <array>
#include <string>

namespace pintle {

using Pair = std::array<double, 2>;

/// Value of `line` for values from `--set PATH=VALUE`.
inline constexpr int set_by_override = -1;

/// Where an entry was written, for messages of `build`; line 0 for a scene made in C++.
struct Place {
  int line = 0;           ///< 1-based, or set_by_override
  std::string key;        ///< path of keys, "joints.gudgeon pin.clearance.radial"
  std::string file = {};  ///< an included file; empty: the scene's
};

}  // namespace pintle
