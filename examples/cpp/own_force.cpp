// A pendulum in a wind that a function blows. Expect that it comes to rest at 0.1972 rad from hanging, where the drag of a wind of 4 m/s,
// 0.125 N s^2/m^2 v^2 = 2 N, balances its weight: tan = 2 N/(1.0204 kg 9.81 m/s^2).
#include <cmath>
#include <cstdio>
#include <variant>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"

constexpr const char* pendulum = R"(
gravity: [0, -9.81 m/s^2]
bodies: {bob: {rigid: {mass: 1.0204 kg, inertia: 1e-3 kg m^2}, points: {top: [0, 1 m], C: [0, 0]}}}
joints: {hook: {revolute: [ground, bob.top]}}
forces: {wind: {force: [0 N, 0 N], at: bob.C}}
run: {until: 120 s, tolerance: 1e-9}
output: {every: 0.1 s}
)";

/// Component k of the drag on a bob that moves with in[0], in[1], and its slopes with respect to these.
pintle::SignalFunction drag(int k) {
  return [k](double, const double* in, double* slope) {
    const double v[2] = {4 - in[0], -in[1]}, size = std::hypot(v[0], v[1]);
    for (int i = 0; slope && i < 2; ++i) slope[i] = size > 0 ? -0.125 * (v[k] * v[i] / size + (i == k ? size : 0)) : 0;
    return 0.125 * size * v[k];
  };
}

int main() {
  using namespace pintle;
  Scene scene = read_scene_text(pendulum, "pendulum.yaml");
  auto& wind = std::get<SceneForce>(scene.loads[0].what);
  for (Law* law : {&wind.x, &wind.y}) {
    law->constant = false;
    law->signals = {"bob.C.vx", "bob.C.vy"};
    law->of_signals = drag(law == &wind.x ? 0 : 1);
  }
  const Model model = build(scene);
  const Run run = simulate(scene, model, assemble(scene, model));
  std::printf("at rest at %.4f rad for %.4f, blown in %.3f J\n", run.trajectory.column("bob.angle [rad]").back(),
              std::atan(2 / (1.0204 * 9.81)), run.ledger.column("wind.work in [J]").back());
}
