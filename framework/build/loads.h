#pragma once

#include "framework/build/markers.h"
#include "framework/build/signals.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Adds the forces of a load in the scene: one, or for an elastic belt one per span.
/// @throws SceneError  it acts on nothing that moves, or its ends are on one body
void add_load(const Scene&, const SceneLoad&, Markers&, SignalMaker&, Model&);

}  // namespace pintle
