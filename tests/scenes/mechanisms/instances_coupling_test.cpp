// Couplings in instances that are turned, mirrored and moved: each runs to the image of what its assembly does, by a map that is written
// here again. A coupling joins by one line.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/scenes/text_runs.h"

namespace pintle_scenes::instances_coupling_test {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Map {
  const char* words;
  double turns, angle;  ///< −1 of a mirror image; direction of the assembly's x axis [rad]
  std::array<double, 2> at;
};
const std::vector<Map> maps{{"angle: 30 deg, at: [1, 2]", 1, pi / 6, {1, 2}},
                            {"mirror: y", -1, 0, {0, 0}},
                            {"mirror: x, angle: 30 deg, at: [1, 2]", -1, pi + pi / 6, {1, 2}}};

struct Kind {
  const char* name;
  std::string joints, forces = "", drivers = "";
};
void PrintTo(const Kind& k, std::ostream* out) { *out << k.name; }

const std::string teeth = "{flores: {restitution: 0.5, stiffness: 1e7}}";
// A wheel a at O, a wheel b 0.3 m from it, a slide s on a slanted line 0.1 m from O, and a disc w that nothing holds.
const std::vector<Kind> kinds{
    {"Gear", "{gear: [a, b], radii: [0.1, 0.2]}"},
    {"Teeth", "{gear: [a, b], teeth: [20, 40]}"},
    {"Ring", "{gear: [a, b], radii: [0.2, 0.5], inside: true}"},
    {"Belt", "{belt: [a, b], radii: [0.1, 0.15]}"},
    {"CrossedBelt", "{belt: [a, b], radii: [0.1, 0.15], crossed: true}"},
    {"Rack", "{rack: [s, a], radius: 0.1}"},
    {"GearWithBacklash", "{gear: [a, b], radii: [0.1, 0.2], clearance: {backlash: 5 mm, pressure angle: 20 deg, normal: " + teeth + "}}"},
    {"RingWithBacklash", "{gear: [a, b], radii: [0.2, 0.5], inside: true, clearance: {backlash: 5 mm, normal: " + teeth + "}}"},
    {"RackWithBacklash", "{rack: [s, a], radius: 0.1, clearance: {backlash: 5 mm, pressure angle: 20 deg, normal: " + teeth + "}}"},
    {"RollsOnALine", "{rolling: [ground.G, w], radius: 0.05}"},
    {"RollsOnADisc", "{rolling: [ground.O, w], radii: [0.03, 0.02]}"},
    {"RollsInADisc", "{rolling: [ground.O, w], radii: [0.09, 0.04], inside: true}"},
    {"Screw", "{screw: [a, s, ground.G], lead: 20 mm}"},
    {"ScrewOnTheGround", "{screw: [a, s], lead: 20 mm}"},
    {"Cam", "{cam: [a, s, ground.G], lift: 10 mm*sin(angle + 0.5) + 3 mm*cos(2*angle)}"},
    {"CamOnTheGround", "{cam: [a, s], lift: 10 mm*sin(angle + 0.5)}"},
    {"CamOnABody", "{cam: [a, b, s], swing: 0.3*sin(angle + 0.4)}"},
    {"CamThatSwings", "{cam: [a, b], swing: 0.3*sin(angle + 0.4)}"},
    {"CamOfPowers", "{cam: [a, s, ground.G], lift: 20 mm*angle + 6 mm*angle^2}"},
    {"CamThatSwingsByPowers", "{cam: [a, b], swing: 0.2*angle + 0.1*angle^2 - 0.05*angle^3}"},
    {"CamByATable", "{cam: [a, s, ground.G], lift: {table: instances_coupling.csv, angle unit: deg, value unit: mm}}"},
    {"CamByATableFromAnAngle",
     "{cam: [a, b], swing: {table: instances_coupling.csv, angle unit: deg, value unit: 0.02 rad, zero: 25 deg, clockwise: true}}"},
    {"Shafts", "{differential: [a, b], ratio: 2}"},
    {"AngleAndDisplacement", "{differential: [{angle: [ground, a]}, {displacement: [ground.G, s], ratio: 30}]}"},
    {"DistanceAndAngle", "{differential: [{distance: [ground.B, s]}, {angle: [ground, a], ratio: 0.02}]}"},
    {"ElasticBelt", "", "{belt: [a, b], radii: [0.1, 0.15], stiffness: 2 kN, damping: 5 N s, pretension: 50 N}"},
    {"CrossedElasticBelt", "", "{belt: [a, b], radii: [0.1, 0.15], crossed: true, stiffness: 2 kN, damping: 5 N s, pretension: 50 N}"},
    {"AngleDriver", "", "", "{angle: [ground, b], law: 20*t^2}"},
    {"AngleDriverFromPresent", "", "", "{angle: [a, b], law: present + 20*t^2}"},
    {"DistanceDriverFromPresent", "", "", "{distance: [ground.B, s], law: present + 0.5 m/s^2*t^2}"},
};

Whole run_placed(const Kind& kind, const std::string& words) {
  const auto entry = [](const char* name, const std::string& what) { return what.empty() ? "" : std::string(name) + ": " + what; };
  const std::string text = R"yaml(
assemblies:
  it:
    ground: {points: {O: [0, 0], B: [0.24, 0.18], G: {at: [0.06, -0.08], angle: asin(0.6)}}}
    bodies:
      a: {rigid: {mass: 1, inertia: 0.01}}
      b: {rigid: {mass: 1, inertia: 0.03}, pose: {at: [0.24, 0.18], angle: 20 deg}}
      s: {rigid: {mass: 1, inertia: 0.01}, pose: {at: [0.06, -0.08], angle: asin(0.6)}}
      w: {rigid: {mass: 1, inertia: 0.001}, pose: {at: [0.03, -0.04]}}
    joints: {at A: {revolute: [ground.O, a]}, at B: {revolute: [ground.B, b]}, guide: {prismatic: [ground.G, s]}, )yaml" +
                           entry("it", kind.joints) + "}\n    forces: {turn: {torque: 0.3, on: a}, spin: {torque: 0.01, on: w}, " +
                           entry("belt", kind.forces) + "}\n    drivers: {" + entry("motor", kind.drivers) + "}\ninstances: {i: {of: it, " +
                           words + "}}\nrun: {until: 0.3, method: dopri5, tolerance: 1e-10}\noutput: {frames: 0, every: 0.1}\n";
  const pintle::Scene scene = pintle::read_scene_text(text, "scene.yaml", {}, testing::TempDir());
  EXPECT_EQ(pintle::read_scene_text(scene.filled_in, "kept.json", {}, testing::TempDir()).filled_in, scene.filled_in);
  return run(scene);
}

class CouplingInInstances : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    std::ofstream table(std::filesystem::path(testing::TempDir()) / "instances_coupling.csv");
    for (int i = 0; i <= 36; ++i) table << 10 * i << " " << 10 * std::sin(pi / 18 * (i % 36) + 0.5) << "\n";
  }
};

TEST_P(CouplingInInstances, MovesAsTheImageOfTheAssembly) {
  const Whole was = run_placed(GetParam(), "at: [0, 0]");
  ASSERT_EQ(was.run.status, pintle::Status::finished) << was.run.reason;
  double moved = 0;
  for (const Map& map : maps) {
    SCOPED_TRACE(map.words);
    const Whole is = run_placed(GetParam(), map.words);
    ASSERT_EQ(is.run.status, pintle::Status::finished) << is.run.reason;
    const double c = std::cos(map.angle), s = std::sin(map.angle);
    for (const std::string body : {"a", "b", "s", "w"}) {
      const auto now = [&](const char* of) { return is.last("i " + body + of); };
      const auto before = [&](const char* of) { return was.last("i " + body + of); };
      const double x = before(".x [m]"), y = map.turns * before(".y [m]");
      EXPECT_NEAR(now(".x [m]"), map.at[0] + c * x - s * y, 1e-7) << body;
      EXPECT_NEAR(now(".y [m]"), map.at[1] + s * x + c * y, 1e-7) << body;
      const double turn = now(".angle [rad]") - map.angle - map.turns * before(".angle [rad]");
      EXPECT_NEAR(std::remainder(turn, 2 * pi), 0, 1e-7) << body;
      EXPECT_NEAR(now(".speed [rad/s]"), map.turns * before(".speed [rad/s]"), 1e-6) << body;
      if (body != "a") moved += std::abs(before(".speed [rad/s]")) + std::abs(before(".vx [m/s]"));
    }
  }
  EXPECT_GT(moved, 0.01);  // what is coupled does move
}

INSTANTIATE_TEST_SUITE_P(, CouplingInInstances, testing::ValuesIn(kinds),
                         [](const testing::TestParamInfo<Kind>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace pintle_scenes::instances_coupling_test
