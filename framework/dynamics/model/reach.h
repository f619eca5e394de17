#pragma once

#include <algorithm>
#include <vector>

#include "framework/common/index.h"
#include "framework/dynamics/model/system.h"

namespace pintle {

/// Of each body, how far its markers are from its mass centre; 0 without markers [m].
inline std::vector<double> reaches(const System& system) {
  std::vector<double> out(system.bodies.size(), 0.0);
  for (const Marker& m : system.markers)
    if (m.body != ground) out[at(m.body)] = std::max(out[at(m.body)], m.x_BP.norm());
  return out;
}

}  // namespace pintle
