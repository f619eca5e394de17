// Signals, states, outputs and events of assemblies: each instance has its own, as if they were written by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/scene/error.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::instances_signal_test {
namespace {

constexpr const char* servo = R"yaml(
assemblies:
  servo:
    parameters: {target: 30 deg, gain: 4 N m/rad}
    bodies: {arm: {rigid: {mass: 1 kg, inertia: 0.02}}}
    joints: {bearing: {revolute: [ground, arm]}}
    drivers: {stop: {angle: [ground, arm], law: 0 rad, engaged: false}}
    states: {integral: {rate: target - arm.angle, start: 0 rad s}, phase: {rate: "0/(1 s)", start: 0}}
    forces: {motor: {torque: "gain*(target - arm.angle) + 0.5*gain/(1 s)*integral - 0.3 N m s*arm.speed", on: arm}}
    events: {there: {when: arm.angle > 0.9*target, once: true, do: {set: {phase: phase + 1}, engage: stop}}}
    outputs: {power: motor.torque*arm.speed, twice: 2*power}
)yaml";

TEST(InstancesSignal, AreThoseWrittenByHandToTheLastBit) {
  const pintle::Scene scene = pintle::read_scene_text(std::string(servo) + R"y(
instances: {slow: {of: servo}, fast: {of: servo, with: {gain: 9 N m/rad, target: 50 deg}}}
run: {until: 1 s}
)y",
                                                      "scene.yaml");
  const Whole is = run(scene), hand = run(R"yaml(
bodies: {slow arm: {rigid: {mass: 1 kg, inertia: 0.02}}, fast arm: {rigid: {mass: 1 kg, inertia: 0.02}}}
joints: {slow bearing: {revolute: [ground, slow arm]}, fast bearing: {revolute: [ground, fast arm]}}
drivers:
  slow stop: {angle: [ground, slow arm], law: 0 rad, engaged: false}
  fast stop: {angle: [ground, fast arm], law: 0 rad, engaged: false}
states:
  slow integral: {rate: (30 deg) - slow arm.angle, start: 0 rad s}
  slow phase: {rate: "0/(1 s)", start: 0}
  fast integral: {rate: (50 deg) - fast arm.angle, start: 0 rad s}
  fast phase: {rate: "0/(1 s)", start: 0}
forces:
  slow motor: {torque: "(4 N m/rad)*((30 deg) - slow arm.angle) + 0.5*(4 N m/rad)/(1 s)*slow integral - 0.3 N m s*slow arm.speed", on: slow arm}
  fast motor: {torque: "(9 N m/rad)*((50 deg) - fast arm.angle) + 0.5*(9 N m/rad)/(1 s)*fast integral - 0.3 N m s*fast arm.speed", on: fast arm}
events:
  slow there: {when: slow arm.angle > 0.9*(30 deg), once: true, do: {set: {slow phase: slow phase + 1}, engage: slow stop}}
  fast there: {when: fast arm.angle > 0.9*(50 deg), once: true, do: {set: {fast phase: fast phase + 1}, engage: fast stop}}
outputs:
  slow power: slow motor.torque*slow arm.speed
  slow twice: 2*slow power
  fast power: fast motor.torque*fast arm.speed
  fast twice: 2*fast power
run: {until: 1 s}
)yaml");
  EXPECT_EQ(is.run.trajectory.header, hand.run.trajectory.header);
  EXPECT_EQ(is.run.trajectory.data, hand.run.trajectory.data);
  const Whole again = run(scene.filled_in);
  EXPECT_EQ(again.run.trajectory.data, is.run.trajectory.data);
}

TEST(InstancesSignal, NumberTheirCopies) {
  const Whole is = run(R"y(
bodies: {wheel: {repeat: 3, rigid: {mass: 1 kg, inertia: 0.02}}}
joints: {bearing: {repeat: 3, revolute: [ground, "wheel {index}"]}}
forces:
  drag: {repeat: 3, torque: "-index*1 N m s*wheel {index}.speed", on: "wheel {index}"}
start: {wheel 1: {speed: 10 rad/s}, wheel 2: {speed: 10 rad/s}, wheel 3: {speed: 10 rad/s}}
run: {until: 20 ms, tolerance: 1e-10}
output: {every: 20 ms}
)y");
  for (int i = 1; i <= 3; ++i)  // J ω' = -i c ω
    EXPECT_NEAR(is.last("wheel " + std::to_string(i) + ".speed [rad/s]"), 10 * std::exp(-i * 0.02 / 0.02), 1e-7);
}

TEST(InstancesSignal, OfAMirroredInstanceAreRefused) {
  pintle_test::expect_refused([] { run(std::string(servo) + "instances: {left: {of: servo, mirror: x}}\nrun: {until: 1 s}\n"); },
                              {"scene.yaml:", "mirrored", "left"});
}

}  // namespace
}  // namespace pintle_scenes::instances_signal_test
