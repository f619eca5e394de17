// Reductions one by one: edge cases, static exactness, effective masses, damping. How many modes
// are kept and what is refused: keep_test.cpp. What every frame tie must do:
// contracts/frame_tie_test.cpp.

#include "framework/component/reduction/modal_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "tests/contracts/reduction_bodies.h"

namespace pintle::modal_model_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double rounding = 1e-12;
// Through K⁻¹ or M⁻¹: rounding times a condition of 1e4 to 1e6.
constexpr double through_inverse = 1e-9;

const ReferenceConditions clamped{ReferenceConditions::tangent, 0, -1}, pinned{ReferenceConditions::chord, 0, 1},
    floating{ReferenceConditions::mean_axes};
const std::vector<int> both{0, 1};

// ---- Craig–Bampton ------------------------------------------------------------------------------

TEST(CraigBampton, ShapesAreStaticOnesAndModesLessThreeRigidMotions) {
  const SampleBody body = plate_on_edges(Coupling::average);
  const Component c = component(body.model);
  EXPECT_EQ(craig_bampton(c, both, floating, {.count = 0}).omega.size(), 3);
  EXPECT_EQ(craig_bampton(c, both, floating, {.count = 4}).omega.size(), 7);
  const SampleBody nodes = plate_on_nodes();
  EXPECT_EQ(craig_bampton(component(nodes.model), both, floating, {.count = 4}).omega.size(), 5);
}

TEST(CraigBampton, OfOneTurningPortIsTheModesOfTheBodyClampedThere) {
  const SampleBody body = plate_on_edges(Coupling::rigid);
  const Component c = component(body.model);
  const ModalModel one = craig_bampton(c, {0}, clamped, {.count = 5});
  const ModalModel modes = normal_modes(c, clamped, {.count = 5});
  ASSERT_EQ(one.omega.size(), 5);
  EXPECT_LT((one.omega - modes.omega).cwiseAbs().maxCoeff(), 1e-8 * modes.omega[4]);
  EXPECT_LT((one.shapes - modes.shapes).cwiseAbs().maxCoeff(), 1e-5 * modes.shapes.cwiseAbs().maxCoeff());
  EXPECT_LT(one.residual.maxCoeff(), 1e-6) << "they are true modes";
}

TEST(CraigBampton, OfOneTurningPortWithoutModesIsRigid) {
  const SampleBody body = euler_beam();
  EXPECT_EQ(craig_bampton(component(body.model), {1}, floating, {.count = 0}).omega.size(), 0);
}

TEST(CraigBampton, WhereTheInterfaceIsTheWholeBodyIsExact) {
  const SampleBody body = euler_beam(1);
  const Component c = component(body.model);
  for (const ReferenceConditions& conditions : {clamped, pinned, floating}) {
    const VectorXd reduced = craig_bampton(c, both, conditions, {.count = 0}).omega;
    const VectorXd all = normal_modes(c, conditions, {.all = true}).omega;
    ASSERT_EQ(reduced.size(), 3);
    EXPECT_EQ(craig_bampton(c, both, conditions, {.below = 1e9}).omega, reduced) << "no mode is left";
    EXPECT_LT((reduced - all).cwiseAbs().maxCoeff(), through_inverse * all[2]);
  }
}

// Rayleigh and Ritz: more shapes never raise a frequency, and all of them give the body's own.
TEST(CraigBampton, FrequenciesFallTowardsThoseOfTheBody) {
  const SampleBody body = plate_on_edges(Coupling::rigid);
  const Component c = component(body.model);
  const VectorXd exact = normal_modes(c, floating, {.count = 3}).omega;
  VectorXd before = VectorXd::Constant(3, std::numeric_limits<double>::infinity());
  for (const int count : {0, 2, 4, 8, 16, 32}) {
    const VectorXd now = craig_bampton(c, both, floating, {.count = count}).omega.head(3);
    EXPECT_TRUE((now.array() <= before.array() * (1 + through_inverse)).all()) << count;
    EXPECT_TRUE((now.array() >= exact.array() * (1 - through_inverse)).all()) << count;
    before = now;
  }
  // What a fixed-interface mode left out would have added is of the order of its own frequency
  // ratio squared.
  const VectorXd all = craig_bampton(c, both, floating, {.count = 32}).omega;
  EXPECT_LT((before - exact).cwiseQuotient(exact).maxCoeff(), std::pow(exact[2] / all[all.size() - 1], 2));
}

// Loads on port b of a body clamped at port a, both in the interface.
TEST(CraigBampton, FlexibilityOfTheHeldBodyIsExactAtItsPorts) {
  for (const Coupling coupling : {Coupling::rigid, Coupling::average}) {
    const SampleBody body = plate_on_edges(coupling);
    const Component c = component(body.model);
    const ModalModel m = craig_bampton(c, both, clamped, {.count = 2});
    const int* a = body.model.ports[0].dof;
    const int* b = body.model.ports[1].dof;
    MatrixXd K = c.K;
    for (int k = 0; k < 3; ++k) {
      K.row(a[k]).setZero();
      K.col(a[k]).setZero();
      K(a[k], a[k]) = 1;
    }
    const std::vector<int> at{b[0], b[1], b[2]};
    const MatrixXd full = K.llt().solve(MatrixXd::Identity(K.rows(), K.rows()))(at, at);
    MatrixXd shape_at_b(3, m.omega.size());
    for (Eigen::Index k = 0; k < m.omega.size(); ++k) shape_at_b.col(k) = port_motion(body, 1, m.shapes.col(k));
    const MatrixXd reduced = shape_at_b * m.omega.cwiseAbs2().cwiseInverse().asDiagonal() * shape_at_b.transpose();
    EXPECT_LT((reduced - full).cwiseQuotient(full.diagonal().cwiseSqrt() * full.diagonal().cwiseSqrt().transpose()).cwiseAbs().maxCoeff(),
              through_inverse);
  }
}

// ---- free modes ---------------------------------------------------------------------------------

TEST(FreeModes, AttachmentShapesAreOneForEachFreedomOfThePorts) {
  const SampleBody body = plate_on_edges(Coupling::rigid);
  const Component c = component(body.model);
  EXPECT_EQ(free_modes(c, both, floating, {.count = 4}).omega.size(), 4 + 6);
  EXPECT_EQ(free_modes(c, {}, floating, {.count = 4}).omega.size(), 4);
}

TEST(FreeModes, KeptModesAreTheBodysOwn) {
  const SampleBody body = plate_on_edges(Coupling::rigid);
  const Component c = component(body.model);
  const ModalModel m = free_modes(c, both, floating, {.count = 4});
  const VectorXd modes = normal_modes(c, floating, {.count = 4}).omega;
  EXPECT_LT((m.omega.head(4) - modes).cwiseAbs().maxCoeff(), 1e-8 * modes[3]);
  EXPECT_LT(m.residual.head(4).maxCoeff(), 1e-6);
}

TEST(FreeModes, AttachmentShapesThatKeptModesMakeUpAreLeftOut) {
  const SampleBody body = euler_beam(2);  // 9 dofs, 6 of them elastic
  const Component c = component(body.model);
  EXPECT_EQ(free_modes(c, both, floating, {.count = 4}).omega.size(), 6);
  EXPECT_EQ(free_modes(c, both, clamped, {.count = 6}).omega.size(), 6);
}

// A force on one port of the free body, met by its inertia: deformation is exact at both ports.
TEST(FreeModes, ResponseOfTheAcceleratingBodyIsExact) {
  const SampleBody body = plate_on_nodes();
  const Component c = component(body.model);
  const ModalModel m = free_modes(c, both, floating, {.count = 1});
  const MatrixXd rigid = rigid_nodal(body.model);
  const MatrixXd M = c.M, K = c.K, Mr = M * rigid;
  const MatrixXd project = MatrixXd::Identity(M.rows(), M.rows()) - rigid * (rigid.transpose() * Mr).inverse() * Mr.transpose();
  MatrixXd load = MatrixXd::Zero(M.rows(), 4);
  int column = 0;
  for (const Port& p : body.model.ports)
    for (int k = 0; k < 2; ++k) load(p.dof[k], column++) = 1;
  const MatrixXd orthonormal = rigid.householderQr().householderQ() * MatrixXd::Identity(M.rows(), 3);
  const MatrixXd regular = K + K.diagonal().mean() * orthonormal * orthonormal.transpose();
  const MatrixXd elastic = project * regular.ldlt().solve(project.transpose() * load);
  const MatrixXd full = load.transpose() * elastic;
  const MatrixXd modal = m.shapes.transpose() * load;
  const MatrixXd reduced = modal.transpose() * m.omega.cwiseAbs2().cwiseInverse().asDiagonal() * modal;
  EXPECT_LT((reduced - full).norm(), 1e-8 * full.norm());
}

// ---- effective mass -----------------------------------------------------------------------------

TEST(EffectiveMass, SumsToTheMassThatIsNotHeld) {
  for (const auto& make : std::vector<std::function<SampleBody()>>{[] { return euler_beam(); }, timoshenko_bracket,
                                                                   [] { return plate_on_edges(Coupling::rigid); }}) {
    const SampleBody body = make();
    const Component c = component(body.model);
    const Sparse M = Assembler(body.model).mass();
    for (const ReferenceConditions& conditions : {clamped, pinned}) {
      const Vector3d sum = effective_mass(body.model, M, normal_modes(c, conditions, {.all = true})).rowwise().sum();
      const RigidInertia r = rigid_inertia(body.model, M);
      const Eigen::Vector2d centre = r.c / r.m;
      MatrixXd rigid = rigid_motions(body.model);
      rigid.col(2) += centre.y() * rigid.col(0) - centre.x() * rigid.col(1);
      const MatrixXd B = reference_condition_rows(c, conditions), dense = c.M;
      const MatrixXd held = (B * dense.llt().solve(B.transpose())).inverse();
      const MatrixXd Br = B * rigid;
      const MatrixXd expected = rigid.transpose() * dense * rigid - Br.transpose() * held * Br;
      EXPECT_LT((sum - expected.diagonal()).cwiseQuotient(expected.diagonal()).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

// What is held alone shrinks with the mesh: the sums come to mass and inertia.
TEST(EffectiveMass, SumsReachMassAndInertiaAsTheMeshIsRefined) {
  double before = 1;
  for (const int elements : {4, 16, 64}) {
    const SampleBody body = euler_beam(elements);
    const Sparse M = Assembler(body.model).mass();
    const RigidInertia r = rigid_inertia(body.model, M);
    const Vector3d whole(r.m, r.m, r.J - r.c.squaredNorm() / r.m);
    const MatrixXd mass = effective_mass(body.model, M, normal_modes(component(body.model), clamped, {.all = true}));
    const double missing = 1 - mass.rowwise().sum().cwiseQuotient(whole).minCoeff();
    EXPECT_LT(missing, 0.35 * before) << elements << " elements: a quarter the element, a quarter the loss";
    EXPECT_GT(missing, 0);
    before = missing;
  }
  EXPECT_LT(before, 0.02);
}

TEST(EffectiveMass, OfFreeModesIsZero) {
  const SampleBody body = plate_on_edges(Coupling::average);
  const Sparse M = Assembler(body.model).mass();
  const MatrixXd mass = effective_mass(body.model, M, normal_modes(component(body.model), floating, {.count = 5}));
  const RigidInertia r = rigid_inertia(body.model, M);
  EXPECT_LT(mass.topRows(2).maxCoeff(), rounding * r.m);
  EXPECT_LT(mass.row(2).maxCoeff(), rounding * r.J);
}

// ---- damping ------------------------------------------------------------------------------------

TEST(Rayleigh, MeetsBothRatiosAtTheirFrequencies) {
  for (const double low : {1.0, 1e3, 1e5})
    for (const double factor : {1.5, 10.0, 1e4}) {
      const Rayleigh r = rayleigh(low, 0.02, low * factor, 0.05);
      const VectorXd zeta = ratios(r, Eigen::Vector2d(low, low * factor));
      EXPECT_NEAR(zeta[0], 0.02, rounding);
      EXPECT_NEAR(zeta[1], 0.05, rounding);
    }
}

TEST(Rayleigh, DoesNotMindTheOrderOfItsModes) {
  const Rayleigh r = rayleigh(10, 0.01, 30, 0.02), s = rayleigh(30, 0.02, 10, 0.01);
  EXPECT_NEAR(r.alpha, s.alpha, rounding);
  EXPECT_NEAR(r.beta, s.beta, rounding);
}

// αM + βK in modal coordinates is diag(2ζω).
TEST(Rayleigh, IsTheDampingMatrixSeenByModes) {
  const SampleBody body = euler_beam();
  const NodalMatrices a = nodal_matrices(body.model);
  const ModalModel m = normal_modes(component(body.model), floating, {.count = 4});
  const Rayleigh r = rayleigh(m.omega[0], 0.01, m.omega[2], 0.03);
  const MatrixXd C = m.shapes.transpose() * (r.alpha * a.M + r.beta * a.K) * m.shapes;
  const VectorXd expected = 2 * ratios(r, m.omega).cwiseProduct(m.omega);
  EXPECT_LT((C - MatrixXd(expected.asDiagonal())).cwiseAbs().maxCoeff(), 1e-8 * expected.maxCoeff());
}

}  // namespace
}  // namespace pintle::modal_model_test
