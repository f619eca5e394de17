#pragma once

#include <optional>
#include <vector>

#include "framework/bodies/mechanism_body.h"
#include "framework/build/preliminary_run.h"
#include "framework/mechanism/model.h"

namespace pintle {

class BodyStore;

/// The bodies of elements of a scene, and what is to be known before they are reduced. One entry a body of the scene.
struct ElasticBodies {
  std::vector<std::optional<ElasticBody>> meshed;   ///< to be moved from
  std::vector<std::optional<ModalChoice>> choices;  ///< of those that say `keep: auto`
  RigidRun run;
  std::optional<PreliminaryRun> preliminary_run;  ///< if there was one
};

/// Meshes all bodies of elements, and runs them rigid where something is to be judged by that.
/// @param store        or nullptr
/// @param preliminary  a rigid run for every scene with flexible bodies, not only for `keep: auto`
/// @throws SceneError  as elastic_body and rigid_run; a beam that is still to be cut into pieces
ElasticBodies elastic_bodies(const Scene&, BodyStore* store, bool preliminary);

/// What the flexible bodies have kept, and what is doubtful about it: model.flexible, bending, stiffening, attachments, warnings.
void report_flexible(const Scene&, const std::vector<std::optional<MechanismBody>>&, const ElasticBodies&, Model&);

}  // namespace pintle
