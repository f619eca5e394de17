#pragma once

#include <string>

#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Which law of signals is no finite number in a state, or has grown beyond all that it was at the start, and what it sees there; empty:
/// none.
std::string explain_signals(const Scene&, const Model&, const State& start, const State&);

}  // namespace pintle
