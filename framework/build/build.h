#pragma once

#include "framework/mechanism/model.h"
#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

class BodyStore;

/// Turns names into indices and judges everything that the reader cannot: the only place that does.
/// Bodies that say `keep: auto` have their modes chosen by a rigid run.
/// @throws SceneError  naming file, line, key, value and remedy
Model build(const Scene&);
/// The same to the bit, with bodies of elements from a store that many scenes share, in any number of threads.
Model build(const Scene&, BodyStore&);
/// The same, with a rigid run for every scene with flexible bodies, which estimates how they bend and
/// stiffen and adds to the warnings: for `pintle check`.
Model build_with_preliminary_run(const Scene&);

}  // namespace pintle
