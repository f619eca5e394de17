#pragma once

#include <optional>
#include <vector>

#include "framework/bodies/mechanism_body.h"
#include "framework/build/preliminary_run.h"
#include "framework/mechanism/model.h"

namespace pintle {

class BodyStore;

/// The bodies of elements of a scene, with the data needed before they are reduced. One entry per body of the scene.
struct ElasticBodies {
  std::vector<std::optional<ElasticBody>> meshed;   ///< to be moved from
  std::vector<std::optional<ModalChoice>> choices;  ///< for those with `keep: auto`
  RigidRun run;
  std::optional<PreliminaryRun> preliminary_run;  ///< if there was one
};

/// Meshes all bodies of elements, and makes a preliminary run with rigid bodies where needed.
/// @param store        or nullptr
/// @param preliminary  a preliminary run for every scene with flexible bodies, not only for `keep: auto`
/// @throws SceneError  as elastic_body and rigid_run; a beam not yet divided into elements
ElasticBodies elastic_bodies(const Scene&, BodyStore* store, bool preliminary);

/// Reports what the flexible bodies have kept, and warnings about it: model.flexible, bending, stiffening, attachments, warnings.
void report_flexible(const Scene&, const std::vector<std::optional<MechanismBody>>&, const ElasticBodies&, Model&);

}  // namespace pintle
