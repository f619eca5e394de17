// How a mechanism holds, loads and starts its bodies: what must not go wrong in silence.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"

namespace pintle::held_body_test {
namespace {

std::string arm(const std::string& modes, const std::string& rest) {
  return "bodies:\n  arm:\n    beam: {from: A, to: B, section: {rectangle: [6 mm, 20 mm]}, young: 70 GPa, poisson: 0.33, "
         "density: 2700}\n    points: {A: [0, 0], B: [500 mm, 0]}\n" +
         modes + "joints: {w: {weld: [ground, arm.A]}}\n" + rest;
}

bool warns(const std::vector<std::string>& warnings, const std::string& of) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return w.find(of) != std::string::npos; });
}

Run run_of(const std::string& text) {
  const Scene scene = read_scene_text(text, "scene.yaml");
  const Model model = build(scene);
  return simulate(scene, model, assemble(scene, model));
}

TEST(Laws, ThatActAfterALongRestAreNotPassedOver) {
  const auto run =
      run_of(arm("    modes: {frame: tangent, count: 3}\n",
                 "forces: {k: {force: [\"0\", \"100 N*step(t, 0.3 s, 0.301 s)*(1 - step(t, 0.304 s, 0.305 s))\"], at: arm.B}}\n"
                 "run: {until: 1 s}\n"));
  EXPECT_EQ(run.status, Status::finished);
  // 0.4 N s at the tip, where each shape weighs a quarter of the beam, 40.5 g: at most p²/2m = 1.98 J a shape, and the first,
  // whose period is twelve times as long as the pulse, takes nearly all of its own.
  EXPECT_GT(run.last.stored(), 1.85);
  EXPECT_LT(run.last.stored(), 3 * 1.98);
}

TEST(Laws, OfADriverThatWaitsAreFollowed) {
  const auto run = run_of(
      "bodies: {arm: {rigid: {mass: 0.2, inertia: 0.004, center: [0.25, 0]}, points: {A: [0, 0]}}}\n"
      "joints: {p: {revolute: [ground, arm.A]}}\n"
      "drivers: {m: {angle: [ground, arm], law: \"5 deg*step(t, 0.3 s, 0.31 s)*(1 - step(t, 0.33 s, 0.34 s))\"}}\nrun: {until: 1 s}\n");
  EXPECT_EQ(run.status, Status::finished) << run.reason;
}

TEST(Rest, OfAHeldBodyIsNoFault) {
  const auto run = run_of(
      "gravity: [0, -9.81]\nbodies: {arm: {rigid: {mass: 0.162, inertia: 0.003, center: [0.25, 0]}, points: {A: [0, 0]}}}\n"
      "joints: {w: {weld: [ground, arm.A]}}\nrun: {until: 0.1 s}\n");
  EXPECT_EQ(run.status, Status::finished) << run.reason;
}

TEST(Weld, TakesTheWholeTurnsOfThePosesAsTheyAre) {
  std::string text = "bodies:\n";
  for (int i = 0; i < 4; ++i) {
    const double x[] = {0, 0.1, 0.1, 0}, y[] = {0, 0, 0.1, 0.1};
    text += "  b" + std::to_string(i) +
            ":\n    beam: {from: a, to: b, section: {circle: 5 mm}, young: 200 GPa, poisson: 0.3, density: 7800, elements: 4}\n"
            "    points: {a: [0, 0], b: [0.1, 0]}\n    modes: {craig-bampton: {count: 1}}\n    pose: {at: [" +
            std::to_string(x[i]) + ", " + std::to_string(y[i]) + "], angle: " + std::to_string(90 * i) + " deg}\n";
  }
  text += "joints:\n";
  for (int i = 0; i < 4; ++i)
    text += "  w" + std::to_string(i) + ": {weld: [b" + std::to_string(i) + ".b, b" + std::to_string((i + 1) % 4) + ".a], angle: 90 deg}\n";
  const Scene scene = read_scene_text(text + "run: {until: 1 ms}\n", "scene.yaml");
  const Model model = build(scene);
  const auto run = simulate(scene, model, assemble(scene, model));
  EXPECT_EQ(run.status, Status::finished) << run.reason;
  EXPECT_LT(run.first.strain, 1e-9);  // the ring closes unbent
}

TEST(Warning, ComesWhereAWeldClampsNormalModesOfAnotherHolding) {
  const auto warnings = [](const std::string& modes) {
    return build(read_scene_text(arm("    modes: " + modes + "\n", "run: {until: 1 s}\n"), "scene.yaml")).warnings;
  };
  EXPECT_TRUE(warns(warnings("{count: 8}"), "craig-bampton"));
  EXPECT_TRUE(warns(warnings("{frame: chord, count: 8}"), "\"arm.A\" is clamped"));
  EXPECT_FALSE(warns(warnings("{frame: tangent, count: 3}"), "clamped"));
  EXPECT_FALSE(warns(warnings("{craig-bampton: {count: 2}}"), "clamped"));
  EXPECT_FALSE(warns(warnings("{frame: chord, keep: all}"), "clamped"));  // all of them span everything
}

TEST(Warning, ComesWhereRotationStiffensABodyHeldElsewhere) {
  const auto warnings = [](const std::string& frame) {
    return build(read_scene_text(
                     arm("    modes: {frame: " + frame + ", craig-bampton: {count: 2}}\n    stiffening: rotation\n", "run: {until: 1 s}\n"),
                     "scene.yaml"))
        .warnings;
  };
  EXPECT_TRUE(warns(warnings("mean axes"), "use axial"));
  EXPECT_TRUE(warns(warnings("{tangent: B}"), "use axial"));
  EXPECT_FALSE(warns(warnings("{tangent: A}"), "use axial"));
}

}  // namespace
}  // namespace pintle::held_body_test
