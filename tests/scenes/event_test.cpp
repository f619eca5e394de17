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

}  // namespace
}  // namespace pintle_scenes::event_test
