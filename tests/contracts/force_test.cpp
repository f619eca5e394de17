// The exam every force element sits, and the contact pair with them. A new force joins by one line
// in `kinds`.

#include "framework/dynamics/model/forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/model/contact_pair.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::force_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Tolerances, relative to the size of the terms.
constexpr double rounding = 1e-12;
// Central difference over `step`: 1e-10 cut-off times third derivatives up to 1e2, 1e-11 rounding.
constexpr double difference = 1e-7;
constexpr double step = 1e-5;
constexpr int draws = 200;

struct Kind {
  const char* name;
  Force force;
  bool internal = true;  // acts between its two bodies, so its wrenches cancel
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
const Kind kinds[] = {
    {"PointForce", PointForce{0, 1, sine, steady, false}, false},
    {"FollowerForce", PointForce{0, 1, sine, steady, true}, false},
    {"Torque", Torque{0, 1, sine}},
    {"Spring", Spring{0, 1, 40, 0, 0.5}},
    {"DampedSpring", Spring{0, 1, 40, 3, 0.5}},
    {"Damper", Spring{0, 1, 0, 3, 0.5}},
    {"TorsionSpring", TorsionSpring{0, 1, 25, 0, -0.8}},
    {"DampedTorsionSpring", TorsionSpring{0, 1, 25, 2, -0.8}},
    {"Maxwell", Maxwell{0, 1, 40, 3}},
    {"SizedForce", SizedForce{SizedForce::world, 0, 1, 0, 1}, false},
    {"SizedFollower", SizedForce{SizedForce::follows, 0, 1, 0, 1}, false},
    {"SizedCouple", SizedForce{SizedForce::couple, 0, 1, 1}},
    {"SizedPull", SizedForce{SizedForce::pull, 0, 1, 1}},
    {"Restoring", SizedForce{SizedForce::restoring, 0, 1, 0}},
    {"BeltSpan", BeltSpan{0, 1, 0.1, -0.05, 40, 0, -6}},
    {"DampedBeltSpan", BeltSpan{0, 1, 0.1, -0.05, 40, 3, -6, 1}},
    {"SlackBeltSpan", BeltSpan{0, 1, 0.1, 0.2, 40, 3, 20}},
};
bool is_load(const Force& f) {
  return std::holds_alternative<PointForce>(f) || std::holds_alternative<Torque>(f) || std::holds_alternative<SizedForce>(f);
}
constexpr double sizes[] = {7.3, -4.1};  // of laws

// Two poses whose points are apart: a spring has no direction where they meet.
std::pair<Vector3d, Vector3d> apart(Draw& draw) {
  for (;;) {
    std::pair<Vector3d, Vector3d> p{draw.pose(), draw.pose()};
    if ((p.first - p.second).head<2>().norm() > 0.3) return p;
  }
}

class ForceContract : public testing::TestWithParam<Kind> {
 protected:
  const Force& force_ = GetParam().force;
  Draw draw_{5};
  const int n_x_ = static_cast<int>(internal_states(force_).size());
  const VectorXd x_ = VectorXd::Constant(n_x_, 0.6);
  ForceEffect effect(const Vector3d& a, const Vector3d& b, const Vector3d& da, const Vector3d& db, const VectorXd& x, double t) const {
    return evaluate(force_, moving(a, da), moving(b, db), t, x.data(), sizes);
  }
  ForceEffect at_rest(const Vector3d& a, const Vector3d& b) const { return effect(a, b, {0, 0, 0}, {0, 0, 0}, x_, 0.3); }
  double stored(const Vector3d& a, const Vector3d& b) const { return at_rest(a, b).stored; }
  VectorXd rates(const ForceEffect& e) const { return Eigen::Map<const VectorXd>(e.x_rate.data(), n_x_); }
};

// wrench_a·ṗ_a + wrench_b·ṗ_b = input − dissipation − d(stored)/dt
TEST_P(ForceContract, PowerGoesWhereItSays) {
  for (int n = 0; n < draws; ++n) {
    const auto poses = apart(draw_);
    const Vector3d &a = poses.first, &b = poses.second;
    const Vector3d da = draw_.rates(), db = draw_.rates();
    const ForceEffect e = effect(a, b, da, db, x_, draw_.within(-3, 3));
    const double power = e.on_a.dot(da) + e.on_b.dot(db);
    const auto stored_after = [&](double t) { return effect(a + t * da, b + t * db, {0, 0, 0}, {0, 0, 0}, x_ + t * rates(e), 0.3).stored; };
    const double rate = (stored_after(step) - stored_after(-step)) / (2 * step);
    const double terms = 1 + std::abs(e.input) + e.dissipation + std::abs(rate) + e.stored;
    EXPECT_NEAR(power, e.input - e.dissipation - rate, terms * difference) << "draw " << n;
  }
}

TEST_P(ForceContract, LosesButNeverGains) {
  for (int n = 0; n < draws; ++n) {
    const auto [a, b] = apart(draw_);
    const Vector3d da = draw_.rates(), db = draw_.rates();
    const ForceEffect e = effect(a, b, da, db, x_, draw_.within(-3, 3));
    EXPECT_GE(e.dissipation, 0);
    EXPECT_GE(e.stored, 0);
    if (!is_load(force_)) {
      EXPECT_EQ(e.input, 0);
    }
  }
}

// What remains at rest is −∇(stored), and for a load, which stores nothing, what its law says.
TEST_P(ForceContract, ConservativePartIsTheSlopeOfTheStoredEnergy) {
  for (int n = 0; n < draws; ++n) {
    const auto [a, b] = apart(draw_);
    const ForceEffect e = at_rest(a, b);
    if (is_load(force_)) {
      EXPECT_EQ(e.stored, 0);
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      const Vector3d d = step * Vector3d::Unit(i);
      const double over_a = (stored(a + d, b) - stored(a - d, b)) / (2 * step);
      const double over_b = (stored(a, b + d) - stored(a, b - d)) / (2 * step);
      EXPECT_NEAR(e.on_a[i], -over_a, (1 + e.stored + e.on_a.norm()) * difference);
      EXPECT_NEAR(e.on_b[i], -over_b, (1 + e.stored + e.on_b.norm()) * difference);
    }
  }
}

// Except for what acts from outside: that leaves marker a alone.
TEST_P(ForceContract, ItsTwoWrenchesCancel) {
  for (int n = 0; n < draws; ++n) {
    const auto [a, b] = apart(draw_);
    const Vector3d da = draw_.rates(), db = draw_.rates();
    const ForceEffect e = effect(a, b, da, db, x_, draw_.within(-3, 3));
    if (!GetParam().internal) {
      EXPECT_EQ(e.on_a.norm(), 0);
      continue;
    }
    const double terms = 1 + e.on_a.norm();
    EXPECT_LT((e.on_a + e.on_b).head<2>().norm(), terms * rounding);
    EXPECT_LT(std::abs(moment(a, e.on_a) + moment(b, e.on_b)), 10 * terms * rounding);
  }
}

// ẋ and the wrenches, by differences: internal states in x, in the poses and in their rates.
TEST_P(ForceContract, InternalTangentIsDifferences) {
  if (n_x_ == 0) return;
  for (int n = 0; n < draws; ++n) {
    const auto poses = apart(draw_);
    const Vector3d &a = poses.first, &b = poses.second;
    const Vector3d da = draw_.rates(), db = draw_.rates();
    const InternalTangent ours = internal_tangent(force_, effect(a, b, da, db, x_, 0.3), moving(a, da), moving(b, db));
    const auto slope = [&](int pose, int rate, int x) {  // of [wrenches; ẋ] in component `pose`, `rate` or `x`, −1 for none
      const auto at = [&](double by) {
        Vector3d p[] = {a, b}, v[] = {da, db};
        VectorXd inner = x_;
        if (pose >= 0) p[pose / 3][pose % 3] += by;
        if (rate >= 0) v[rate / 3][rate % 3] += by;
        if (x >= 0) inner[x] += by;
        const ForceEffect e = effect(p[0], p[1], v[0], v[1], inner, 0.3);
        VectorXd out(6 + n_x_);
        out << e.on_a, e.on_b, rates(e);
        return out;
      };
      return VectorXd((at(step) - at(-step)) / (2 * step));
    };
    const double terms = 1 + ours.wrench.norm() + ours.g_pose.norm() + ours.g_x.norm();
    for (int i = 0; i < n_x_; ++i) {
      const VectorXd by_x = slope(-1, -1, i);
      EXPECT_LT((by_x.head(6) - ours.wrench.col(i)).norm(), terms * difference);
      EXPECT_LT((by_x.tail(n_x_) - ours.g_x.col(i)).norm(), terms * difference);
    }
    for (int i = 0; i < 6; ++i) {
      EXPECT_LT((slope(i, -1, -1).tail(n_x_) - ours.g_pose.col(i)).norm(), terms * difference);
      EXPECT_LT((slope(-1, i, -1).tail(n_x_) - ours.g_rate.col(i)).norm(), terms * difference);
    }
  }
}

TEST(PointForce, TurnsWithItsBodyOnlyIfItFollows) {
  const double t = 0.4, turn = 2.1;
  const Vector3d at(0.2, -0.5, 3.0);
  const MarkerMotion still = moving({0, 0, 0}, {0, 0, 0}), b = moving(at, {0, 0, 0}), turned = moving(at + Vector3d(0, 0, turn), {0, 0, 0});
  const Force fixed = PointForce{0, 1, sine, steady, false};
  EXPECT_EQ(evaluate(fixed, still, b, t, nullptr).on_b, Wrench(sine(t).value, steady(t).value, 0));
  EXPECT_EQ(evaluate(fixed, still, turned, t, nullptr).on_b, evaluate(fixed, still, b, t, nullptr).on_b);

  const Force follower = PointForce{0, 1, sine, steady, true};
  const Vector2d law(sine(t).value, steady(t).value);
  const auto along = [&](double angle) -> Vector2d { return Eigen::Rotation2Dd(angle) * law; };
  EXPECT_LT((evaluate(follower, still, b, t, nullptr).on_b.head<2>() - along(at[2])).norm(), rounding);
  EXPECT_LT((evaluate(follower, still, turned, t, nullptr).on_b.head<2>() - along(at[2] + turn)).norm(), rounding);
}

TEST(Spring, OfNoLengthGivesNoForce) {
  const MarkerMotion here = moving({0.1, 0.2, 0}, {1, 2, 3});
  const ForceEffect e = evaluate(Spring{0, 1, 40, 3, 0.5}, here, here, 0, nullptr);
  EXPECT_EQ(e.on_a.norm() + e.on_b.norm() + e.dissipation, 0);
  EXPECT_DOUBLE_EQ(e.stored, 0.5 * 40 * 0.25);
}

// ---- in a system: the power that reaches the bodies, the ground taking none -------------------

// The part of the generalised forces that comes of forces and contacts.
VectorXd applied(const System& system, const State& s, Equations& eq) {
  System bare = system;
  bare.forces.clear();
  bare.contacts.clear();
  number(bare);
  Equations others(bare);
  VectorXd dy(system.n_y()), rest(bare.n_y());
  State same = s;
  same.y = VectorXd::Zero(bare.n_y());
  same.y.head(2 * system.n()) = s.y.head(2 * system.n());
  EXPECT_TRUE(evaluate(system, s, eq, dy));
  EXPECT_TRUE(evaluate(bare, same, others, rest));
  return eq.f - others.f;
}
State after(const System& system, const State& before, double t) {
  State s = before;
  s.y.head(system.n()) += t * s.y.segment(system.n(), system.n());
  Equations eq(system);
  VectorXd dy(system.n_y());
  if (system.n_x() > 0 && evaluate(system, before, eq, dy))
    s.y.segment(system.x_begin(), system.n_x()) += t * dy.segment(system.x_begin(), system.n_x());
  return s;
}

class ForceBetween : public testing::TestWithParam<std::tuple<Kind, Carriers>> {};

TEST_P(ForceBetween, PowerOnTheBodiesGoesWhereItSays) {
  const auto& [kind, carriers] = GetParam();
  System system = two_bodies(carriers);
  system.forces = {kind.force};
  system.force_names = {kind.name};
  for (const double size : sizes) system.laws.push_back({[size](double, const double*, double*) { return size; }, {}});
  number(system);
  Equations eq(system);
  Draw draw(13);
  for (int n = 0; n < draws; ++n) {
    State s = random_state(system, draw, eq);
    s.t = 0.3;
    const auto stored_after = [&](double t) {
      applied(system, after(system, s, t), eq);
      return eq.force[0].stored;
    };
    const double rate = (stored_after(step) - stored_after(-step)) / (2 * step);
    const VectorXd f = applied(system, s, eq);
    const ForceEffect& e = eq.force[0];
    const double terms = 1 + std::abs(e.input) + e.dissipation + std::abs(rate) + e.stored;
    EXPECT_NEAR(f.dot(s.y.segment(system.n(), system.n())), e.input - e.dissipation - rate, terms * difference) << "draw " << n;
  }
}

class ContactBetween : public testing::TestWithParam<Carriers> {};

TEST_P(ContactBetween, PowerOnTheBodiesGoesToStorageHysteresisAndFriction) {
  constexpr double clearance = 0.01, depth = 1e-3, h = 3e-8;
  System system = two_bodies(GetParam());
  system.contacts = {{0, 1, JournalBearing{0.1 - clearance, 0.1}, ImpactLaw{1e6, 1.5, 0.6}, Ambrosio{0.3, 1e-3, 1e-2}}};
  system.contact_names = {"pair"};
  number(system);
  Equations eq(system);
  Draw draw(19);
  for (int n = 0; n < draws; ++n) {
    State s = random_state(system, draw, eq);
    s.impact_rate = {draw.within(0.5, 4)};
    // The body that can move goes to where the two surfaces overlap.
    const double angle = draw.within(-M_PI, M_PI);
    const Vector2d wanted = (clearance + depth) * Vector2d(std::cos(angle), std::sin(angle));
    const Vector2d shift = wanted - (eq.motion[0].r - eq.motion[1].r);
    if (system.markers[0].body != ground)
      s.y.head<2>() += shift;
    else
      s.y.segment<2>(3) -= shift;
    const auto stored_after = [&](double t) {
      applied(system, after(system, s, t), eq);
      return eq.contact[0].normal.stored;
    };
    const double rate = (stored_after(h) - stored_after(-h)) / (2 * h);
    const VectorXd f = applied(system, s, eq);
    const ContactEffect& e = eq.contact[0];
    ASSERT_NEAR(e.gap.depth, depth, rounding);
    const double terms = std::abs(rate) + e.normal.dissipation + std::abs(e.friction_loss) + e.normal.force * std::abs(e.gap.rate);
    // Rates below 10 m/s change the depth by 3e-4 of itself: cut-off 1e-8, rounding of the depth
    // 1e-13 of itself.
    EXPECT_NEAR(f.dot(s.y.segment(system.n(), system.n())), -rate - e.normal.dissipation - e.friction_loss, terms * difference)
        << "draw " << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ForceContract, testing::ValuesIn(kinds), [](const auto& p) { return p.param.name; });
INSTANTIATE_TEST_SUITE_P(Each, ForceBetween, testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(all_carriers())),
                         [](const auto& p) { return std::get<0>(p.param).name + name_of(std::get<1>(p.param)); });
INSTANTIATE_TEST_SUITE_P(Each, ContactBetween, testing::ValuesIn(all_carriers()), [](const auto& p) { return name_of(p.param); });

TEST(ForceContract, EveryKindSitsTheExam) {
  std::vector<std::size_t> seen;
  for (const Kind& kind : kinds) seen.push_back(kind.force.index());
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(seen.size(), std::variant_size_v<Force>);
}

}  // namespace
}  // namespace pintle::force_test
