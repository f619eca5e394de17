#pragma once

#include "framework/mechanism/model.h"
#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

class BodyStore;

/// Resolves names into indices and checks everything that the reader cannot; no other code does this. Modes of bodies with `keep: auto` are
/// chosen by a preliminary run with rigid bodies.
/// @throws SceneError  naming file, line, key, value and remedy
Model build(const Scene&);
/// The same to the bit, with bodies of elements from a store shared by many scenes, in any number of threads.
Model build(const Scene&, BodyStore&);
/// The same, with a preliminary run for every scene with flexible bodies; it estimates their bending and geometric stiffness, and adds
/// warnings: for `pintle check`.
Model build_with_preliminary_run(const Scene&);

}  // namespace pintle
