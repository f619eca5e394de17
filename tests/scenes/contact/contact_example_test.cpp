// Examples with contacts: each comes to the number that its head promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/oracles/woodpecker.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::contact_example_test {
namespace {

using pintle_scenes::at, pintle_scenes::expect_sound, pintle_scenes::impacts, pintle_scenes::run, pintle_scenes::Whole;

constexpr double degree = M_PI / 180;

Scene example(const std::string& name) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/" + name + ".yaml");
  s.output.frames = 0;
  return s;
}
double most(const std::vector<double>& x) {
  double out = 0;
  for (const double each : x) out = std::max(out, std::abs(each));
  return out;
}

// Half-way through a slot the pin is at a − b from the wheel's axis and goes straight past it. Rows are 2 ms apart: there the speed is
// less by ½ w'' (1 ms)², w'' = w³ k (1 + k)/(1 − k)³ with k = b/a.
TEST(ContactExample, AGenevaWheelGoesAQuarterATurn) {
  const Whole w = run(example("geneva"));
  expect_sound(w);
  const double speed = 2 * M_PI, k = std::sqrt(0.5), fastest = speed * k / (1 - k);
  const double between = std::pow(speed, 3) * k * (1 + k) / std::pow(1 - k, 3) * 1e-6 / 2;
  EXPECT_NEAR(most(w.column("wheel.speed [rad/s]")), fastest, between + 1e-3 * fastest);  // a pin with 0.1 mm of play in its slot
  const double held = 0.1e-3 / 55e-3;                                                     // by the play of the locking disc
  for (int turn = 1; turn <= 3; ++turn) EXPECT_NEAR(at(w, "wheel.angle [rad]", turn), -turn * M_PI / 2, held) << turn;
}

// At the end of each swing the holding pawl stands in the next tooth.
TEST(ContactExample, ARatchetGainsAToothASwing) {
  const Whole w = run(example("ratchet"));
  expect_sound(w);
  const double step = 1e-4;
  for (int swing = 1; swing < 5; ++swing)  // the nose lies at the root of a tooth, as it did
    EXPECT_NEAR(at(w, "wheel.angle [rad]", swing + 1) - at(w, "wheel.angle [rad]", swing), 45 * degree, 1e-9) << swing;
  const double turned = w.last("wheel.angle [rad]") - at(w, "wheel.angle [rad]", 0);
  EXPECT_NEAR(turned, 225 * degree, 0.2 * degree);  // the start is 1.3° before the root, as near as its tip stands
  EXPECT_NEAR(w.ledger("lifted.work in [J]"), -5 * turned, 5 * most(w.column("wheel.speed [rad/s]")) * step * 100);
}

// The lever past its dead centre by 3°, the link by asin(r sin 3°/l): the spring of the pad has what is left of its 0.5 mm.
TEST(ContactExample, AToggleClampHoldsUntilItIsOpened) {
  const Whole w = run(example("latch"));
  expect_sound(w);
  const double r = 0.04, l = 0.06, k = 1e6, over = 3 * degree, link = std::asin(r * std::sin(over) / l);
  const double pressed = k * (0.5e-3 - (r + l - r * std::cos(over) - l * std::cos(link)));
  EXPECT_NEAR(pressed, 408.6, 0.05);
  EXPECT_NEAR(at(w, "lever.angle [rad]", 1), -over, 1e-9);
  EXPECT_NEAR(at(w, "clamping.normal [N]", 1), pressed, 1e-6 * pressed);
  const double opens = pressed * r * std::sin(over + link) / std::cos(link) / 0.15, when = 1 + opens / 20;
  const std::vector<Impact> stop = impacts(w, "past centre");
  ASSERT_FALSE(stop.empty());
  EXPECT_NEAR(stop.back().end, when, 1e-6);  // the lever then leaves its stop
  EXPECT_GT(w.last("lever.angle [rad]"), 0);
}

// In its middle, between the changes of legs, it goes a turn's way in each turn of its cranks.
TEST(ContactExample, AWalkerGoesItsTwoStepsATurn) {
  Scene s = example("walker");
  s.run.tolerance = 1e-8;
  const Whole w = run(std::move(s));
  expect_sound(w);
  const double e = 0.015, h = 0.06, l = 0.08, f = 0.005;
  const double turn = 2 * (2 * e * (1 + l / std::hypot(e, h)) + 2 * f * std::atan2(e, h));
  EXPECT_NEAR(turn, 0.14251, 5e-6);
  EXPECT_NEAR(at(w, "body.x [m]", 3.1) - at(w, "body.x [m]", 2.1), turn, 1e-5);  // e^-20 of a turn is left of its start
}

// Its motion repeats itself, knock by knock, as an integration of three coordinates has it.
TEST(ContactExample, AWoodpeckerComesDownByTheStep) {
  const Whole w = run(example("woodpecker"));
  expect_sound(w);
  const std::vector<pintle_oracle::Knock> truth = pintle_oracle::woodpecker_knocks(1.2, 4e-5);
  const std::vector<Impact> knocks = impacts(w, "knock");
  ASSERT_GE(truth.size(), 8u);
  ASSERT_GE(knocks.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(knocks[i].begin, truth[i].t, 1e-6) << i;
  const double period = truth.back().t - truth[truth.size() - 2].t, step = truth[truth.size() - 2].height - truth.back().height;
  EXPECT_NEAR(knocks.back().begin - knocks[knocks.size() - 2].begin, period, 1e-7);
  EXPECT_NEAR(period, 0.13077, 5e-6);
  EXPECT_NEAR(step, 14.51e-3, 5e-6);
}

}  // namespace
}  // namespace pintle::contact_example_test
