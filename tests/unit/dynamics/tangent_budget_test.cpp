// The tangent is part of every implicit step: it must not allocate.

#include <gtest/gtest.h>

#include <vector>

#include "framework/dynamics/equations/tangent.h"
#include "tests/contracts/moving_bodies.h"
#include "tests/unit/heap.h"

namespace pintle::tangent_budget_test {
namespace {

Jet steady(double) { return {-1.3, 0, 0}; }

TEST(TangentBudget, EvaluationDoesNotAllocate) {
  for (const Carriers& carriers : all_carriers()) {
    SCOPED_TRACE(name_of(carriers));
    System s = two_bodies(carriers);
    s.gravity = {0.6, -9.8};
    s.joints = {Revolute{0, 1}, Slot{0, 1}, Weld{0, 1}, Distance{0, 1, 0.8}, AngleDriver{0, 1, steady}};
    s.forces = {PointForce{0, 1, steady, steady, true}, Torque{0, 1, steady}, Spring{0, 1, 40, 3, 0.5}, TorsionSpring{0, 1, 25, 2, -0.8}};
    s.contacts = {{0, 1, JournalBearing{0.01, 0.1}, ImpactLaw{1e6, 1.5, 0}, Ambrosio{0.3, 0, 50}}};
    s.joint_names.assign(s.joints.size(), "joint");
    s.force_names.assign(s.forces.size(), "force");
    s.contact_names = {"contact"};
    number(s);
    Equations eq(s);
    Draw draw(5);
    State state = random_state(s, draw, eq);  // farther apart than the clearance: touching
    state.impact_rate = {1};
    const Eigen::VectorXd a = draw.matrix(s.n(), 1, 5), lambda = draw.matrix(s.n_rows(), 1, 5);
    pose(s, state.t, state.y, eq);
    update_mass(s, state.y, eq);
    speed(s, state.t, state.y, eq);
    apply_forces(s, state, eq);
    ASSERT_GT(eq.contact[0].normal.force, 0);
    Tangent tangent(s);
    std::vector<double> values(tangent.places().size());
    EXPECT_EQ(allocated([&] { tangent.evaluate(s, state, eq, a, lambda, {1, 2, 3}, values); }), 0);
  }
}

}  // namespace
}  // namespace pintle::tangent_budget_test
