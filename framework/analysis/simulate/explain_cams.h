#pragma once

#include <string>

#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The cam that has reached an end of its table in a state, so that the next step would leave it; empty: none.
std::string explain_cams(const Scene&, const Model&, const State&);

}  // namespace pintle
