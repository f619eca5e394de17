// Friction in ideal joints at an instant, under forces that are already determined.
#include <cmath>
#include <variant>

#include "framework/common/index.h"
#include "framework/dynamics/equations/sticking.h"

namespace pintle {

namespace {

// Slopes of force over N.
void find_slopes(const JointFriction& rub, const DryFriction& now, const double* x, JointFrictionEffect& effect) {
  if (const auto* dry = std::get_if<Coulomb>(&rub.law)) {
    effect.d_slip = std::abs(now.direction) == 1 ? evaluate(*dry, effect.slip, 1, now.direction).d_speed : 0;
    return;
  }
  const BristleForce bristles = bend(rub.law, effect.slip, x);
  effect.per_load = bristles.force, effect.d_slip = bristles.d_speed, effect.x_rate = bristles.rate;
}

}  // namespace

void add_joint_friction(const System& system, const State& state, Equations& eq) {
  for (std::size_t k = 0; k < system.frictions.size(); ++k) {
    const JointFriction& rub = system.frictions[k];
    const JointEnds ends = ends_of(system.joints[at(rub.joint)]);
    const MarkerMotion &a = eq.motion[at(ends.marker[0])], &b = eq.motion[at(ends.marker[1])];
    JointFrictionEffect& effect = eq.friction[k];
    const std::array<Wrench, 2> unit = unit_friction(system.joints[at(rub.joint)], rub, a, b);
    effect.slip = slip(system.joints[at(rub.joint)], rub, a, b);
    if (state.friction.empty()) continue;
    if (is_released(system, Switch::joint, rub.joint, state.y)) {
      effect = {.slip = effect.slip};
      continue;
    }
    const DryFriction& now = state.friction[system.contacts.size() + k];
    effect.force = now.force, effect.load = now.load, effect.sticks = now.direction == 0;
    find_slopes(rub, now, state.y.data() + system.x_begin() + system.friction_x[k], effect);
    for (std::size_t i = 0; i < 2; ++i) add_wrench(system, eq, ends.marker[i], effect.force * unit[i], eq.f);
  }
}

}  // namespace pintle
