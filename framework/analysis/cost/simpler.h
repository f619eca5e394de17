#pragma once

#include <string>
#include <vector>

#include "framework/build/build.h"

namespace pintle {

/// A simplified model, to find out what the simplification would save. Made from the built system, so nothing is meshed or reduced again;
/// its shapes are the first ones of the model, not those of a new reduction.
struct Simpler {
  std::string what;  ///< "\"coupler\" rigid", in the words of a scene
  System system;
  Scheme scheme;  ///< chosen anew, as by `build`
  State start;    ///< the model's, near the constraints of the simpler system but not on them; links that are now pins are closed
};

/// One model for each simplification: flexible bodies rigid, with half their shapes (the lowest), or without geometric stiffness; ideal
/// clearances; no friction; a tolerance a hundred times as large, at most 1e-3. Bodies and clearances are simplified separately if there
/// are at most three, and all together.
/// @param start  of the model, assembled
std::vector<Simpler> simpler_models(const Scene&, const Model&, const State& start);

}  // namespace pintle
