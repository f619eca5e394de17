// Results name a joint's force alike with and without clearance: on its second body, or on the first if the second is the ground.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/runs/drawn_forces.h"
#include "tests/scenes/text_runs.h"

namespace pintle::written_force_test {
namespace {

const std::string law = "normal: {hunt-crossley: {stiffness: 1e7, exponent: 1, restitution: 0.5}}";
const std::string hole = "clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: ";

struct Kind {
  const char* name;
  std::string kind, rest;  ///< "revolute", and what follows the names of its bodies; BEARING is replaced by one of them
};
const Kind kinds[] = {
    {"Ideal", "revolute", ""},
    {"InAHole", "revolute", hole + "BEARING, " + law + "}"},
    {"ByImpacts", "revolute", hole + "BEARING, model: impact, restitution: 0}"},
    {"MasslessLink", "revolute", hole + "BEARING, model: massless link}"},
    {"InAnOpenHole", "revolute", hole + "BEARING, arc: {middle: 0, extent: 300 deg, wall: 8 mm, edge: 2 mm}, " + law + "}"},
    {"Guide", "prismatic", ""},
    {"GuideWithGap", "prismatic", "clearance: {gap: 0.1 mm, length: 80 mm, height: 30 mm, " + law + "}"},
    {"Slot", "slot", ""},
    {"SlotWithGap", "slot", "clearance: {gap: 0.1 mm, pin radius: 5 mm, travel: 60 mm, " + law + "}"},
};
void PrintTo(const Kind& k, std::ostream* out) { *out << k.name; }

std::string with(std::string text, const std::string& bearing) {
  if (const auto at = text.find("BEARING"); at != std::string::npos) text.replace(at, 7, bearing);
  return text.empty() ? text : ", " + text;
}
std::vector<std::string> force_columns(const Table& t, const std::string& joint) {
  std::vector<std::string> out;
  for (const std::string& c : t.header)
    if (c.starts_with(joint + ".fx on ")) out.push_back(c);
  return out;
}
// Nothing else acts on the body: the joint's force on it is m (a − g).
void expect_newton(const pintle_scenes::Whole& w, const std::string& body, double mass) {
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const Table& t = w.run.trajectory;
  ASSERT_EQ(force_columns(t, "j"), std::vector{"j.fx on " + body + " [N]"});
  const auto fx = t.column("j.fx on " + body + " [N]"), fy = t.column("j.fy on " + body + " [N]");
  const auto ax = t.column(body + ".ax [m/s^2]"), ay = t.column(body + ".ay [m/s^2]");
  const auto most = std::max(std::ranges::max(fx), std::ranges::max(fy));
  EXPECT_GT(most, 0);
  for (std::size_t i = 0; i < fx.size(); ++i) {
    EXPECT_NEAR(fx[i], mass * (ax[i] - 3), 1e-9 * (1 + std::abs(fx[i])));
    EXPECT_NEAR(fy[i], mass * (ay[i] + 10), 1e-9 * (1 + std::abs(fy[i])));
  }
}

class WrittenForce : public testing::TestWithParam<Kind> {
 protected:
  static std::string scene(const std::string& first, const std::string& second, const std::string& bearing) {
    const bool two = first != "ground" && second != "ground";
    std::string text = "gravity: [3 m/s^2, -10 m/s^2]\nbodies:\n  a: {rigid: {mass: 2 kg, inertia: 0.1 kg m^2}}\n";
    if (two) text += "  b: {rigid: {mass: 3 kg, inertia: 0.2 kg m^2}}\n";
    text += "joints:\n  j: {" + GetParam().kind + ": [" + first + ", " + second + "]" + with(GetParam().rest, bearing) + "}\n";
    if (two) text += "  holds: {weld: [ground, " + first + "]}\n";
    return text + "run: {until: 20 ms, method: dopri5, tolerance: 1e-8}\noutput: {every: 0.5 ms}\n";
  }
  static pintle_scenes::Whole run(const std::string& first, const std::string& second, const std::string& bearing) {
    return pintle_scenes::run(scene(first, second, bearing));
  }
};
TEST_P(WrittenForce, IsOnTheBodyThatMovesWhereTheOtherIsTheGround) {
  for (const char* bearing : {"ground", "a"}) {
    expect_newton(run("ground", "a", bearing), "a", 2);
    expect_newton(run("a", "ground", bearing), "a", 2);
  }
}
TEST_P(WrittenForce, IsOnTheSecondOfTwoBodies) {
  for (const char* bearing : {"a", "b"}) {
    expect_newton(run("a", "b", bearing), "b", 3);
    expect_newton(run("b", "a", bearing), "a", 2);
  }
}
TEST_P(WrittenForce, IsTheOneThatFramesShow) {
  for (const auto& [first, second] : {std::pair("ground", "a"), std::pair("a", "ground"), std::pair("a", "b"), std::pair("b", "a")})
    for (const char* bearing : {first, second})
      EXPECT_GT(pintle_scenes::expect_frames_hold_written_forces(read_scene_text(scene(first, second, bearing), "scene.yaml")), 0);
}
INSTANTIATE_TEST_SUITE_P(Kinds, WrittenForce, testing::ValuesIn(kinds), [](const auto& k) { return std::string(k.param.name); });

}  // namespace
}  // namespace pintle::written_force_test
