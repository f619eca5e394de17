// Static answers, loads and stresses, judged by closed forms of beams, rods, thick cylinders and
// the plate with a hole, and by equilibrium.

#include "framework/component/fe/statics.h"

#include "framework/component/fe/from_mesh.h"
#include "framework/component/fe/loads.h"
#include "tests/unit/component/fe_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace pintle::stress_field_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Relative. Some hundred dofs on beams of ten elements: condition 1e4 to 1e5 times 1e-16.
constexpr double rounding = 1e-10;

StaticSolution solve(const FeModel& m, const Supports& supports, const VectorXd& load) {
  return solve_static(m, Assembler(m).stiffness(), supports, load);
}

/// Thick cylinder under internal pressure: Lamé's solution.
struct Lame {
  double a, b, p, E, nu;
  PlaneState state;
  double A() const { return p * a * a / (b * b - a * a); }
  double B() const { return A() * b * b; }
  double u(double r) const {
    return state == PlaneState::strain ? (1 + nu) / E * ((1 - 2 * nu) * A() * r + B() / r) : ((1 - nu) * A() * r + (1 + nu) * B() / r) / E;
  }
  /// [σx σy τxy σz] at a place.
  Eigen::Vector4d stress(const Vector2d& x) const {
    const double r2 = x.squaredNorm();
    const Vector2d e = x / std::sqrt(r2);
    const Matrix2d radial = e * e.transpose();
    const Matrix2d s = (A() - B() / r2) * radial + (A() + B() / r2) * (Matrix2d::Identity() - radial);
    return {s(0, 0), s(1, 1), s(0, 1), state == PlaneState::strain ? 2 * nu * A() : 0};
  }
};

struct Errors {
  double u, nodal, points, jump;
};
Errors lame_errors(const Lame& exact, CellShape shape, int n) {
  const Quarter q(exact.a, exact.b, n, n, shape, exact.state);
  const VectorXd f = pressure_load(q.model, q.plate.edge.at("bottom"), exact.p, q.thickness);
  const StaticSolution s = solve(q.model, q.supports, independent_load(q.model, f));
  const StressField field = stress_field(q.model, s.u);
  Errors e{0, 0, 0, field.jump};
  for (int i = 0; i < q.model.x.cols(); ++i) {
    const Vector2d x = q.model.x.col(i);
    e.u = std::max(e.u, (s.u.segment<2>(2 * i) - exact.u(x.norm()) * x.normalized()).norm() / exact.u(exact.a));
    e.nodal = std::max(e.nodal, (field.nodal.col(i) - exact.stress(x)).norm() / exact.p);
  }
  for (Eigen::Index i = 0; i < field.points.cols(); ++i)
    e.points = std::max(e.points, (field.at_points.col(i) - exact.stress(field.points.col(i))).norm() / exact.p);
  return e;
}

// Displacement of quadratic cells is of order 3, their stress of order 2, and 1.7 leaves room for
// the largest of many places. Cells are h = a/12 high at the bore, where σ varies as 4p/3 (a/r)²:
// what a linear field misses there is p (h/a)², twice that where it is extrapolated, in two
// components: 2 %.
class ThickCylinder : public testing::TestWithParam<PlaneState> {};
INSTANTIATE_TEST_SUITE_P(Both, ThickCylinder, testing::Values(PlaneState::stress, PlaneState::strain),
                         [](const auto& at) { return at.param == PlaneState::stress ? "stress" : "strain"; });

TEST_P(ThickCylinder, DisplacementAndStressConvergeToLame) {
  const Lame exact{0.1, 0.2, 5e6, 2e11, 0.3, GetParam()};
  for (const CellShape shape : {CellShape::quadrilateral8, CellShape::quadrilateral9, CellShape::triangle6}) {
    const Errors coarse = lame_errors(exact, shape, 6), fine = lame_errors(exact, shape, 12);
    EXPECT_GT(std::log2(coarse.u / fine.u), 2.9) << name_of(shape) << " " << fine.u;
    EXPECT_GT(std::log2(coarse.nodal / fine.nodal), 1.7) << name_of(shape) << " " << fine.nodal;
    EXPECT_GT(std::log2(coarse.points / fine.points), 1.7) << name_of(shape) << " " << fine.points;
    EXPECT_GT(std::log2(coarse.jump / fine.jump), 1.7) << name_of(shape) << " " << fine.jump;
    EXPECT_LT(fine.u, 1e-4);
    EXPECT_LT(fine.nodal, 0.02);
  }
}

// Kirsch's plate under tension along x: its own traction on a circle of 5 radii, so that the edge
// of the mesh adds no error of model. Traction is constant over a side of 1/16 of the quarter: with
// half a side of 0.05 rad and cos 2θ in it, ½(0.1)²/3 = 0.2 % of it is left out; stress of cells an
// eighth of a radius high is good to (1/8)² = 1.6 % at most.
TEST(PlateWithAHole, ConcentratesStressThreefold) {
  const double tension = 1e6, R = 5;
  const auto traction = [&](double angle) -> Vector2d {
    const double q = 1 / (R * R), c = std::cos(2 * angle), s = std::sin(2 * angle);
    const double radial = tension / 2 * (1 - q + (1 - 4 * q + 3 * q * q) * c);
    const double shear = -tension / 2 * (1 + 2 * q - 3 * q * q) * s;
    const Vector2d e(std::cos(angle), std::sin(angle));
    return radial * e + shear * Vector2d(-e.y(), e.x());
  };
  const Quarter q(1, R, 16, 16, CellShape::quadrilateral8, PlaneState::stress, 1.5);
  VectorXd f = VectorXd::Zero(q.model.N());
  const Cells& sides = q.plate.edge.at("top")[0];
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const std::vector<int> nodes(sides.nodes.begin() + 3 * static_cast<long>(k), sides.nodes.begin() + 3 * static_cast<long>(k) + 3);
    const Vector2d middle = q.model.x.col(nodes[2]);
    f += traction_load(q.model, {{CellShape::line3, nodes, {1}}}, traction(std::atan2(middle.y(), middle.x())), q.thickness);
  }
  const StressField field = stress_field(q.model, solve(q.model, q.supports, f).u);
  const int above = q.plate.nodes.at("left").back(), beside = q.plate.nodes.at("right").front();
  EXPECT_NEAR(field.nodal(0, above), 3 * tension, 0.018 * 3 * tension);
  EXPECT_NEAR(field.nodal(1, beside), -tension, 0.018 * 3 * tension);
  EXPECT_NEAR(field.von_mises.maxCoeff(), 3 * tension, 0.018 * 3 * tension);
}

// A linear displacement has one stress everywhere, on any mesh.
TEST(StressField, OfALinearDisplacementIsEvenAndWithoutJump) {
  for (const CellShape shape :
       {CellShape::triangle3, CellShape::triangle6, CellShape::quadrilateral4, CellShape::quadrilateral8, CellShape::quadrilateral9}) {
    const FeModel m = model_of(plate(3, 3, shape, bent_rectangle(2, 1)), steel(PlaneState::strain));
    VectorXd u(m.N());
    Matrix2d gradient;
    gradient << 1e-4, 3e-4, -2e-4, 5e-4;
    for (int i = 0; i < m.x.cols(); ++i) u.segment<2>(2 * i) = gradient * m.x.col(i);
    const double E = 2e11, nu = 0.3, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
    const double sum = 6e-4;
    const Eigen::Vector4d exact(lambda * sum + 2 * mu * 1e-4, lambda * sum + 2 * mu * 5e-4, mu * 1e-4, lambda * sum);
    const StressField field = stress_field(m, u);
    for (Eigen::Index i = 0; i < m.x.cols(); ++i) EXPECT_LT((field.nodal.col(i) - exact).norm(), rounding * exact.norm()) << name_of(shape);
    for (Eigen::Index i = 0; i < field.at_points.cols(); ++i)
      EXPECT_LT((field.at_points.col(i) - exact).norm(), rounding * exact.norm()) << name_of(shape);
    EXPECT_LT(field.jump, rounding);
    EXPECT_EQ(field.section_forces.cols(), 0);
  }
}

// A square and, to its right, two triangles, stretched by a and by b: without Poisson's ratio σx = E a on the left, E b on the
// right, and where they meet the mean over the elements there, whatever their shape.
TEST(StressField, IsTheMeanOfAllElementsThatMeetWhateverTheirShape) {
  Eigen::Matrix2Xd x(2, 6);
  x << 0, 1, 2, 0, 1, 2,  //
      0, 0, 0, 1, 1, 1;
  const double E = 2e11, a = 1e-3, b = 4e-3;
  const PlaneProperties p{plane_material({Isotropic{E, 0}, 1}, PlaneState::stress), 1, 1};
  const FeModel m = fe_model(x, {Block<Quadrilateral4>{{{p}}, {0, 1, 4, 3}, {0}}, Block<Triangle3>{{{p}}, {1, 2, 5, 1, 5, 4}, {1, 2}}});
  VectorXd u = VectorXd::Zero(m.N());
  for (int i = 0; i < 6; ++i) u[2 * i] = x(0, i) <= 1 ? a * x(0, i) : a + b * (x(0, i) - 1);
  const StressField field = stress_field(m, u);
  const double mean[6]{a, (a + 2 * b) / 3, b, a, (a + b) / 2, b};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(field.nodal(0, i), E * mean[i], rounding * E * b) << i;
    EXPECT_NEAR(field.von_mises[i], E * mean[i], rounding * E * b) << i;
  }
  EXPECT_NEAR(field.jump, (b - a) * 2 / 3 / b, rounding) << "the square's own stress where three elements meet";
}

// Two materials pulled alike: at their seam stress jumps, and that is no error of the mesh.
TEST(StressField, IsNotAveragedAcrossMaterials) {
  const Plate lower = plate(2, 2, CellShape::quadrilateral4, rectangle(1, 1));
  const auto per_row = lower.mesh.cells[0].nodes.size() / 2;
  const auto half = [&](std::size_t from, double E) {
    Block<Quadrilateral4> b;
    b.properties = {{{plane_material({Isotropic{E, 0}, 1}, PlaneState::stress), 1, 1}}};
    b.nodes.assign(lower.mesh.cells[0].nodes.begin() + static_cast<long>(from),
                   lower.mesh.cells[0].nodes.begin() + static_cast<long>(from + per_row));
    return b;
  };
  const FeModel m = fe_model(lower.mesh.x, {half(0, 1e9), half(per_row, 3e9)});
  VectorXd u = VectorXd::Zero(m.N());
  for (int i = 0; i < m.x.cols(); ++i) u[2 * i] = 1e-3 * m.x(0, i);
  const StressField field = stress_field(m, u);
  for (Eigen::Index i = 0; i < m.x.cols(); ++i) EXPECT_NEAR(field.von_mises[i], m.x(1, i) < 0.4 ? 1e6 : 3e6, rounding * 3e6);
  EXPECT_LT(field.jump, rounding);
}

TEST(StressField, OfABeamIsItsSectionForcesAndItsOutermostFibre) {
  const double L = 2, P = 500, pull = 3000;
  const Vector2d along(std::cos(0.6), std::sin(0.6)), across(-along.y(), along.x());
  FeModel m = chain(BeamEuler{2e8, 1500, 8}, 4, {0, 0}, L * along);
  add_ports(m, {{"tip", 4}}, {});
  Supports supports;
  hold(supports, m, 0, true, true, true);
  VectorXd f = VectorXd::Zero(m.n());
  add_force(f, *m.port("tip"), pull * along - P * across, 0);
  const VectorXd u = solve(m, supports, f).u;
  const StressField bare = stress_field(m, u);
  EXPECT_EQ(bare.von_mises.size(), 0);
  const Fibre fibre{1e-3, 7.5e-9, 0.01};
  const StressField field = stress_field(m, u, std::vector<Fibre>(4, fibre));
  ASSERT_EQ(field.section_forces.cols(), 8);
  for (int e = 0; e < 4; ++e)
    for (int end = 0; end < 2; ++end) {
      // Pressed down at the tip, the upper side is stretched: M = −P (L − s), V = −dM/ds.
      const double M = -P * (L - L * (e + end) / 4);
      const Vector3d expected(pull, -P, M);
      EXPECT_LT((field.section_forces.col(2 * e + end) - expected).norm(), rounding * pull);
    }
  for (int i = 0; i <= 4; ++i) {
    const double sigma = pull / fibre.A + P * (L - L * i / 4) * fibre.distance / fibre.I;
    EXPECT_NEAR(field.von_mises[i], sigma, rounding * 1e9);
  }
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { stress_field(m, u, {fibre}); }), "1 for 4 line elements"));
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { stress_field(m, VectorXd::Zero(3)); }), "must be 15"));
}

}  // namespace
}  // namespace pintle::stress_field_test
