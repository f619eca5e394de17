#pragma once

#include <string>
#include <vector>

#include "framework/bodies/load_history.h"
#include "framework/bodies/modal_choice.h"

namespace pintle {

/// A short run with every body rigid.
struct RigidRun {
  std::string trouble;  ///< why there is none, or why it ended early; in words
  double until = 0;     ///< reached [s]
  long steps = 0;
  double seconds = 0;               ///< of computing
  std::vector<LoadHistory> bodies;  ///< one a body of the scene; empty unless it has modes
  bool usable() const { return steps > 0; }
};

/// The scene, its bodies of elements rigid, over `run.until` or, where nothing but motors that turn
/// evenly and forces that do not change drive it, over ten turns; no longer than a bounded number of
/// steps. Cannot fail for mechanical reasons: `trouble` says what went wrong.
/// @param elements  one a body of the scene, nullptr for those that are not made of elements
/// @throws SceneError  as build
RigidRun rigid_run(const Scene&, const std::vector<const ElasticBody*>& elements);

/// The modes to keep for one body of a scene alone: makes the others, and runs them rigid.
ModalChoice choose_modes(const Scene&, const ElasticBody&);

}  // namespace pintle
