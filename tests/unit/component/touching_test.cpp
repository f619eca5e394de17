// Contact of meshed bodies: constant pressure passes exactly between meshes that do not fit, discs meet Hertz and Persson.

#include "framework/component/fe/touching.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/component/fe/loads.h"
#include "tests/contact_laws/disc_in_eye.h"
#include "tests/unit/component/fe_bodies.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using std::numbers::pi;

struct Block2 {
  Plate part;
  FeModel model;
  Sparse K;
  Supports supports;
};

Block2 block(int nx, int ny, CellShape shape, double from, double to, double young) {
  Block2 b;
  b.part = plate(nx, ny, shape, [=](double u, double v) { return Vector2d(2 * u, from + (to - from) * v); });
  const Material material{Isotropic{young, 0.3}, 1};
  b.model = fe_model(b.part.mesh.x, plane_blocks(b.part.mesh, {plane_material(material, PlaneState::stress), 1, 0.5}, ""));
  b.K = Assembler(b.model).stiffness();
  return b;
}

struct Stack {
  Block2 lower, upper;
  ContactRows rows;
  TouchingBodies bodies;
  Stack(CellShape below, CellShape above)
      : lower(held(block(5, 2, below, 0, 1, 3))),
        upper(guided(block(3, 3, above, 1, 1.5, 1))),
        rows(touch(upper, lower)),
        bodies({{&lower.model, &lower.K, lower.supports}, {&upper.model, &upper.K, upper.supports}}, {{1, 0, rows}}) {}
  static Block2 held(Block2 b) {
    for (const int node : b.part.nodes.at("bottom")) hold(b.supports, b.model, node, false, true, false);
    hold(b.supports, b.model, b.part.nodes.at("bottom").front(), true, false, false);
    return b;
  }
  static Block2 guided(Block2 b) {
    hold(b.supports, b.model, b.part.nodes.at("bottom").front(), true, false, false);
    return b;
  }
  static ContactRows touch(const Block2& a, const Block2& b) {
    return contact_rows(a.model, contact_surface(a.part.mesh, a.part.edge.at("bottom"), 0.5), b.model,
                        contact_surface(b.part.mesh, b.part.edge.at("top"), 0.5), {0, 0});
  }
  TouchingSolution press(double pressure) const {
    return bodies.solve({VectorXd::Zero(lower.model.n()), pressure_load(upper.model, upper.part.edge.at("top"), pressure, 0.5)});
  }
};

}  // namespace

TEST(Touching, PassesConstantPressureExactly) {
  for (const CellShape below : {CellShape::quadrilateral4, CellShape::quadrilateral8, CellShape::triangle6})
    for (const CellShape above : {CellShape::quadrilateral4, CellShape::quadrilateral9, CellShape::triangle3}) {
      const Stack stack(below, above);
      constexpr double p = 1e-3;
      const TouchingSolution s = stack.press(p);
      for (Eigen::Index i = 0; i < s.force[0].size(); ++i) EXPECT_NEAR(s.force[0][i] / stack.rows.area[i], p, 1e-10 * p);
      for (const auto& [body, u] : {std::pair(&stack.lower, &s.bodies[0].u), std::pair(&stack.upper, &s.bodies[1].u)}) {
        const StressField stress = stress_field(body->model, *u);
        EXPECT_LT((stress.at_points.row(1).array() + p).abs().maxCoeff(), 1e-10 * p);
        EXPECT_LT(stress.at_points.row(0).cwiseAbs().maxCoeff() + stress.at_points.row(2).cwiseAbs().maxCoeff(), 1e-10 * p);
      }
    }
}

TEST(Touching, NeverPulls) {
  const Stack stack(CellShape::quadrilateral8, CellShape::quadrilateral8);
  // A moment lifts one end off: what is left carries the load, and nowhere is there both a gap and a force.
  VectorXd load = pressure_load(stack.upper.model, stack.upper.part.edge.at("top"), 1e-3, 0.5);
  const VectorXd x = rigid_fields(stack.upper.model).x;
  for (Eigen::Index i = 1; i < load.size(); i += 2) load[i] *= x[i - 1] / 2 * x[i - 1] / 2 * 3;
  const TouchingSolution s = stack.bodies.solve({VectorXd::Zero(stack.lower.model.n()), load});
  const double total = -load.sum(), most = s.force[0].maxCoeff(), widest = s.gap[0].maxCoeff();
  EXPECT_NEAR(s.force[0].sum(), total, 1e-10 * total);
  EXPECT_GE(s.force[0].minCoeff(), 0);
  EXPECT_GE(s.gap[0].minCoeff(), -1e-11 * widest);
  EXPECT_GT(widest, 1e-6);
  for (Eigen::Index i = 0; i < s.gap[0].size(); ++i) EXPECT_TRUE(s.force[0][i] < 1e-9 * most || s.gap[0][i] < 1e-9 * widest) << i;
}

TEST(Touching, SaysWhatNothingHolds) {
  const Stack stack(CellShape::quadrilateral4, CellShape::quadrilateral4);
  EXPECT_NE(refusal<std::runtime_error>([&] { stack.press(-1e-3); }).find("pull a body away"), std::string::npos);
  const Block2 lower = Stack::held(block(5, 2, CellShape::quadrilateral4, 0, 1, 3)),
               loose = block(3, 3, CellShape::quadrilateral4, 1, 1.5, 1);
  const ContactRows rows = Stack::touch(loose, lower);
  const auto along = [&] {
    TouchingBodies({{&lower.model, &lower.K, lower.supports}, {&loose.model, &loose.K, loose.supports}}, {{1, 0, rows}});
  };
  EXPECT_NE(refusal<std::runtime_error>(along).find("slide along its contacts"), std::string::npos);
}

// Half-width and greatest pressure of Hertz's line contact, a = 2√(FR/(πE*L)), p₀ = 2F/(πaL), where the contact is narrow.
TEST(Touching, NarrowContactIsHertzs) {
  pintle_test::DiscInEye d;
  d.clearance = 0.05, d.finest = 2e-3, d.growth = 0.2;
  constexpr double force = 2e-5;
  const double a = 2 * std::sqrt(force * (1 - d.clearance) / d.clearance / pi);
  const pintle_test::Pressed p = pintle_test::PressedDisc(d).press(force);
  EXPECT_NEAR(p.greatest_pressure, 2 * force / (pi * a), 0.01 * p.greatest_pressure);  // curvature of the bodies: of order a
  EXPECT_NEAR(p.half_angle * (1 - d.clearance), a, d.finest + d.growth * a);           // a side of the mesh there
}

// Half-angle of Persson's conforming contact of like bodies in an unbounded plate, b = tan²(ε/2).
TEST(Touching, WideContactIsPerssons) {
  pintle_test::DiscInEye d;
  d.clearance = 1e-4, d.outer = 12, d.finest = 0.02, d.growth = 0.15, d.load_in_the_middle = true;
  const pintle_test::PressedDisc disc(d);
  for (const double angle : {pi / 9, pi / 4, pi / 3}) {
    const double b = std::pow(std::tan(angle / 2), 2);
    const double force = 2 * pi * b * (1 + b) / (2 - std::log1p(b) - 2 * b * b) * d.clearance;
    EXPECT_NEAR(disc.press(force).half_angle, angle, std::max(0.04, 0.15 * angle) / 2) << angle;
  }
}

}  // namespace pintle
