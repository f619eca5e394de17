// Contacts of dry friction that stick: what holds them leaves no acceleration along the slip and is shared out as they can bear.

#include "framework/dynamics/equations/sticking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "contact/profile.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::sticking_test {
namespace {

using Eigen::VectorXd;

struct Kind {
  const char* name;
  PiecePair gap;
  std::vector<Joint> joints = {};
};
const Piece disc{.radius = 0.07, .centre = {0.02, -0.03}}, hollow{.radius = -0.3, .centre = {-0.04, 0.05}},
    flat{.centre = {-0.02, 0.06}, .normal = -0.7, .half = 0.5, .straight = true};
// Of an egg.
Piece span() {
  std::vector<Eigen::Vector2d> rim;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * M_PI * i / 12, r = 0.3 + 0.02 * std::cos(angle);
    rim.emplace_back(0.03 + r * std::cos(angle), -0.02 + r * std::sin(angle));
  }
  return profile_through(rim, true).pieces[1];
}
const Piece egg = span();
const std::vector<Kind> kinds{
    {"JournalInItsBearing", JournalBearing{0.09, 0.1}},
    {"DiscOnDisc", {disc, disc}},
    {"DiscInHollow", {disc, hollow}},
    {"LineOnDisc", {flat, disc}},
    {"DiscOnLine", {disc, flat}},
    {"CurveOnDisc", {egg, disc}},
    {"LineOnCurve", {flat, egg}},
    {"DiscOnLineBesideAJoint", {disc, flat}, {Slot{0, 1}}},
};

struct Case {
  Kind kind;
  Carriers carriers;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.kind.name << name_of(c.carriers); }

class Sticking : public testing::TestWithParam<Case> {
 protected:
  static System make(const Case& c) {
    System s = two_bodies(c.carriers);
    s.gravity = {0.6, -9.8};
    s.joints = c.kind.joints;
    s.joint_names.assign(s.joints.size(), "slot");
    ContactPair pair{0, 1, c.kind.gap, ImpactLaw{1e5, 1.5, 0.5}, Coulomb{0.2, 0.3, 0}};
    pair.profiles = pair.follows = true;
    s.contacts = {pair};
    s.contact_names = {"contact"};
    number(s);
    return s;
  }
  // Pressed by a millimetre, sticking.
  State pressed(Draw& draw) {
    State s = random_state(system_, draw, eq_);
    speed(system_, s.t, s.y, eq_);
    const Gap gap = evaluate(system_.contacts[0].gap, moving_point(eq_.motion[0]), moving_point(eq_.motion[1]));
    const Eigen::Vector2d shift = (1e-3 - gap.depth) * gap.n;
    if (system_.markers[0].body != ground)
      s.y.head<2>() += shift;
    else
      s.y.segment<2>(3) -= shift;
    s.impact_rate = {1.5};
    s.friction = {{0, draw.within(-50, 50)}};
    return s;
  }
  double slip(const State& s) {
    pose(system_, s.t, s.y, eq_);
    speed(system_, s.t, s.y, eq_);
    return evaluate(system_.contacts[0].gap, moving_point(eq_.motion[0]), moving_point(eq_.motion[1])).material_slip;
  }
  System system_ = make(GetParam());
  Equations eq_{system_};
};
INSTANTIATE_TEST_SUITE_P(Every, Sticking, testing::ValuesIn([] {
                           std::vector<Case> all;
                           for (const Kind& kind : kinds)
                             for (const Carriers& carriers : all_carriers()) all.push_back({kind, carriers});
                           return all;
                         }()),
                         [](const auto& i) { return i.param.kind.name + name_of(i.param.carriers); });

// The slip along the motion that accelerate gives, at times h about now: differences of second order err by h² of third derivatives.
TEST_P(Sticking, HoldsTheSlipWhereItIs) {
  Draw draw(11);
  const Eigen::Index n = system_.n();
  for (int k = 0; k < 8; ++k) {
    const State s = pressed(draw);
    VectorXd dy(system_.n_y());
    if (!evaluate(system_, s, eq_, dy)) continue;  // a slot along the way, by chance
    const VectorXd a = eq_.a, v = s.y.segment(n, n);
    VectorXd left = -eq_.f;
    add_mass_times(system_, eq_, a, left);
    add_reaction(eq_, eq_.lambda, left);
    EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-10 * (1 + eq_.f.cwiseAbs().maxCoeff())) << "draw " << k;
    const double h = 1e-5;
    const auto at = [&](double t) {
      State moved = s;
      moved.y.head(n) += t * v + t * t / 2 * a;
      moved.y.segment(n, n) += t * a;
      return slip(moved);
    };
    const double rate = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    EXPECT_NEAR(rate, 0, 1e-7 * (1 + a.cwiseAbs().maxCoeff())) << "draw " << k;
  }
}

// By what the contact itself can do, a change of M⁻¹Jᵀ under the joints, and no more than there is slip.
TEST_P(Sticking, TakesTheSlipOutOfTheSpeeds) {
  Draw draw(12);
  for (int k = 0; k < 8; ++k) {
    State s = pressed(draw);
    pose(system_, s.t, s.y, eq_);
    factor(system_, s.y, eq_);
    if (!eq_.regular) continue;
    speed(system_, s.t, s.y, eq_);
    const VectorXd before = s.y.segment(system_.n(), system_.n());
    const double slid = slip(s);
    remove_slip(system_, s, eq_);
    EXPECT_NEAR(slip(s), 0, 1e-12 * (1 + std::abs(slid)));
    State again = s;
    remove_slip(system_, again, eq_);
    EXPECT_LT((again.y - s.y).cwiseAbs().maxCoeff(), 1e-12 * (1 + before.cwiseAbs().maxCoeff()));
  }
}

// Two discs under one body on one floor, along one line: what holds is shared as the normal forces are; the force that they hold together
// is that of one.
TEST(StickingTogether, IsSharedByWhatEachCanHold) {
  System s;
  s.gravity = {1.5, -9.81};
  s.bodies = {{"box", 2, 0.1}};
  s.markers = {{0, {0, 0}, 0}, {ground, {0, 0}, 0}};
  const Piece left{.radius = 0.02, .centre = {-0.2, -0.1}}, right{.radius = 0.02, .centre = {0.3, -0.1}},
      floor{.normal = M_PI / 2, .half = 5, .straight = true};
  for (const Piece& foot : {left, right}) {
    ContactPair pair{0, 1, {foot, floor}, ImpactLaw{s.contacts.empty() ? 2e5 : 1e5, 1, 0, 0}, Coulomb{0.4, 0.5, 0}};
    pair.profiles = true;
    s.contacts.push_back(pair);
  }
  s.contact_names = {"left", "right"};
  number(s);
  Equations eq(s);
  State state;
  state.y.setZero(s.n_y());
  state.y.head<3>() << 0.4, 0.12 - 1e-4, 0;
  state.impact_rate = {1, 1};
  state.friction = {{0, 0}, {0, 0}};
  VectorXd dy(s.n_y());
  ASSERT_TRUE(evaluate(s, state, eq, dy));
  const ContactEffect &a = eq.contact[0], &b = eq.contact[1];
  ASSERT_GT(a.normal.force, 1.2 * b.normal.force);
  EXPECT_NEAR(a.friction / a.normal.force, b.friction / b.normal.force, 1e-12);
  EXPECT_GT(std::abs(b.friction), 0.1);
  EXPECT_NEAR(eq.a[0] + 0.12 * eq.a[2], 0, 1e-12);
  state.friction = {{0, 0}, {1, 0}};  // one of them slides: the other holds what is left
  ASSERT_TRUE(evaluate(s, state, eq, dy));
  EXPECT_NEAR(b.friction, -0.4 * b.normal.force, 1e-12 * b.normal.force);
}

}  // namespace
}  // namespace pintle::sticking_test
