// Rigid bodies that nothing can stop: a run ends there with its reason, and never continues with one body inside another.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/build/build.h"
#include "framework/integration/events/deep_overlap.h"
#include "framework/integration/events/impact_log.h"
#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::pressed_together_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::struck, pintle_scenes::Whole;

const std::vector<std::string> methods{"dopri5", "rkf45", "verner87", "{moreau: {step: 0.1 ms}}"};

// A ram, moved by a driver along x, pushes a block of 0.2 m, with room of `gap` before it, towards a wall at x = 1.
Whole press(const std::string& method, const std::string& laws, double room, const std::string& law, double until) {
  return run(
      "ground: {points: {B: [-1, 0]}, profiles: {wall: {path: [[1, -1], [1, 1]], material: right}}}\nbodies:\n"
      "  ram: {rigid: {mass: 1, inertia: 0.1}, points: {P: [0, 0]}, profiles: {face: {path: [[0, -1], [0, 1]], material: left}}}\n"
      "  block: {rigid: {mass: 1, inertia: 0.01}, points: {P: [0, 0]}, profiles: {back: {disc: [-0.05, 0], radius: 0.05}, nose: "
      "{disc: [0.05, 0], radius: 0.05}}}\n"
      "joints: {g1: {prismatic: [ground, ram.P]}, g2: {prismatic: [ground, block.P]}}\ncontacts:\n" +
      struck("push", "ram.face", "block.back", laws) + struck("stop", "block.nose", "ground.wall", laws) +
      "drivers: {drive: {distance: [ground.B, ram.P], law: \"" + number(1.8 - room) + " m + " + law +
      "\"}}\nstart: {ram: {x: " + number(0.8 - room) + "}, block: {x: " + number(0.9 - room / 2) + "}}\nrun: {until: " + number(until) +
      ", method: " + method + "}\noutput: {every: 10 ms, frames: 0}\n");
}

TEST(PressedTogether, ABlockBetweenADrivenRamAndAWallEndsTheRun) {
  for (const std::string& method : methods)
    for (const std::string laws : {"restitution: 0", "restitution: 0.3", "restitution: 0.3, restitution law: poisson",
                                   "restitution: 0.3, friction: {coulomb: {coefficient: 0.2}}"}) {
      if (method.starts_with("{") && laws.find("poisson") != std::string::npos) continue;  // not taken
      SCOPED_TRACE(method + ", " + laws);
      const Whole w = press(method, laws, 0.2, "1 m/s*t", 1);
      EXPECT_EQ(w.run.status, Status::failed);
      pintle_test::expect_says(w.run.reason, {"contact \"", "driver", "law with a stiffness"});
      EXPECT_LE(w.run.t_end, 0.2 + 0.03);
      EXPECT_LE(w.last("ram.x [m]"), 0.8 + 0.03);
    }
}

// At rest from the start, so that no impact ever occurs.
TEST(PressedTogether, SoDoesABlockThatTheRamBeginsToPush) {
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    const Whole w = press(method, "restitution: 0", 0, "1 m/s^2*t^2", 1);
    EXPECT_EQ(w.run.status, Status::failed);
    pintle_test::expect_says(w.run.reason, {"contact \"", "driver", "law with a stiffness"});
    EXPECT_LE(w.last("ram.x [m]"), 0.8 + 0.03);
  }
}

TEST(PressedTogether, WithRoomItIsPushedAndStopsAtTheWall) {
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    const Whole w = press(method, "restitution: 0", 0.2, "0.195 m*step(t, 0, 1 s)", 1.5);
    expect_sound(w);
    EXPECT_NEAR(w.last("block.x [m]"), 0.9, 1e-3);
  }
}

// A body that stays behind a wall is no closer to it than its surface says, and must be left alone.
TEST(PressedTogether, AStepThatPassesAnOpenContactIsImpossible) {
  const Scene scene = read_scene_text(
      "ground: {profiles: {wall: {path: [[0, -1], [0, 1]], material: right}}}\n"
      "bodies: {ball: {rigid: {mass: 1, inertia: 1e-3}, profiles: {rim: {disc: [0, 0], radius: 0.05}}}}\n"
      "contacts: {hit: {between: [ball.rim, ground.wall], model: impact, restitution: 1}}\nrun: {until: 1}\n",
      "scene.yaml");
  const Model model = build(scene);
  const std::size_t n = model.system.contacts.size();
  const auto why = [&](double from, double to) {
    Step step;
    std::vector<Guard> guards[2];
    const auto put = [&](double x, State& state, std::vector<Guard>& guard) {
      state.y.setZero(model.system.n_y());
      state.y[0] = x;
      state.impact_rate.resize(n);
      state.friction.resize(dry_states(model.system));
      for (std::size_t c = 0; c < n; ++c) guard.push_back(onset_of(model.system, static_cast<int>(c), state));
    };
    put(from, step.from.state, guards[0]), put(to, step.to.state, guards[1]);
    return deep_overlap(model.system, step, guards[0], guards[1], 0);
  };
  pintle_test::expect_says(why(-0.06, -0.04), {"contact \"hit\"", "0.01 m"});
  EXPECT_EQ(why(-0.06, -0.0502), "");
  EXPECT_EQ(why(-0.06, -0.0499), "");
  EXPECT_EQ(why(0.2, 0.3), "");
  EXPECT_EQ(why(0.2, -0.2), "");
}

}  // namespace
}  // namespace pintle::pressed_together_test
