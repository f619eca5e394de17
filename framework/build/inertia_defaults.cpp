#include "framework/build/inertia_defaults.h"

#include <algorithm>
#include <string>
#include <vector>

#include "framework/common/some_of.h"
#include "framework/common/text.h"

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

std::optional<Scene> for_kinematics_alone(const Scene& scene) {
  std::vector<std::string> massless;
  for (const SceneBody& b : scene.bodies)
    if (!b.elastic && (b.mass == 0 || b.inertia == 0)) massless.push_back(quoted(b.name));
  if (massless.empty()) return {};
  Scene out = ready_for_kinematics(scene);
  out.warnings.push_back(
      some_of(massless, false) + (massless.size() == 1 ? " lacks" : " lack") +
      " mass or inertia: only `pintle kinematics` can run this scene (and `pintle statics`, with masses or without gravity)");
  return out;
}

}  // namespace pintle
