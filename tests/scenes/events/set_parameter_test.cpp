// Parameters that events set.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/build/build.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::set_parameter_test {
namespace {

using pintle_scenes::Whole;
using pintle_test::expect_one_line;

Scene scene(const std::string& text) { return read_scene_text(text, "scene.yaml"); }

const std::string swing = R"yaml(
parameters: {k: 1 N m, mass: 1 kg}
bodies: {arm: {rigid: {mass: mass, inertia: 1 kg m^2}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
forces: {spring: {torque: -k*arm.angle, on: arm}}
start: {arm: {angle: 0.1 rad}}
run: {until: 2 s, method: dopri5, tolerance: 1e-10}
output: {every: 10 ms}
)yaml";

// cos t, and from 1 s on twice as fast.
TEST(SetParameter, AStiffnessThatAnEventSetsIsAnotherFromThenOn) {
  const Whole w = pintle_scenes::run(swing + "events: {stiffen: {when: t > 1 s, once: true, do: {set: {k: 4*k}}}}\n");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const auto t = w.run.trajectory.column("t [s]"), angle = w.run.trajectory.column("arm.angle [rad]"),
             k = w.run.trajectory.column("k [N m]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double s = t[i] - 1, a = 0.1 * std::cos(1.0), v = -0.1 * std::sin(1.0);
    EXPECT_NEAR(angle[i], t[i] <= 1 ? 0.1 * std::cos(t[i]) : a * std::cos(2 * s) + v / 2 * std::sin(2 * s), 1e-8) << t[i];
    if (std::abs(s) > 1e-9) {
      EXPECT_EQ(k[i], s < 0 ? 1 : 4) << t[i];
    }
  }
}

TEST(SetParameter, ItIsTheSameAsAStateWrittenByHand) {
  const std::string by_hand = "states: {q: {rate: 0, start: 1 N m}}\nevents: {stiffen: {when: arm.angle < 0 rad, do: {set: {q: 4 N m}}}}\n";
  std::string hand = swing + by_hand;
  hand.replace(hand.find("-k*"), 3, "-q*");
  const Whole a = pintle_scenes::run(swing + "events: {stiffen: {when: arm.angle < 0 rad, do: {set: {k: 4 N m}}}}\n"),
              b = pintle_scenes::run(hand);
  EXPECT_EQ(a.run.trajectory.data, b.run.trajectory.data);
}

TEST(SetParameter, TheSceneFilledInReadsBack) {
  const Scene first = scene(swing + "events: {stiffen: {when: t > 1 s, do: {set: {k: 4 N m}}}}\n"), again = scene(first.filled_in);
  EXPECT_EQ(again.filled_in, first.filled_in);
  EXPECT_EQ(pintle_scenes::run(again).run.trajectory.data, pintle_scenes::run(first).run.trajectory.data);
}

TEST(SetParameter, WhereAValueIsMadeOnceItIsRefusedByName) {
  const auto refusal = [](std::string text) { return pintle_test::refusal_by([&] { build(scene(text)); }); };
  expect_one_line(refusal(swing + "events: {heavy: {when: t > 1 s, do: {set: {mass: 2 kg}}}}\n"),
                  "scene.yaml:3: bodies.arm.rigid.mass: ", {"mass is a parameter that an event sets", "evaluated once"});
  expect_one_line(
      refusal(swing + "drivers: {d: {angle: [ground, arm], law: k*t/(1 N m s)}}\nevents: {e: {when: t > 1 s, do: {set: {k: 2 N m}}}}\n"),
      "scene.yaml:9: drivers.d.law: ", {"k is a parameter that an event sets"});
  std::string derived = swing + "events: {e: {when: t > 1 s, do: {set: {k: 2 N m}}}}\n";
  derived.replace(derived.find("mass: 1 kg"), 10, "mass: 1 kg, k2: 2*k");
  expect_one_line(refusal(derived), "scene.yaml:2: parameters.k2: ", {"k is a parameter that an event sets"});
  expect_one_line(refusal(swing + "events: {e: {when: t > 1 s, do: {set: {kk: 2 N m}}}}\n"),
                  "scene.yaml:9: events.e.do.set.kk: ", {"there is no state \"kk\"", "Did you mean \"k\"?"});
  expect_one_line(refusal(swing + "events: {e: {when: t > 1 s, do: {set: {k: 2 kg}}}}\n"),
                  "scene.yaml:9: events.e.do.set.k: ", {"expected"});
  // what an event sets is a parameter and a state: named once
  expect_one_line(refusal(swing + "events: {e: {when: t > 1 s, do: {set: {gain: 2, k: 2 N m}}}}\n"),
                  "scene.yaml:9: events.e.do.set.gain: ", {"Known here: k or mass."});
}

}  // namespace
}  // namespace pintle::set_parameter_test
