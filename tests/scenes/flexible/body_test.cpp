// Bodies of elements from their scene to an answer, as the commands modes, mesh and static use them.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/analysis/static_case/static_case.h"
#include "framework/build/build.h"
#include "framework/drawing/body_drawing.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"

namespace pintle::body_test {
namespace {

using pintle_test::expect_says;

const std::string steel = "young: 200 GPa, poisson: 0.3, density: 8000 kg/m^3";

std::string beam(const std::string& rest, const std::string& statics = "") {
  return "bodies:\n  rod:\n    beam: {from: A, to: B, section: {rectangle: [0.1, 0.05]}, elements: 8, theory: euler, " + steel +
         "}\n    points: {A: [0, 0], B: [2, 0]}\n" + rest + statics;
}

std::string plate(const std::string& shape, const std::string& rest = "", const std::string& statics = "") {
  return "bodies:\n  part:\n    plate: {thickness: 10 mm, " + steel + ", " + shape + "}\n" + rest + statics;
}

StaticReport solved(const std::string& text) {
  const Scene scene = read_scene_text(text, "test.yaml");
  const ElasticBody e = elastic_body(scene, elastic_of(scene, ""));
  return solve_case(scene, e);
}

/// What the commands say of a bad scene.
std::string complaint(const std::string& text, const std::filesystem::path& folder = ".", int count = 6) {
  return pintle_test::refusal_by([&] {
    const Scene scene = read_scene_text(text, (folder / "test.yaml").string(), {}, folder);
    const ElasticBody e = elastic_body(scene, elastic_of(scene, ""));
    modes_of(scene, e, count);
    if (scene.statics) solve_case(scene, e);
  });
}

class BadFile : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::path(testing::TempDir()) /
             ("pintle_bad_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  std::filesystem::path folder;
};

TEST(Body, LineLoadGivesTheSectionForcesOfTheTextbook) {
  const StaticReport r = solved(beam("    supports: {A: fixed}\n", "static: {loads: {snow: {line load: [0, -600 N/m]}}}\n"));
  // Root: V = 1200 N, M = q L²/2 hogging; tip: nothing; the middle: q L²/8.
  const Eigen::Matrix3Xd& f = r.stress.section_forces;
  EXPECT_NEAR(f(2, 0), -1200, 1e-6);
  EXPECT_NEAR(f(1, 0), -1200, 1e-6);
  EXPECT_NEAR(f(2, 8), -300, 1e-6);
  EXPECT_NEAR(f.rightCols<1>().norm(), 0, 1e-6);
  EXPECT_NEAR(r.greatest_stress, 1200 * 0.05 / (0.05 * 0.001 / 12), 1);
  EXPECT_NEAR(r.reactions[0].resultant[1], 1200, 1e-7);
  EXPECT_NEAR(r.reactions[0].resultant[2], 1200, 1e-6);
}

TEST(Body, SpinAndWeightStretchARodAsTheirClosedForms) {
  const double E = 200e9, rho = 8000, L = 2, w = 100, g = 50;
  const StaticReport spun = solved(beam("    supports: {A: fixed}\n", "static: {loads: {spin: {spin: 100 rad/s, about: A}}}\n"));
  EXPECT_NEAR(spun.ports[1].u.x(), rho * w * w * L * L * L / (3 * E), 1e-12);
  EXPECT_NEAR(spun.stress.section_forces(0, 0), rho * 0.005 * w * w * L * L / 2, 1e-6);
  EXPECT_NEAR(spun.stress.section_forces.rightCols<1>().norm(), 0, 1e-6);
  const StaticReport hung = solved(beam("    supports: {A: fixed}\n", "static: {loads: {weight: {acceleration: [50, 0]}}}\n"));
  EXPECT_NEAR(hung.ports[1].u.x(), rho * g * L * L / (2 * E), 1e-15);
  EXPECT_NEAR(hung.stress.section_forces(0, 0), rho * 0.005 * g * L, 1e-8);
}

TEST(Body, SupportsShareReactionsThatBalanceTheLoad) {
  const StaticReport r = solved(beam("    supports: {A: pinned, B: [y]}\n",
                                     "static: {loads: {p: {at: B, force: [100, 0]}, q: {line load: [0, -10]}, t: {at: A, torque: 6}}}\n"));
  Eigen::Vector3d sum = r.load;
  for (const SupportReaction& s : r.reactions) sum += s.resultant;
  EXPECT_NEAR(sum.norm(), 0, 1e-9 * r.load.norm());
  EXPECT_NEAR(r.reactions[1].resultant[1], 10 - 3, 1e-9);
}

TEST(Body, GivenMassSetsTheDensity) {
  const Scene scene = read_scene_text(
      "bodies:\n  part:\n    plate: {thickness: 10 mm, young: 1e9, poisson: 0.3, mass: 3 kg, link: {disc: {diameter: 0.2, bore: 0.1}}}\n",
      "t");
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  EXPECT_NEAR(rigid_inertia(e.model, e.M).m, 3, 1e-12);
}

TEST(Body, WithoutModesIsRigidInAMechanismWithTheInertiaOfItsShape) {
  const Scene scene =
      read_scene_text(plate("link: {eye bar: {length: 0.2, width: 0.03, eyes: [{bore: 0.03, outer: 0.06}, {bore: 0.02, outer: 0.04}]}}",
                            "    points: {A: {hole: eye 1}, B: {hole: eye 2}}\n"),
                      "t");
  const Model model = build(scene);
  const Body& body = model.system.bodies[0];
  EXPECT_EQ(model.system.n(), 3);
  EXPECT_NEAR(model.outlines[0][1].x() - body.x_BO.x(), 0.2, 1e-9);
  EXPECT_GT(body.m, 0.4);
  EXPECT_LT(body.m, 8000 * 0.01 * (0.2 * 0.03 + std::numbers::pi / 4 * (0.06 * 0.06 + 0.04 * 0.04)));
  EXPECT_LT(body.x_BO.x(), -0.03);
  EXPECT_GT(body.x_BO.x(), -0.1);
}

TEST(Body, RepeatedFrequenciesOfASymmetricRingComeInPairs) {
  const Scene scene = read_scene_text(plate("link: {disc: {diameter: 0.2, bore: 0.16}}, size: 6 mm"), "t");
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  const ModesReport r = modes_of(scene, e, 6);
  const Eigen::VectorXd& w = r.natural.modes.omega;
  EXPECT_EQ(r.rigid, 3);
  for (int i = 0; i < 6; i += 2) EXPECT_NEAR(w[i + 1] / w[i], 1, 1e-3);  // the mesh is not as symmetric as the ring
  // Thin ring, n = 2: ω² = 36/5 · E I / (ρ A R⁴); shear and thickness lower it by some per cent.
  const double thin = std::sqrt(7.2 * 200e9 * 0.02 * 0.02 / 12 / (8000 * std::pow(0.09, 4)));
  EXPECT_NEAR(w[0] / thin, 1, 0.05);
}

TEST(Body, DrawnBeamBendsWithItsSections) {
  const Scene scene = read_scene_text(beam("    supports: {A: fixed}\n"), "t");
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  const BodyDrawing drawing(e);
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(e.model.N());  // a small rotation about the origin
  for (int i = 0; i < e.mesh.x.cols(); ++i) turn.segment<3>(3 * i) << -e.mesh.x(1, i), e.mesh.x(0, i), 1;
  const Eigen::Matrix2Xd u = drawing.displacement(turn);
  for (Eigen::Index p = 0; p < u.cols(); ++p) {
    EXPECT_NEAR(u(0, p), -drawing.points(1, p), 1e-12);
    EXPECT_NEAR(u(1, p), drawing.points(0, p), 1e-12);
  }
  EXPECT_NEAR(drawing.stress(turn).norm(), 0, 1e-2);  // of 2e11 Pa × 1
}

TEST(BadBody, StaticsWithoutSupportsOrWithTooFewAreRefused) {
  expect_says(complaint(beam("", "static: {loads: {p: {at: B, force: [1, 0]}}}\n")),
              {"test.yaml", "\"rod\"", "no supports", "supports: {"});
  expect_says(complaint(beam("    supports: {A: pinned}\n", "static: {loads: {p: {at: B, force: [1, 0]}}}\n")),
              {"test.yaml", "rod", "turn"});
}

TEST(BadBody, MoreModesThanDegreesOfFreedomAreRefusedWithBothNumbers) {
  const std::string text = "bodies:\n  rod:\n    beam: {from: A, to: B, section: {circle: 0.1}, elements: 1, " + steel +
                           "}\n    points: {A: [0, 0], B: [2, 0]}\n";
  expect_says(complaint(text, ".", 9), {"rod", "9", "3"});
  expect_says(complaint(text + "    supports: {A: fixed}\n", ".", 9), {"rod", "9", "3"});
  EXPECT_EQ(complaint(text, ".", 3), "accepted");
}

TEST(BadBody, HoleThatNoGroupNamesIsRefusedWithTheGroupsThereAre) {
  const std::string shape = "link: {disc: {diameter: 0.2, bore: 0.1}}";
  expect_says(complaint(plate(shape, "    points: {A: {hole: bor}}\n")), {"test.yaml", "bodies.part.points.A", "\"bor\"", "bore"});
  expect_says(complaint(plate(shape, "    supports: {rim: fixed}\n")), {"\"rim\"", "bore", "outline"});
}

TEST(BadBody, PointWhereNoNodeIsIsRefusedWithTheNearest) {
  expect_says(complaint(plate("grid: {corners: [[0, 0], [1, 0], [1, 1], [0, 1]], cells: [4, 4]}", "    points: {A: [0.3, 0.3]}\n")),
              {"points.A", "nearest", "(0.25, 0.25)"});
  expect_says(complaint("bodies:\n  rod:\n    beam: {from: A, to: B, section: {circle: 0.1}, " + steel +
                        "}\n    points: {A: [0, 0], B: [2, 0], C: [1, 0.1]}\n"),
              {"points.C", "axis"});
}

TEST(BadBody, BarsHingedInALineHaveNoModes) {
  expect_says(complaint("bodies:\n  rod:\n    beam: {from: A, to: B, section: {circle: 0.1}, elements: 10, theory: bar, " + steel +
                        "}\n    points: {A: [0, 0], B: [1, 0]}\n    supports: {A: fixed}\n"),
              {"rod", "without stiffness"});
}

std::string blade(const std::string& height, const std::string& end) {
  return "bodies:\n  blade:\n    beam: {from: A, to: B, section: {rectangle: [" + height + ", 0.01]}, elements: 20, theory: euler, " +
         steel + "}\n    points: {A: [0, 0], B: " + end + "}\n    supports: {A: fixed}\n";
}

// Askew, its stiffness to bending is lost in the rounding of its stiffness to stretch: 1e-13 of it is taken for none.
TEST(BadBody, AModeLostInRoundingIsNotTakenForARigidMotion) {
  EXPECT_EQ(complaint(blade("1e-4", "[0.6, 0.8]")), "accepted");
  expect_says(complaint(blade("1e-5", "[0.6, 0.8]")), {"blade", "without stiffness", "ten thousand times as long as thick"});
}

TEST(Body, ABeamSoSlenderThatRoundingMayBendItHasAWarning) {
  const auto warnings = [](const std::string& height) {
    const Scene scene = read_scene_text(blade(height, "[1, 0]"), "test.yaml");
    return elastic_body(scene, scene.bodies[0]).warnings;
  };
  EXPECT_TRUE(warnings("1e-5").empty());  // 20 EA L²/3EI units in the last place: 0.02 %
  ASSERT_EQ(warnings("1e-6").size(), 1u);
  expect_says(warnings("1e-6")[0], {"1e+06 times as long as thick", "1.8 %", "thicker section"});
}

TEST(Body, SupportsThatLeaveAMotionLeaveTheModesAsked) {
  const Scene scene = read_scene_text(beam("    supports: {A: pinned}\n"), "test.yaml");
  const ModesReport r = modes_of(scene, elastic_body(scene, scene.bodies[0]), 3);
  EXPECT_EQ(r.rigid, 1);
  EXPECT_EQ(r.natural.modes.omega.size(), 3);
}

TEST(BadBody, DampingThatWouldFeedAModeIsRefused) {
  expect_says(complaint(beam("    supports: {A: fixed}\n    damping: {rayleigh: {ratios: [0.2, 0.001]}}\n")),
              {"damping", "mode 6", "ratio -0.28", "add energy"});
}

TEST(BadBody, OutlineIsNoHole) {
  expect_says(complaint(plate("link: {disc: {diameter: 0.2, bore: 0.1}}", "    points: {A: {hole: outline}}\n")), {"points.A", "outline"});
}

TEST(BadBody, PressureThatARigidRimSwallowsIsRefused) {
  expect_says(complaint(plate("link: {disc: {diameter: 0.2, bore: 0.1}}", "    points: {A: {hole: bore}}\n    supports: {outline: fixed}\n",
                              "static: {loads: {p: {on: bore, pressure: 1 MPa}}}\n")),
              {"loads.p", "rigid", "average"});
}

TEST(Body, RayleighDampingIsOfTheBodyAndNotOfTheTable) {
  const Scene scene =
      read_scene_text(beam("    modes: {frame: tangent, count: 4}\n    damping: {rayleigh: {ratios: [0.01, 0.01]}}\n"), "t");
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  const ModesReport r = modes_of(scene, e, 4);
  EXPECT_NEAR(r.reduced->zeta[0], 0.01, 1e-12);
  EXPECT_NEAR(r.reduced->zeta[1], 0.01, 1e-12);
  const Rayleigh c = rayleigh(r.reduced->modes.omega[0], 0.01, r.reduced->modes.omega[1], 0.01);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(r.natural.zeta[i], c.alpha / (2 * r.natural.modes.omega[i]) + c.beta * r.natural.modes.omega[i] / 2, 1e-12);
}

TEST_F(BadFile, WithAClockwiseCellHasNoHoleForIt) {
  write("turned.inp", "*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n*ELEMENT, TYPE=CPS4\n1,1,4,5,2\n2,2,3,6,5\n");
  const Scene scene = read_scene_text(plate("file: turned.inp"), (folder / "test.yaml").string(), {}, folder);
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  ASSERT_EQ(e.mesh.groups.size(), 1u);
  EXPECT_EQ(e.mesh.groups[0].name, "outline");
}

TEST_F(BadFile, WithoutASurfaceOrACellIsRefused) {
  write("empty.inp", "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n");
  expect_says(complaint(plate("file: empty.inp"), folder), {"test.yaml", "part", "empty.inp"});
  write("empty.geo", "Point(1) = {0, 0, 0, 1};\n");
  expect_says(complaint(plate("file: empty.geo"), folder), {"part", "surface"});
}

TEST_F(BadFile, InTwoPiecesIsRefusedByANodeOfTheSecond) {
  write("two.inp", "*NODE\n1,0,0\n2,1,0\n3,0,1\n11,5,0\n12,6,0\n13,5,1\n*ELEMENT, TYPE=CPS3\n1,1,2,3\n2,11,12,13\n");
  expect_says(complaint(plate("file: two.inp"), folder), {"part", "2 pieces", "node 11", "(5, 0)"});
}

TEST_F(BadFile, WithAnInvertedCellIsRefusedByNumberAndPlace) {
  // Cell 7 is a quadrilateral whose third corner lies inside the triangle of the others.
  write("bad.inp", "*NODE\n1,0,0\n2,1,0\n3,0.2,0.2\n4,0,1\n5,2,0\n6,2,1\n*ELEMENT, TYPE=CPS4\n7,1,2,3,4\n*ELEMENT, TYPE=CPS3\n8,2,5,6\n");
  expect_says(complaint(plate("file: bad.inp"), folder), {"part", "inverted", "7", "(0.3, 0.3)"});
}

TEST_F(BadFile, ThatIsNotThereOrBrokenIsNamed) {
  expect_says(complaint(plate("file: nowhere.step"), folder), {"part", "nowhere.step"});
  write("broken.step", "ISO-10303-21;\nrubbish\n");
  expect_says(complaint(plate("file: broken.step"), folder), {"part", "broken.step"});
  write("broken.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 2\n");
  expect_says(complaint(plate("file: broken.msh"), folder), {"part", "broken.msh"});
}

}  // namespace
}  // namespace pintle::body_test
