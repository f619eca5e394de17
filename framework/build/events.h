#pragma once

#include "framework/build/signals.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Makes a switch of the system for each element that the scene's events may release and engage. Before its coordinates are numbered.
/// @throws SceneError  an event names something that does not exist or cannot be released
void add_switches(const Scene&, Model&);
/// Adds the events themselves to the model's scheme. After add_switches, and when signals are finished.
void add_events(const Scene&, Model&, SignalMaker&);

}  // namespace pintle
