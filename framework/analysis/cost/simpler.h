#pragma once

#include <string>
#include <vector>

#include "framework/build/build.h"

namespace pintle {

/// A simplified model, for trying out what the simplification would save. Made from the built system, so that nothing is meshed or reduced
/// again; its shapes are the first of the model's, not those of a reduction to fewer.
struct Simpler {
  std::string what;  ///< "\"coupler\" rigid", in the words of a scene
  System system;
  Scheme scheme;  ///< chosen again, as by `build`
  State start;    ///< the model's, near the constraints of the simpler system but not on them; links that are now pins are closed
};

/// One for each simplification of the model: flexible bodies rigid, with half their shapes (the lowest), without geometric stiffness;
/// clearances ideal; contacts without friction; the tolerance a hundred times as large. Bodies and clearances separately if there are few,
/// and together.
/// @param start  of the model, assembled
std::vector<Simpler> simpler_models(const Scene&, const Model&, const State& start);

}  // namespace pintle
