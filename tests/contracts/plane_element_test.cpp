// The exam of plane elements beyond the one that every element sits: patches, null spaces,
// numbering, quality, loads on sides, stress.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/contracts/plane_patch.h"

namespace pintle::patch::plane_element_test {
namespace {

using std::numbers::pi;
// Relative to the size of the terms summed.
constexpr double rounding = 1e-12;
// After a solution with a patch's stiffness, whose condition is about 1e3.
constexpr double solved = 1e-10;

struct Random {
  std::mt19937 engine{20260};
  double operator()(double size) { return std::uniform_real_distribution<>(-size, size)(engine); }
  Point point(double size) {
    const double x = (*this)(size);
    return {x, (*this)(size)};
  }
};

template <class E>
struct PlaneContract : testing::Test {};
TYPED_TEST_SUITE(PlaneContract, Kinds);

// ---- patch tests --------------------------------------------------------------------------------

// A field of constant strain prescribed on the rim must hold inside, with its stress at every
// point.
template <class E>
void expect_patch(const Mesh<E>& mesh, const Elastic& m, const Field& field, const Eigen::Vector3d& strain,
                  const std::function<bool(const Point&)>& rim) {
  const E e = element<E>(m, 1, 1e-3);
  const Eigen::VectorXd u = solve(assembled_stiffness(mesh, e), Eigen::VectorXd::Zero(mesh.dofs()), hold(mesh, rim, field));
  Eigen::Vector4d sigma;
  sigma << m.D() * strain, m.Dz() * strain;
  const double size = u.cwiseAbs().maxCoeff();
  int inside = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    inside += !rim(mesh.nodes[i]);
    EXPECT_LT((u.segment<2>(2 * static_cast<Eigen::Index>(i)) - field(mesh.nodes[i])).norm(), solved * size);
  }
  EXPECT_GT(inside, 0) << "is there anything to find?";
  for (const auto& cell : mesh.cells) {
    const Stress<E> s = stress(e, mesh.coords(cell), gather<E>(cell, u));
    EXPECT_LT((s.colwise() - sigma).cwiseAbs().maxCoeff(), solved * sigma.norm());
    EXPECT_LT((nodal_stress(e, s).colwise() - sigma).cwiseAbs().maxCoeff(), solved * sigma.norm());
  }
}

const std::vector<Point> membrane_vertices{{0, 0}, {.24, 0}, {.24, .12}, {0, .12}, {.04, .02}, {.18, .03}, {.16, .08}, {.08, .08}};
const std::vector<std::array<int, 4>> membrane_quads{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
bool on_membrane_rim(const Point& x) {
  constexpr double near = 1e-9;
  return x.minCoeff() < near || x.x() > 0.24 - near || x.y() > 0.12 - near;
}
Point membrane_field(const Point& x) { return 1e-3 * Point(x.x() + x.y() / 2, x.y() + x.x() / 2); }

TYPED_TEST(PlaneContract, PassesThePublishedMembranePatch) {
  const auto mesh = refine<TypeParam>(membrane_vertices, membrane_quads);
  const Elastic m{1e6, 0.25};
  const auto e = element<TypeParam>(m, 1, 1e-3);
  const Eigen::VectorXd u =
      solve(assembled_stiffness(mesh, e), Eigen::VectorXd::Zero(mesh.dofs()), hold(mesh, on_membrane_rim, membrane_field));
  const std::array<Point, 4> published{Point{5.00e-5, 4.00e-5}, {1.95e-4, 1.20e-4}, {2.00e-4, 1.60e-4}, {1.20e-4, 1.20e-4}};
  for (int i = 0; i < 4; ++i) EXPECT_LT((u.segment<2>(2 * (4 + i)) - published[i]).norm(), solved * 1e-4);
  for (const auto& cell : mesh.cells) {
    const auto s = stress(e, mesh.coords(cell), gather<TypeParam>(cell, u));
    const Eigen::Vector4d printed(1333.33, 1333.33, 400, 0);
    EXPECT_LT((s.colwise() - printed).cwiseAbs().maxCoeff(), 0.005);
  }
}

TYPED_TEST(PlaneContract, PassesTheMembranePatchInPlaneStrain) {
  expect_patch<TypeParam>(refine<TypeParam>(membrane_vertices, membrane_quads), {1e6, 0.25, true}, membrane_field, {1e-3, 1e-3, 1e-3},
                          on_membrane_rim);
}

// Nine squares whose inner nodes, middles of sides and centres are pushed about: sides are curved
// where the element has nodes for it.
TYPED_TEST(PlaneContract, PassesRandomPatchesWithCurvedSides) {
  const auto rim = [](const Point& x) { return x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9; };
  Random random;
  for (int trial = 0; trial < 20; ++trial) {
    auto mesh = grid<TypeParam>(3, 3);
    const double push = order<TypeParam> == 1 ? 0.06 : 0.025;
    for (Point& x : mesh.nodes)
      if (!rim(x)) x += random.point(push);
    for (const auto& cell : mesh.cells) ASSERT_GT(nodal_jacobians(TypeParam{}, mesh.coords(cell)).minCoeff(), 0);
    const Eigen::Matrix2d H = 1e-3 * Eigen::Matrix2d{{random(1), random(1)}, {random(1), random(1)}};
    const Field field = [&](const Point& x) -> Point { return H * x + Point(1e-3, -2e-3); };
    expect_patch<TypeParam>(mesh, {2, 0.3, trial % 2 == 1}, field, {H(0, 0), H(1, 1), H(0, 1) + H(1, 0)}, rim);
  }
}

// ---- null spaces --------------------------------------------------------------------------------

int null_space(const Eigen::MatrixXd& K) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  return static_cast<int>((values.array() < 1e-10 * values.maxCoeff()).count());
}

template <class E>
Coords<E> distorted(Random& random) {
  auto mesh = grid<E>(1, 1);
  for (Point& x : mesh.nodes) x += random.point(order<E> == 1 ? 0.15 : 0.06);
  return mesh.coords(mesh.cells.front());
}

TYPED_TEST(PlaneContract, AloneItHasRigidMotionsAndItsSpuriousModesForFree) {
  const auto e = element<TypeParam>({1, 0.3});
  Random random;
  for (int trial = 0; trial < 20; ++trial) EXPECT_EQ(null_space(stiffness(e, distorted<TypeParam>(random))), 3 + TypeParam::spurious_modes);
  const auto square = grid<TypeParam>(1, 1);
  EXPECT_EQ(null_space(stiffness(e, square.coords(square.cells.front()))), 3 + TypeParam::spurious_modes);
}

TYPED_TEST(PlaneContract, TwoThatShareASideHaveRigidMotionsAlone) {
  const Eigen::MatrixXd K = assembled_stiffness(grid<TypeParam>(2, 1), element<TypeParam>({1, 0.3}));
  EXPECT_EQ(null_space(K), 3);
}

// Fields of constant strain lie in every element, so u₁ᵀ K u₂ = ε₁ᵀ D ε₂ t A whatever D couples.
TYPED_TEST(PlaneContract, EnergyOfConstantStrainIsThatOfAnyMaterial) {
  static_assert(Element<TypeParam>);
  TypeParam e{{{}, 1, 0.3}};
  e.p.material.D << 5, 1, -0.7, 1, 3, 0.4, -0.7, 0.4, 2;
  e.p.material.Dz.setZero();
  Random random;
  const Coords<TypeParam> x = distorted<TypeParam>(random);
  double area = 0;
  for_quadrature<TypeParam>([&](const Point& xi, double weight) { area += weight * determinant(e, x, xi); });
  Eigen::Matrix<double, TypeParam::dofs, 3> u;
  for (int i = 0; i < TypeParam::nodes; ++i) u.template middleRows<2>(2 * i) << x(0, i), 0, x(1, i), 0, x(1, i), 0;
  const Eigen::Matrix3d energy = u.transpose() * stiffness(e, x) * u;
  EXPECT_LT((energy - 0.3 * area * e.p.material.D).norm(), rounding * energy.norm());
}

// ---- numbering, quality -------------------------------------------------------------------------

// Starting from the next corner changes names, not what the element is.
TYPED_TEST(PlaneContract, NumberingMayStartAtAnyCorner) {
  constexpr int c = corners<TypeParam>;
  const auto e = element<TypeParam>({1, 0.3}, 7, 0.1);
  Random random;
  const Coords<TypeParam> x = distorted<TypeParam>(random);
  Square<TypeParam> P = Square<TypeParam>::Zero();
  Coords<TypeParam> turned;
  for (int i = 0; i < TypeParam::nodes; ++i) {
    const int from = i == 8 ? 8 : (i / c) * c + (i + 1) % c;
    turned.col(i) = x.col(from);
    P(2 * i, 2 * from) = P(2 * i + 1, 2 * from + 1) = 1;
  }
  const auto expect_same = [&](const Square<TypeParam>& named, const Square<TypeParam>& original) {
    EXPECT_LT((named - P * original * P.transpose()).norm(), rounding * original.norm());
  };
  expect_same(stiffness(e, turned), stiffness(e, x));
  expect_same(mass(e, turned), mass(e, x));
  expect_same(skew_mass(e, turned), skew_mass(e, x));
  expect_same(lumped_mass(e, turned).asDiagonal(), lumped_mass(e, x).asDiagonal());
  const Eigen::Matrix<double, 1, TypeParam::nodes> J = nodal_jacobians(e, x), Jt = nodal_jacobians(e, turned);
  EXPECT_NEAR(J[1], Jt[0], rounding);
}

// Twice the area of the triangle at a corner, over 2 (triangle) or 8 (a cell of side 2): by hand.
TYPED_TEST(PlaneContract, JacobianAtACornerIsThatOfItsTwoSides) {
  constexpr int c = corners<TypeParam>;
  auto mesh = grid<TypeParam>(1, 1);
  mesh = mapped(mesh, [](const Point& x) -> Point { return {3 * x.x() + x.y() * 0.5, 2 * x.y() - x.x() * 0.1}; });
  const Coords<TypeParam> x = mesh.coords(mesh.cells.front());
  const auto J = nodal_jacobians(TypeParam{}, x);
  for (int i = 0; i < c; ++i) {
    const Point a = x.col((i + 1) % c) - x.col(i), b = x.col((i + c - 1) % c) - x.col(i);
    EXPECT_NEAR(J[i], (a.x() * b.y() - a.y() * b.x()) / (c == 3 ? 1 : 4), rounding * 10);
  }
}

TYPED_TEST(PlaneContract, JacobianIsNegativeForClockwiseNodes) {
  auto mesh = mapped(grid<TypeParam>(1, 1), [](const Point& x) -> Point { return {-x.x(), x.y()}; });
  EXPECT_LT(nodal_jacobians(TypeParam{}, mesh.coords(mesh.cells.front())).maxCoeff(), 0);
}

// A triangle with such a corner has no area at all.
template <class E>
struct Quadrilateral : testing::Test {};
TYPED_TEST_SUITE(Quadrilateral, QuadrilateralKinds);

TYPED_TEST(Quadrilateral, JacobianTellsOfACornerOf180Degrees) {
  const auto with_corner_at = [](double place) {
    const auto mesh = refine<TypeParam>({{0, 0}, {1, 0}, {place, place}, {0, 1}}, {{0, 1, 2, 3}});
    return nodal_jacobians(TypeParam{}, mesh.coords(mesh.cells.front()))[2];
  };
  EXPECT_NEAR(with_corner_at(0.5), 0, rounding);
  EXPECT_LT(with_corner_at(0.45), 0);
  EXPECT_GT(with_corner_at(0.55), 0);
}

// ---- mass ---------------------------------------------------------------------------------------

// Of NᵀN det J, degree 6 in a triangle and 7 in ξ and in η with curved sides; these points: 8
// and 9.
TYPED_TEST(PlaneContract, ConsistentMassIsExactOnCurvedSides) {
  const auto e = element<TypeParam>({1, 0.3}, 7800, 0.01);
  Random random;
  for (int trial = 0; trial < 10; ++trial) {
    const Coords<TypeParam> x = distorted<TypeParam>(random);
    Square<TypeParam> M = Square<TypeParam>::Zero();
    for_quadrature<TypeParam>([&](const Point& xi, double weight) {
      const ShapeMatrix<TypeParam> N = shape(e, x, xi);
      M += weight * determinant(e, x, xi) * 78 * N.transpose() * N;
    });
    EXPECT_LT((mass(e, x) - M).norm(), rounding * M.norm());
  }
}

// ---- lumped mass --------------------------------------------------------------------------------

TYPED_TEST(PlaneContract, LumpedMassIsPositiveAndKeepsTheMass) {
  const auto e = element<TypeParam>({1, 0.3}, 7800, 0.01);
  Random random;
  for (int trial = 0; trial < 50; ++trial) {
    const Coords<TypeParam> x = distorted<TypeParam>(random);
    double volume = 0;
    for_quadrature<TypeParam>([&](const Point& xi, double w) { volume += w * determinant(e, x, xi) * 0.01; });
    const NodalVector<TypeParam> m = lumped_mass(e, x);
    EXPECT_GT(m.minCoeff(), 0);
    EXPECT_NEAR(m.sum(), 2 * 7800 * volume, rounding * m.sum());
  }
}

template <class E>
struct LinearPlane : testing::Test {};
TYPED_TEST_SUITE(LinearPlane, LinearKinds);

TYPED_TEST(LinearPlane, LumpedMassKeepsTheMassCentre) {
  const auto e = element<TypeParam>({1, 0.3});
  Random random;
  const Coords<TypeParam> x = distorted<TypeParam>(random);
  const NodalVector<TypeParam> m = lumped_mass(e, x);
  Point lumped(0, 0), exact(0, 0);
  for (int i = 0; i < TypeParam::nodes; ++i) lumped += m[2 * i] * x.col(i);
  for_quadrature<TypeParam>([&](const Point& xi, double w) {
    const Eigen::Map<const NodalVector<TypeParam>> nodal(x.data());
    exact += w * determinant(e, x, xi) * shape(e, x, xi) * nodal;
  });
  EXPECT_LT((lumped - exact).norm(), rounding);
}

template <class E>
struct QuadraticPlane : testing::Test {};
TYPED_TEST_SUITE(QuadraticPlane, QuadraticKinds);

// By hand: the consistent diagonal of corner : middle is 6 : 32 with 6 and 8 nodes, and the square
// of 4 : 16 : 4 with 9, which is Simpson's rule.
TYPED_TEST(QuadraticPlane, LumpedMassIsInProportionToTheConsistentDiagonal) {
  const auto e = element<TypeParam>({1, 0.3});
  const auto mesh = grid<TypeParam>(1, 1);
  const NodalVector<TypeParam> m = lumped_mass(e, mesh.coords(mesh.cells.front()));
  constexpr int n = TypeParam::nodes;
  const double corner = n == 6 ? 1.5 / 57 : n == 8 ? 3.0 / 76 : 1.0 / 36;
  const double middle = n == 6 ? 8.0 / 57 : n == 8 ? 16.0 / 76 : 4.0 / 36;
  for (int i = 0; i < n; ++i) EXPECT_NEAR(m[2 * i], i < corners<TypeParam> ? corner : i < 8 ? middle : 16.0 / 36, rounding);
}

}  // namespace
}  // namespace pintle::patch::plane_element_test
