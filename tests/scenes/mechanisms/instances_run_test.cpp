// Mechanisms written by instances: they run as those written by hand, a mirrored one as the mirror image, and closed forms are met.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/scenes/text_runs.h"

namespace pintle_scenes::instances_run_test {
namespace {

pintle::Scene example(const std::string& name, const pintle::Overrides& set = {}) {
  return pintle::read_scene(std::filesystem::path(PINTLE_SOURCE_DIR) / "examples" / name, set);
}

TEST(InstancesRun, AsTheSceneWrittenByHandToTheLastBit) {
  const Whole is = run(R"(
gravity: [0, -9.81]
assemblies:
  arm:
    parameters: {mass: 1 kg, l: 1 m}
    ports: [on]
    bodies: {rod: {rigid: {mass: mass, inertia: mass*l^2/12}, points: {A: [-l/2, 0], B: [l/2, 0]}, pose: {at: [l/2, 0]}}}
    joints: {pin: {revolute: [on, rod.A]}}
    forces: {drive: {torque: mass*l*1 m/s^2*sin(3*t/(1 s)), on: rod}}
    start: {rod: {angle: 0, speed: 1}}
instances:
  upper: {of: arm, ports: {on: ground}}
  lower: {of: arm, at: [1 m, 0], with: {mass: 0.7 kg, l: 0.6 m}, ports: {on: upper rod.B}}
run: {until: 1 s}
)"),
              hand = run(R"(
gravity: [0, -9.81]
bodies:
  upper rod: {rigid: {mass: 1 kg, inertia: 1 kg*(1 m)^2/12}, points: {A: [-0.5, 0], B: [0.5, 0]}, pose: {at: [0.5, 0]}}
  lower rod: {rigid: {mass: 0.7 kg, inertia: 0.7 kg*(0.6 m)^2/12}, points: {A: [-0.3, 0], B: [0.3, 0]}, pose: {at: [1 m + 0.3 m, 0]}}
joints: {upper pin: {revolute: [ground, upper rod.A]}, lower pin: {revolute: [upper rod.B, lower rod.A]}}
forces:
  upper drive: {torque: 1 kg*1 m*1 m/s^2*sin(3*t/(1 s)), on: upper rod}
  lower drive: {torque: 0.7 kg*0.6 m*1 m/s^2*sin(3*t/(1 s)), on: lower rod}
start: {upper rod: {angle: 0, speed: 1}, lower rod: {angle: 0, speed: 1}}
run: {until: 1 s}
)");
  EXPECT_EQ(is.run.trajectory.header, hand.run.trajectory.header);
  EXPECT_EQ(is.run.trajectory.data, hand.run.trajectory.data);
}

TEST(InstancesRun, AgainFromWhatIsKeptToTheLastBit) {
  const pintle::Scene scene = example("walker.yaml", {{"run.until", "0.2 s"}, {"output.frames", "0"}});
  const Whole first = run(scene), again = run(scene.filled_in);
  EXPECT_EQ(first.run.trajectory.header, again.run.trajectory.header);
  EXPECT_EQ(first.run.trajectory.data, again.run.trajectory.data);
}

/// A pendulum with a driver, springs, a torque and a ball that bounces in a trough, beside its mirror image.
TEST(InstancesRun, AMirroredInstanceMovesAsItsMirrorImage) {
  const Whole w = run(R"(
gravity: [0, -9.81]
assemblies:
  machine:
    ground: {points: {P: [1, 2]}, profiles: {trough: {path: [[-0.2, 1.2], {arc: 1}, [0.8, 0.8], [1.3, 1.1]], material: right}}}
    bodies:
      bar: {rigid: {mass: 1, inertia: 0.1, center: [0.1, 0.05]}, points: {A: [-0.5, 0], B: [0.5, 0.1]}, pose: {at: [1.4, 1.7], angle: -30 deg}}
      rod: {rigid: {mass: 0.5, inertia: 0.02}, points: {A: [-0.25, 0], B: [0.25, 0]}, pose: {at: [2, 1.2], angle: -60 deg}}
      ball: {rigid: {mass: 0.2, inertia: 1e-3}, profiles: {rim: {disc: [0, 0], radius: 50 mm}}, pose: {at: [0.6, 1.1]}}
    joints: {pin: {revolute: [ground.P, bar.A]}, elbow: {revolute: [bar.B, rod.A]}}
    drivers: {swing: {angle: [bar, rod], law: -30 deg + 20 deg*sin(4*t/(1 s))}}
    forces:
      twist: {torque: 0.3 N m, on: bar}
      hair: {torsion spring: [ground, bar], stiffness: 2, damping: 0.1, free angle: -20 deg}
      coil: {spring: [ground.P, rod.B], stiffness: 30, free length: 1}
      wind: {force: [0.5 N, 0.1 N], at: rod.B}
    contacts: {bounce: {between: [ball.rim, ground.trough], normal: {hunt-crossley: {restitution: 0.7, stiffness: 1e6}}, friction: {tanh: {coefficient: 0.2}}}}
    start: {bar: {angle: -30 deg, speed: 1}, ball: {at: [0.6, 1.1], velocity: [0.3, 0], speed: 2}}
instances: {right: {of: machine}, left: {of: machine, mirror: x}}
run: {until: 0.8 s, tolerance: 1e-10}
output: {points: [right rod.B, left rod.B]}
)");
  expect_sound(w);
  const auto expect_image = [&](const std::string& name, double sign, double near) {
    const std::vector<double> right = w.column("right " + name);
    const std::size_t on = name.find("on ");
    std::string image = "left " + name;
    if (on != std::string::npos) image.replace(image.find("right", 5), 5, "left");
    const std::vector<double> left = w.column(image);
    for (std::size_t row = 0; row < right.size(); row += 20) EXPECT_NEAR(left[row], sign * right[row], near) << name << ", row " << row;
  };
  expect_image("rod.B.x [m]", -1, 1e-8);
  expect_image("rod.B.y [m]", 1, 1e-8);
  expect_image("ball.x [m]", -1, 1e-6);
  expect_image("ball.speed [rad/s]", -1, 1e-4);
  expect_image("swing.torque on right rod [N m]", -1, 1e-5);
}

/// What goes straight in an in-line four balances in the first order: the bearing feels 4 m d²/dt² sqrt(l² − r² sin²θ).
TEST(InstancesRun, AFourCylinderEngineIsUnbalancedInTheSecondOrder) {
  const Whole w = run(example("engine_four.yaml", {{"run.until", "20 ms"}, {"output.frames", "0"}}));
  expect_sound(w);
  const double r = 0.04, l = 0.14, m = 0.4 + 0.5 / 3, omega = 100 * 3.14159265358979323846;
  const std::vector<double> t = w.column("t [s]"), force = w.column("main bearing.fy on crankshaft [N]");
  for (std::size_t row = 0; row < t.size(); row += 10) {
    const double angle = omega * t[row], s = std::sin(angle), c = std::cos(angle);
    const double root = std::sqrt(l * l - r * r * s * s), slope = -r * r * s * c / root;
    EXPECT_NEAR(force[row], -4 * m * omega * omega * (r * r * (c * c - s * s) + slope * slope) / root, 1e-5 * 2557);
  }
  EXPECT_NEAR(force.front(), -2557, 1);
}

TEST(InstancesRun, AMirroredSuspensionHeavesWithoutRolling) {
  const Whole w = run(example("double_wishbone.yaml", {{"run.until", "0.5 s"}, {"output.frames", "0"}}));
  expect_sound(w);
  const std::vector<double> roll = w.column("chassis.angle [rad]"), y = w.column("chassis.y [m]"),
                            left = w.column("left upright.angle [rad]"), right = w.column("right upright.angle [rad]");
  for (std::size_t row = 0; row < roll.size(); ++row) {
    EXPECT_NEAR(roll[row], 0, 1e-9);
    EXPECT_NEAR(left[row] + right[row], 3.14159265358979323846, 1e-9);
  }
  EXPECT_GT(*std::ranges::max_element(y) - *std::ranges::min_element(y), 1e-3);
}

TEST(DrawnJournal, StartsWhereItIsDrawn) {
  const auto scene = [](const std::string& y, const std::string& more) {
    return pintle::read_scene_text(
        "gravity: [0, -9.81]\nbodies: {bob: {rigid: {mass: 1, inertia: 0.1}, points: {A: [0, 0]}, pose: {at: [0, " + y +
            "]}}}\njoints: {pin: {revolute: [ground, bob.A], clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: ground, "
            "normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}}}\n" +
            more + "run: {until: 1 us}\n",
        "scene.yaml");
  };
  const auto begins = [&](const pintle::Scene& s) { return run(s).column("bob.y [m]").front(); };
  const auto doubted = [&](const pintle::Scene& s) {
    return std::ranges::any_of(run(s).run.warnings,
                               [](const std::string& w) { return w.find("the journal is drawn") != std::string::npos; });
  };
  EXPECT_NEAR(begins(scene("-0.09 mm", "")), -0.09e-3, 1e-12);
  EXPECT_NEAR(begins(scene("-0.09 mm", "start: {pin: {eccentricity: [0, 0.05 mm]}}\n")), 0.05e-3, 1e-12);
  EXPECT_NEAR(begins(scene("-0.2 mm", "")), 0, 1e-12);
  EXPECT_FALSE(doubted(scene("-0.2 mm", "")));
  EXPECT_TRUE(doubted(scene("-20 mm", "")));
}

TEST(DrawnPose, ThatIsLeftFarBehindIsTold) {
  const auto doubts = [](const std::string& pose) {
    return run("bodies: {crank: {rigid: {mass: 1, inertia: 1}, points: {A: [1, 0]}}, rod: {rigid: {mass: 1, inertia: 1}, points: {A: [-1, "
               "0], B: [1, 0]}, pose: {" +
               pose +
               "}}}\njoints: {a: {revolute: [ground, crank]}, b: {revolute: [crank.A, rod.A]}, c: {slot: [ground, rod.B]}}\n"
               "start: {crank: {angle: 60 deg}}\nrun: {until: 1 us}\n")
        .assembly.doubts;
  };
  EXPECT_TRUE(doubts("at: [1.4, 0.4], angle: -25 deg").empty());
  const std::vector<std::string> far = doubts("at: [1.4, 40], angle: -25 deg");
  ASSERT_EQ(far.size(), 1u);
  for (const char* part : {"\"rod\"", "moved by", "pose"}) EXPECT_NE(far.front().find(part), std::string::npos) << far.front();
}

TEST(Drivers, OfOneFreedomThatAgreeAreNamedTogether) {
  const Whole w = run(
      "bodies: {crank: {rigid: {mass: 1, inertia: 1}}}\njoints: {a: {revolute: [ground, crank]}}\n"
      "drivers: {left motor: {angle: [ground, crank], law: 3*t}, right motor: {angle: [ground, crank], law: 3*t}}\nrun: {until: 0.1 s}\n");
  EXPECT_TRUE(std::ranges::any_of(w.run.warnings, [](const std::string& s) {
    return s.find("the drivers \"left motor\" and \"right motor\" drive the same degree of freedom") != std::string::npos;
  }));
}

}  // namespace
}  // namespace pintle_scenes::instances_run_test
