#include "framework/integration/held_forces.h"

#include "framework/dynamics/equations/sticking.h"
#include "framework/integration/dense_output.h"
#include "framework/integration/stepper.h"

namespace pintle {

bool holds_anything(const System& system, const State& state) {
  for (std::size_t k = 0; k < state.friction.size(); ++k)
    if (sticks(system, state, k) || (k < system.contacts.size() && holds_gap(system, state, k))) return true;
  return false;
}

void HeldForces::look(const System& system, const Stepper& stepper, const Step& step, State& work) {
  if (!eq_) eq_ = std::make_unique<Equations>(system), dy_.resize(system.n_y());
  begin_inside(step, step.from.state.t + step.h / 2, work);
  stepper.interpolate(step, work.t, work.y);
  known_ = evaluate(system, work, *eq_, dy_);
  if (known_) keep_friction(system, *eq_, work);
  middle_ = work.friction;
}

DryFriction HeldForces::at(const Step& step, double t, std::size_t k) const {
  const double x = (t - step.from.state.t) / step.h;
  const double from = (1 - x) * (1 - 2 * x), middle = 4 * x * (1 - x), to = x * (2 * x - 1);
  const DryFriction &a = step.from.state.friction[k], &b = middle_[k], &c = step.to.state.friction[k];
  return {a.direction, from * a.force + middle * b.force + to * c.force, from * a.load + middle * b.load + to * c.load};
}

}  // namespace pintle
