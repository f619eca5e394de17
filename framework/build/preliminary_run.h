#pragma once

#include <string>
#include <vector>

#include "framework/bodies/load_history.h"
#include "framework/bodies/modal_choice.h"

namespace pintle {

/// A short preliminary run with every body rigid.
struct RigidRun {
  std::string trouble;  ///< why there is none, or why it ended early, in words
  double until = 0;     ///< reached [s]
  long steps = 0;
  double seconds = 0;               ///< computing time [s]
  std::vector<LoadHistory> bodies;  ///< one per body of the scene; empty unless it has modes
  bool usable() const { return steps > 0; }
};

/// Runs the scene, with its bodies of elements rigid, over `run.until` or, where it is driven only by uniform motors and constant forces,
/// over ten turns; the number of steps is limited. `trouble` reports problems, for example a law that reads a deflection.
/// @param elements  one per body of the scene, nullptr for those that are not made of elements
RigidRun rigid_run(const Scene&, const std::vector<const ElasticBody*>& elements);

/// Chooses the modes to keep for a single body of a scene, by building the others and a run with all bodies rigid.
ModalChoice choose_modes(const Scene&, const ElasticBody&);

}  // namespace pintle
