#include "framework/study/nonlinear/follower.h"

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

namespace {

void step_towards(Integrator& integrator, double t, const std::function<bool()>& go_on) {
  if (go_on && integrator.counts().steps % 64 == 0 && !go_on()) throw OrbitTrouble{status_text(Status::interrupted), "stopped by the user"};
  const bool stepped = integrator.advance(t);
  if (!integrator.failure().empty()) throw OrbitTrouble{status_text(Status::failed), integrator.failure()};
  if (!integrator.ended().empty()) throw OrbitTrouble{"ended", "an event has ended the run: " + integrator.ended()};
  if (!stepped) throw OrbitTrouble{status_text(Status::failed), "no step is possible"};
}

}  // namespace

void go_to(Integrator& integrator, double t, const std::function<bool()>& go_on) {
  while (integrator.state().t < t) step_towards(integrator, t, go_on);
}

bool go_to_return(Integrator& integrator, double until, const std::function<bool()>& go_on) {
  while (integrator.state().t < until) {
    step_towards(integrator, until, go_on);
    if (integrator.asks_for_row()) return true;
  }
  return false;
}

Eigen::VectorXd phase_scales(const System& system, double time) {
  Eigen::VectorXd out(system.z_begin());
  const Eigen::Index n = system.n();
  out.head(n) = system.scale;
  out.segment(n, n) = system.scale / time;
  for (Eigen::Index k = 0; k < system.n_x(); ++k) out[2 * n + k] = system.x_scale[k] > 0 ? system.x_scale[k] : system.length;
  return out;
}

}  // namespace pintle
