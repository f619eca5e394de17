// Flexible bodies held by joints: accelerations and reactions against a dense solve of the whole
// system, and the two ways of keeping constraints against each other.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/integration/integrator.h"
#include "framework/scene/yaml/reader.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::flexible_constraints_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string reference(int link, const char* point) { return link < 0 ? "ground" : "link " + std::to_string(link) + "." + point; }

/// Beams hung in a row, every third link rigid; each fourth joint is a weld, the others are pins. A
/// spring from the first to the last.
System chain(int links, const std::string& stiffening) {
  std::string bodies, joints;
  for (int i = 0; i < links; ++i) {
    const std::string name = "  link " + std::to_string(i) + ":\n";
    bodies += name + (i % 3 == 2 ? "    rigid: {mass: 0.3, inertia: 4e-4, center: [0.06, 0]}\n"
                                 : "    beam: {from: A, to: B, section: {rectangle: [8 mm, 5 mm]}, "
                                   "elements: 6, young: 70 GPa, poisson: 0.33, density: 2700}\n"
                                   "    modes: {frame: " +
                                       std::string(i % 2 == 0 ? "chord" : "mean axes") + ", count: 4}\n    stiffening: " + stiffening +
                                       "\n    damping: {ratios: 0.01}\n");
    bodies += "    points: {A: [0, 0], B: [0.12, 0]}\n";
    joints += "  joint " + std::to_string(i) + (i % 4 == 3 ? ": {weld: [" : ": {revolute: [") + reference(i - 1, "B") + ", " +
              reference(i, "A") + "]}\n";
  }
  return build(read_scene_text("gravity: [0, -9.81]\nbodies:\n" + bodies + "joints:\n" + joints + "forces:\n  s: {spring: [link 0.B, " +
                                   reference(links - 1, "B") + "], stiffness: 500, damping: 2, free length: 0.1}\n",
                               "chain.yaml"))
      .system;
}

VectorXd random_y(const System& system, Draw& draw) {
  VectorXd y = VectorXd::Zero(system.n_y());
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const auto at = 3 * static_cast<Eigen::Index>(b);
    y.segment<3>(at) = draw.pose();
    y.segment<3>(system.n() + at) = draw.rates();
    const int begin = system.eta_begin[b], n = system.bodies[b].modes();
    if (n == 0) continue;
    const FlexInertia& f = *system.bodies[b].flex;  // half a millimetre, alike in energy
    const VectorXd reach = std::sqrt(system.bodies[b].m) * f.omega[0] * f.omega.cwiseInverse();
    y.segment(begin, n) = draw.matrix(n, 1, 5e-4).cwiseProduct(reach);
    y.segment(system.n() + begin, n) = draw.matrix(n, 1, 0.5).cwiseProduct(reach);
  }
  return y;
}

/// [M Cqᵀ; Cq 0], bodies and rows put in their places one by one.
MatrixXd whole_matrix(const System& system, const Equations& eq) {
  const int n = system.n(), rows = system.n_rows();
  MatrixXd K = MatrixXd::Zero(n + rows, n + rows);
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Body& body = system.bodies[b];
    const auto at = 3 * static_cast<Eigen::Index>(b);
    if (body.modes() == 0) {
      K.diagonal().segment<3>(at) << body.m, body.m, body.J;
      continue;
    }
    const FlexibleInertia& e = eq.flexible[static_cast<std::size_t>(eq.flexible_of[b])];
    const MatrixXd M = mass_matrix(e);
    K.block<3, 3>(at, at) = M.topLeftCorner<3, 3>();
    K.block(at, e.begin, 3, e.n) = M.topRightCorner(3, e.n);
    K.block(e.begin, at, e.n, 3) = M.bottomLeftCorner(e.n, 3);
    K.block(e.begin, e.begin, e.n, e.n) = M.bottomRightCorner(e.n, e.n);
  }
  visit_jacobian(eq, [&](int row, int column, double v) { K(n + row, column) = K(column, n + row) = v; });
  return K;
}

struct ChainCase {
  int links;
  const char* stiffening;
};
class FlexibleChain : public testing::TestWithParam<ChainCase> {};

TEST_P(FlexibleChain, AccelerationsAndReactionsAreThoseOfADenseSolve) {
  const System system = chain(GetParam().links, GetParam().stiffening);
  const int n = system.n(), rows = system.n_rows();
  Equations eq(system);
  EXPECT_EQ(eq.schur.sparse(), rows > Schur::dense_rows);
  EXPECT_EQ(rows > Schur::dense_rows, GetParam().links > 12) << "both ways sit the exam";
  VectorXd dy(system.n_y());
  Draw draw(31);
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(evaluate(system, {0.1, random_y(system, draw), {}}, eq, dy));
    VectorXd right(n + rows);
    right << eq.f, eq.gamma;
    // Unknowns and equations in their own sizes: coordinates by √M, multipliers by their rows.
    const MatrixXd K = whole_matrix(system, eq);
    VectorXd unit(n + rows);
    unit.head(n) = K.diagonal().head(n).cwiseSqrt().cwiseInverse();
    unit.tail(rows) = (K.bottomLeftCorner(rows, n) * unit.head(n).asDiagonal()).rowwise().norm().cwiseInverse();
    const VectorXd x = MatrixXd(unit.asDiagonal() * K * unit.asDiagonal()).partialPivLu().solve(unit.cwiseProduct(right));
    const VectorXd a = eq.a.cwiseQuotient(unit.head(n)), lambda = eq.lambda.cwiseQuotient(unit.tail(rows));
    // Rounding times the condition number of S, which grows with the square of the links, 1e3 for
    // thirty, and with the ratio of inertias, 1e2.
    constexpr double solved = 1e-11;
    EXPECT_LT((a - x.head(n)).norm(), solved * x.head(n).norm());
    EXPECT_LT((lambda - x.tail(rows)).norm(), solved * x.tail(rows).norm());
    EXPECT_EQ(VectorXd(dy.segment(n, n)), eq.a);
  }
}
INSTANTIATE_TEST_SUITE_P(Every, FlexibleChain,
                         testing::Values(ChainCase{5, "none"}, ChainCase{12, "axial"}, ChainCase{30, "none"}, ChainCase{30, "axial"}),
                         [](const auto& p) {
                           return std::to_string(p.param.links) + "Links" + (p.param.stiffening[0] == 'n' ? "Linear" : "Stiffening");
                         });

// ---- projection and partitioning ----------------------------------------------------------------

struct End {
  VectorXd frames;  // coordinates and speeds in sizes of their own
  VectorXd eta;
};
End end_of_run(const std::string& modes, const std::string& constraints) {
  const Scene scene = read_scene_text(
      "gravity: [0, -9.81]\n"
      "bodies:\n"
      "  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [-25 mm, 0], A: [25 mm, 0]}}\n"
      "  coupler:\n"
      "    beam: {from: A, to: B, section: {circle: 5 mm}, elements: 10, young: 207 GPa,\n"
      "           poisson: 0.3, mass: 0.21 kg}\n"
      "    points: {A: [0, 0], B: [120 mm, 0]}\n"
      "    modes: " +
          modes +
          "\n"
          "  slider: {rigid: {mass: 0.14, inertia: 1e-4}, points: {P: [0, 0]}}\n"
          "joints:\n"
          "  bearing: {revolute: [ground, crank.O]}\n"
          "  crank pin: {revolute: [crank.A, coupler.A]}\n"
          "  gudgeon: {revolute: [coupler.B, slider.P]}\n"
          "  guide: {prismatic: [ground, slider.P]}\n"
          "start: {crank: {angle: 0, speed: 150}}\n"
          "run: {until: 0.02, tolerance: 1e-11, constraints: " +
          constraints + "}\n",
      "crank.yaml");
  const Model model = build(scene);
  Integrator run(model.system, model.scheme, assemble(scene, model).start);
  while (run.state().t < scene.run.until)
    if (!run.advance(scene.run.until)) {
      ADD_FAILURE() << run.failure();
      break;
    }
  EXPECT_EQ(run.counts().partitions > 0, constraints == "partitioning");
  const System& s = model.system;
  const VectorXd& y = run.state().y;
  VectorXd frames(2 * s.n_rigid());
  frames << y.head(s.n_rigid()), y.segment(s.n(), s.n_rigid()) / 150;
  frames = frames.cwiseQuotient(s.scale.head(s.n_rigid()).replicate(2, 1)).eval();
  return {frames, y.segment(s.n_rigid(), s.n() - s.n_rigid())};
}

// Half a turn of the crank, local errors of 1e-11 of the mechanism's size over some thousand steps;
// shapes, which bend by 1e-4 of it and turn a hundred times, know themselves to fewer digits.
TEST(FlexibleSliderCrank, PartitioningAndProjectionGiveTheSameMotion) {
  for (const char* modes : {"{frame: chord, count: 2}", "{frame: mean axes, count: 2}", "{frame: {tangent: A}, count: 3}",
                            "{frame: chord, count: 2}\n    stiffening: axial"}) {
    const End projected = end_of_run(modes, "projection"), partitioned = end_of_run(modes, "partitioning");
    EXPECT_LT((projected.frames - partitioned.frames).lpNorm<Eigen::Infinity>(), 1e-9) << modes;
    EXPECT_LT((projected.eta - partitioned.eta).norm(), 1e-7 * projected.eta.norm()) << modes;
    EXPECT_GT(projected.eta.norm(), 0) << modes;
  }
}

}  // namespace
}  // namespace pintle::flexible_constraints_test
