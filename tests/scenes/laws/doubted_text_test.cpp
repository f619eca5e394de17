// Bare angles that may be meant in degrees, and braces in expressions.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::doubted_text_test {
namespace {

const std::string arm = R"yaml(
bodies: {arm: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
run: {until: 1 s}
)yaml";

std::vector<std::string> doubts(const std::string& text) { return read_scene_text(arm + text, "scene.yaml").warnings; }

TEST(DoubtedText, ABareAngleInAConditionAsksForDegrees) {
  const auto said = doubts("events: {e: {when: t > 0.1 s && arm.angle > 30, do: {row: true}}}\n");
  ASSERT_EQ(said.size(), 1U);
  pintle_test::expect_one_line(said[0], "scene.yaml:5: events.e.when: ", {"30 without a unit is in rad", "write \"30 deg\""});
  for (const char* clear : {"arm.angle > 30 deg", "arm.angle > 3", "arm.angle < -40*1 rad"})
    EXPECT_EQ(doubts("events: {e: {when: \"" + std::string(clear) + "\", do: {row: true}}}\n").size(), 0U) << clear;
}

TEST(DoubtedText, ABareLawOfADriverAsksForDegrees) {
  const auto said = doubts("drivers: {d: {angle: [ground, arm], law: 90 + t}}\n");
  ASSERT_EQ(said.size(), 1U);
  pintle_test::expect_one_line(said[0], "scene.yaml:5: drivers.d.law: ", {"without units is in rad", "14.3 turns"});
  for (const char* clear : {"90 deg + 1 rad/s*t", "150*t", "20*pi + t"})
    EXPECT_EQ(doubts("drivers: {d: {angle: [ground, arm], law: " + std::string(clear) + "}}\n").size(), 0U) << clear;
}

TEST(DoubtedText, BracesMayNumberPartsInAnyExpression) {
  const auto w = pintle_scenes::run(R"yaml(
parameters: {links: 2}
bodies: {link: {repeat: links, rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {A: [0, 0], B: [1 m, 0]}, pose: {at: [index - 1, 0]}}}
joints: {hook: {revolute: [ground, link 1.A]}, pin: {revolute: [link 1.B, link 2.A]}}
outputs: {last: "link {links}.B.x"}
run: {until: 10 ms}
)yaml");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.run.trajectory.column("last [m]").front(), 2, 1e-9);
}

}  // namespace
}  // namespace pintle::doubted_text_test
