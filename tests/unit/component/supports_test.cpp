// Supports that leave a motion free are told by it; parts and mechanisms by their place.

#include "framework/component/fe/loads.h"
#include "framework/component/fe/statics.h"
#include "tests/unit/component/fe_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace pintle::supports_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

StaticSolution solve(const FeModel& m, const Supports& supports, const VectorXd& load) {
  return solve_static(m, Assembler(m).stiffness(), supports, load);
}

// What the supports leave, in words.
class LooseBody : public testing::Test {
 protected:
  const Plate p = plate(4, 2, CellShape::quadrilateral4, rectangle(2, 1));
  const FeModel m = model_of(p, steel(PlaneState::stress));
  Supports s;
  std::string complaint() const {
    return refusal<std::runtime_error>([&] { solve(m, s, VectorXd::Zero(m.n())); });
  }
};

TEST_F(LooseBody, HeldByNothingMayMoveEveryWay) {
  EXPECT_TRUE(says(complaint(), "free to move along x, to move along y and to turn")) << complaint();
}
TEST_F(LooseBody, PinnedAtOneNodeMayTurnAboutIt) {
  hold(s, m, p.nodes.at("right").back(), true, true, false);
  EXPECT_TRUE(says(complaint(), "free to turn about (2, 1)")) << complaint();
}
TEST_F(LooseBody, OnRollersMayMoveAlong) {
  for (const int i : p.nodes.at("bottom")) hold(s, m, i, false, true, false);
  EXPECT_TRUE(says(complaint(), "free to move along x;")) << complaint();
}
TEST_F(LooseBody, AgainstAWallMayMoveUp) {
  for (const int i : p.nodes.at("left")) hold(s, m, i, true, false, false);
  EXPECT_TRUE(says(complaint(), "free to move along y;")) << complaint();
}
TEST_F(LooseBody, TwoRollersThatMeetAtAPointLeaveATurnAboutIt) {
  hold(s, m, p.nodes.at("bottom").front(), true, false, false);  // at (0, 0)
  hold(s, m, p.nodes.at("right").back(), false, true, false);    // at (2, 1)
  EXPECT_TRUE(says(complaint(), "free to turn about (2, 0)")) << complaint();
}
TEST_F(LooseBody, OneRollerLeavesASlideAndATurn) {
  hold(s, m, p.nodes.at("bottom").front(), true, false, false);
  EXPECT_TRUE(says(complaint(), "free to move along y and to turn about")) << complaint();
}
TEST_F(LooseBody, ASupportThatIsRepeatedHoldsNoMore) {
  for (int k = 0; k < 3; ++k) hold(s, m, 0, true, true, false);
  EXPECT_TRUE(says(complaint(), "free to turn about (0, 0)")) << complaint();
}

TEST(LooseParts, APartHeldByNothingIsNamedByItsPlace) {
  Eigen::Matrix2Xd x(2, 5);
  x << 0, 1, 2, 5, 6, 0, 0, 0, 3, 4;
  const FeModel m = fe_model(x, {Block<BeamEuler>{{{2e8, 1500, 8}}, {0, 1, 1, 2, 3, 4}, {0, 1, 2}}});
  Supports s;
  hold(s, m, 0, true, true, true);
  const std::string words = refusal<std::runtime_error>([&] { solve(m, s, VectorXd::Zero(m.n())); });
  EXPECT_TRUE(says(words, "2 parts") && says(words, "between (5, 3) and (6, 4)")) << words;
}

TEST(Mechanism, HingedBarsThatSwayAreNamedByPlaceAndDirection) {
  Eigen::Matrix2Xd x(2, 4);
  x << 0, 1, 0, 1, 0, 0, 1, 1;
  const FeModel m = fe_model(x, {Block<Bar>{{{1e8, 4}}, {0, 2, 2, 3, 1, 3}, {0, 1, 2}}});
  Supports s;
  hold(s, m, 0, true, true, false);
  hold(s, m, 1, true, true, false);
  const std::string words = refusal<std::runtime_error>([&] { solve(m, s, VectorXd::Zero(m.n())); });
  EXPECT_TRUE(says(words, "1) in x")) << words;
}

TEST(Mechanism, AStraightChainOfBarsIsOne) {
  for (const double angle : {0.0, 0.3}) {
    const Vector2d along(std::cos(angle), std::sin(angle));
    const FeModel m = chain(Bar{1e8, 4}, 5, {0, 0}, along);
    Supports s;
    hold(s, m, 0, true, true, false);
    hold(s, m, 5, true, true, false);
    EXPECT_TRUE(says(refusal<std::runtime_error>([&] { solve(m, s, VectorXd::Zero(m.n())); }), "without resistance"));
  }
}

TEST(Supports, WhatCannotBeHeldIsRefused) {
  FeModel m = model_of(plate(4, 2, CellShape::quadrilateral4, rectangle(2, 1)), steel(PlaneState::stress));
  add_ports(m, {}, {{"edge", {0, 0}, {0, 1, 2}, {1, 2, 1}, Coupling::rigid}});
  Supports s;
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { hold(s, m, 1, true, false, false); }), "hold the port instead"));
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { hold(s, m, -2, true, false, false); }), "node -2 does not exist"));
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { hold(s, m, 7, false, false, true); }), "no rotation to hold"));
  FeModel bars = chain(Bar{1e8, 4}, 1, {0, 0}, {1, 0});
  add_ports(bars, {{"end", 1}}, {});
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { hold(s, bars, *bars.port("end"), false, false, true); }), "\"end\""));
  VectorXd f = VectorXd::Zero(4);
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { add_force(f, *bars.port("end"), {0, 0}, 3); }), "no rotation"));
  EXPECT_TRUE(s.dofs.empty());
}

}  // namespace
}  // namespace pintle::supports_test
