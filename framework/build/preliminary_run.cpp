#include "framework/build/preliminary_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/bodies/elastic_body.h"
#include "framework/bodies/attachments.h"
#include "framework/bodies/modal_basis.h"
#include "framework/build/build.h"
#include "framework/common/processor_time.h"
#include "framework/common/stop_point.h"
#include "framework/component/reduction/inertia.h"
#include "framework/component/reduction/modal_model.h"
#include "framework/configuration/assemble.h"
#include "framework/integration/integrator.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;

constexpr long most_steps = 20'000;
constexpr double most_numbers = 1e7;  ///< stored for all bodies together: 80 MB
constexpr int turns_seen = 10;        ///< of the slowest motor
constexpr int steps_a_turn = 64;      ///< at least, of the fastest driver
constexpr double least_tolerance = 1e-6;

/// A rigid body with the same points, so that all names remain valid.
SceneBody rigid_twin(const ElasticBody& e) {
  SceneBody body = *e.scene;
  const RigidInertia inertia = rigid_inertia(e.model, e.M);
  const Vector2d centre = inertia.c / inertia.m;
  body.mass = inertia.m;
  body.inertia = inertia.J - inertia.c.squaredNorm() / inertia.m;
  body.center = {centre.x(), centre.y()};
  for (ScenePoint& p : body.points)
    if (const Port* port = e.model.port(p.name)) p.at = {port->x.x(), port->x.y()};
  body.elastic.reset();
  return body;
}

Scene rigid_twin(const Scene& scene, const std::vector<const ElasticBody*>& elements) {
  Scene twin = scene;
  for (std::size_t b = 0; b < elements.size(); ++b)
    if (elements[b]) twin.bodies[b] = rigid_twin(*elements[b]);
  for (StartBody& s : twin.start_bodies) s.deflection.clear(), s.modes.clear();
  twin.output.points.clear();
  twin.output.stress.clear();
  twin.output.frames = 0;
  twin.outputs.clear();  // they may read deflections, which rigid bodies lack
  return twin;
}

/// Stores one column of every history at the present state.
void keep(const System& system, const std::vector<Attachment>& attachments, const State& state, const Equations& eq, Index column,
          std::vector<LoadHistory>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].factor.size() == 0) continue;
    loads_now(system, attachments, state, eq, b, bodies[b].factor.col(column));
    bodies[b].t.push_back(state.t);
  }
}

/// Whether the scene is driven only by uniform motors and constant forces.
bool is_even(const Scene& scene, const std::vector<Imposed>& imposed) {
  const auto turns = [](const Imposed& i) { return i.even && i.turns; };
  bool even = !imposed.empty() && std::all_of(imposed.begin(), imposed.end(), turns);
  for (const SceneLoad& l : scene.loads) {
    if (const auto* f = std::get_if<SceneForce>(&l.what)) even = even && f->x.constant && f->y.constant;
    if (const auto* q = std::get_if<SceneTorque>(&l.what)) even = even && q->law.constant;
    if (const auto* s = std::get_if<SceneSpring>(&l.what)) even = even && !s->law;
    if (const auto* r = std::get_if<SceneTorsionSpring>(&l.what)) even = even && !r->law;
  }
  return even;
}

double span_of(const Scene& scene, const std::vector<Imposed>& imposed) {
  if (!is_even(scene, imposed)) return scene.run.until;
  double slowest = 0;
  for (const Imposed& i : imposed) slowest = std::max(slowest, turns_seen / i.frequency);
  return std::min(scene.run.until, slowest);
}

Scheme scheme_of(const Model& model, double span, const std::vector<Imposed>& imposed) {
  Scheme scheme = model.scheme;
  scheme.tolerance = std::max(scheme.tolerance, least_tolerance);
  scheme.max_step = std::min(scheme.max_step, span / steps_a_turn);
  for (const Imposed& i : imposed)
    if (i.frequency > 0) scheme.max_step = std::min(scheme.max_step, 1 / (steps_a_turn * i.frequency));
  return scheme;
}

void march(const Scene& twin, const Model& model, const Assembly& assembly, const std::vector<Attachment>& attachments,
           const std::vector<Imposed>& imposed, RigidRun& run) {
  double rows = 1;
  for (const LoadHistory& h : run.bodies) rows += static_cast<double>(h.factor.rows());
  const long most = std::min(most_steps, static_cast<long>(most_numbers / rows));
  for (LoadHistory& h : run.bodies) h.factor.conservativeResize(Eigen::NoChange, h.factor.rows() > 0 ? most + 1 : 0);
  const double span = span_of(twin, imposed);
  Integrator integrator(model.system, scheme_of(model, span, imposed), assembly.start);
  if (integrator.failure().empty()) keep(model.system, attachments, integrator.state(), integrator.equations(), 0, run.bodies);
  while (integrator.failure().empty() && run.steps < most && integrator.state().t < span && integrator.advance(span)) {
    stop_point();
    keep(model.system, attachments, integrator.state(), integrator.equations(), ++run.steps, run.bodies);
  }
  run.until = integrator.state().t;
  run.trouble = integrator.failure();
  for (LoadHistory& h : run.bodies) h.factor.conservativeResize(Eigen::NoChange, h.factor.rows() > 0 ? run.steps + 1 : 0);
}

}  // namespace

RigidRun rigid_run(const Scene& scene, const std::vector<const ElasticBody*>& elements) {
  RigidRun run;
  const double begin = processor_time();
  run.bodies.resize(scene.bodies.size());
  for (std::size_t b = 0; b < elements.size(); ++b)
    if (elements[b] && elements[b]->scene->elastic->modes)
      run.bodies[b].factor.resize(inertia_loads + 3 * static_cast<Index>(elements[b]->model.ports.size()), 1);
  const Scene twin = rigid_twin(scene, elements);
  try {
    const Model model = build(twin);
    const Assembly assembly = assemble(twin, model);
    if (!assembly.redundant.empty()) {
      const Redundancy& r = assembly.redundant.front();
      run.trouble = "with every body rigid, " + row_text(model.system, r.joint, r.row) + " is implied by other joints";
    } else {
      march(twin, model, assembly, attachments_of(scene, model.order, elements), imposed_frequencies(scene), run);
    }
  } catch (const AssemblyError& error) {
    run.trouble = error.what();
  } catch (const SceneError& error) {  // also if laws read deflections; errors of the scene itself are reported again by `build`
    run.trouble = std::string("with every body rigid, the scene cannot be built: ") + error.what();
  }
  run.seconds = processor_time() - begin;
  return run;
}

ModalChoice choose_modes(const Scene& scene, const ElasticBody& e) {
  if (!scene.has_run) return choose_by_rule(scene, e, "the scene has no `run`");
  std::vector<ElasticBody> made;
  made.reserve(scene.bodies.size());
  std::vector<const ElasticBody*> elements;
  std::size_t own = 0;
  for (const SceneBody& b : scene.bodies) {
    if (&b == e.scene) own = elements.size();
    elements.push_back(&b == e.scene ? &e : b.elastic ? &made.emplace_back(elastic_body(scene, b)) : nullptr);
  }
  const RigidRun run = rigid_run(scene, elements);
  return run.usable() ? choose_modes(scene, e, run.bodies[own]) : choose_by_rule(scene, e, run.trouble);
}

}  // namespace pintle
