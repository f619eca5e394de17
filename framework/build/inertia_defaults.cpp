#include "framework/build/inertia_defaults.h"

#include <algorithm>

namespace pintle {

namespace {

void give_inertia(SceneBody& body, bool mass_too) {
  if (body.elastic) return;
  if (body.mass == 0 && mass_too) body.mass = 1;
  double reach = 0;
  for (const ScenePoint& p : body.points) reach = std::max(reach, p.at[0] * p.at[0] + p.at[1] * p.at[1]);
  if (body.inertia == 0 && body.mass > 0) body.inertia = body.mass * (reach > 0 ? reach : 1);
}

}  // namespace

Scene ready_for_statics(Scene scene) {
  const bool weightless = scene.gravity[0] == 0 && scene.gravity[1] == 0;
  for (SceneBody& b : scene.bodies) give_inertia(b, weightless);
  return scene;
}

Scene ready_for_kinematics(Scene scene) {
  for (SceneBody& b : scene.bodies) {
    give_inertia(b, true);
    if (!b.elastic) continue;
    b.elastic->modes.reset();
    b.elastic->stiffening = Stiffening::none;
    if (auto* beam = std::get_if<SceneBeam>(&b.elastic->shape)) beam->pieces = 1;
  }
  scene.output.stress.clear();
  return scene;
}

}  // namespace pintle
