#include "framework/scene/error.h"
#include "framework/study/fit/fit.h"
#include "framework/study/nonlinear/nonlinear.h"
#include "framework/study/sensitivity/sensitivity.h"
#include "framework/study/study.h"
#include "framework/study/sweep/sweep.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/targets.h"

namespace pintle {

namespace {
constexpr const char* scene = R"(
gravity: [0, -9.81]
parameters: {mass: 2 kg, arm: 0.1 m, clearance: 0.1 mm}
bodies:
  crank: {rigid: {mass: mass, inertia: 0.01 kg m^2}, points: {O: [-arm, 0], A: [arm, 0]}, pose: {at: [arm, 0]}}
  bob: {rigid: {mass: 1, inertia: 1e-3}, pose: {at: [2*arm, 0]}}
joints:
  bearing: {revolute: [ground, crank.O]}
  pin: {revolute: [crank.A, bob], clearance: {radial: clearance, bearing radius: 10 mm, bearing: crank,
        normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}}
run: {until: 0.3 s}
)";
}  // namespace

void fuzz_study(std::string_view bytes) {
  static const auto written = fuzz_folder().write("scene.yaml", scene);
  const auto study = fuzz_folder().write("study.yaml", bytes);
  const auto read = [&](auto reader) {
    try {
      reader(study, Overrides{});
    } catch (const SceneError&) {
    }
  };
  read(read_sweep);
  read(read_fit);
  read(read_sensitivity);
  read(read_nonlinear);
}

}  // namespace pintle
