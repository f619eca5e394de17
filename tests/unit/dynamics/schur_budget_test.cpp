// What S = Cq M⁻¹ Cqᵀ costs by its number of rows, as counts: entries, bytes and allocations.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <utility>

#include "framework/dynamics/equations/equations.h"
#include "tests/unit/heap.h"

namespace pintle::schur_budget_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Rods of length 0.1 hung in a row, angles and spins at random but the same each time.
struct Chain {
  System system;
  State state;
};
Chain chain(int links, double bent = 1.5, double turned = 0) {
  constexpr double half = 0.05, m = 0.2, J = m * 0.01 / 12;
  Chain c;
  c.system.gravity = {0.3, -9.81};
  c.system.markers.push_back({});
  for (int i = 0; i < links; ++i) {
    c.system.bodies.push_back({"link", m, J});
    c.system.markers.push_back({i, {-half, 0}, 0});
    c.system.markers.push_back({i, {half, 0}, 0});
    c.system.joints.emplace_back(Revolute{2 * i, 2 * i + 1});
    c.system.joint_names.push_back("pin");
  }
  c.system.length = half;
  number(c.system);
  c.state.y.setZero(c.system.n_y());
  Vector2d end(0, 0), end_rate(0, 0);
  for (int i = 0; i < links; ++i) {
    const double angle = turned + bent * std::sin(3.0 * i), spin = 2 * std::cos(5.0 * i);
    const Vector2d u(std::cos(angle), std::sin(angle));
    c.state.y.segment<3>(3 * i) << end + half * u, angle;
    c.state.y.segment<3>(c.system.n() + 3 * i) << end_rate + half * spin * perp(u), spin;
    end += 2 * half * u;
    end_rate += 2 * half * spin * perp(u);
  }
  return c;
}

// [M Cqᵀ; Cq 0] [a; λ] = [f; γ], written down for this chain alone and solved densely.
VectorXd reference_accelerations(const Chain& c) {
  constexpr double half = 0.05;
  const int n = c.system.n(), rows = c.system.n_rows();
  MatrixXd K = MatrixXd::Zero(n + rows, n + rows);
  VectorXd r = VectorXd::Zero(n + rows);
  for (int i = 0; i < n / 3; ++i) {
    const Body& b = c.system.bodies[static_cast<std::size_t>(i)];
    K.diagonal().segment<3>(3 * i) << b.m, b.m, b.J;
    r.segment<2>(3 * i) = b.m * c.system.gravity;
    const double angle = c.state.y[3 * i + 2], spin = c.state.y[n + 3 * i + 2];
    const Vector2d u = half * Vector2d(std::cos(angle), std::sin(angle));
    // Pin i: r_i − u − (r_j + u_j) = 0; its second derivative holds +spin² u + spin_j² u_j.
    const int row = n + 2 * i;
    K.block<2, 2>(row, 3 * i).setIdentity();
    K.block<2, 1>(row, 3 * i + 2) = -perp(u);
    r.segment<2>(row) -= spin * spin * u;
    if (i + 1 < n / 3) {
      K.block<2, 2>(row + 2, 3 * i) = -MatrixXd::Identity(2, 2);
      K.block<2, 1>(row + 2, 3 * i + 2) = -perp(u);
      r.segment<2>(row + 2) -= spin * spin * u;
    }
  }
  K.topRightCorner(n, rows) = K.bottomLeftCorner(rows, n).transpose();
  return K.partialPivLu().solve(r).head(n);
}

TEST(Schur, IsSparseAboveFortyEightRowsAndGivesTheSameAccelerations) {
  for (int links : {1, 5, 24, 25, 60}) {
    const Chain c = chain(links);
    Equations eq(c.system);
    VectorXd dy(c.system.n_y());
    ASSERT_TRUE(evaluate(c.system, c.state, eq, dy));
    EXPECT_EQ(eq.schur.sparse(), 2 * links > 48);
    const VectorXd a = reference_accelerations(c);
    // Condition number of S grows with the square of the links, 1e4 for sixty.
    EXPECT_LT((dy.segment(c.system.n(), c.system.n()) - a).norm(), 1e-10 * a.norm()) << links;
  }
}

TEST(Schur, AnAccelerationOfAChainOfAThousandDoesNotAllocate) {
  Chain c = chain(1000);
  Equations eq(c.system);
  VectorXd dy(c.system.n_y());
  ASSERT_STREQ(eq.schur.solver(), "sparse (LDL)");
  bool regular = true;
  EXPECT_EQ(allocated([&] {
              for (int i = 0; i < 3; ++i) {
                c.state.y[2] += 1e-6;
                regular = regular && evaluate(c.system, c.state, eq, dy);
              }
            }),
            0);
  EXPECT_TRUE(regular);
}

// Entries of L, and bytes, a body: the same at 100 and at 10 000 links.
TEST(Schur, AChainsFactorAndMemoryGrowWithTheLinks) {
  const auto measure = [](int links) {
    const Chain c = chain(links);
    const long before = heap_in_use();
    const Equations eq(c.system);
    const long bytes = before < 0 ? 0 : heap_in_use() - before;
    return std::pair(eq.schur.nonzeros() / links, static_cast<double>(bytes) / links);
  };
  const auto [few_entries, few_bytes] = measure(100);
  const auto [many_entries, many_bytes] = measure(10'000);
  EXPECT_LT(many_entries, 1.05 * few_entries);
  EXPECT_LT(many_bytes, 1.2 * few_bytes);
}

// The weakest combination of its rows is about 1/N² of the whole: less than what rounding leaves of 2 N dependent rows, but far above what it
// leaves of rows of a factor as narrow as this.
TEST(Schur, AStraightChainOfManyLinksHasIndependentRows) {
  const Chain c = chain(120'000, 0);
  Equations eq(c.system);
  pose(c.system, 0, c.state.y, eq);
  factor(c.system, c.state.y, eq);
  EXPECT_TRUE(eq.regular);
  EXPECT_FALSE(eq.schur.dependent());
}

// Pinned at its far end too, it carries the same force along its whole length without any load: one combination of all rows is dependent.
TEST(Schur, AStraightChainBetweenTwoPinsHasOneDependentRow) {
  for (const int links : {100, 3000, 60'000})
    for (const double turned : {0.0, 0.3, 2.0}) {
      Chain c = chain(links, 0, turned);
      const double length = 0.1 * links;
      const int far_pin = static_cast<int>(c.system.markers.size());
      c.system.markers.push_back({ground, {length * std::cos(turned), length * std::sin(turned)}, 0});
      c.system.joints.emplace_back(Revolute{2 * links, far_pin});
      c.system.joint_names.push_back("pin");
      number(c.system);
      c.state.y.conservativeResize(c.system.n_y());
      Equations eq(c.system);
      pose(c.system, 0, c.state.y, eq);
      factor(c.system, c.state.y, eq);
      EXPECT_TRUE(eq.regular);
      EXPECT_EQ(eq.schur.lost(), 1) << links << " links at " << turned;
    }
}

TEST(Schur, DenseDependentRowsDoNotAllocate) {
  Chain c = chain(3);
  for (int k : {1, 2}) c.system.joints.push_back(c.system.joints[static_cast<std::size_t>(k)]);
  c.system.joint_names.resize(c.system.joints.size());
  number(c.system);
  Equations eq(c.system);
  pose(c.system, 0, c.state.y, eq);
  VectorXd mu = VectorXd::Ones(c.system.n_rows());
  factor(c.system, c.state.y, eq);
  EXPECT_EQ(allocated([&] {
              factor(c.system, c.state.y, eq);
              eq.schur.solve(mu);
            }),
            0);
  EXPECT_TRUE(eq.schur.dependent());
}
}  // namespace
}  // namespace pintle::schur_budget_test
