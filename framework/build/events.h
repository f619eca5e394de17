#pragma once

#include "framework/build/signals.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// What the scene's events may release and engage becomes a switch of the system. Before its coordinates are numbered.
/// @throws SceneError  an event names what there is not, or what cannot be released
void add_switches(const Scene&, Model&);
/// The events themselves, in the model's scheme. After add_switches, and when signals are finished.
void add_events(const Scene&, Model&, SignalMaker&);

}  // namespace pintle
