// Bodies that are not what their author meant: joined, refused or warned of, with place and remedy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>

#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/bodies/beam_mesh.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "meshes/gmsh.h"
#include "meshes/rim_shape.h"
#include "tests/refusal.h"

namespace pintle::unsound_body_test {
namespace {

using pintle_test::expect_says;

using std::numbers::pi;

const std::string steel = "young: 200 GPa, poisson: 0.3, density: 7850 kg/m^3";

std::string text_of(double x) {
  std::ostringstream s;
  s << std::setprecision(17) << x;
  return s.str();
}

std::string beam(const std::string& through, const std::string& points, const std::string& more = "") {
  return "bodies:\n  frame:\n    beam: {through: [" + through +
         "], section: {rectangle: [10 mm, 20 mm]}, theory: euler, rotary inertia: false, " + steel + more + "}\n    points: {" + points +
         "}\n";
}

ElasticBody made(const std::string& text, const std::filesystem::path& folder = ".") {
  const Scene scene = read_scene_text(text, (folder / "test.yaml").string(), {}, folder);
  ElasticBody e = elastic_body(scene, elastic_of(scene, ""));
  e.scene = nullptr;
  return e;
}
std::string refusal(const std::string& text, const std::filesystem::path& folder = ".") {
  return pintle_test::refusal_by([&] { made(text, folder); });
}
std::string warnings(const std::string& text, const std::filesystem::path& folder = ".") {
  std::string all;
  for (const std::string& w : made(text, folder).warnings) all += w + "\n";
  return all;
}
// Two modes of each free ring bend it in its plane at ω² = EI/(ρA R⁴) n²(n² − 1)²/(n² + 1) (Hoppe 1871), n = 2 the lowest.
// A polygon of N sides between corners on the circle differs from it by O((π/N)²).
TEST(BeamPath, ThatComesBackToItsFirstPointIsARing) {
  constexpr int N = 60;
  constexpr double R = 0.5, h = 0.01;
  std::string points, through;
  for (int i = 0; i < N; ++i) {
    const std::string name = "P" + std::to_string(i);
    points += (i ? ", " : "") + name + ": [" + text_of(R * std::cos(2 * pi * i / N)) + ", " + text_of(R * std::sin(2 * pi * i / N)) + "]";
    through += name + ", ";
  }
  const std::string text = beam(through + "P0", points, ", elements: 120");
  const Scene scene = read_scene_text(text, "test.yaml");
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  EXPECT_EQ(e.mesh.x.cols(), 120);
  EXPECT_TRUE(e.warnings.empty());
  const ModesReport r = modes_of(scene, e, 2);
  const double n = 2, exact = std::sqrt(200e9 * h * h / 12 / 7850) / (R * R) * n * (n * n - 1) / std::sqrt(n * n + 1);
  const double side = (pi / N) * (pi / N);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(r.natural.modes.omega[i], exact, 2 * side * exact);
  EXPECT_NEAR(r.natural.modes.omega[1], r.natural.modes.omega[0], 1e-6 * exact);
}

TEST(BeamPath, JoinsWhereverItPassesOnePointAgain) {
  const std::string square = "A: [0, 0], B: [1, 0], C: [1, 1], D: [0, 1]";
  EXPECT_EQ(made(beam("A, B, C, D, A", square, ", elements: 8")).mesh.x.cols(), 8);
  // An eight through its middle point, and the same middle as a point that the path does not name.
  const std::string eight = "A: [-1, -1], B: [1, 1], C: [1, -1], D: [-1, 1]";
  for (const std::string path : {"A, M, B, C, M, D", "A, B, C, D"}) {
    const ElasticBody e = made(beam(path, eight + ", M: [0, 0]", ", elements: 8"));
    EXPECT_EQ(e.mesh.x.cols(), static_cast<Eigen::Index>(e.mesh.cell_count())) << path;  // one loop
    EXPECT_TRUE(e.warnings.empty()) << e.warnings.front();
  }
  // A path that ends on the middle of its first stretch.
  const ElasticBody T = made(beam("A, B, C, D", "A: [0, 0], B: [1, 0], C: [1, 1], D: [0.5, 0]", ", elements: 9"));
  EXPECT_EQ(T.mesh.x.cols(), static_cast<Eigen::Index>(T.mesh.cell_count()));
}

TEST(BeamPath, ThatCrossesItselfWhereNoPointIsWarnsWithBothStretches) {
  const std::string eight = beam("A, B, C, D", "A: [-1, -1], B: [1, 1], C: [1, -1], D: [-1, 1]");
  expect_says(warnings(eight),
              {"meets itself at (0, 0) m", "between A and B", "between C and D", "not joined", "give the body a point there"});
  EXPECT_EQ(warnings(beam("A, B, C, D", "A: [-1, -1], B: [1, 1], C: [1, -1], D: [0.1, 0]")), "");
}

TEST(BeamPath, ThatRunsBackOnItselfIsRefused) {
  expect_says(refusal(beam("A, B, A", "A: [0, 0], B: [1, 0]")), {"test.yaml:2", "bodies.frame", "twice between B and A", "count twice"});
  expect_says(refusal(beam("A, B, C", "A: [0, 0], B: [1, 0], C: [0.4, 0]")), {"twice between B and C"});
}

TEST(BeamPath, ThatPassesTwoPointsAtOnePlaceMustSayWhetherItJoins) {
  expect_says(refusal(beam("A, B, C, E", "A: [0, 0], B: [1, 0], C: [1, 1], E: [0, 0]")),
              {"passes A and E", "both lie at (0, 0) m", "move one"});
  EXPECT_EQ(refusal(beam("A, B, C, A", "A: [0, 0], B: [1, 0], C: [1, 1], E: [0, 0]")), "accepted");
}

TEST(BeamPath, CutIntoPiecesMayNotPassAPointTwice) {
  const std::string text = beam("A, B, C, D", "A: [-1, -1], B: [1, 1], C: [1, -1], D: [-1, 1], M: [0, 0]", ", pieces: 3") +
                           "    modes: {frame: chord, craig-bampton: {count: 0}}\n";
  pintle_test::expect_refused([&] { with_pieces(read_scene_text(text, "test.yaml")); }, {"bodies.frame", "passes M twice", "weld"});
}

class PlateFile : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::path(testing::TempDir()) /
             ("pintle_plate_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::string plate(const std::string& inp, const std::string& more = "", const std::string& points = "",
                    const std::string& rest = "") const {
    std::ofstream(folder / "part.inp") << inp;
    return "bodies:\n  part:\n    plate: {file: part.inp, thickness: 5 mm, " + steel + more + "}\n" + points + rest;
  }
  std::string rejected(const std::string& inp, const std::string& more = "", const std::string& points = "") const {
    return refusal(plate(inp, more, points), folder);
  }
  std::string warned(const std::string& inp, const std::string& more = "", const std::string& points = "") const {
    return warnings(plate(inp, more, points), folder);
  }
  std::filesystem::path folder;
};

const std::string two_cells = "*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n*ELEMENT, TYPE=CPS4, ELSET=all\n1,1,2,5,4\n2,2,3,6,5\n";

TEST_F(PlateFile, WithAFaultyMeshIsRefusedWithTheCells) {
  EXPECT_EQ(rejected(two_cells), "accepted");
  EXPECT_EQ(warned(two_cells), "");
  expect_says(rejected(two_cells + "7,2,3,6,5\n"), {"test.yaml:2", "bodies.part", "cells 2 and 7", "twice"});
  expect_says(warned("*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n7,1,1\n*ELEMENT, TYPE=CPS4\n1,1,2,5,4\n2,2,3,6,7\n"),
              {"from nodes 2 and 5 and from nodes 7 and 2", "slit", "merge", "at node 2", "hinge"});
  expect_says(rejected("*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n7,1,1\n8,1,0\n*ELEMENT, TYPE=CPS4\n1,1,2,5,4\n2,8,3,6,7\n"),
              {"2 pieces", "merge nodes"});
}

TEST_F(PlateFile, CardsThatMakeAnotherBodyAreRefusedByLine) {
  for (const char* card : {"*EQUATION\n2\n1,1,1.,3,1,-1.\n", "*TIE, NAME=t\na,b\n", "*MPC\nBEAM,1,2\n",
                           "*RIGID BODY, ELSET=all, REF NODE=1\n", "*EMBEDDED ELEMENT\nall\n", "*SPRING, ELSET=s\n\n100.\n"}) {
    const std::string word = std::string(card).substr(0, std::string(card).find_first_of(",\n"));
    expect_says(rejected(two_cells + card), {"part.inp:11: ", word, "not supported"});
  }
}

TEST_F(PlateFile, CardsThatTheSceneAnswersAreWarnedOfAndOutputIsNot) {
  expect_says(warned(two_cells + "*BOUNDARY\n1,1,2\n*CLOAD\n3,1,5.\n"),
              {"*BOUNDARY (part.inp:11) and *CLOAD (part.inp:13)", "those of the scene apply"});
  expect_says(warned(two_cells + "*COUPLING, REF NODE=1, SURFACE=s\n*KINEMATIC\n"), {"*COUPLING (part.inp:11)", "hole: NAME"});
  expect_says(warned(two_cells + "*WHATEVER\n1,2\n"), {"*WHATEVER (part.inp:11)", "unknown and ignored"});
  expect_says(warned(two_cells + "*MATERIAL,NAME=s\n*PLASTIC\n1,0\n"), {"*PLASTIC (part.inp:12)", "linear"});
  EXPECT_EQ(
      warned("*HEADING\n a title\n** a comment\n" + two_cells + "*STEP\n*STATIC\n*NODE FILE\nU\n*EL FILE\nS\n*OUTPUT, FIELD\n*END STEP\n"),
      "");
}

TEST_F(PlateFile, MaterialAndThicknessThatContradictTheSceneAreWarnedOf) {
  const auto section = [&](const std::string& t, const std::string& E, const std::string& nu) {
    return two_cells + "*MATERIAL, NAME=m\n*ELASTIC\n" + E + "," + nu + "\n*SOLID SECTION, ELSET=all, MATERIAL=m\n" + t + "\n";
  };
  EXPECT_EQ(warned(section("5.", "200000.", "0.3"), ", unit: mm"), "");
  EXPECT_EQ(warned(section("", "2e11", "0.3")), "");
  expect_says(warned(section("4.", "200000.", "0.3"), ", unit: mm"), {"part.inp:14", "thickness 4", "0.004 m", "0.005 m"});
  expect_says(warned(section("5.", "70000.", "0.3"), ", unit: mm"), {"part.inp:12", "7e+04", "2e+11 Pa"});
  expect_says(warned(section("5.", "200000.", "0.33"), ", unit: mm"), {"part.inp:12", "0.33", "0.3;"});
  expect_says(warned(two_cells + "*ELSET, ELSET=r\n2\n*SOLID SECTION, ELSET=all, MATERIAL=steel\n*SOLID SECTION, ELSET=r, MATERIAL=alu\n"),
              {"2 materials", "steel", "alu"});
}

TEST_F(PlateFile, OfPlaneStrainMustBeAskedFor) {
  std::string strain = two_cells;
  strain.replace(strain.find("CPS4"), 4, "CPE4");
  expect_says(rejected(strain), {"part.inp:9", "plane strain", "plane: strain"});
  EXPECT_EQ(rejected(strain, ", plane: strain"), "accepted");
  EXPECT_EQ(warned(strain, ", plane: strain"), "");
  expect_says(warned(strain, ", plane: stress"), {"part.inp:9", "the scene sets plane stress"});
  expect_says(rejected(two_cells + "*NODE\n7,3,0\n*ELEMENT,TYPE=CPE3\n9,3,7,6\n"), {"part.inp:14", "plane strain", "line 9"});
}

TEST_F(PlateFile, LinesWithASectionBesideCellsAreRefusedAndEdgesAreNot) {
  const std::string edge = two_cells + "*ELEMENT, TYPE=B31, ELSET=rib\n11,1,2\n12,2,3\n";
  EXPECT_EQ(warned(edge), "");
  expect_says(rejected(edge + "*BEAM SECTION, ELSET=rib, SECTION=RECT, MATERIAL=m\n1,1\n"), {"part.inp:14", "2 line elements", "\"rib\""});
  expect_says(warned(two_cells + "*NODE\n9,5,5\n*ELEMENT, TYPE=T2D2\n21,6,9\n"), {"part.inp:14", "element 21", "is ignored"});
}

TEST_F(PlateFile, ReadInMetresThatMeansMillimetresIsWarnedOf) {
  const std::string big = "*NODE\n1,0,0\n2,200,0\n3,200,20\n4,0,20\n*ELEMENT, TYPE=CPS4\n1,1,2,3,4\n";
  const auto warning = [&](const std::string& inp, const std::string& more, const std::string& rest) {
    const Scene scene = read_scene_text(plate(inp, more, "", rest), (folder / "test.yaml").string(), {}, folder);
    return size_warning(scene, elastic_body(scene, scene.bodies[0]));
  };
  expect_says(warning(big, "", ""), {"201 m across", "unit: mm"});
  EXPECT_EQ(warning(big, ", unit: mm", ""), "");
  EXPECT_EQ(warning(big, ", unit: m", ""), "");
  EXPECT_EQ(warning(two_cells, "", ""), "");
  const std::string crank = "  crank:\n    rigid: {mass: 1, inertia: 1e-6}\n    points: {A: [0, 0], B: [2 mm, 0]}\n";
  expect_says(warning(two_cells, "", crank), {"2.236 m across", "a thousand times the rest", "unit: mm"});
  EXPECT_EQ(warning(two_cells, ", unit: m", crank), "");
  expect_says(rejected(big, "", "    points: {A: [0, 0], B: [200 mm, 0]}\n"), {"points.B", "thousand times", "unit: mm"});
}

/// A ring of n by 1 four-node cells, radii 10 and 20 mm; `half` names the inner nodes of the first n/2 + 1.
std::string ring(int n) {
  std::ostringstream s;
  s << std::setprecision(17) << "*NODE\n";
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2; ++k)
      s << 2 * i + k + 1 << "," << 10 * (k + 1) * std::cos(2 * pi * i / n) << "," << 10 * (k + 1) * std::sin(2 * pi * i / n) << "\n";
  s << "*ELEMENT, TYPE=CPS4\n";
  for (int i = 0; i < n; ++i)
    s << i + 1 << "," << 2 * i + 1 << "," << 2 * i + 2 << "," << 2 * ((i + 1) % n) + 2 << "," << 2 * ((i + 1) % n) + 1 << "\n";
  s << "*NSET, NSET=whole, GENERATE\n1," << 2 * n - 1 << ",2\n*NSET, NSET=half, GENERATE\n1," << n + 1
    << ",2\n*NSET, NSET=tenth, GENERATE\n1," << n / 5 + 1 << ",2\n";
  return s.str();
}

TEST_F(PlateFile, HalfARimIsNoHole) {
  const auto point = [](const std::string& name) { return "    points: {P: {hole: " + name + ", coupling: rigid}}\n"; };
  EXPECT_EQ(warned(ring(40), ", unit: mm", point("whole")), "");
  expect_says(rejected(ring(40), ", unit: mm", point("half")),
              {"points.P", "\"half\" covers 180 of 360 deg", "radius 0.01 m", "whole rim"});
  expect_says(warned(ring(40), ", unit: mm", point("tenth")), {"covers 36 of 360 deg", "centre of that arc"});
}

TEST_F(PlateFile, AStraightEdgeMayCarryAPoint) {
  EXPECT_EQ(warned(two_cells + "*NSET, NSET=left\n1,4\n", "", "    points: {P: {hole: left, coupling: rigid}}\n"), "");
}

TEST(RimShape, OfARoundHoleIsItsCircle) {
  const Mesh mesh = mesh_link(Disc{0.2, 0.1}, {});
  const RimShape rim = rim_shape(mesh, mesh.group("bore")->sides);
  EXPECT_EQ(rim.loops, 1);
  EXPECT_EQ(rim.open, 0);
  EXPECT_NEAR(rim.radius, 0.05, 1e-9);
  EXPECT_NEAR(rim.angle, 2 * pi, 1e-9);
  EXPECT_LT(rim.center.norm(), 1e-9);
}

// A warning of the mesh reaches the model of a mechanism, and so run, check and run.json.
TEST_F(PlateFile, DoubtsReachTheMechanism) {
  const std::string text =
      plate(two_cells + "*BOUNDARY\n1,1,2\n", "", "    points: {A: [0, 0]}\n", "joints:\n  pin: {revolute: [ground, part.A]}\n\n");
  const Model model = build(read_scene_text(text, (folder / "test.yaml").string(), {}, folder));
  const bool told = std::any_of(model.warnings.begin(), model.warnings.end(),
                                [](const std::string& w) { return w.find("*BOUNDARY") != std::string::npos; });
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace pintle::unsound_body_test
