#pragma once

#include <string>
#include <vector>

#include "framework/build/build.h"

namespace pintle {

/// A model with something taken away, for trying out what that would save. Made of the built system, so that nothing is
/// meshed or reduced again; its shapes are those of the model, fewer of them, not those of a reduction to fewer.
struct Simpler {
  std::string what;  ///< "\"coupler\" rigid", in the words of a scene
  System system;
  Scheme scheme;  ///< chosen again, as `build` would
  State start;    ///< the model's, near the constraints of the simpler system, not on them; links that are pins now are closed
};

/// Each of what the model has that could be left out: flexible bodies rigid, with half their shapes (the lowest), without
/// stiffening; clearances ideal; contacts without friction; the tolerance a hundred times as large. Bodies and clearances
/// one by one if they are few, and together.
/// @param start  of the model, assembled
std::vector<Simpler> simpler_models(const Scene&, const Model&, const State& start);

}  // namespace pintle
