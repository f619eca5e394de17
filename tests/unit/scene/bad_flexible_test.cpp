// Every way to get a flexible body in a mechanism wrong, and the one line that says where and what to do.
#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "tests/unit/scene/elastic_text.h"

namespace pintle::bad_flexible_test {
namespace {

/// A beam of steel from A (0, 0) to B (1, 0) with a point M between; line 5 on: `keys`, then `rest`.
std::string beam(const std::string& keys, const std::string& rest = "") {
  return "bodies:\n  rod:\n    beam: {from: A, to: B, section: {circle: 10 mm}, " + steel_keys +
         "}\n    points: {A: [0, 0], M: [0.5, 0], B: [1, 0]}\n" + keys + rest + "run: {until: 1 s}\n";
}
/// A disc of steel with a bore in its middle.
std::string disc(const std::string& points, const std::string& keys) {
  return "bodies:\n  part:\n    plate: {thickness: 5 mm, " + steel_keys +
         ", size: 20 mm, link: {disc: {diameter: 0.2, bore: 0.1}}}\n    points: {" + points + "}\n" + keys + "run: {until: 1 s}\n";
}
/// A strip of plate whose corners A and B are nodes.
std::string grid(const std::string& keys, const std::string& rest = "") {
  return "bodies:\n  part:\n    plate: {thickness: 5 mm, " + steel_keys +
         ", grid: {corners: [[0, 0], [1, 0], [1, 0.2], [0, 0.2]], cells: [8, 2]}}\n    points: {A: [0, 0], B: [1, 0]}\n" + keys + rest +
         "run: {until: 1 s}\n";
}

std::string said_of(const std::string& text) {
  return refusal_by([&] { build(with_pieces(read_scene_text(text, "scene.yaml"))); });
}

const std::string modes = "    modes: {frame: chord, count: 3}\n";

TEST(BadFlexible, JointsHoldPointsThatTheBodyHas) {
  expect_one_line(said_of(beam(modes, "joints: {pin: {revolute: [ground, rod.N]}}\n")), "scene.yaml:6: joints.pin",
                  {"\"rod\" has no point \"N\"", "A, M or B"});
  std::string off = beam(modes, "joints: {pin: {revolute: [ground, rod.M]}}\n");
  off.replace(off.find("M: [0.5, 0]"), 11, "M: [0.5, 0.1]");
  expect_one_line(said_of(off), "scene.yaml:4: bodies.rod.points.M", {"no node lies at (0.5, 0.1) m", "put the point on the beam's axis"});
  std::string beside = grid(modes);
  beside.replace(beside.find("B: [1, 0]"), 9, "B: [1.1, 0]");
  expect_one_line(said_of(beside), "scene.yaml:4: bodies.part.points.B", {"the nearest", "(1, 0) m"});
}

TEST(BadFlexible, HolesAreThoseOfTheMesh) {
  expect_one_line(said_of(disc("C: {hole: bor}", "    modes: {count: 3}\n")), "scene.yaml:4: bodies.part.points.C",
                  {"no group \"bor\"", "\"bore\"?"});
}

TEST(BadFlexible, FramesHoldTheBody) {
  expect_one_line(said_of(grid("    modes: {frame: {tangent: A}, count: 3}\n")), "scene.yaml:5: bodies.part.modes",
                  {"tangent at A, a point of a plate", "no direction", "the centre of a hole", "mean axes"});
  std::string same = beam("    modes: {frame: {chord: [A, M]}, count: 3}\n");
  same.replace(same.find("M: [0.5, 0]"), 11, "M: [0, 0]");
  expect_one_line(said_of(same), "scene.yaml:5: bodies.rod.modes", {"chord runs from A to M", "same place, (0, 0) m", "tangent: A"});
  expect_one_line(said_of(disc("C: {hole: bore}", "    modes: {frame: chord, count: 3}\n")), "scene.yaml:5: bodies.part.modes",
                  {"needs two points", "add them under points"});
}

TEST(BadFlexible, ChordsOfScenesWrittenInCodeRunBetweenTwoPoints) {
  Scene scene = read_scene_text(beam(modes), "scene.yaml");
  scene.bodies[0].elastic->modes->a = scene.bodies[0].elastic->modes->b = "M";
  pintle_test::expect_refused([&] { build(scene); }, {"from M to M", "(0.5, 0) m"});
}

TEST(BadFlexible, CraigBamptonNeedsPoints) {
  const std::string text = "bodies:\n  part:\n    plate: {thickness: 5 mm, " + steel_keys +
                           ", link: {disc: {diameter: 0.2, bore: 0.1}}}\n    modes: {craig-bampton: {count: 3}}\nrun: {until: 1 s}\n";
  expect_one_line(said_of(text), "scene.yaml:4: bodies.part.modes", {"0 degrees of freedom", "add a port", "free modes"});
}

TEST(BadFlexible, MoreModesThanThereAreAreRefusedWithBothNumbers) {
  expect_one_line(said_of(beam("    modes: {frame: chord, count: 400}\n")), "scene.yaml:5: bodies.rod.modes",
                  {"400 modes asked for", "has "});
}

TEST(BadFlexible, APlatesPointHasNoDirectionToHold) {
  const auto said = [](const std::string& what) { return said_of(grid("    modes: {frame: chord, count: 3}\n", what)); };
  const std::vector<std::string> remedy{"\"part.A\" is a point of a plate", "no direction", "the centre of a hole"};
  expect_one_line(said("joints: {j: {weld: [ground, part.A]}}\n"), "scene.yaml:6: joints.j", remedy);
  expect_one_line(said("joints: {j: {prismatic: [ground, part.A]}}\n"), "scene.yaml:6: joints.j", remedy);
  expect_one_line(said("forces: {f: {torsion spring: [ground, part.A], stiffness: 1 N m}}\n"), "scene.yaml:6: forces.f", remedy);
  expect_one_line(said("drivers: {d: {angle: [ground, part.A], law: 1*t}}\n"), "scene.yaml:6: drivers.d", remedy);
  expect_one_line(said("forces: {f: {torque: 1 N m, on: part.A}}\n"), "scene.yaml:6: forces.f", remedy);
}

TEST(BadFlexible, ABodyAloneIsItsPointAtTheOrigin) {
  std::string text = beam(modes, "joints: {pin: {revolute: [ground, rod]}}\n");
  EXPECT_EQ(said_of(text), "accepted");
  text.replace(text.find("A: [0, 0]"), 9, "A: [0.1, 0]");
  expect_one_line(said_of(text), "scene.yaml:6: joints.pin",
                  {"\"rod\" without a point means the origin", "has no point", "name one of its points"});
}

TEST(BadFlexible, StressIsOfMaterial) {
  const std::string with = "output: {stress: [part.C]}\n";
  expect_one_line(said_of(disc("C: {hole: bore}", "    modes: {count: 3}\n" + with)), "scene.yaml:6: output.stress",
                  {"the centre of a hole, where there is no material", "name a point of the plate"});
}

TEST(BadFlexible, LumpedMassMustLeaveTheFrameInertia) {
  // A section's turn carries no mass in it, and the frame turns with that of the root.
  const auto rod = [](const std::string& matrix) {
    return "bodies:\n  rod:\n    beam: {from: A, to: B, section: {circle: 10 mm}, theory: euler, rotary inertia: false, elements: 2, " +
           steel_keys + "}\n    points: {A: [0, 0], B: [1, 0]}\n    mass matrix: " + matrix +
           "\n    modes: {frame: {tangent: A}, keep: all}\nrun: {until: 1 s}\n";
  };
  expect_one_line(said_of(rod("lumped")), "scene.yaml:2: bodies.rod",
                  {"leave the frame no inertia", "consistent mass matrix", "another frame or fewer shapes"});
  EXPECT_EQ(said_of(rod("consistent")), "accepted");
}

TEST(BadFlexible, BarsHaveNoDirectionForATangent) {
  const std::string bars = "bodies:\n  rod:\n    beam: {from: A, to: B, section: {circle: 10 mm}, theory: bar, elements: 1, " + steel_keys +
                           "}\n    points: {A: [0, 0], B: [1, 0]}\n    modes: {frame: {tangent: A}, keep: all}\nrun: {until: 1 s}\n";
  expect_one_line(said_of(bars), "scene.yaml:5: bodies.rod.modes", {"tangent at A, a point of a bar", "no direction"});
}

TEST(BadFlexible, DampingAboveCriticalAndStiffeningOfRigidBodiesAreRefused) {
  expect_one_line(refusal_of(beam(modes, "    damping: {ratios: 1.5}\n")), "scene.yaml:6: bodies.rod.damping.ratios", {"between 0 and 1"});
  expect_one_line(refusal_of(beam("    stiffening: rotation\n")), "scene.yaml:5: bodies.rod.stiffening", {"needs a flexible body"});
}

TEST(BadFlexible, BadScenesAreRefusedAlikeWhereModesAreChosen) {
  expect_one_line(said_of(beam("    modes: {frame: chord, keep: auto}\n", "joints: {pin: {revolute: [ground, rod.N]}}\n")),
                  "scene.yaml:6: joints.pin", {"\"rod\" has no point \"N\""});
  expect_one_line(said_of(grid("    modes: {frame: chord, keep: auto}\n", "joints: {j: {weld: [ground, part.A]}}\n")),
                  "scene.yaml:6: joints.j", {"a point of a plate"});
}

}  // namespace
}  // namespace pintle::bad_flexible_test
