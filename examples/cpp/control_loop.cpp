// An arm held level by a controller, once a millisecond. Expect 5.886 N m at the end: 2 kg at 0.3 m under gravity.
#include <algorithm>
#include <cstdio>

#include "framework/analysis/simulate/simulation.h"
#include "framework/build/build.h"
#include "framework/mechanism/result_tables.h"
#include "framework/scene/yaml/reader.h"

// `torque` is an input: a state that changes only where the loop sets it.
constexpr const char* arm = R"(
gravity: [0, -9.81 m/s^2]
bodies: {arm: {rigid: {mass: 2 kg, inertia: 0.06 kg m^2, center: [0.3 m, 0]}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states: {torque: {rate: 0 N m/s, start: 0 N m}}
forces: {servo: {torque: torque, on: arm}}
start: {arm: {angle: -90 deg}}
run: {until: 4 s}
)";

int main() {
  using namespace pintle;
  const Scene scene = read_scene_text(arm, "arm.yaml");
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  const std::vector<std::string> columns = trajectory_table(model).header;
  const auto place = [&](const char* name) { return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin()); };
  const std::size_t angle = place("arm.angle [rad]"), speed = place("arm.speed [rad/s]");
  constexpr double step = 1e-3;
  constexpr int torque = 0;  // index of the state

  Simulation simulation(scene, model, assembly);
  double integral = 0;
  do {
    const std::vector<double> now = simulation.now();
    const double error = 0 - now[angle];
    integral += error * step;
    simulation.set(torque, 40 * error + 60 * integral - 6 * now[speed]);
  } while (simulation.advance(simulation.time() + step));
  const Run run = simulation.finish();
  std::printf("angle %.6f rad, torque %.3f N m at %.3f s\n", run.trajectory.column("arm.angle [rad]").back(),
              run.trajectory.column("torque [N m]").back(), run.t_end);
}
