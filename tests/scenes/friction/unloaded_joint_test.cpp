// Rough joints that carry no load but that of a contact which begins and ends: before and after it they move freely.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/scenes/text_runs.h"

namespace pintle::unloaded_joint_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::run, pintle_scenes::Whole;

const std::vector<Method> methods{
    {"dopri5", "dopri5", 1e-8, 1e-6},
    {"rkf45", "rkf45", 1e-8, 1e-6},
    {"verner87", "verner87", 1e-8, 1e-6},
    {"alpha", "generalized-alpha", 1e-6, 1e-3},
};
class UnloadedJoint : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(All, UnloadedJoint, testing::ValuesIn(methods), pintle_scenes::name_of);

const std::string ball =
    "  ball: {rigid: {mass: 0.1, inertia: 1e-4}, profiles: {rim: {disc: [0, 0], radius: 0.05}}}\n"
    "contacts: {hit: {between: [part.top, ball.rim], normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e6 N/m^1.5}}}}\n";

// The slider loses μ times the ball's impulse.
TEST_P(UnloadedJoint, ASliderIsBrakedOnlyByTheBlowOfABall) {
  const Whole w =
      run("bodies:\n  part: {rigid: {mass: 1, inertia: 0.01}, points: {P: [0, 0]}, profiles: {top: {path: [[-1, 0.1], [1, 0.1]], "
          "material: right}}}\n" +
              ball +
              "joints: {guide: {prismatic: [ground, part.P], friction: {coulomb: {coefficient: 0.2}, length: 1000}}}\n"
              "start: {part: {vx: 0.5}, ball: {at: [0.1, 0.2], velocity: [0, -1]}}\nrun: {until: 0.2}\noutput: {every: 1 ms, "
              "frames: 0}\n",
          GetParam());
  expect_sound(w);
  const double impulse = 0.1 * (1 + w.last("ball.vy [m/s]"));
  EXPECT_GT(impulse, 0.14);
  EXPECT_NEAR(w.last("part.vx [m/s]"), 0.5 - 0.2 * impulse, 0.02 * 0.2 * impulse);  // the guide's couple adds 1e-3
}

TEST_P(UnloadedJoint, AnArmIsStruckAndTurnsOn) {
  const Whole w =
      run("bodies:\n  part: {rigid: {mass: 1, inertia: 0.05}, points: {O: [0, 0]}, profiles: {top: {path: [[-0.5, 0.02], [0.5, "
          "0.02]], material: right}}}\n" +
              ball +
              "joints: {pivot: {revolute: [ground, part.O], friction: {coulomb: {coefficient: 0.2}, radius: 20 mm}}}\n"
              "start: {ball: {at: [0.3, 0.2], velocity: [0, -1]}}\nrun: {until: 0.3}\noutput: {every: 1 ms, frames: 0}\n",
          GetParam());
  expect_sound(w);
  // About the pivot: the ball's moment of momentum, 0.3 m from it, less friction of μ r times the impulse.
  const double impulse = 0.1 * (1 + w.last("ball.vy [m/s]"));
  EXPECT_GT(impulse, 0.1);
  EXPECT_NEAR(w.last("part.speed [rad/s]"), -(0.3 - 0.2 * 0.02) * impulse / 0.05, 1e-2 * 6 * impulse);
}

}  // namespace
}  // namespace pintle::unloaded_joint_test
