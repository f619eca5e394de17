// Meshes whose cells do not make one sheet, and those that do.
#include "meshes/soundness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "meshes/generate.h"
#include "meshes/gmsh.h"
#include "meshes/inp.h"
#include "meshes/quality.h"

namespace pintle::soundness_test {
namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;

const std::vector<CellShape> plane_shapes{CellShape::triangle3, CellShape::triangle6, CellShape::quadrilateral4, CellShape::quadrilateral8,
                                          CellShape::quadrilateral9};

Mesh grid(int nx, int ny, CellShape shape, Vector2d low = {0, 0}, Vector2d high = {4, 2}) {
  const Vector2d corners[4]{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  return grid_mesh(corners, nx, ny, shape);
}

/// Puts the cells of one mesh beside those of another; nodes less than 1e-9 apart become one if `merge`.
Mesh together(const Mesh& a, const Mesh& b, bool merge) {
  Mesh out = a;
  std::vector<int> to;
  for (Eigen::Index i = 0; i < b.x.cols(); ++i) {
    const int there = merge ? nearest_node(a, b.x.col(i), 1e-9) : -1;
    to.push_back(there >= 0 ? there : static_cast<int>(out.x.cols()));
    if (there >= 0) continue;
    out.x.conservativeResize(2, out.x.cols() + 1);
    out.x.col(out.x.cols() - 1) = b.x.col(i);
    out.node_numbers.push_back(1000 + b.node_numbers[static_cast<std::size_t>(i)]);
  }
  for (Cells cells : b.cells) {
    for (int& node : cells.nodes) node = to[static_cast<std::size_t>(node)];
    for (long& number : cells.numbers) number += 500;
    out.cells.push_back(std::move(cells));
  }
  return out;
}

std::string fault(const Mesh& mesh) {
  const Soundness s = soundness(mesh);
  return s.faults.empty() ? "" : s.faults.front();
}
std::string warning(const Mesh& mesh) {
  const Soundness s = soundness(mesh);
  EXPECT_TRUE(s.faults.empty()) << s.faults.front();
  return s.warnings_of.empty() ? "" : s.warnings_of.front();
}
void expect_words(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << "\"" << text << "\" lacks " << word;
}
void expect_sound(const Mesh& mesh, const std::string& what) {
  const Soundness s = soundness(mesh);
  EXPECT_TRUE(s.faults.empty()) << what << ": " << s.faults.front();
  EXPECT_TRUE(s.warnings_of.empty()) << what << ": " << s.warnings_of.front();
}

TEST(Soundness, GridsAndLinksOfEveryShapeAreSound) {
  for (const CellShape shape : plane_shapes) {
    expect_sound(grid(5, 3, shape), name_of(shape));
    const Vector2d skew[4]{{0, 0}, {1, 0.1}, {1.3, 0.9}, {-0.2, 0.5}};
    expect_sound(grid_mesh(skew, 7, 40, shape), name_of(shape));
    MeshOptions options;
    options.shape = shape;
    for (const Link& link :
         {Link{EyeBar{0.12, 0.014, {0.024, 0.038}, {0.012, 0.022}}}, Link{Disc{0.2, 0.19}}, Link{Disc{0.2, 0.1}},
          Link{Triangle{{{0, 0}, {0.1, 0}, {0.05, 0.08}}, {{0.01, 0.02}, {0.01, 0.02}, {0.01, 0.02}}}}, Link{TaperedBar{0.1, 0.02, 0.01}}})
      expect_sound(mesh_link(link, options), name_of(shape));
  }
}

TEST(Soundness, MeshesOfTheTestsAndExamplesAreSound) {
  for (const char* folder : {"tests/data/meshes", "examples/verification", "examples"})
    for (const auto& file : fs::directory_iterator(fs::path(PINTLE_SOURCE_DIR) / folder)) {
      const std::string kind = file.path().extension().string();
      if (kind != ".inp" && kind != ".msh" && kind != ".geo" && kind != ".step" && kind != ".brep") continue;
      Mesh mesh = kind == ".inp" ? read_inp(file.path()) : read_geometry(file.path(), {});
      orient(mesh);
      expect_sound(mesh, file.path().string());
    }
}

// A slot much narrower than the cells along it is a slot.
TEST(Soundness, NarrowGapsAreNoSlits) {
  Mesh c = together(grid(4, 1, CellShape::quadrilateral4, {0, 0}, {4, 1}), grid(4, 1, CellShape::quadrilateral4, {0, 1.01}, {4, 2}), false);
  c = together(c, grid(1, 1, CellShape::quadrilateral4, {4, 0}, {5, 1}), true);
  EXPECT_TRUE(soundness(c).faults.empty());
  EXPECT_TRUE(soundness(c).warnings_of.empty());
}

TEST(Unsound, CellsThatStandTwiceAreNamedByTheirNumbers) {
  for (const CellShape shape : plane_shapes) {
    Mesh mesh = grid(4, 2, shape);
    Cells& cells = mesh.cells.front();
    const auto n = static_cast<std::ptrdiff_t>(nodes_of(shape));
    const std::vector<int> second(cells.nodes.begin() + n, cells.nodes.begin() + 2 * n);
    cells.nodes.insert(cells.nodes.end(), second.begin(), second.end());
    cells.numbers.push_back(77);
    expect_words(fault(mesh), {"cells 2 and 77", "twice"});
  }
}

TEST(Unsound, CellsThatOverlapWithNodesOfTheirOwnAreFound) {
  for (const CellShape shape : plane_shapes)
    for (const double shift : {0.0, 0.4, 0.8}) {
      const Mesh over = grid(1, 1, shape, {1 + shift, 0.2}, {2 + shift, 1.2});
      expect_words(fault(together(grid(4, 2, shape), over, false)), {"overlap", "cell 501", "twice"});
    }
}

TEST(Unsound, ALayerThatSharesOnlyAFewNodesIsFound) {
  for (const CellShape shape : plane_shapes) {
    // Over the left half a second layer, joined to the first along its left edge alone.
    Mesh mesh = grid(4, 2, shape), layer = grid(2, 2, shape, {0, 0}, {2, 2});
    Mesh both = together(mesh, layer, false);
    for (Cells& cells : both.cells)
      for (int& node : cells.nodes)
        if (both.x(0, node) == 0) node = nearest_node(mesh, both.x.col(node), 1e-9);
    EXPECT_FALSE(fault(both).empty()) << name_of(shape);
  }
}

TEST(Unsound, HangingNodesAreFoundOnStraightAndCurvedSides) {
  for (const CellShape shape : plane_shapes) {
    const Mesh coarse = grid(1, 1, shape, {0, 0}, {1, 1}), fine = grid(3, 3, shape, {1, 0}, {2, 1});
    expect_words(fault(together(coarse, fine, true)), {"lies on the side between nodes", "not a node of that cell", "side to side"});
  }
}

TEST(Unsound, HangingNodesInThePlaceOfAMiddleNodeAreFound) {
  for (const CellShape shape : {CellShape::triangle6, CellShape::quadrilateral8, CellShape::quadrilateral9}) {
    const Mesh coarse = grid(1, 1, shape, {0, 0}, {1, 1}), fine = grid(2, 2, CellShape::quadrilateral4, {1, 0}, {2, 1});
    expect_words(fault(together(coarse, fine, true)), {"in the middle of a side", "a corner of"});
  }
}

TEST(Unsound, QuadraticBesideLinearCellsCrack) {
  for (const CellShape shape : {CellShape::triangle6, CellShape::quadrilateral8, CellShape::quadrilateral9}) {
    const Mesh coarse = grid(1, 1, shape, {0, 0}, {1, 1}), other = grid(1, 1, CellShape::quadrilateral4, {1, 0}, {2, 1});
    expect_words(fault(together(coarse, other, true)), {"share the side", "no middle node", "the middle node", "the same order"});
  }
}

TEST(Unsound, UnmergedNodesAreASlitThatIsDoubted) {
  for (const CellShape shape : plane_shapes) {
    Mesh mesh = together(grid(2, 2, shape, {0, 0}, {2, 2}), grid(2, 2, shape, {2, 0}, {4, 2}), false);
    expect_words(warning(mesh), {"lie on each other", "slit", "merge"});
    std::vector<int> piece;
    ASSERT_EQ(pieces(mesh, piece), 2);
    const auto pair = unjoined(mesh, piece);
    ASSERT_TRUE(pair);
    EXPECT_EQ(mesh.x.col(pair->first), mesh.x.col(pair->second));
  }
}

TEST(Unsound, CellsThatMeetAtOneNodeAreAHinge) {
  for (const CellShape shape : plane_shapes) {
    const Mesh mesh = together(grid(2, 2, shape, {0, 0}, {2, 2}), grid(2, 2, shape, {2, 2}, {4, 4}), true);
    expect_words(warning(mesh), {"share only this node", "(2, 2) m", "hinge"});
  }
}

TEST(Unsound, ThreeCellsAtOneSideAreFound) {
  Mesh mesh = grid(2, 1, CellShape::quadrilateral4, {0, 0}, {2, 1});
  // Stands on the side between the two, over the right one, with corners of its own.
  mesh = together(mesh, grid(1, 1, CellShape::quadrilateral4, {1, 0}, {1.7, 1}), true);
  expect_words(fault(mesh), {"overlap", "501"});
}

// What the scatter of digits in a file does must not turn a sound mesh into a doubted one.
TEST(Soundness, CoordinatesOfSixDigitsAreSound) {
  for (const CellShape shape : plane_shapes) {
    MeshOptions options;
    options.shape = shape;
    Mesh mesh = mesh_link(EyeBar{0.12, 0.014, {0.024, 0.038}, {0.012, 0.022}}, options);
    for (double& x : mesh.x.reshaped()) x = std::strtod(std::to_string(x).c_str(), nullptr);
    expect_sound(mesh, name_of(shape));
  }
}

}  // namespace
}  // namespace pintle::soundness_test
