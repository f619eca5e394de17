// Events of a scene: what they release and engage, against closed forms.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/integration/integrator.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::event_test {
namespace {

using namespace pintle;

const Method methods[] = {{"dopri5", "dopri5", 1e-9, 1e-7},
                          {"rkf45", "rkf45", 1e-9, 1e-7},
                          {"verner87", "verner87", 1e-9, 1e-7},
                          {"implicit", "generalized-alpha", 1e-7, 1e-4}};

class ByMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Events, ByMethod, testing::ValuesIn(methods), name_of);

double last(const Whole& w, const std::string& column) { return w.run.trajectory.column(column).back(); }
double booked(const Whole& w, const std::string& name) { return w.run.ledger.column(name + " [J]").back(); }

// Two discs on shafts of their own, and what holds them together from 0.1 s on.
std::string clutch(const std::string& events, const std::string& more = "") {
  return R"(
bodies:
  a: {rigid: {mass: 1 kg, inertia: 0.2 kg m^2}, points: {A: [0.1, 0]}}
  b: {rigid: {mass: 1 kg, inertia: 0.3 kg m^2}, points: {B: [0.1, 0]}}
joints:
  bearing a: {revolute: [ground, a]}
  bearing b: {revolute: [ground, b]}
  clutch: {differential: [a, b], ratio: -1, engaged: false}
start: {a: {angle: 0.4, speed: 10 rad/s}, b: {angle: 0, speed: -3 rad/s}}
events: {)" +
         events + "}\nrun: {until: 0.2 s}\n" + more;
}

TEST_P(ByMethod, AClutchLeavesTheSpeedOfTheMomentumAndLosesTheRest) {
  const Whole w = run(clutch("shift: {when: t > 0.1 s, do: {engage: clutch}}"), GetParam());
  expect_sound(w);
  const double together = (0.2 * 10 - 0.3 * 3) / 0.5;
  EXPECT_NEAR(last(w, "a.speed [rad/s]"), together, 1e-9 * 13);
  EXPECT_NEAR(last(w, "b.speed [rad/s]"), together, 1e-9 * 13);
  EXPECT_NEAR(last(w, "a.angle [rad]") - last(w, "b.angle [rad]"), 0.4 + 0.1 * 13, GetParam().near) << "it holds what it has found";
  EXPECT_NEAR(booked(w, "clutch.lost to engaging"), 0.5 * 0.2 * 0.3 / 0.5 * 13 * 13, 1e-9 * 10);
  ASSERT_EQ(w.run.happenings.size(), 1u);
  EXPECT_NEAR(w.run.happenings[0].t, 0.1, 1e-12);
}

TEST_P(ByMethod, AReleasedPendulumFlies) {
  const Whole w = run(R"(
gravity: [0, -9.81]
bodies: {bob: {rigid: {mass: 2 kg, inertia: 0.1 kg m^2}, points: {P: [-1, 0]}}}
joints: {pin: {revolute: [ground, bob.P]}}
start: {bob: {angle: -20 deg, speed: 3 rad/s}}
events: {let go: {when: t > 0.3 s, once: true, do: {release: pin, row: true}}}
run: {until: 0.7 s}
output: {every: 0.1 s}
)",
                      GetParam());
  expect_sound(w);
  const auto& t = w.run.trajectory.column("t [s]");
  const std::size_t at = static_cast<std::size_t>(std::ranges::lower_bound(t, 0.3) - t.begin());
  const auto column = [&](const char* name) { return w.run.trajectory.column(name); };
  const double left = 0.7 - t[at];
  EXPECT_NEAR(column("bob.x [m]").back(), column("bob.x [m]")[at] + left * column("bob.vx [m/s]")[at], GetParam().near);
  EXPECT_NEAR(column("bob.y [m]").back(), column("bob.y [m]")[at] + left * column("bob.vy [m/s]")[at] - 9.81 / 2 * left * left,
              GetParam().near);
  EXPECT_NEAR(column("bob.speed [rad/s]").back(), column("bob.speed [rad/s]")[at], GetParam().near);
  EXPECT_EQ(column("pin.fx on bob [N]").back(), 0);
  EXPECT_GT(std::abs(column("pin.fx on bob [N]")[at - 1]), 1) << "until then it held";
}

// Half the speed of one disc is left to two. The row that is due at that instant shows it before, the event's own row after.
TEST_P(ByMethod, ARowOfAnEventStandsBesideTheOneThatIsDue) {
  const Whole w = run(R"(
bodies:
  a: {rigid: {mass: 1 kg, inertia: 0.1 kg m^2}}
  b: {rigid: {mass: 1 kg, inertia: 0.1 kg m^2}}
joints:
  p: {revolute: [ground, a]}
  q: {revolute: [ground, b]}
  lock: {differential: [a, b], ratio: -1, engaged: false}
start: {a: {speed: 10 rad/s}}
events: {close: {when: t > 0.5 s, once: true, do: {engage: lock, row: true}}}
run: {until: 1 s}
output: {every: 0.25 s}
)",
                      GetParam());
  expect_sound(w);
  EXPECT_EQ(w.run.trajectory.column("t [s]"), (std::vector<double>{0, 0.25, 0.5, 0.5, 0.75, 1}));
  const std::vector<double> speeds{10, 10, 10, 5, 5, 5};
  const auto& speed = w.run.trajectory.column("a.speed [rad/s]");
  ASSERT_EQ(speed.size(), speeds.size());
  for (std::size_t row = 0; row < speeds.size(); ++row) EXPECT_NEAR(speed[row], speeds[row], GetParam().near) << row;
  EXPECT_NEAR(w.run.ledger.column("kinetic [J]")[3], 2.5, GetParam().near);
}

// Ring held: the sun turns 1 + k times for the carrier's one, k = 1.5. Locked: all turn as one.
TEST_P(ByMethod, APlanetaryStageShiftsAsItsInertiasSay) {
  const Whole w = run(R"(
bodies:
  sun: {rigid: {mass: 1 kg, inertia: 0.02 kg m^2}}
  ring: {rigid: {mass: 1 kg, inertia: 0.05 kg m^2}}
  carrier: {rigid: {mass: 1 kg, inertia: 0.4 kg m^2}}
joints:
  s: {revolute: [ground, sun]}
  r: {revolute: [ground, ring]}
  c: {revolute: [ground, carrier]}
  planets: {differential: [sun, ring, carrier], ratio: 1.5}
  lock: {differential: [sun, carrier], ratio: -1, engaged: false}
drivers: {brake: {angle: [ground, ring], law: 0 rad}}
forces: {engine: {torque: 8 N m, on: sun}}
events: {up: {when: carrier.speed > 20 rad/s, once: true, do: {release: brake, engage: lock, row: true}}}
run: {until: 1 s}
output: {every: 0.1 s}
)",
                      GetParam());
  expect_sound(w);
  const double shift = 20 * (0.02 * 2.5 * 2.5 + 0.4) / (8 * 2.5), after = (0.02 * 50 + 0.4 * 20) / 0.47;
  ASSERT_EQ(w.run.happenings.size(), 1u);
  EXPECT_NEAR(w.run.happenings[0].t, shift, GetParam().near * shift);
  const auto t = w.run.trajectory.column("t [s]"), speed = w.run.trajectory.column("sun.speed [rad/s]");
  const auto row = static_cast<std::size_t>(std::ranges::find(t, w.run.happenings[0].t) - t.begin());
  ASSERT_LT(row, t.size());
  EXPECT_NEAR(speed[row], after, 1e-8 * after);
  EXPECT_NEAR(last(w, "ring.speed [rad/s]"), after + 8 / 0.47 * (1 - shift), 10 * GetParam().near * after);
  const double lost = 0.5 * (0.02 * 50 * 50 + 0.4 * 20 * 20 - 0.47 * after * after);
  EXPECT_NEAR(booked(w, "lock.lost to engaging"), lost, 1e-7 * lost);
  EXPECT_EQ(booked(w, "brake.lost to engaging"), 0);
}

// The law of the driver is the speed at once: its impulse does twice the work that is left as energy, and the other half is lost.
TEST_P(ByMethod, ADriverThatIsEngagedBooksItsImpulse) {
  const Whole w = run(R"(
bodies: {rotor: {rigid: {mass: 1 kg, inertia: 0.5 kg m^2}}}
joints: {bearing: {revolute: [ground, rotor]}}
drivers: {motor: {angle: [ground, rotor], law: 6 rad/s*t, engaged: false}}
start: {rotor: {angle: 1, speed: 2 rad/s}}
events: {on: {when: t > 0.25 s, do: {engage: motor}}}
run: {until: 0.5 s}
)",
                      GetParam());
  expect_sound(w);
  EXPECT_NEAR(last(w, "rotor.angle [rad]"), 1 + 0.25 * 2 + 0.25 * 6, GetParam().near) << "it goes on from the angle that it has found";
  EXPECT_NEAR(booked(w, "motor.lost to engaging"), 0.5 * 0.5 * 4 * 4, 1e-9);
  EXPECT_NEAR(booked(w, "motor.work in"), 0.5 * 4 * 6, 1e-9);
}

TEST_P(ByMethod, ASpringThatIsReleasedTakesWhatItHeldWithIt) {
  const Whole w = run(R"(
bodies: {block: {rigid: {mass: 2 kg, inertia: 1 kg m^2}}}
ground: {points: {wall: [-1 m, 0]}}
joints: {guide: {prismatic: [ground, block]}}
forces: {coil: {spring: [ground.wall, block], stiffness: 200 N/m, free length: 1.1 m}}
start: {block: {x: 0}}
events: {cut: {when: block.x > 4 cm, once: true, do: {release: coil}}}
run: {until: 0.2 s}
)",
                      GetParam());
  expect_sound(w);
  const double speed = std::sqrt(200.0 / 2 * (0.1 * 0.1 - 0.06 * 0.06));  // of the swing about x = 0.1
  EXPECT_NEAR(last(w, "block.vx [m/s]"), speed, GetParam().near);
  EXPECT_NEAR(booked(w, "coil.lost to switching"), 0.5 * 200 * 0.06 * 0.06, 1e2 * GetParam().near);
  EXPECT_EQ(last(w, "coil.fx on block [N]"), 0);
}

// A thermostat: up at 2 a second, down at 1 a second, between 0 and 1.
TEST_P(ByMethod, TwoEventsAtTwoLevelsAreAHysteresis) {
  const Whole w = run(R"(
bodies: {rotor: {rigid: {mass: 1 kg, inertia: 0.5 kg m^2}}}
joints: {bearing: {revolute: [ground, rotor]}}
start: {rotor: {speed: 1 rad/s}}
states:
  heater: {rate: 0/(1 s), start: 1}
  warmth: {rate: 3/(1 s)*heater - 1/(1 s), start: 0.5, scale: 1}
events:
  off: {when: warmth > 1, do: {set: {heater: 0}}}
  on: {when: warmth < 0, do: {set: {heater: 1}}}
run: {until: 10 s}
)",
                      GetParam());
  expect_sound(w);
  ASSERT_EQ(w.run.happenings.size(), 13u) << "at 0.25, 1.25, 1.75, 2.75 … 9.25";
  for (std::size_t k = 0; k < w.run.happenings.size(); ++k)
    EXPECT_NEAR(w.run.happenings[k].t, 0.25 + 1.5 * static_cast<double>(k / 2) + (k % 2 == 0 ? 0 : 1), 1e-7) << k;
}

TEST_P(ByMethod, AStopIsLocatedToRounding) {
  const Whole w = run(R"(
bodies: {rotor: {rigid: {mass: 1 kg, inertia: 0.5 kg m^2}}}
joints: {bearing: {revolute: [ground, rotor]}}
start: {rotor: {speed: 2 rad/s}}
events: {full: {when: t > 0.1 s && rotor.angle > 1 rad, do: {stop: it has turned by a radian}}}
run: {until: 3 s}
)",
                      GetParam());
  expect_sound(w);
  EXPECT_EQ(w.run.reason, "it has turned by a radian");
  EXPECT_NEAR(w.run.t_end, 0.5, 1e-12);
}

// Whatever happens between two discs and a torque on one: their angular momentum is that of the torque.
TEST_P(ByMethod, AThousandSwitchingsKeepTheBooks) {
  const Whole w =
      run(clutch("beat: {when: \"sin(1e4*pi*t/(1 s)) > 0.3\", from start: false, do: {engage: clutch}, else: {release: clutch}}",
                 "forces: {engine: {torque: 5 N m, on: a}}\noutput: {every: 0.01 s}"),
          GetParam());
  expect_sound(w);
  EXPECT_EQ(w.run.happenings.size(), 2000u);
  EXPECT_NEAR(0.2 * last(w, "a.speed [rad/s]") + 0.3 * last(w, "b.speed [rad/s]"), 0.2 * 10 - 0.3 * 3 + 5 * 0.2, 1e-6);
  EXPECT_GT(booked(w, "clutch.lost to engaging"), 0.5 * 0.12 * 13 * 13);
}

// A chain so long that its equations are sparse: what is cut off flies, and what is left swings.
TEST_P(ByMethod, AChainIsCutInTwo) {
  std::string bodies, joints;
  for (int i = 0; i < 30; ++i) {
    const std::string link = "l" + std::to_string(i), before = i == 0 ? "ground" : "l" + std::to_string(i - 1) + ".B";
    bodies += "  " + link + ": {rigid: {mass: 0.1 kg, inertia: 1e-4 kg m^2}, points: {A: [-5 cm, 0], B: [5 cm, 0]}, pose: {at: [" +
              number(0.05 + 0.1 * i) + ", 0]}}\n";
    joints += "  p" + std::to_string(i) + ": {revolute: [" + before + ", " + link + ".A]}\n";
  }
  const Whole w =
      run("gravity: [0, -9.81]\nbodies:\n" + bodies + "joints:\n" + joints +
              "events: {cut: {when: l0.angle < -5 deg, once: true, do: {release: p20}}}\nrun: {until: 0.3 s}\noutput: {every: 0.01 s}",
          GetParam());
  expect_sound(w);
  ASSERT_EQ(w.run.happenings.size(), 1u);
  EXPECT_EQ(last(w, "p20.fx on l20 [N]"), 0);
  EXPECT_EQ(last(w, "p20.fy on l20 [N]"), 0);
  double momentum = 0;  // of the ten links that fly
  const auto t = w.run.trajectory.column("t [s]");
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(t, w.run.happenings[0].t) - t.begin());
  for (int i = 20; i < 30; ++i) {
    const auto vy = w.run.trajectory.column("l" + std::to_string(i) + ".vy [m/s]");
    momentum += 0.1 * (vy.back() - vy[after]);
  }
  EXPECT_NEAR(momentum, -9.81 * (t.back() - t[after]), 1e2 * GetParam().near);
}

}  // namespace
}  // namespace pintle_scenes::event_test
