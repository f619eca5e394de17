// How many modes a reduction keeps, and what reductions refuse.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/component/reduction/modal_model.h"
#include "tests/contracts/reduction_bodies.h"
#include "tests/refusal.h"

namespace pintle::keep_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const ReferenceConditions clamped{ReferenceConditions::tangent, 0, -1}, pinned{ReferenceConditions::chord, 0, 1},
    floating{ReferenceConditions::mean_axes};
const std::vector<int> both{0, 1};

// ---- how many -----------------------------------------------------------------------------------

TEST(Keep, ByCountGivesThatManyModes) {
  const SampleBody body = euler_beam();
  const Component c = component(body.model);
  for (const ReferenceConditions& conditions : {clamped, pinned, floating}) {
    EXPECT_EQ(normal_modes(c, conditions, {.count = 5}).omega.size(), 5);
    EXPECT_EQ(normal_modes(c, conditions, {.count = 5}).sturm, 5) << "none missed";
  }
}

TEST(Keep, NoModesAtAllIsARigidBody) {
  const SampleBody body = euler_beam();
  const ModalModel m = normal_modes(component(body.model), floating, {.count = 0});
  EXPECT_EQ(m.shapes.cols(), 0);
  EXPECT_EQ(m.shapes.rows(), body.model.N());
  EXPECT_EQ(m.omega.size(), 0);
  const NodalMatrices a = nodal_matrices(body.model);
  EXPECT_EQ(flex_inertia(body.model, a.M.sparseView(), a.G.sparseView(), m).S.cols(), 0);
  EXPECT_EQ(effective_mass(body.model, a.M.sparseView(), m).cols(), 0);
}

TEST(Keep, BelowAFrequencyGivesAllModesBelowIt) {
  const SampleBody body = plate_on_edges(Coupling::rigid);
  const Component c = component(body.model);
  for (const ReferenceConditions& conditions : {clamped, floating}) {
    const VectorXd all = normal_modes(c, conditions, {.all = true}).omega / (2 * M_PI);
    const ModalModel m = normal_modes(c, conditions, {.below = (all[5] + all[6]) / 2});
    ASSERT_EQ(m.omega.size(), 6);
    EXPECT_LT((m.omega / (2 * M_PI) - all.head(6)).cwiseAbs().maxCoeff(), 1e-8 * all[5]);
    EXPECT_EQ(normal_modes(c, conditions, {.below = all[0] / 2}).omega.size(), 0);
  }
}

TEST(Keep, ByEffectiveMassTakesTheFewestModesThatExceedTheShare) {
  const SampleBody body = plate_on_edges(Coupling::rigid);
  const Component c = component(body.model);
  const NodalMatrices a = nodal_matrices(body.model);
  const RigidInertia r = rigid_inertia(body.model, a.M.sparseView());
  const Vector3d whole(r.m, r.m, r.J - r.c.squaredNorm() / r.m);
  for (const double share : {0.3, 0.6, 0.8}) {
    const ModalModel m = normal_modes(c, clamped, {.effective_mass = share});
    const MatrixXd mass = effective_mass(body.model, a.M.sparseView(), m);
    const auto k = mass.cols();
    const Vector3d with = mass.rowwise().sum().cwiseQuotient(whole);
    const Vector3d without = mass.leftCols(k - 1).rowwise().sum().cwiseQuotient(whole);
    EXPECT_GT(with.minCoeff(), share);
    EXPECT_LE(without.minCoeff(), share);
    EXPECT_EQ(m.sturm, static_cast<int>(k));
  }
}

TEST(Keep, AllGivesAsManyShapesAsDegreesOfFreedomLessThree) {
  for (const SampleBody& body : {euler_beam(), plate_on_edges(Coupling::average), plate_on_nodes()}) {
    const Component c = component(body.model);
    EXPECT_EQ(normal_modes(c, floating, {.all = true}).omega.size(), body.model.n() - 3);
    EXPECT_EQ(normal_modes(c, pinned, {.all = true}).omega.size(), body.model.n() - 3);
    EXPECT_EQ(craig_bampton(c, both, pinned, {.all = true}).omega.size(), body.model.n() - 3);
    EXPECT_EQ(free_modes(c, both, pinned, {.all = true}).omega.size(), body.model.n() - 3);
  }
}

// Lumped masses of beams may leave rotations without inertia: they follow statically and are no
// modes.
TEST(Keep, AllLeavesOutDegreesOfFreedomWithoutMass) {
  const int elements = 6;
  SampleBody body = euler_beam(elements);
  const Component lumped = component(body.model, true);
  const Component massless = [&] {
    Component c = lumped;
    for (int node = 0; node <= elements; ++node) c.M.coeffRef(3 * node + 2, 3 * node + 2) = 0;
    c.M.prune([](int, int, double value) { return value != 0; });
    return c;
  }();
  EXPECT_EQ(normal_modes(massless, floating, {.all = true}).omega.size(), 2 * (elements + 1) - 3);
  EXPECT_EQ(normal_modes(massless, pinned, {.all = true}).omega.size(), 2 * (elements + 1) - 3);
  // Clamping holds two dofs with mass and one without.
  EXPECT_EQ(normal_modes(massless, clamped, {.all = true}).omega.size(), 2 * (elements + 1) - 2);
  // Static condensation of the rotations, by hand.
  MatrixXd K = massless.K;
  std::vector<int> moving, turning;
  for (int node = 0; node <= elements; ++node) {
    if (node > 0) moving.insert(moving.end(), {3 * node, 3 * node + 1});
    if (node > 0) turning.push_back(3 * node + 2);
  }
  const MatrixXd Ktt = K(turning, turning), Ktm = K(turning, moving);
  const MatrixXd condensed = K(moving, moving) - Ktm.transpose() * Ktt.llt().solve(Ktm);
  const MatrixXd M = MatrixXd(massless.M)(moving, moving);
  const VectorXd expected = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(condensed, M).eigenvalues().cwiseSqrt();
  const VectorXd omega = normal_modes(massless, clamped, {.all = true}).omega;
  EXPECT_LT((omega - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.maxCoeff());
}

TEST(Keep, ReductionsOfMasslessDegreesOfFreedomHaveFiniteFrequencies) {
  const SampleBody body = euler_beam(2);
  Component c = component(body.model, true);
  for (int node = 0; node <= 2; ++node) c.M.coeffRef(3 * node + 2, 3 * node + 2) = 0;
  // Interface: all dofs but those of the middle node; two modes there. Only 6 dofs have
  // mass.
  const ModalModel m = craig_bampton(c, both, floating, {.count = 2});
  EXPECT_LE(m.omega.size(), 3);
  EXPECT_TRUE(m.omega.allFinite());
  EXPECT_TRUE(m.shapes.allFinite());
}

// ---- refusals -----------------------------------------------------------------------------------

void expect_refused(const std::function<void()>& act, const std::vector<std::string>& words) {
  pintle_test::expect_refused<std::invalid_argument>(act, words);
}

TEST(Refused, MoreModesThanThereAre) {
  const SampleBody body = euler_beam(2);
  const Component c = component(body.model);
  expect_refused([&] { normal_modes(c, floating, {.count = 9}); }, {"9 modes asked for, the body has 6"});
  expect_refused([&] { normal_modes(c, clamped, {.count = 7}); }, {"7 modes asked for", "has 6"});
  expect_refused([&] { craig_bampton(c, both, clamped, {.count = 4}); }, {"4 modes asked for", "interface", "has 3"});
  expect_refused([&] { free_modes(c, both, clamped, {.count = 7}); }, {"7 modes asked for", "has 6"});
}

TEST(Refused, AKeepThatSaysNothingOrTwoThings) {
  const SampleBody body = euler_beam(2);
  const Component c = component(body.model);
  expect_refused([&] { normal_modes(c, floating, {}); }, {"0 rules", "exactly one"});
  expect_refused([&] { normal_modes(c, floating, {.count = 1, .below = 10.0}); }, {"2 rules"});
  expect_refused([&] { normal_modes(c, floating, {.count = -1}); }, {"count = -1", "at least 0"});
  expect_refused([&] { normal_modes(c, floating, {.below = 0.0}); }, {"below = 0 Hz", "positive"});
  expect_refused([&] { normal_modes(c, clamped, {.effective_mass = 1.0}); }, {"effective mass = 1", "between 0 and 1"});
}

TEST(Refused, EffectiveMassOfAFreeBody) {
  const SampleBody body = euler_beam();
  const Component c = component(body.model);
  for (const auto& reduce : {std::function<void()>([&] { normal_modes(c, floating, {.effective_mass = 0.9}); }),
                             std::function<void()>([&] { free_modes(c, both, clamped, {.effective_mass = 0.9}); })})
    expect_refused(reduce, {"effective mass", "use count or below"});
}

TEST(Refused, AnEffectiveMassThatTheMeshCannotReach) {
  const SampleBody body = euler_beam(4);
  expect_refused([&] { normal_modes(component(body.model), clamped, {.effective_mass = 0.999}); }, {"0.999 cannot be reached", "refine"});
}

TEST(Refused, AllModesOfALargeBody) {
  const SampleBody body = euler_beam(most_for_all / 3 + 2);
  const Component c = component(body.model);
  expect_refused([&] { normal_modes(c, floating, {.all = true}); }, {"too many", "3000", "use count"});
}

TEST(Refused, PortsThatAreNotThereOrNamedTwice) {
  const SampleBody body = euler_beam();
  const Component c = component(body.model);
  expect_refused([&] { craig_bampton(c, {0, 2}, clamped, {.count = 1}); }, {"interface port = 2", "has 2 ports"});
  expect_refused([&] { craig_bampton(c, {0, 0}, clamped, {.count = 1}); }, {"\"A\"", "once"});
  expect_refused([&] { free_modes(c, {1, 1}, clamped, {.count = 1}); }, {"\"B\"", "once"});
  expect_refused([&] { normal_modes(c, {ReferenceConditions::tangent, -1, -1}, {.count = 1}); }, {"port a = -1", "has 2 ports"});
  expect_refused([&] { normal_modes(c, {ReferenceConditions::chord, 0, 5}, {.count = 1}); }, {"port b = 5"});
  expect_refused([&] { normal_modes(c, {ReferenceConditions::chord, 1, 1}, {.count = 1}); }, {"coincide", "tangent"});
}

TEST(Refused, AnInterfaceThatDoesNotHoldTheBody) {
  const SampleBody body = plate_on_nodes();
  const Component c = component(body.model);
  expect_refused([&] { craig_bampton(c, {0}, floating, {.count = 2}); }, {"leave a rigid motion", "add a port"});
  expect_refused([&] { craig_bampton(c, {}, floating, {.count = 2}); }, {"leave a rigid motion"});
}

TEST(Refused, ABodyInTwoPieces) {
  Eigen::Matrix2Xd x(2, 4);
  x << 0, 0.1, 0.3, 0.4, 0, 0, 0, 0;
  SampleBody body = on_nodes(fe_model(x, {Block<BeamEuler>{{euler_strip()}, {0, 1, 2, 3}, {0, 1}}}), 0, 1);
  const Component c = component(body.model);
  for (const auto& reduce : {std::function<void()>([&] { normal_modes(c, floating, {.count = 3}); }),
                             std::function<void()>([&] { normal_modes(c, clamped, {.count = 3}); }),
                             std::function<void()>([&] { craig_bampton(c, both, clamped, {.count = 0}); }),
                             std::function<void()>([&] { free_modes(c, both, clamped, {.count = 0}); })})
    EXPECT_THROW(reduce(), std::runtime_error);
}

TEST(Refused, RayleighDampingThatIsNotDetermined) {
  expect_refused([] { rayleigh(10, 0.01, 10, 0.02); }, {"second frequency = 10", "differ"});
  expect_refused([] { rayleigh(0, 0.01, 10, 0.02); }, {"frequency = 0", "positive"});
  expect_refused([] { rayleigh(1, -0.01, 10, 0.02); }, {"ratio = -0.01", "negative"});
}

}  // namespace
}  // namespace pintle::keep_test
