// Meshes by Gmsh: links, drawings and finished meshes. Areas, circles and places are those of the
// drawings, worked out here by hand.

#include "meshes/gmsh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "meshes/quality.h"
#include "tests/unit/meshes/mesh_sides.h"
#include "tests/refusal.h"

namespace pintle::gmsh_test {
namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;

const fs::path data = fs::path(PINTLE_SOURCE_DIR) / "tests/data/meshes";
// Coordinates pass through Gmsh's angles and back: some hundred roundings of the body's size.
constexpr double rounding = 1e-12;

constexpr std::array plane_shapes{CellShape::triangle3, CellShape::triangle6, CellShape::quadrilateral4, CellShape::quadrilateral8,
                                  CellShape::quadrilateral9};

struct Round {
  std::string name;
  Vector2d center;
  double radius;
};
struct Sample {
  const char* name;
  Link link;
  double length;  // of the body
  std::vector<Round> holes;
};
const std::vector<Sample> samples{
    {"StraightBar", StraightBar{0.5, 0.05}, 0.5, {}},
    {"EyeBar", EyeBar{0.3, 0.03, {0.03, 0.06}, {0.02, 0.04}}, 0.35, {{"eye 1", {0, 0}, 0.015}, {"eye 2", {0.3, 0}, 0.01}}},
    {"TaperedBar", TaperedBar{0.5, 0.08, 0.03}, 0.5, {}},
    {"Triangle",
     Triangle{{{0, 0}, {0.3, 0}, {0.1, 0.2}}, {{0.03, 0.06}, {0.02, 0.05}, {0.02, 0.04}}},
     0.35,
     {{"eye 1", {0, 0}, 0.015}, {"eye 2", {0.3, 0}, 0.01}, {"eye 3", {0.1, 0.2}, 0.01}}},
    {"Disc", Disc{0.2, 0.05}, 0.2, {{"bore", {0, 0}, 0.025}}}};

double longest(const Mesh& mesh, const std::vector<Cells>& blocks) {
  double most = 0;
  for (const Cells& c : blocks)
    for (std::size_t s = 0; s < c.size(); ++s) {
      const int* node = &c.nodes[s * static_cast<std::size_t>(nodes_of(c.shape))];
      most = std::max(most, (mesh.x.col(node[0]) - mesh.x.col(node[1])).norm());
    }
  return most;
}
std::string complaint(const fs::path& path, const MeshOptions& options = {}, double scale = 1) {
  return pintle_test::refusal_by<std::exception>([&] { read_geometry(path, options, scale); });
}
/// A drawing of its own, removed at the end.
class Drawing {
 public:
  explicit Drawing(const std::string& text, const std::string& end = "\n") {
    std::string pattern = (fs::temp_directory_path() / "pintle_geo_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    std::ofstream(path()) << text << end;
  }
  ~Drawing() { fs::remove_all(folder_); }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  fs::path path() const { return folder_ / "drawing.geo"; }

 private:
  fs::path folder_;
};

class LinkMesh : public testing::TestWithParam<Sample> {
 protected:
  const Sample& link_ = GetParam();
  Mesh mesh(CellShape shape, double share) const { return mesh_link(link_.link, {shape, share * link_.length, 0, {}}); }
};

// A thirtieth to a tenth of the length: from one or two cells across a shank to eight. Good is a
// Jacobian of 0.4 at every node; 0.1 is the bar below which a cell is called bad.
TEST_P(LinkMesh, IsGoodAtEveryNodeInEveryShapeAndSize) {
  for (const CellShape shape : plane_shapes)
    for (const double share : {0.1, 0.04, 0.012}) {
      const Mesh m = mesh(shape, share);
      const MeshQuality q = quality(m);
      EXPECT_GT(q.least_jacobian, 0.4) << name_of(shape) << " at " << share;
      EXPECT_GT(q.mean_jacobian, 0.8) << name_of(shape) << " at " << share;
      ASSERT_EQ(m.cells.size(), 1u) << "cells of one shape";
      EXPECT_EQ(m.cells[0].shape, shape);
      std::vector<int> piece;
      EXPECT_EQ(pieces(m, piece), 1);
    }
}

TEST_P(LinkMesh, HolesAreRoundToTheLastMiddleNode) {
  for (const CellShape shape : plane_shapes) {
    const Mesh m = mesh(shape, 0.05);
    for (const Round& hole : link_.holes) {
      const Group* g = m.group(hole.name);
      ASSERT_NE(g, nullptr) << hole.name;
      for (const int node : g->nodes)
        EXPECT_NEAR((m.x.col(node) - hole.center).norm(), hole.radius, rounding * link_.length) << name_of(shape);
      EXPECT_GE(count(g->sides), 20u);
    }
  }
}

// The body's area is that inside the outline less the holes'; second-order sides miss an arc's area
// by less than a thousandth, and each group must have the body on its left for the signs to come
// out.
TEST_P(LinkMesh, GroupsCloseRoundTheBody) {
  for (const CellShape shape : {CellShape::triangle6, CellShape::quadrilateral8, CellShape::quadrilateral9}) {
    const Mesh m = mesh(shape, 0.05);
    double sum = 0;
    for (const Group& g : m.groups) sum += area_left_of(m, g.sides);
    EXPECT_NEAR(sum, area_left_of(m, outline(m)), rounding) << "every side of the outline is in one group";
    for (const Round& hole : link_.holes) {
      const double circle = M_PI * hole.radius * hole.radius;
      EXPECT_NEAR(area_left_of(m, m.group(hole.name)->sides), -circle, 1e-3 * circle) << hole.name;
    }
  }
}

TEST_P(LinkMesh, SameInputGivesTheSameBits) {
  for (const CellShape shape : {CellShape::triangle6, CellShape::quadrilateral8}) {
    const Mesh first = mesh(shape, 0.05);
    mesh(CellShape::triangle3, 0.031);  // something else in between
    const Mesh again = mesh(shape, 0.05);
    ASSERT_EQ(first.x.cols(), again.x.cols());
    EXPECT_TRUE((first.x.array() == again.x.array()).all());
    EXPECT_EQ(first.cells[0].nodes, again.cells[0].nodes);
  }
}

TEST_P(LinkMesh, SizesAreKept) {
  const double size = 0.03 * link_.length;
  for (const CellShape shape : plane_shapes) {
    const Mesh m = mesh_link(link_.link, {shape, size, size / 4, {}});
    // Free meshing places corners a little off the size asked for.
    for (const Round& hole : link_.holes) EXPECT_LT(longest(m, m.group(hole.name)->sides), 1.05 * size / 4) << name_of(shape);
    EXPECT_LT(longest(m, outline(m)), 1.3 * size) << name_of(shape);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, LinkMesh, testing::ValuesIn(samples),
                         [](const testing::TestParamInfo<Sample>& param) { return std::string(param.param.name); });

TEST(LinkMeshArea, IsThatOfTheDrawing) {
  // Bar with eyes: outer discs and shank, less what the shank covers twice, less the bores.
  const double R = 0.03, r = 0.02, h = 0.015, L = 0.3;
  const auto segment = [&](double radius) {  // of the disc, beyond its chord of half-height h
    const double a = std::asin(h / radius);
    return radius * radius * (a - std::sin(a) * std::cos(a));
  };
  const double shank = 2 * h * (L - std::sqrt(R * R - h * h) - std::sqrt(r * r - h * h));
  const double area = M_PI * (R * R + r * r - 0.015 * 0.015 - 0.01 * 0.01) - segment(R) - segment(r) + shank;
  const Mesh m = mesh_link(samples[1].link, {CellShape::triangle6, 0.01, 0, {}});
  EXPECT_NEAR(area_left_of(m, outline(m)), area, 1e-4 * area);
}

TEST(LinkMeshPoints, BecomeNodesExactly) {
  const std::vector<Vector2d> on_bar{{0, 0}, {0.5, 0}, {0.123, 0.0077}, {0.31, 0.025}, {0.5, -0.025}, {0.2, -0.025}};
  const std::vector<Vector2d> on_taper{{0, 0}, {0.5, 0.015}, {0.25, 0.0275}, {0.3, 0.01}};
  const std::vector<Vector2d> on_eyes{{0.15, 0}, {0.15, 0.015}, {-0.03, 0}, {0.2, -0.004}, {0, 0.015}, {0, 0.022}};
  const std::vector<Vector2d> on_triangle{{0.13, 0.05}, {0.1, 0.22}, {0.09, 0.2}};
  const std::vector<Vector2d> on_disc{{0.1, 0}, {0, 0.1}, {0.06, 0.01}, {-0.025, 0}, {0.1 / std::sqrt(2), 0.1 / std::sqrt(2)}};
  const std::vector<Vector2d> points[] = {on_bar, on_eyes, on_taper, on_triangle, on_disc};
  for (std::size_t k = 0; k < samples.size(); ++k)
    for (const CellShape shape : plane_shapes) {
      const Mesh m = mesh_link(samples[k].link, {shape, 0.04 * samples[k].length, 0, points[k]});
      for (const Vector2d& p : points[k]) {
        EXPECT_GE(nearest_node(m, p, 0), 0) << samples[k].name << " " << name_of(shape) << " " << p.transpose();
      }
      EXPECT_TRUE(quality(m).bad.empty()) << samples[k].name << " " << name_of(shape);
    }
}

TEST(LinkMeshPoints, AreRefusedWhereThereIsNoMaterial) {
  for (const CellShape shape : {CellShape::triangle6, CellShape::quadrilateral8})
    for (const auto& [k, p, words] : {std::tuple{1u, Vector2d{0.003, 0.002}, "in a hole"},
                                      {1u, Vector2d{0.15, 0.02}, "outside"},
                                      {4u, Vector2d{0.01, 0}, "hole"},
                                      {0u, Vector2d{0.2, 0.0251}, "outside"},
                                      {2u, Vector2d{0.5, 0.02}, "outside"}}) {
      SCOPED_TRACE(samples[k].name + std::string(" ") + std::string(name_of(shape)));
      pintle_test::expect_refused<std::invalid_argument>([&, &k = k, &p = p] { mesh_link(samples[k].link, {shape, 0, 0, {p}}); }, {words});
    }
}

TEST(LinkMeshOptions, AreJudged) {
  const Link bar = samples[0].link, eyes = samples[1].link;
  EXPECT_THROW(mesh_link(bar, {CellShape::line2, 0, 0, {}}), std::invalid_argument);
  EXPECT_THROW(mesh_link(bar, {CellShape::triangle6, -1, 0, {}}), std::invalid_argument);
  EXPECT_THROW(mesh_link(bar, {CellShape::triangle6, NAN, 0, {}}), std::invalid_argument);
  EXPECT_THROW(mesh_link(eyes, {CellShape::triangle6, 0, -1, {}}), std::invalid_argument);
  EXPECT_THROW(mesh_link(eyes, {CellShape::triangle6, 1e-8, 0, {}}), std::invalid_argument) << "too many cells";
  EXPECT_THROW(mesh_link(bar, {CellShape::quadrilateral8, 1e-8, 0, {}}), std::invalid_argument) << "too many cells";
  EXPECT_THROW(mesh_link(EyeBar{0.3, 0.1, {0.03, 0.06}, {0.02, 0.04}}, {}), std::invalid_argument);
}

// The plate of the STEP and BREP files: 120 mm by 40 mm, holes of radius 10 mm and 5 mm at x = 20
// and 100 mm.
void expect_plate(const Mesh& m) {
  const double area = 0.120 * 0.040 - M_PI * (0.010 * 0.010 + 0.005 * 0.005);
  EXPECT_NEAR(area_left_of(m, outline(m)), area, 1e-5 * area);
  const Round holes[] = {{"hole 1", {0.020, 0}, 0.010}, {"hole 2", {0.100, 0}, 0.005}};
  for (const Round& hole : holes) {
    const Group* g = m.group(hole.name);
    ASSERT_NE(g, nullptr) << hole.name;
    EXPECT_EQ(count(g->sides), 24u);
    for (const int node : g->nodes) EXPECT_NEAR((m.x.col(node) - hole.center).norm(), hole.radius, 1e-9) << "7 digits in the file";
  }
  ASSERT_NE(m.group("outline"), nullptr);
  EXPECT_NEAR(area_left_of(m, m.group("outline")->sides), 0.0048, 1e-9);
  EXPECT_GT(quality(m).least_jacobian, 0.4);
}

TEST(StepFile, InMillimetresComesOutInMetres) { expect_plate(read_geometry(data / "plate_mm.step", {})); }
TEST(BrepFile, HasNoUnitSoScaleGivesIt) { expect_plate(read_geometry(data / "plate_mm.brep", {}, 0.001)); }
TEST(StepFile, PointsBecomeNodes) {
  for (const CellShape shape : plane_shapes) {
    const std::vector<Vector2d> points{{0.06, 0.005}, {0, 0}, {0.05, 0.02}, {0.12, 0.02}};
    const Mesh m = read_geometry(data / "plate_mm.step", {shape, 0, 0, points});
    for (const Vector2d& p : points) EXPECT_GE(nearest_node(m, p, 0), 0) << name_of(shape) << " " << p.transpose();
    EXPECT_TRUE(quality(m).bad.empty()) << name_of(shape);
  }
}

// The plate of rocker.geo and of the meshes made of it: see the file.
void expect_rocker(const Mesh& m, double unit = 1) {
  const Group *pin = m.group("pin hole"), *left = m.group("left edge"), *corner = m.group("corner"), *steel = m.group("steel"),
              *unnamed = m.group("hole 1");
  ASSERT_TRUE(pin && left && corner && steel && unnamed);
  for (const int node : pin->nodes) EXPECT_NEAR((m.x.col(node) - unit * Vector2d(0.02, 0)).norm(), unit * 0.01, unit * rounding);
  for (const int node : unnamed->nodes) EXPECT_NEAR((m.x.col(node) - unit * Vector2d(0.10, 0)).norm(), unit * 0.01, unit * rounding);
  for (const int node : left->nodes) EXPECT_EQ(m.x(0, node), 0);
  EXPECT_LT(area_left_of(m, pin->sides), 0);
  EXPECT_LT(area_left_of(m, unnamed->sides), 0);
  ASSERT_EQ(corner->nodes.size(), 1u);
  EXPECT_LT((m.x.col(corner->nodes[0]) - unit * Vector2d(0.12, 0.02)).norm(), unit * rounding);
  EXPECT_EQ(static_cast<Eigen::Index>(steel->nodes.size()), m.x.cols());
  EXPECT_EQ(m.group("outline"), nullptr) << "part of it is called \"left edge\"";
  EXPECT_EQ(m.group("hole 2"), nullptr);
}

TEST(GeoFile, PhysicalNamesAreGroupsAndOtherHolesGetNames) {
  for (const CellShape shape : plane_shapes) {
    const Mesh m = read_geometry(data / "rocker.geo", {shape, 0, 0, {}});
    expect_rocker(m);
    EXPECT_EQ(m.cells[0].shape, shape);
  }
}
TEST(GeoFile, ScaleMultipliesLengthsAndSizesAreInMetres) {
  const Mesh m = read_geometry(data / "rocker.geo", {CellShape::triangle6, 2, 0.5, {{60, 10}}}, 1000);
  expect_rocker(m, 1000);
  EXPECT_LT(longest(m, m.group("pin hole")->sides), 0.5 * 1.05);
  EXPECT_GE(nearest_node(m, {60, 10}, 0), 0);
}
TEST(MshFile, OfBothFormatsGivesTheSameGroups) {
  const Mesh old = read_geometry(data / "rocker_22.msh", {}), now = read_geometry(data / "rocker_41.msh", {});
  EXPECT_EQ(old.cells[0].shape, CellShape::triangle6);
  EXPECT_EQ(now.cells[0].shape, CellShape::triangle3);
  expect_rocker(old);
  expect_rocker(now);
  expect_rocker(read_geometry(data / "rocker_22.msh", {}, 1000), 1000);
}

const std::string square =
    "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={1,1,0}; Point(4)={0,1,0};\n"
    "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4};\n";

TEST(GeoFile, OwnSizesHoldWhereTheyAreSmallerUnlessASizeIsGiven) {
  const Drawing fine(square + "Plane Surface(1)={1}; MeshSize{1:4}=0.02;");
  const Mesh own = read_geometry(fine.path(), {CellShape::triangle3, 0, 0, {}});
  EXPECT_NEAR(longest(own, outline(own)), 0.02, 0.001);
  const Mesh asked = read_geometry(fine.path(), {CellShape::triangle3, 0.25, 0, {}});
  EXPECT_NEAR(longest(asked, outline(asked)), 0.25, 0.01);
}
TEST(GeoFile, OptionsOfOneDrawingDoNotReachTheNext) {
  const Drawing plain(square + "Plane Surface(1)={1};"), wild(square + "Plane Surface(1)={1}; Mesh.MeshSizeMax=0.01; Mesh.Algorithm=1;");
  const Mesh before = read_geometry(plain.path(), {});
  read_geometry(wild.path(), {});
  const Mesh after = read_geometry(plain.path(), {});
  ASSERT_EQ(before.x.cols(), after.x.cols());
  EXPECT_TRUE((before.x.array() == after.x.array()).all());
}
TEST(GeoFile, PhysicalSurfaceSaysWhatIsTheBody) {
  const Drawing two(square +
                    "Plane Surface(1)={1}; Point(5)={3,0,0}; Point(6)={3,1,0}; Line(5)={2,5}; Line(6)={5,6}; "
                    "Line(7)={6,3};"
                    "Curve Loop(2)={5,6,7,-2}; Plane Surface(2)={2}; Physical Surface(\"link\")={2};");
  const Mesh m = read_geometry(two.path(), {});
  EXPECT_NEAR(area_left_of(m, outline(m)), 2, rounding);
  EXPECT_EQ(m.x.row(0).minCoeff(), 1);
}
TEST(GeoFile, TransfiniteCurvesStand) {
  const Drawing drawing(square + "Plane Surface(1)={1}; Transfinite Curve{1:4}=5; Transfinite Surface{1};");
  EXPECT_EQ(read_geometry(drawing.path(), {CellShape::triangle6, 0, 0, {}}).cell_count(), 32u);
  EXPECT_EQ(read_geometry(drawing.path(), {CellShape::quadrilateral8, 0, 0, {}}).cell_count(), 16u);
}
TEST(GeoFile, ClockwiseFacesAreTurned) {
  const Drawing drawing(square + "Curve Loop(2)={-4,-3,-2,-1}; Plane Surface(1)={2};");
  const Mesh m = read_geometry(drawing.path(), {});
  EXPECT_GT(quality(m).least_jacobian, 0.4);
  EXPECT_NEAR(area_left_of(m, outline(m)), 1, rounding);
}

TEST(Gmsh, IsSilent) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  mesh_link(samples[3].link, {CellShape::quadrilateral9, 0.02, 0, {}});
  read_geometry(data / "plate_mm.step", {});
  read_geometry(data / "rocker_22.msh", {});
  complaint(Drawing("Point(1)={0,0;").path());
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(GeometryRefused, SayingWhatAndWhy) {
  const auto says = [](const std::string& text, const std::string& words) {
    const std::string said = complaint(Drawing(text).path());
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("drawing.geo"), std::string::npos) << said;
  };
  says("Point(1)={0,0,0};", "no surface");
  says("", "no surface");
  says("Point(1)={0,0;", "syntax error");
  says(square + "Plane Surface(1)={9};", "Gmsh cannot");
  says("SetFactory(\"OpenCASCADE\"); Box(1)={0,0,0,1,1,1};", "solid");
  says("SetFactory(\"OpenCASCADE\"); Rectangle(1)={0,0,0.5,1,1};", "z = 0");
  says(
      "SetFactory(\"OpenCASCADE\"); Rectangle(1)={0,0,0,1,1}; "
      "Rotate{{1,0,0},{0,0,0},0.3}{Surface{1};}",
      "z = 0");
  says("SetFactory(\"OpenCASCADE\"); Sphere(1)={0,0,0,1};", "solid");
  EXPECT_NE(complaint(Drawing(square + "Plane Surface(1)={1};", "").path()).find("newline"), std::string::npos);
  EXPECT_NE(complaint(data / "no_such_file.step").find("no such file"), std::string::npos);
  EXPECT_THROW(read_geometry(data / "no_such_file.step", {}), std::runtime_error);
  EXPECT_THROW(read_geometry(Drawing("Point(1)={0,0;").path(), {}), std::runtime_error);
  EXPECT_THROW(read_geometry(Drawing("Point(1)={0,0,0};").path(), {}), std::invalid_argument);
  EXPECT_NE(complaint("drawing.dwg").find("not a known kind of drawing"), std::string::npos);
  EXPECT_NE(complaint(data / "rocker.geo", {}, 0).find("scale"), std::string::npos);
  EXPECT_NE(complaint(data / "rocker.geo", {CellShape::triangle6, 0, 0, {{0.02, 0.001}}}).find("in a hole"), std::string::npos);
}
}  // namespace
}  // namespace pintle::gmsh_test
