// Meshes without a mesher: what a mesh is, its outline, pieces, quality and sense of rotation.

#include "meshes/mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "meshes/generate.h"
#include "meshes/link.h"
#include "meshes/quality.h"
#include "meshes/rim.h"

namespace pintle::mesh_test {
namespace {

using Eigen::Vector2d;

// A few operations on numbers of one size.
constexpr double rounding = 1e-12;
constexpr std::array plane_shapes{CellShape::triangle3, CellShape::triangle6, CellShape::quadrilateral4, CellShape::quadrilateral8,
                                  CellShape::quadrilateral9};
const std::array<Vector2d, 4> unit_square{Vector2d{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const std::array<Vector2d, 4> skew{Vector2d{0, 0}, {3, 0.4}, {2.6, 2}, {-0.3, 1.5}};

Mesh one_cell(CellShape shape, const std::vector<Vector2d>& x) {
  Mesh mesh;
  mesh.x.resize(2, static_cast<Eigen::Index>(x.size()));
  Cells cells{shape, {}, {7}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    mesh.x.col(static_cast<Eigen::Index>(i)) = x[i];
    mesh.node_numbers.push_back(static_cast<long>(i) + 1);
    cells.nodes.push_back(static_cast<int>(i));
  }
  mesh.cells.push_back(cells);
  return mesh;
}
double corner_area(const Mesh& mesh) {
  double area = 0;
  for (const Cells& c : mesh.cells) {
    const int n = nodes_of(c.shape), corners = corners_of(c.shape);
    for (std::size_t k = 0; k < c.size(); ++k)
      for (int i = 0; i < corners; ++i) {
        const Vector2d a = mesh.x.col(c.nodes[k * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)]);
        const Vector2d b = mesh.x.col(c.nodes[k * static_cast<std::size_t>(n) + static_cast<std::size_t>((i + 1) % corners)]);
        area += (a.x() * b.y() - a.y() * b.x()) / 2;
      }
  }
  return area;
}
std::size_t side_count(const std::vector<Cells>& blocks) {
  std::size_t n = 0;
  for (const Cells& c : blocks) n += c.size();
  return n;
}

TEST(GridMesh, CellsCoverTheQuadrilateralInEveryShape) {
  const double area = 0.5 * std::abs((skew[2] - skew[0]).x() * (skew[3] - skew[1]).y() - (skew[2] - skew[0]).y() * (skew[3] - skew[1]).x());
  for (const CellShape shape : plane_shapes) {
    const Mesh mesh = grid_mesh(skew, 5, 3, shape);
    EXPECT_EQ(mesh.cell_count(), corners_of(shape) == 3 ? 30u : 15u);
    EXPECT_NEAR(corner_area(mesh), area, rounding * area) << name_of(shape);
    EXPECT_GT(quality(mesh).least_jacobian, 0.5) << name_of(shape);
  }
}

TEST(GridMesh, NodesAreThoseOfTheLatticeAndEachBelongsToACell) {
  EXPECT_EQ(grid_mesh(unit_square, 4, 3, CellShape::triangle3).x.cols(), 5 * 4);
  EXPECT_EQ(grid_mesh(unit_square, 4, 3, CellShape::quadrilateral4).x.cols(), 5 * 4);
  EXPECT_EQ(grid_mesh(unit_square, 4, 3, CellShape::triangle6).x.cols(), 9 * 7);
  EXPECT_EQ(grid_mesh(unit_square, 4, 3, CellShape::quadrilateral9).x.cols(), 9 * 7);
  EXPECT_EQ(grid_mesh(unit_square, 4, 3, CellShape::quadrilateral8).x.cols(), 9 * 7 - 12);
}

TEST(GridMesh, GroupsAreItsFourSides) {
  for (const CellShape shape : plane_shapes) {
    const Mesh mesh = grid_mesh(unit_square, 4, 3, shape);
    const struct {
      const char* name;
      int axis;
      double at;
      std::size_t sides;
    } edges[] = {{"bottom", 1, 0, 4}, {"top", 1, 1, 4}, {"left", 0, 0, 3}, {"right", 0, 1, 3}};
    for (const auto& e : edges) {
      const Group* g = mesh.group(e.name);
      ASSERT_NE(g, nullptr);
      EXPECT_EQ(side_count(g->sides), e.sides);
      for (const int node : g->nodes) EXPECT_EQ(mesh.x(e.axis, node), e.at);
      const std::size_t per_side = nodes_of(shape) > corners_of(shape) ? 2 : 1;
      EXPECT_EQ(g->nodes.size(), per_side * e.sides + 1);
    }
  }
}

TEST(GridMesh, RefusesWhatIsNoConvexQuadrilateral) {
  const std::array<Vector2d, 4> clockwise{Vector2d{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  const std::array<Vector2d, 4> dented{Vector2d{0, 0}, {1, 0}, {0.1, 0.1}, {0, 1}};
  EXPECT_THROW(grid_mesh(clockwise, 2, 2, CellShape::triangle3), std::invalid_argument);
  EXPECT_THROW(grid_mesh(dented, 2, 2, CellShape::triangle3), std::invalid_argument);
  EXPECT_THROW(grid_mesh(unit_square, 0, 2, CellShape::triangle3), std::invalid_argument);
  EXPECT_THROW(grid_mesh(unit_square, 2, 2, CellShape::line2), std::invalid_argument);
}

TEST(LineMesh, PiecesAreCutEvenly) {
  const std::array<Vector2d, 3> corners{Vector2d{0, 0}, {3, 4}, {3, 6}};
  const std::array cells{5, 2};
  const Mesh mesh = line_mesh(corners, cells);
  EXPECT_FALSE(mesh.plane());
  ASSERT_EQ(mesh.x.cols(), 8);
  for (int i = 0; i < 7; ++i) EXPECT_NEAR((mesh.x.col(i + 1) - mesh.x.col(i)).norm(), 1, rounding);
  EXPECT_EQ(line_mesh(corners, std::array{4}).cell_count(), 8u) << "one number for all pieces";
}

TEST(LineMesh, RefusesAnAxisWithoutLength) {
  const std::array<Vector2d, 3> twice{Vector2d{0, 0}, {1, 0}, {1, 0}};
  EXPECT_THROW(line_mesh(twice, std::array{2}), std::invalid_argument);
  EXPECT_THROW(line_mesh(std::span(twice).first(1), std::array{2}), std::invalid_argument);
  EXPECT_THROW(line_mesh(std::span(twice).first(2), std::array{0}), std::invalid_argument);
  EXPECT_THROW(line_mesh(twice, std::array{1, 2, 3}), std::invalid_argument);
}

TEST(Outline, RunsRoundTheBodyOnceWithTheBodyOnItsLeft) {
  for (const CellShape shape : plane_shapes) {
    const Mesh mesh = grid_mesh(skew, 6, 4, shape);
    const auto sides = outline(mesh);
    EXPECT_EQ(side_count(sides), 20u);
    double area = 0;
    for (const Cells& c : sides)
      for (std::size_t s = 0; s < c.size(); ++s) {
        const std::size_t n = static_cast<std::size_t>(nodes_of(c.shape));
        const Vector2d a = mesh.x.col(c.nodes[s * n]), b = mesh.x.col(c.nodes[s * n + 1]);
        area += (a.x() * b.y() - a.y() * b.x()) / 2;
        const Vector2d middle = n == 3 ? Vector2d(mesh.x.col(c.nodes[s * n + 2])) : Vector2d((a + b) / 2);
        EXPECT_LT((middle - (a + b) / 2).norm(), rounding * 5);
      }
    EXPECT_NEAR(area, corner_area(mesh), rounding * area);
  }
}

TEST(Outline, SidesWithinNodesNeedAllOfThem) {
  const Mesh mesh = grid_mesh(unit_square, 4, 3, CellShape::quadrilateral8);
  std::vector<int> nodes = mesh.group("bottom")->nodes;
  EXPECT_EQ(side_count(sides_within(mesh, nodes)), 4u);
  nodes.erase(nodes.begin() + 1);
  EXPECT_EQ(side_count(sides_within(mesh, nodes)), 3u);
}

TEST(NearestNode, IsTheNearestWithinReach) {
  const Mesh mesh = grid_mesh(unit_square, 10, 10, CellShape::quadrilateral4);
  const int node = nearest_node(mesh, {0.52, 0.29}, 0.05);
  ASSERT_GE(node, 0);
  EXPECT_LT((mesh.x.col(node) - Vector2d(0.5, 0.3)).norm(), rounding);
  EXPECT_EQ(nearest_node(mesh, {0.55, 0.35}, 0.05), -1);
}

TEST(Pieces, AreWhatNoCellJoins) {
  Mesh mesh = grid_mesh(unit_square, 3, 1, CellShape::quadrilateral4);
  std::vector<int> piece;
  EXPECT_EQ(pieces(mesh, piece), 1);
  Cells& cells = mesh.cells[0];
  cells.nodes.erase(cells.nodes.begin() + 4, cells.nodes.begin() + 8);  // the middle one of three
  cells.numbers.erase(cells.numbers.begin() + 1);
  EXPECT_EQ(pieces(mesh, piece), 2);
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) EXPECT_EQ(piece[static_cast<std::size_t>(i)], mesh.x(0, i) < 0.5 ? 0 : 1);
}

TEST(DropUnusedNodes, KeepsPlacesNumbersAndGroups) {
  Mesh mesh = grid_mesh(unit_square, 3, 1, CellShape::quadrilateral4);
  const Mesh before = mesh;
  Cells& cells = mesh.cells[0];
  cells.nodes.erase(cells.nodes.begin(), cells.nodes.begin() + 4);
  cells.numbers.erase(cells.numbers.begin());
  drop_unused_nodes(mesh);
  EXPECT_EQ(mesh.x.cols(), 6);
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) {
    const long number = mesh.node_numbers[static_cast<std::size_t>(i)];
    EXPECT_EQ(mesh.x.col(i), before.x.col(number - 1));
  }
  EXPECT_TRUE(mesh.group("left")->nodes.empty());
  EXPECT_EQ(mesh.group("right")->nodes.size(), 2u);
}

// A rhombus's Jacobian is the sine of its angle; a triangle's the sine of the least over that of
// 60°.
TEST(Quality, ScaledJacobianIsTheSineOfTheAngle) {
  for (const double angle : {0.2, 0.7, M_PI / 2, 2.0, 2.9}) {
    const Vector2d u(1, 0), v(std::cos(angle), std::sin(angle));
    const auto q = quality(one_cell(CellShape::quadrilateral4, {{0, 0}, u, u + v, v}));
    EXPECT_NEAR(q.least_jacobian, std::sin(angle), rounding);
    EXPECT_NEAR(q.least_angle, std::min(angle, M_PI - angle), rounding);
    EXPECT_NEAR(q.greatest_angle, std::max(angle, M_PI - angle), rounding);
  }
  const double h = 0.3;  // height of an isosceles triangle on a base of 1: base angles atan 0.6, the least
  for (int turn = 0; turn < 3; ++turn) {
    const Vector2d p[] = {{0, 0}, {1, 0}, {0.5, h}};
    const auto q = quality(one_cell(CellShape::triangle3, {p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]}));
    EXPECT_NEAR(q.least_jacobian, std::sin(std::atan(0.6)) / std::sin(M_PI / 3), rounding) << "whatever corner is first";
    EXPECT_NEAR(q.greatest_aspect, 1 / std::hypot(0.5, h), rounding);
  }
}

TEST(Quality, StraightSidedCellsOfHigherOrderAreAsGoodAsTheirCorners) {
  for (const auto& [low, high] : {std::pair{CellShape::triangle3, CellShape::triangle6},
                                  {CellShape::quadrilateral4, CellShape::quadrilateral8},
                                  {CellShape::quadrilateral4, CellShape::quadrilateral9}})
    EXPECT_NEAR(quality(grid_mesh(skew, 2, 2, high)).least_jacobian, quality(grid_mesh(skew, 2, 2, low)).least_jacobian, rounding)
        << name_of(high);
}

// Middle nodes at the quarter points make the mapping singular at the corner between them, and past
// them turn it over: what fracture mechanics uses on purpose.
TEST(Quality, QuarterPointsMakeACornerSingularAndBeyondThemInverted) {
  const auto with_mid_at = [](double t) {
    std::vector<Vector2d> x{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {t, 0}, {1, 0.5}, {0.5, 1}, {0, t}};
    const Mesh eight = one_cell(CellShape::quadrilateral8, x);
    x.push_back({0.5, 0.5});
    const Mesh nine = one_cell(CellShape::quadrilateral9, x);
    const Mesh six = one_cell(CellShape::triangle6, {{0, 0}, {1, 0}, {0, 1}, {t, 0}, {0.5, 0.5}, {0, t}});
    return std::array{quality(eight), quality(nine), quality(six)};
  };
  for (const auto& q : with_mid_at(0.3)) EXPECT_TRUE(q.inverted.empty());
  for (const auto& q : with_mid_at(0.25)) EXPECT_EQ(q.inverted.size(), 1u);
  // Both sides set out backwards: the determinant alone is positive again.
  for (const auto& q : with_mid_at(0.2)) EXPECT_EQ(q.inverted.size(), 1u);
}

TEST(Quality, StraightCornerIsNamedWithNumberAndPlace) {
  const auto q = quality(one_cell(CellShape::quadrilateral4, {{0, 0}, {1, 0}, {2, 0}, {1, 1}}));
  ASSERT_EQ(q.inverted.size(), 1u);
  EXPECT_EQ(q.inverted[0].number, 7);
  EXPECT_LT((q.inverted[0].at - Vector2d(1, 0.25)).norm(), rounding);
  EXPECT_NEAR(q.greatest_angle, M_PI, rounding);
}

TEST(Quality, DoesNotDependOnPlaceTurnOrSize) {
  for (const CellShape shape : plane_shapes) {
    Mesh mesh = grid_mesh(skew, 3, 2, shape);
    const auto before = quality(mesh);
    const Eigen::Rotation2Dd turn(1.1);
    mesh.x = ((turn.toRotationMatrix() * mesh.x).array() * 1e-3).matrix().colwise() + Vector2d(0.3, -0.2);
    const auto after = quality(mesh);
    EXPECT_NEAR(after.least_jacobian, before.least_jacobian, 1e3 * rounding) << "places of 1 for sizes of 1e-3";
    EXPECT_NEAR(after.greatest_aspect, before.greatest_aspect, 1e3 * rounding);
  }
}

TEST(Orient, TurnsClockwiseCellsOverAndLeavesOthers) {
  for (const CellShape shape : plane_shapes) {
    Mesh mesh = grid_mesh(skew, 3, 2, shape);
    const Mesh before = mesh;
    orient(mesh);
    EXPECT_EQ(mesh.cells[0].nodes, before.cells[0].nodes);
    mesh.x.row(0) *= -1;  // mirrored: every cell runs clockwise
    EXPECT_LT(quality(mesh).least_jacobian, 0);
    orient(mesh);
    EXPECT_NEAR(quality(mesh).least_jacobian, quality(before).least_jacobian, rounding) << name_of(shape);
    const Group* bottom = mesh.group("bottom");
    for (const Cells& c : bottom->sides)
      for (std::size_t s = 0; s < c.size(); ++s) {
        const int* node = &c.nodes[s * static_cast<std::size_t>(nodes_of(c.shape))];
        EXPECT_LT(mesh.x(0, node[0]), mesh.x(0, node[1])) << "the body stays on the left";
      }
  }
}

TEST(Loops, HolesAreNumberedFromLeftToRightThenFromBelow) {
  Mesh mesh = grid_mesh(std::array<Vector2d, 4>{Vector2d{0, 0}, {7, 0}, {7, 7}, {0, 7}}, 7, 7, CellShape::quadrilateral4);
  Cells kept{CellShape::quadrilateral4, {}, {}};
  for (std::size_t c = 0; c < 49; ++c) {
    if (c == 5 * 7 + 3 || c == 1 * 7 + 3 || c == 3 * 7 + 5) continue;  // fields (3, 5), (3, 1), (5, 3)
    for (std::size_t k = 0; k < 4; ++k) kept.nodes.push_back(mesh.cells[0].nodes[4 * c + k]);
    kept.numbers.push_back(static_cast<long>(c));
  }
  mesh.cells[0] = kept;
  mesh.groups.clear();
  name_loops(mesh, Rim(mesh));
  const std::pair<const char*, Vector2d> holes[] = {{"hole 1", {3.5, 1.5}}, {"hole 2", {3.5, 5.5}}, {"hole 3", {5.5, 3.5}}};
  for (const auto& [name, center] : holes) {
    const Group* g = mesh.group(name);
    ASSERT_NE(g, nullptr) << name;
    Vector2d mean = Vector2d::Zero();
    for (const int node : g->nodes) mean += mesh.x.col(node) / static_cast<double>(g->nodes.size());
    EXPECT_LT((mean - center).norm(), rounding * 10) << name;
  }
  EXPECT_EQ(mesh.group("outline")->nodes.size(), 28u);
  EXPECT_EQ(mesh.group("hole 4"), nullptr);
}

TEST(LinkJudge, RefusesWhatCannotBeMade) {
  const Eye eye{0.02, 0.04};
  const Link bad[] = {StraightBar{0, 0.1},
                      StraightBar{1, -0.1},
                      StraightBar{NAN, 0.1},
                      TaperedBar{1, 0.1, 0},
                      Disc{0.1, 0.1},
                      Disc{0.1, 0},
                      EyeBar{0.3, 0.05, eye, eye},                                       // shank wider than the eyes
                      EyeBar{0.03, 0.02, eye, eye},                                      // eyes overlap
                      EyeBar{0.3, 0.02, {0.04, 0.04}, eye},                              // no material round the bore
                      Triangle{{{0, 0}, {0.2, 0}, {0.1, 0}}, {eye, eye, {0.01, 0.03}}},  // the third hidden
                      Triangle{{{0, 0}, {0.2, 0}, {0.01, 0.01}}, {eye, eye, eye}}};
  for (const Link& link : bad) EXPECT_THROW(validate(link), std::invalid_argument) << link.index();
  EXPECT_NO_THROW(validate(Triangle{{{0, 0}, {0.2, 0}, {0.1, -0.2}}, {eye, eye, eye}})) << "in either sense of rotation";
}

TEST(LinkDrawing, LoopsCloseAndArcsStayOnTheirCircles) {
  const Eye small{0.02, 0.04}, large{0.03, 0.07};
  const Link links[] = {StraightBar{0.3, 0.04},
                        EyeBar{0.3, 0.04, large, small},
                        EyeBar{0.3, 0.02, large, small},
                        TaperedBar{0.3, 0.05, 0.02},
                        Triangle{{{0, 0}, {0.2, 0.02}, {0.1, -0.2}}, {small, large, small}},
                        Disc{0.2, 0.05}};
  for (const Link& link : links) {
    bool outer = true;
    for (const Loop& loop : drawing(link)) {
      ASSERT_EQ(loop.edges.size(), loop.names.size());
      double area = 0;
      for (std::size_t k = 0; k < loop.edges.size(); ++k) {
        const Edge& e = loop.edges[k];
        EXPECT_EQ(e.to, loop.edges[(k + 1) % loop.edges.size()].from);
        EXPECT_TRUE(!e.arc || std::abs((e.from - e.center).norm() - (e.to - e.center).norm()) < rounding);
        area += (e.from.x() * e.to.y() - e.from.y() * e.to.x()) / 2;
      }
      EXPECT_GT(area, 0);
      EXPECT_EQ(outer, loop.names[0].find("eye") == std::string::npos && loop.names[0] != "bore");
      outer = false;
    }
  }
}

}  // namespace
}  // namespace pintle::mesh_test
