// What may be asked of a mechanism beside a run: its rest, its small motion, its motion by drivers, their torques; modes of a body.
// Expect 53.39 deg for the lever, as its file says.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/bodies/elastic_body.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/yaml/reader.h"

using namespace pintle;

/// A scene with the system and the start that are made of it.
struct Mechanism {
  explicit Mechanism(Scene s) : scene(std::move(s)), model(build(scene)), assembly(assemble(scene, model)) {}
  Scene scene;
  Model model;
  Assembly assembly;
};

int main(int, char** arguments) {
  const auto read = [&](const char* name) { return read_scene(std::string(arguments[1]) + "/" + name); };

  const Mechanism lever(with_pieces(ready_for_statics(read("statics_lever.yaml"))));
  const Equilibrium rest = find_equilibrium(lever.scene, lever.model, lever.assembly);
  std::printf("a lever at rest at %.2f deg, stable: %s\n", rest.table.column("lever.angle [rad]").back() * 180 / std::numbers::pi,
              rest.stability.unstable == 0 ? "yes" : "no");

  const Mechanism arm(with_pieces(read("pid_arm.yaml")));
  const Equilibrium held = find_equilibrium(arm.scene, arm.model, arm.assembly);
  const Linearization small = linearize(arm.scene, arm.model, held.state, Laws::hold);
  std::printf("slowest mode of a servo: %.4f 1/s of %zu states\n", small.modes.front().root.real(), small.space.states.size());

  const Mechanism shaper(ready_for_kinematics(read("kinematics_quick_return.yaml")));
  std::printf("a quick return moves through %zu poses\n", kinematics(shaper.scene, shaper.model, shaper.assembly).trajectory.rows());

  const Mechanism four_bar(with_pieces(read("inverse_four_bar.yaml")));
  for (const DriverEffort& effort : inverse(four_bar.scene, four_bar.model, four_bar.assembly).drivers) {
    const auto [least, most] = std::ranges::minmax(effort.value);
    std::printf("%s: at most %.4f %s\n", effort.name.c_str(), std::max(-least, most), effort.turns ? "N m" : "N");
  }

  const Scene beam = read("modes_beam.yaml");
  const ModesReport modes = modes_of(beam, elastic_body(beam, elastic_of(beam, "")), 3);
  std::printf("modes of a beam:");
  for (const double omega : modes.natural.modes.omega) std::printf(" %.4f Hz", omega / (2 * std::numbers::pi));
  std::printf("\n");
}
