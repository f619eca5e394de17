// Dry friction in ideal joints, under what they bear, in whole runs: against closed forms and an integration of its own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::joint_friction_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;
using pintle_test::expect_refused;

constexpr double g = 9.81;

const std::array methods{Method{"Dopri5", "dopri5", 1e-9, 1e-7}, Method{"Rkf45", "rkf45", 1e-9, 1e-7},
                         Method{"Verner87", "verner87", 1e-9, 1e-7}, Method{"GeneralizedAlpha", "generalized-alpha", 1e-8, 2e-4}};

constexpr double rounding = 1e-15;  ///< what is held has no energy in play [J]

class JointFriction : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(By, JointFriction, testing::ValuesIn(methods), pintle_scenes::name_of);

// A wheel in its bearing is stopped by μ r m g, and stays.
TEST_P(JointFriction, AWheelRunsOut) {
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {wheel: {rigid: {mass: 3, inertia: 0.02}}}\n"
          "joints: {axle: {revolute: [ground, wheel], friction: {coulomb: {coefficient: 0.1, static: 0.15}, radius: 20 mm}}}\n"
          "start: {wheel: {speed: 5}}\nrun: {until: 3}\noutput: {every: 10 ms}\n",
          GetParam());
  expect_sound(w, rounding);
  const double slows = 0.1 * 0.02 * 3 * g / 0.02, stops = 5 / slows;
  const std::vector<double> t = w.column("t [s]"), speed = w.column("wheel.speed [rad/s]");
  for (std::size_t i = 0; i < t.size(); ++i)
    ASSERT_NEAR(speed[i], t[i] < stops ? 5 - slows * t[i] : 0, 5 * 10 * GetParam().near) << "t = " << t[i];
  EXPECT_NEAR(w.last("wheel.speed [rad/s]"), 0, 1e-15);
  EXPECT_NEAR(w.ledger("axle.lost to friction [J]"), 0.5 * 0.02 * 25, 10 * GetParam().near);
  EXPECT_NEAR(w.last("axle.load [N]"), 3 * g, 1e-9);
  EXPECT_NEAR(w.column("axle.friction [N]").front(), -0.1 * 3 * g, 1e-9);
}

// A pendulum's pin is pressed by what swings, its acceleration included: integrated here by itself.
TEST_P(JointFriction, APendulumIsSlowedByWhatItsPinBears) {
  constexpr double m = 2, l = 0.5, J = 0.04, r = 0.03, mu = 0.3, start = 1.2;
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {bob: {rigid: {mass: 2, inertia: 0.04}, points: {P: [0, 0.5]}}}\n"
          "joints: {pin: {revolute: [ground, bob.P], friction: {coulomb: {coefficient: 0.3}, radius: 30 mm}}}\n"
          "start: {bob: {angle: 1.2}}\nrun: {until: 1.4}\noutput: {every: 0.1}\n",
          GetParam());
  expect_sound(w, rounding);
  double theta = start, rate = 0;
  const auto accel = [&](double th, double om, double direction) {
    double a = -m * g * l * std::sin(th) / (J + m * l * l);
    for (int i = 0; i < 60; ++i) {  // N of the acceleration that it makes
      const double N = m * std::hypot(g * std::cos(th) + l * om * om, g * std::sin(th) + l * a);
      a = (-m * g * l * std::sin(th) - direction * mu * r * N) / (J + m * l * l);
    }
    return a;
  };
  const std::vector<double> t = w.column("t [s]"), angle = w.column("bob.angle [rad]");
  const double h = 1e-5;
  std::size_t row = 1;
  double direction = -1, now = 0;
  for (long i = 1; row < t.size(); ++i) {
    const auto slope = [&](double th, double om) { return std::array{om, accel(th, om, direction)}; };
    const auto k1 = slope(theta, rate), k2 = slope(theta + h / 2 * k1[0], rate + h / 2 * k1[1]),
               k3 = slope(theta + h / 2 * k2[0], rate + h / 2 * k2[1]), k4 = slope(theta + h * k3[0], rate + h * k3[1]);
    theta += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]);
    rate += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]);
    if (direction * rate < 0) direction = -direction;  // gravity is more than friction at its turning points
    now = static_cast<double>(i) * h;
    if (std::abs(now - t[row]) < h / 2) {
      ASSERT_NEAR(angle[row], theta, 1e-5 + 30 * GetParam().near) << "t = " << now;
      ++row;
    }
  }
}

// It stays where m g l sin θ is less than μ_s r m g, and goes from a little beyond.
TEST_P(JointFriction, APendulumStaysInItsFriction) {
  const auto last = [&](double angle) {
    const Whole w =
        run("gravity: [0, -9.81]\nbodies: {bob: {rigid: {mass: 2, inertia: 0.04}, points: {P: [0, 0.5]}}}\n"
            "joints: {pin: {revolute: [ground, bob.P], friction: {coulomb: {coefficient: 0.3, static: 0.4}, radius: 30 mm}}}\n"
            "start: {bob: {angle: " +
                number(angle) + "}}\nrun: {until: 0.5}\noutput: {every: 10 ms}\n",
            GetParam());
    expect_sound(w, rounding);
    return w.last("bob.angle [rad]") - angle;
  };
  const double limit = std::asin(0.4 * 0.03 / 0.5);
  EXPECT_NEAR(last(0.98 * limit), 0, 1e-13);
  EXPECT_LT(last(1.02 * limit), -1e-4);
}

// At the end of a swing it is held, however little inertia it has about its middle: ends at 2 δ − θ₀ with δ = μ r/l.
TEST_P(JointFriction, ACompactPendulumIsHeldAtTheEndOfItsSwing) {
  for (const double inertia : {1e-4, 1e-6, 1e-9}) {
    SCOPED_TRACE(inertia);
    const double start = 0.005, offset = 0.2 * 0.01 / 0.5;
    const Whole w = run("gravity: [0, -9.81]\nbodies: {bob: {rigid: {mass: 1, inertia: " + number(inertia) +
                            "}, points: {P: [0, 0.5]}}}\n"
                            "joints: {pin: {revolute: [ground, bob.P], friction: {coulomb: {coefficient: 0.2}, radius: 10 mm}}}\n"
                            "start: {bob: {angle: " +
                            number(start) + "}}\nrun: {until: 3}\noutput: {every: 0.1}\n",
                        GetParam());
    expect_sound(w);
    EXPECT_NEAR(w.last("bob.angle [rad]"), 2 * offset - start, 1e-3 * start);
    EXPECT_NEAR(w.last("bob.speed [rad/s]"), 0, 1e-12);
  }
}

// As does a bucket that hangs on an arm which lifts it: with both pins rough, and masses in points.
TEST_P(JointFriction, ACompactBucketSwingsOnARoughArm) {
  for (const double inertia : {1e-1, 1e-4, 1e-7}) {
    SCOPED_TRACE(inertia);
    const Whole w =
        run("gravity: [0, -9.81]\nbodies:\n  arm: {rigid: {mass: 10, inertia: 0.3}, points: {O: [-0.3, 0], E: [0.3, 0]}, pose: {at: [0.3, "
            "0]}}\n"
            "  bucket: {rigid: {mass: 5, inertia: " +
                number(inertia) +
                "}, points: {P: [0, 0.2]}, pose: {at: [0.6, -0.2]}}\n"
                "joints:\n  h: {revolute: [ground, arm.O], friction: {coulomb: {coefficient: 0.2}, radius: 20 mm}}\n"
                "  p: {revolute: [arm.E, bucket.P], friction: {coulomb: {coefficient: 0.2}, radius: 15 mm}}\n"
                "drivers: {d: {angle: [ground, arm], law: \"0.5*step(t, 0, 1 s)\"}}\nrun: {until: 10}\noutput: {every: 0.1}\n",
            GetParam());
    expect_sound(w);
    EXPECT_NEAR(w.last("bucket.speed [rad/s]"), 0, 1e-9);
    EXPECT_LT(std::abs(w.last("bucket.angle [rad]")), 1.01 * 0.2 * 0.015 / 0.2);  // the pin holds no more
    const std::vector<double> t = w.column("t [s]"), couple = w.column("h.friction [N]");
    for (std::size_t i = 0; i < t.size(); ++i)
      EXPECT_TRUE(t[i] < 1.05 || couple[i] * couple.back() > 0) << "the arm stands, whatever the bucket does: " << t[i];
  }
}

// A drawer pushed off its middle by h jams in its guide of length L where 2 μ h/L > 1, however hard the push.
TEST_P(JointFriction, ADrawerJamsWherePushedTooFarFromItsMiddle) {
  const auto moved = [&](double h, double push) {
    const Whole w = run("bodies: {drawer: {rigid: {mass: 1, inertia: 0.01}, points: {H: [0, " + number(h) +
                            "]}}}\n"
                            "joints: {guide: {prismatic: [ground, drawer], friction: {coulomb: {coefficient: 0.4}, length: 0.2}}}\n"
                            "forces: {push: {force: [" +
                            number(push) + ", 0], at: drawer.H}}\nrun: {until: 0.2}\noutput: {every: 10 ms}\n",
                        GetParam());
    expect_sound(w, rounding);
    return w.last("drawer.x [m]");
  };
  for (const double push : {1.0, 100.0}) {
    EXPECT_NEAR(moved(0.26, push), 0, 1e-13);
    const double a = push * (1 - 0.4 * 2 * 0.15 / 0.2);
    EXPECT_NEAR(moved(0.15, push), a * 0.02, 10 * GetParam().near * a);
  }
}

// A preload rubs without load; in a slot.
TEST_P(JointFriction, APreloadedPinInASlotStops) {
  const Whole w =
      run("bodies: {pin: {rigid: {mass: 0.5, inertia: 1e-4}}}\n"
          "joints: {slot: {slot: [ground, pin], friction: {coulomb: {coefficient: 0.2}, preload: 10 N}}}\n"
          "start: {pin: {vx: 1}}\nrun: {until: 0.5}\noutput: {every: 10 ms}\n",
          GetParam());
  expect_sound(w, rounding);
  EXPECT_NEAR(w.last("pin.x [m]"), 0.5 * 1 / (2 * 0.2 * 10), 10 * GetParam().near);
  EXPECT_NEAR(w.last("pin.vx [m/s]"), 0, 1e-13);
}

// A slider-crank all of whose joints rub: what holds it is shared among them, then it goes, and the books close.
std::string slider_crank(const std::string& torque) {
  const std::string pin = "friction: {coulomb: {coefficient: 0.15, static: 0.2}, radius: 10 mm, preload: 5}";
  return "gravity: [0, -9.81]\nbodies:\n  crank: {rigid: {mass: 0.3, inertia: 1e-4, center: [25 mm, 0]}, points: {A: [50 mm, 0]}}\n"
         "  rod: {rigid: {mass: 0.2, inertia: 4e-4, center: [60 mm, 0]}, points: {B: [120 mm, 0]}}\n  slider: {rigid: {mass: 0.4, inertia: "
         "1e-4}}\n"
         "joints:\n  axle: {revolute: [ground, crank], " +
         pin + "}\n  big end: {revolute: [crank.A, rod], " + pin +
         "}\n"
         "  small end: {revolute: [rod.B, slider], " +
         pin +
         "}\n"
         "  guide: {prismatic: [ground, slider], friction: {coulomb: {coefficient: 0.15}, length: 40 mm, preload: 2}}\n"
         "forces: {motor: {torque: " +
         torque + ", on: crank}}\nstart: {crank: {angle: 0.6}}\nrun: {until: 0.6}\noutput: {every: 5 ms}\n";
}
TEST_P(JointFriction, ASliderCrankIsHeldByAllItsJointsThenGoes) {
  const Whole held = run(slider_crank("0.12"), GetParam());
  expect_sound(held, rounding);
  EXPECT_NEAR(held.last("crank.angle [rad]"), 0.6, 1e-12);
  const Whole w = run(slider_crank("0.8 N m/s*t"), GetParam());
  expect_sound(w, rounding);
  const Whole reference = run(slider_crank("0.8 N m/s*t"), {"", "dopri5", 1e-11, 0});
  EXPECT_GT(std::abs(w.last("crank.angle [rad]") - 0.6), 0.1);
  EXPECT_NEAR(w.last("crank.angle [rad]"), reference.last("crank.angle [rad]"), 500 * GetParam().near);
  EXPECT_GT(w.ledger("big end.lost to friction [J]"), 0);
}

TEST(BadJointFriction, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    std::string joint, key, says;
  };
  const std::string law = "coulomb: {coefficient: 0.3}";
  for (const Bad& bad : std::vector<Bad>{
           {"revolute: [ground, a], friction: {" + law + "}", "joints.j.friction", "add for example radius"},
           {"prismatic: [ground, a], friction: {" + law + "}", "joints.j.friction", "add for example length"},
           {"revolute: [ground, a], friction: {" + law + ", radius: 1 cm, length: 2 cm}", "friction.length",
            "does not belong to a revolute"},
           {"revolute: [ground, a], friction: {radius: 1 cm}", "joints.j.friction", "add for example coulomb"},
           {"revolute: [ground, a], friction: {ambrosio: {coefficient: 0.1}, radius: 1 cm}", "friction.ambrosio", "unknown key"},
           {"revolute: [ground, a], friction: {" + law + ", radius: 1 cm, preload: -1}", "friction.preload", "must not be negative"},
           {"weld: [ground, a], friction: {" + law + "}", "joints.j.friction", "weld"},
           {"revolute: [ground, a], friction: {" + law +
                ", radius: 1 cm}, clearance: {radial: 1 mm, bearing radius: 1 cm, bearing: a, normal: {hertz: {stiffness: 1e9}}}",
            "joints.j.friction", "has a clearance"}}) {
    SCOPED_TRACE(bad.joint);
    const std::string text = "bodies: {a: {rigid: {mass: 1, inertia: 1}}}\njoints: {j: {" + bad.joint + "}}\nrun: {until: 1}\n";
    expect_refused([&] { build(read_scene_text(text, "scene.yaml")); }, {bad.key, bad.says});
  }
}

}  // namespace
}  // namespace pintle::joint_friction_test
