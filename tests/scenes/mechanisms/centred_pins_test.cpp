// Bodies pinned at their mass centres, where positions differ from zero by rounding alone.
#include <gtest/gtest.h>

#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"

namespace pintle_scenes::centred_pins_test {
namespace {

using namespace pintle;

pintle::Run run_of(const std::string& text) {
  const Scene scene = read_scene_text(text, "centred.yaml");
  const Model model = build(scene);
  EXPECT_GT(model.system.length, 0.01) << text;
  return simulate(scene, model, assemble(scene, model));
}

// The point is 0.1 m + 0.2 m from the origin and the mass centre 0.3 m, which differ by 5.6e-17 m.
TEST(CentredPins, ARigidBodyFallsWithAWheelAtItsCentre) {
  const pintle::Run run = run_of(
      "gravity: [0, -9.81]\nbodies:\n"
      "  a: {rigid: {mass: 1 kg, inertia: 0.01, center: [0.3 m, 0]}, points: {P: [0.1 m + 0.2 m, 0]}}\n"
      "  b: {rigid: {mass: 1 kg, inertia: 0.01}, points: {P: [0, 0]}, pose: {at: [0.3 m, 0]}}\n"
      "joints: {pin: {revolute: [a.P, b.P]}}\n"
      "start: {a: {at: [0, 0], angle: 0, vx: 1 m/s, speed: 10 rad/s}, b: {at: [0.3 m, 0], speed: -3 rad/s}}\nrun: {until: 1 s}\n");
  ASSERT_EQ(run.status, Status::finished) << run.reason;
  EXPECT_NEAR(run.trajectory.column("a.angle [rad]").back(), 10, 1e-6);
  EXPECT_NEAR(run.trajectory.column("b.angle [rad]").back(), -3, 1e-6);
}

TEST(CentredPins, ABeamFallsWithAWheelAtItsMiddle) {
  for (const int degrees : {0, 10, 20, 30}) {
    const std::string angle = std::to_string(degrees) + " deg";
    const pintle::Run run = run_of(
        "gravity: [0, -9.81]\nbodies:\n  a:\n    beam: {from: A, to: B, section: {rectangle: [10 mm, 10 mm]}, young: 200 GPa, poisson: "
        "0.3, "
        "density: 8000 kg/m^3}\n    points: {A: [0, 0], M: [0.5 m, 0], B: [1 m, 0]}\n    modes: {count: 3}\n"
        "  b: {rigid: {mass: 1 kg, inertia: 0.01}, points: {P: [0, 0]}}\njoints: {pin: {revolute: [a.M, b.P]}}\n"
        "start:\n  a: {at: [0, 0], angle: " +
        angle + ", speed: 1 rad/s}\n  b: {at: [0.5 m*cos(" + angle + "), 0.5 m*sin(" + angle + ")], speed: 0}\nrun: {until: 50 ms}\n");
    ASSERT_EQ(run.status, Status::finished) << degrees << ": " << run.reason;
    EXPECT_NEAR(run.trajectory.column("a.angle [rad]").back(), degrees * 0.017453292519943295 + 0.05, 1e-5) << degrees;
  }
}

}  // namespace
}  // namespace pintle_scenes::centred_pins_test
