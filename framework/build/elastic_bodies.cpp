#include "framework/build/elastic_bodies.h"

#include "framework/bodies/attachments.h"
#include "framework/bodies/body_store.h"
#include "framework/bodies/elastic_body.h"
#include "framework/bodies/flexible_report.h"
#include "framework/bodies/holding_warnings.h"
#include "framework/bodies/load_history.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/build/shape_warnings.h"
#include "framework/common/text.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

/// Without a preliminary run, warns of a body without stiffening whose given spin matters. @returns whether a warning was added
bool warn_of_spin(const Scene& scene, const MechanismBody& b, Model& model) {
  if (b.elastic.scene->elastic->stiffening != Stiffening::none) return false;
  const double spin = given_spin(scene, b.body.name);
  if (!(spin > 0)) return false;
  const std::string warning = spin_warning(b.body.name, spin, stiffened_by_spin(scene, b, spin));
  if (!warning.empty()) model.warnings.push_back(warning);
  return !warning.empty();
}

}  // namespace

ElasticBodies elastic_bodies(const Scene& scene, BodyStore* store, bool preliminary) {
  ElasticBodies out;
  const std::size_t n = scene.bodies.size();
  out.meshed.resize(n), out.choices.resize(n);
  std::vector<const ElasticBody*> all(n, nullptr);
  bool flexible = false, automatic = false;
  for (std::size_t i = 0; i < n; ++i) {
    const SceneBody& b = scene.bodies[i];
    if (!b.elastic) continue;
    if (const auto* beam = std::get_if<SceneBeam>(&b.elastic->shape); beam && beam->pieces > 1)
      throw SceneError(scene.file, b.place, "it must be cut into pieces first; build the scene that with_pieces returns");
    all[i] = &out.meshed[i].emplace(store ? store->elastic(scene, b) : elastic_body(scene, b));
    if (const std::string warning = size_warning(scene, *all[i]); !warning.empty()) out.meshed[i]->warnings.push_back(warning);
    validate_inertia(scene, *all[i]);
    flexible = flexible || b.elastic->modes;
    automatic = automatic || (b.elastic->modes && b.elastic->modes->keep.automatic);
  }
  if (!automatic && !(preliminary && flexible)) return out;
  if (scene.has_run)
    out.run = rigid_run(scene, all);
  else
    out.run.trouble = "the scene has no `run`";
  out.preliminary_run = {out.run.until, out.run.seconds, out.run.steps, out.run.trouble};
  for (std::size_t i = 0; i < n; ++i)
    if (all[i] && scene.bodies[i].elastic->modes && scene.bodies[i].elastic->modes->keep.automatic)
      out.choices[i] = out.run.usable() ? choose_modes(scene, *all[i], out.run.bodies[i]) : choose_by_rule(scene, *all[i], out.run.trouble);
  return out;
}

void report_flexible(const Scene& scene, const std::vector<std::optional<MechanismBody>>& elements, const ElasticBodies& made,
                     Model& model) {
  std::vector<Imposed> imposed;
  for (const Body& b : model.system.bodies)
    if (b.modes() > 0 && imposed.empty()) imposed = imposed_frequencies(scene);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!elements[i] || !elements[i]->elastic.scene->elastic->modes) continue;
    if (!elements[i]->body.flex) {
      model.warnings.push_back(quoted(scene.bodies[i].name) + " stays rigid: its `modes` keep no shape; increase below, or give a count");
      continue;
    }
    FlexibleReport& r = model.flexible.emplace_back(flexible_report(*elements[i]));
    r.choice = made.choices[i];
    model.bending.push_back(bending_probe(*elements[i], static_cast<int>(i)));
    StiffeningProbe& probe = model.stiffening.emplace_back(stiffening_probe(*elements[i], static_cast<int>(i)));
    if (made.run.usable()) r.motion = motion_estimate(*elements[i], made.run.bodies[i]), probe.judged = true;
    const std::vector<std::string> found = warnings_of(scene, r, imposed);
    model.warnings.insert(model.warnings.end(), found.begin(), found.end());
    if (!r.motion) probe.judged = warn_of_spin(scene, *elements[i], model) || probe.judged;
    if (const std::string warning = stiff_parts_warning(*elements[i]); !warning.empty()) model.warnings.push_back(warning);
  }
  if (!model.stiffening.empty()) {
    std::vector<const ElasticBody*> flexible;
    for (const auto& e : elements) flexible.push_back(e && e->body.flex ? &e->elastic : nullptr);
    model.attachments = attachments_of(scene, model.order, flexible);
  }
  const std::vector<std::string> held = holding_warnings(scene, elements);
  model.warnings.insert(model.warnings.end(), held.begin(), held.end());
}

}  // namespace pintle
