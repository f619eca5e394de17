// Stress of plane elements where it can be known, and the loads on their sides.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/contracts/plane_patch.h"

namespace pintle::patch::plane_stress_test {
namespace {

using std::numbers::pi;
constexpr double rounding = 1e-12;  // relative to the size of the terms summed

template <class E>
struct PlaneStress : testing::Test {};
TYPED_TEST_SUITE(PlaneStress, Kinds);

// A single rectangle (two triangles) of 2 × 1 about the origin, turned.
template <class E>
Mesh<E> turned_rectangle(double angle) {
  const Eigen::Rotation2Dd turn(angle);
  return mapped(grid<E>(1, 1), [turn](const Point& x) -> Point { return turn * Point(2 * x.x() - 1, x.y() - 0.5); });
}

// ---- stress of pure bending ---------------------------------------------------------------------

// Bent to curvature k about its own axis: σ = −E k y along it, no other, u = k (−xy, (x² + ν
// y²)/2).
constexpr double bend_angle = 0.4, curvature = 1e-3;
constexpr Elastic bent{200, 0.3};

Point bent_displacement(const Point& x) {
  const Eigen::Rotation2Dd turn(bend_angle);
  const Point s = turn.inverse() * x;
  const Point u(-s.x() * s.y(), (s.x() * s.x() + bent.nu * s.y() * s.y()) / 2);
  return turn * (curvature * u);
}
Eigen::Vector4d bent_stress(const Point& x) {
  const double c = std::cos(bend_angle), s = std::sin(bend_angle);
  const double along = -bent.E * curvature * (-s * x.x() + c * x.y());
  return along * Eigen::Vector4d(c * c, s * s, c * s, 0);
}

struct BendingError {
  double points = 0, nodes = 0;  ///< largest, relative to the largest stress
};

template <class E>
BendingError bending_error() {
  const Mesh<E> mesh = turned_rectangle<E>(bend_angle);
  const E e = element<E>(bent);
  const double size = bent.E * curvature / 2;
  BendingError worst;
  for (const auto& cell : mesh.cells) {
    const Coords<E> x = mesh.coords(cell);
    NodalVector<E> u;
    for (int i = 0; i < E::nodes; ++i) u.template segment<2>(2 * i) = bent_displacement(x.col(i));
    const Stress<E> s = stress(e, x, u);
    const auto at_points = stress_points(e, x);
    const auto at_nodes = nodal_stress(e, s);
    for (int p = 0; p < E::points; ++p) worst.points = std::max(worst.points, (s.col(p) - bent_stress(at_points.col(p))).norm() / size);
    for (int i = 0; i < E::nodes; ++i) worst.nodes = std::max(worst.nodes, (at_nodes.col(i) - bent_stress(x.col(i))).norm() / size);
  }
  return worst;
}

// The displacement is quadratic, so it lies in these fields; with four nodes, thanks to the
// incompatible modes, whose strain must be in the stress.
template <class E>
struct BendingStress : testing::Test {};
using BendingKinds = testing::Types<Triangle6, Quadrilateral4, Quadrilateral8, Quadrilateral8Reduced, Quadrilateral9>;
TYPED_TEST_SUITE(BendingStress, BendingKinds);

TYPED_TEST(BendingStress, IsExactAtPointsAndNodesOfARectangle) {
  const BendingError worst = bending_error<TypeParam>();
  EXPECT_LT(worst.points, rounding);
  EXPECT_LT(worst.nodes, rounding);
}

TEST(Quadrilateral4Plain, ShowsShearInBendingWhereThereIsNone) { EXPECT_GT(bending_error<Quadrilateral4Plain>().points, 0.3); }

// ---- points and nodes ---------------------------------------------------------------------------

TYPED_TEST(PlaneStress, PointsAreWhereTheShapesPutThem) {
  const auto mesh =
      mapped(turned_rectangle<TypeParam>(0.2), [](const Point& x) -> Point { return x + 0.05 * Point(x.y() * x.y(), x.x() * x.y()); });
  const TypeParam e;
  const auto x = mesh.coords(mesh.cells.front());
  const Eigen::Map<const NodalVector<TypeParam>> nodal(x.data());
  const auto xi = reference_points(e);
  for (int p = 0; p < TypeParam::points; ++p) EXPECT_LT((stress_points(e, x).col(p) - shape(e, x, xi.col(p)) * nodal).norm(), rounding);
}

// Where the nodes are in the reference cell: there one shape is 1 and the others 0.
template <class E>
Point reference_node(int i) {
  if constexpr (triangular<E>) {
    const std::array<Point, 6> at{Point{0, 0}, {1, 0}, {0, 1}, {.5, 0}, {.5, .5}, {0, .5}};
    return at[i];
  } else {
    const std::array<Point, 9> at{Point{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
    return at[i];
  }
}

TYPED_TEST(PlaneStress, ShapesAreOneAtTheirNodeAndZeroAtTheOthers) {
  for (int i = 0; i < TypeParam::nodes; ++i) {
    const auto N = shape(TypeParam{}, Coords<TypeParam>::Zero().eval(), reference_node<TypeParam>(i));
    for (int j = 0; j < TypeParam::nodes; ++j) EXPECT_EQ(N(0, 2 * j), i == j ? 1 : 0);
  }
}

TYPED_TEST(PlaneStress, LinearFieldReachesTheNodesUnchanged) {
  const TypeParam e;
  const auto field = [](const Point& xi) -> Eigen::Vector4d {
    const double linear = TypeParam::points == 1 ? 0 : 1, bilinear = triangular<TypeParam> ? 0 : 1;
    return {3, 1 + linear * xi.x(), 2 - linear * 4 * xi.y(), 1 + bilinear * xi.x() * xi.y()};
  };
  Stress<TypeParam> s;
  for (int p = 0; p < TypeParam::points; ++p) s.col(p) = field(reference_points(e).col(p));
  const auto nodal = nodal_stress(e, s);
  for (int i = 0; i < TypeParam::nodes; ++i) EXPECT_LT((nodal.col(i) - field(reference_node<TypeParam>(i))).norm(), 10 * rounding);
}

// ξ² is 1/3 at the 2 × 2 Gauss points: what lies between them and the sides is not followed.
template <class E>
struct NinePoints : testing::Test {};
using NinePointKinds = testing::Types<Quadrilateral8, Quadrilateral9>;
TYPED_TEST_SUITE(NinePoints, NinePointKinds);

TYPED_TEST(NinePoints, NodesAreToldByTheFieldThroughFourGaussPoints) {
  const TypeParam e;
  Stress<TypeParam> s;
  for (int p = 0; p < TypeParam::points; ++p) s.col(p).setConstant(reference_points(e)(0, p) * reference_points(e)(0, p));
  EXPECT_LT((nodal_stress(e, s).array() - 1.0 / 3).abs().maxCoeff(), rounding);
}

TYPED_TEST(PlaneStress, OutOfPlaneStressHoldsPlaneStrainFlat) {
  const Elastic m{3, 0.3, true};
  const auto e = element<TypeParam>(m);
  const auto mesh = turned_rectangle<TypeParam>(0.3);
  const auto x = mesh.coords(mesh.cells.front());
  NodalVector<TypeParam> u;
  for (int i = 0; i < TypeParam::dofs; ++i) u[i] = std::sin(1.0 + 2.3 * i);
  const Stress<TypeParam> s = stress(e, x, u);
  // εz = (σz − ν (σx + σy))/E = 0.
  const double left = (s.row(3) - m.nu * (s.row(0) + s.row(1))).cwiseAbs().maxCoeff();
  EXPECT_LT(left, rounding * s.cwiseAbs().maxCoeff());
}

// ---- what is read off -------------------------------------------------------------------------

TEST(VonMises, IsTheStressOfTensionAndRootThreeOfShear) {
  EXPECT_NEAR(von_mises({-5, 0, 0, 0}), 5, rounding);
  EXPECT_NEAR(von_mises({0, 0, 2, 0}), 2 * std::sqrt(3.0), rounding);
  EXPECT_NEAR(von_mises({0, 0, 0, 7}), 7, rounding);
}

TEST(VonMises, IsZeroUnderPressureFromAllSides) { EXPECT_EQ(von_mises({-1e9, -1e9, 0, -1e9}), 0); }

TEST(Principal, AreEigenvaluesAndDirectionOfTheTensor) {
  for (double angle : {-1.5, -0.7, 0.0, 0.3, 1.2, 1.55}) {
    const Eigen::Rotation2Dd turn(angle);
    const Eigen::Matrix2d s = turn * Eigen::Vector2d(5, -3).asDiagonal() * turn.inverse();
    const Eigen::Vector3d found = principal({s(0, 0), s(1, 1), s(0, 1), 99});
    EXPECT_NEAR(found[0], 5, 10 * rounding);
    EXPECT_NEAR(found[1], -3, 10 * rounding);
    EXPECT_NEAR(found[2], angle, 10 * rounding);
  }
}

TEST(Principal, AngleIsAboveMinusARightAngle) {
  EXPECT_DOUBLE_EQ(principal({-1, 1, -0.0, 0})[2], pi / 2);
  EXPECT_EQ(principal({2, 2, 0, 0}), Eigen::Vector3d(2, 2, 0));
}

// ---- sides --------------------------------------------------------------------------------------

struct Resultant {
  Point force{0, 0};
  double moment = 0;  ///< about the origin
};
double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }
Resultant resultant(const Eigen::Matrix2Xd& side, const Eigen::VectorXd& load) {
  Resultant out;
  for (Eigen::Index i = 0; i < side.cols(); ++i) {
    out.force += load.segment<2>(2 * i);
    out.moment += cross(side.col(i), load.segment<2>(2 * i));
  }
  return out;
}

// The parabola (h ξ, s (1 − ξ²)), ξ ∈ [−1, 1], turned and moved: ends, then its top.
struct Parabola {
  double half_chord, rise, angle = 0;
  Point centre{0, 0};
  Point place(const Point& own) const { return centre + Eigen::Rotation2Dd(angle) * own; }
  Eigen::Matrix2Xd side() const {
    Eigen::Matrix2Xd x(2, 3);
    x << place({-half_chord, 0}), place({half_chord, 0}), place({0, rise});
    return x;
  }
  /// ∫ |∂x/∂ξ| and ∫ ξ² |∂x/∂ξ| in closed form.
  Eigen::Vector2d lengths() const {
    const double h = half_chord, k = 2 * std::abs(rise);
    const double root = std::hypot(h, k), length = root + h * h / k * std::asinh(k / h);
    return {length, root * root * root / (2 * k * k) - h * h / (4 * k * k) * length};
  }
};

// A rise of 0.414 half chords is an arc of 90°; at a flat side the closed form loses digits itself.
TEST(SideLoad, HasResultantAndMomentOfTheTractionOnAParabola) {
  for (double rise : {0.02, -0.1, 0.3, 0.414 * 0.8}) {
    const Parabola parabola{0.8, rise, 0.7, {3, -2}};
    const Point traction(5, -2);
    const double thickness = 0.1;
    const Resultant found = resultant(parabola.side(), side_load(parabola.side(), traction, thickness));
    const auto [length, second] = std::pair(parabola.lengths()[0], parabola.lengths()[1]);
    const Point first = parabola.place({0, rise * (1 - second / length)}) * length;
    EXPECT_LT((found.force - thickness * length * traction).norm(), 1e-11) << rise;
    EXPECT_NEAR(found.moment, thickness * cross(first, traction), 1e-11) << rise;
  }
}

TEST(SideLoad, OfAStraightSideIsSharedByTheRulesOfTrapezoidAndSimpson) {
  Eigen::Matrix2Xd two(2, 2), three(2, 3);
  two << 0, 3, 0, 4;
  three << 0, 3, 1.5, 0, 4, 2;
  const Point traction(2, -1);
  const double total = 5 * 0.1;
  const Eigen::VectorXd f = side_load(two, traction, 0.1), g = side_load(three, traction, 0.1);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT((f.segment<2>(2 * i) - total / 2 * traction).norm(), rounding);
    EXPECT_LT((g.segment<2>(2 * i) - total / 6 * traction).norm(), rounding);
  }
  EXPECT_LT((g.tail<2>() - total * 2 / 3 * traction).norm(), rounding);
}

TEST(SidePressure, PushesToTheLeftAcrossTheChordHoweverTheSideCurves) {
  for (double rise : {0.0, 0.2, -0.5}) {
    const Parabola parabola{0.8, rise};
    const Resultant found = resultant(parabola.side(), side_pressure(parabola.side(), 3, 0.1));
    EXPECT_LT((found.force - Point(0, 3 * 0.1 * 1.6)).norm(), rounding);
    EXPECT_NEAR(found.moment, 0, rounding);
  }
}

// The outline of a bent square, counter-clockwise, and the virtual work of the pressure: on
// u = x it is −p times the divergence, 2, times the volume.
TYPED_TEST(PlaneStress, PressureOnAClosedOutlineBalancesAndWorksOnTheVolume) {
  const auto rim = [](const Point& x) { return x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9; };
  auto mesh = grid<TypeParam>(3, 3);
  auto list = sides(mesh, rim);
  std::erase_if(list,
                [&](const auto& side) {  // a triangle's diagonal may join two sides of the rim
                  const Point a = mesh.nodes[side[0]], b = mesh.nodes[side[1]];
                  return std::min(std::abs(a.x() - b.x()), std::abs(a.y() - b.y())) > 1e-9;
                });
  mesh = mapped(mesh, [](const Point& x) -> Point { return x + 0.1 * Point(std::sin(3 * x.y() + 1), x.x() * x.x() - x.x() * x.y()); });
  const double pressure = 4, thickness = 0.2;
  const Eigen::VectorXd f = side_loads(mesh, list, [&](const Eigen::Matrix2Xd& x) { return side_pressure(x, pressure, thickness); });
  Resultant sum;
  double work = 0, volume = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Point share = f.segment<2>(2 * static_cast<Eigen::Index>(i));
    sum.force += share;
    sum.moment += cross(mesh.nodes[i], share);
    work += share.dot(mesh.nodes[i]);
  }
  for_points(mesh, element<TypeParam>({1, 0.3}, 1, thickness),
             [&](const Point&, double part, const auto&, const auto&) { volume += part; });
  EXPECT_LT(sum.force.norm(), rounding);
  EXPECT_NEAR(sum.moment, 0, rounding);
  EXPECT_NEAR(work, -2 * pressure * volume, 10 * rounding);
}

TEST(SideLoad, RefusesASideOfFourNodesByItsNumber) {
  const Eigen::Matrix2Xd four = Eigen::Matrix2Xd::Random(2, 4);
  try {
    side_load(four, {1, 0}, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("4 nodes"), std::string::npos) << error.what();
  }
  EXPECT_THROW(side_pressure(four.leftCols(1), 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace pintle::patch::plane_stress_test
