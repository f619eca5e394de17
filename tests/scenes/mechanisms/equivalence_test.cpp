// What must not change the motion, and limits that one description of a mechanism tends to.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "framework/build/clearance.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::equivalence_test {
namespace {

using pintle::JointKind;
using pintle::Status;

// Two runs of the same motion at a tolerance of 1e-12 differ by rounding alone, which a few impacts
// magnify by some 10 each.
constexpr double same = 1e-8;         // of the largest value
constexpr double same_smooth = 1e-9;  // without impacts

SliderCrank striking() {
  return {.clearance = 5e-4, .angle = 0.4, .friction = 0.05, .eccentricity = {1e-4, -2e-4}, .until = 6e-3, .tolerance = 1e-12};
}

std::vector<double> plus(std::vector<double> v, double x) {
  for (double& i : v) i += x;
  return v;
}
std::vector<double> times(std::vector<double> v, double x) {
  for (double& i : v) i *= x;
  return v;
}

void expect_same_impacts(const Whole& a, const Whole& b, double per_time = 1, double per_speed = 1) {
  ASSERT_GE(a.run.impacts.size(), 3u);
  ASSERT_EQ(a.run.impacts.size(), b.run.impacts.size());
  for (std::size_t i = 0; i < a.run.impacts.size(); ++i) {
    const auto &p = a.run.impacts[i], &q = b.run.impacts[i];
    EXPECT_NEAR(p.begin * per_time, q.begin, same * q.begin) << i;
    EXPECT_NEAR(p.approach * per_speed, q.approach, 100 * same * q.approach) << i;
  }
}

// --- invariance ---

TEST(World, ShiftedAndTurnedWithGravityChangesNothing) {
  const double dx = 0.3, dy = -0.7, turn = 2.1, c = std::cos(turn), d = std::sin(turn);
  const pintle::Scene s = scene(striking());
  const Whole a = run(s), b = run(moved(s, dx, dy, turn));
  ASSERT_EQ(b.run.status, Status::finished) << b.run.reason;
  for (const char* name : {"crank.angle [rad]", "coupler.angle [rad]"})
    EXPECT_LT(relative_difference(plus(b.column(name), -turn), a.column(name)), same) << name;
  for (const char* name : {"crank.speed [rad/s]", "coupler.speed [rad/s]", "gudgeon pin.rate [m/s]"})
    EXPECT_LT(relative_difference(b.column(name), a.column(name)), same) << name;
  const auto x = a.column("slider.x [m]"), bx = b.column("slider.x [m]"), by = b.column("slider.y [m]");
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(bx[i], dx + c * x[i], same);
    EXPECT_NEAR(by[i], dy + d * x[i], same);
  }
  expect_same_impacts(b, a);
  EXPECT_NEAR(b.run.last.lost, a.run.last.lost, same * a.run.first.stored());
}

TEST(World, MirroredWithGravityMirrorsTheMotion) {
  const pintle::Scene s = scene(striking());
  const Whole a = run(s), b = run(mirrored(s));
  ASSERT_EQ(b.run.status, Status::finished) << b.run.reason;
  for (const char* name : {"crank.angle [rad]", "coupler.speed [rad/s]", "gudgeon pin.ey [m]"})
    EXPECT_LT(relative_difference(times(b.column(name), -1), a.column(name)), same) << name;
  EXPECT_LT(relative_difference(b.column("slider.x [m]"), a.column("slider.x [m]")), same);
  expect_same_impacts(b, a);
}

TEST(Scene, OrderOfBodiesAndJointsDoesNotMatter) {
  pintle::Scene s = scene(striking());
  const Whole a = run(s);
  std::reverse(s.bodies.begin(), s.bodies.end());
  std::reverse(s.joints.begin(), s.joints.end());
  for (const char* constraints : {"projection", "partitioning"}) {
    s.run.constraints = constraints;
    const Whole b = run(s);
    for (const char* name : {"crank.angle [rad]", "coupler.speed [rad/s]", "slider.vx [m/s]"})
      EXPECT_LT(relative_difference(b.column(name), a.column(name)), 10 * same) << name;
    expect_same_impacts(b, a);
  }
}

TEST(Scene, OrderOfAJointsTwoPointsOnlyTurnsItsForceRound) {
  pintle::Scene s = scene(SliderCrank{.clearance = 0, .tolerance = 1e-12});
  const Whole a = run(s);
  std::swap(s.joints[1].a, s.joints[1].b);
  const Whole b = run(s);
  EXPECT_LT(relative_difference(b.column("slider.x [m]"), a.column("slider.x [m]")), same_smooth);
  EXPECT_LT(relative_difference(times(b.column("crank pin.fx on crank [N]"), -1), a.column("crank pin.fx on coupler [N]")), same_smooth);
}

// Lengths, masses and times measured in other units: every quantity times a power of these three.
TEST(Scene, ScaledInLengthMassAndTimeMovesAlike) {
  const double l = 30, m = 0.02, t = 7;
  pintle::Scene s = scene(striking());
  s.joints[2].clearance->normal.stiffness = pintle::contact_stiffness(*s.joints[2].clearance);
  const Whole a = run(s);
  const auto lengths = [&](pintle::Pair& p) { p[0] *= l, p[1] *= l; };
  for (double& g : s.gravity) g *= l / (t * t);
  for (pintle::SceneBody& b : s.bodies) {
    b.mass *= m, b.inertia *= m * l * l;
    lengths(b.at);
    for (pintle::ScenePoint& p : b.points) lengths(p.at);
  }
  pintle::SceneClearance& c = *s.joints[2].clearance;
  c.radial *= l, c.bearing_radius *= l;
  *c.normal.stiffness *= m / (t * t) / std::sqrt(l);  // N/m^1.5
  c.normal.slowest_impact *= l / t;
  c.friction->v0 *= l / t, c.friction->v1 *= l / t;
  lengths(s.start_journals[0].eccentricity);
  *s.start_bodies[0].speed /= t;
  s.run.until *= t, s.output.every *= t;
  const Whole b = run(s);
  ASSERT_EQ(b.run.status, Status::finished) << b.run.reason;
  const auto check = [&](const char* name, double unit) {
    EXPECT_LT(relative_difference(b.column(name), times(a.column(name), unit)), same) << name;
  };
  check("crank.angle [rad]", 1);
  check("coupler.speed [rad/s]", 1 / t);
  check("slider.x [m]", l);
  check("slider.vx [m/s]", l / t);
  check("crank pin.fx on coupler [N]", m * l / (t * t));
  EXPECT_NEAR(b.run.last.lost, a.run.last.lost * m * l * l / (t * t), same * b.run.first.stored());
  // The run itself is dimensionless: as many steps, but for what rounding decides.
  EXPECT_NEAR(static_cast<double>(b.run.counts.steps), static_cast<double>(a.run.counts.steps),
              0.02 * static_cast<double>(a.run.counts.steps));
}

// --- equivalence ---

TEST(Weld, OfTwoBodiesIsOneBody) {
  // A pendulum of two rods: end to end, turned 0.6 rad to each other.
  const double turn = 0.6, c = std::cos(turn), d = std::sin(turn), m1 = 1, m2 = 0.5, j1 = 0.1, j2 = 0.03;
  pintle::Scene two;
  two.gravity = {0, -9.81};
  two.bodies = {body("rod", m1, j1, {point("P", -0.3), point("end", 0.3)}), body("tip", m2, j2, {point("near", -0.2)})};
  two.bodies[0].at = {0.3, 0};
  two.bodies[1].at = {0.6 + 0.2 * c, 0.2 * d}, two.bodies[1].angle = turn;
  two.joints = {joint("pivot", JointKind::revolute, "ground", "rod.P"), joint("clamp", JointKind::weld, "rod.end", "tip.near")};
  two.joints[1].angle = turn;
  two.start_bodies = {start_angle("rod", 0, 3)};
  two.run.until = 2, two.run.tolerance = 1e-12;

  // The same as one body: centre of mass and inertia about it, in the rod's axes.
  const double x2 = 0.3 + 0.2 * c, y2 = 0.2 * d, m = m1 + m2, x = m2 * x2 / m, y = m2 * y2 / m;
  const double inertia = j1 + j2 + m1 * m2 / m * (x2 * x2 + y2 * y2);
  pintle::Scene one = two;
  one.bodies = {body("rod", m, inertia, {point("P", -0.3)})};
  one.bodies[0].center = {x, y}, one.bodies[0].at = {0.3, 0};
  one.joints.resize(1);

  for (const char* constraints : {"projection", "partitioning"}) {
    one.run.constraints = two.run.constraints = constraints;
    const Whole a = run(two), b = run(one);
    for (const char* name : {"rod.angle [rad]", "rod.speed [rad/s]", "rod.x [m]", "pivot.fx on rod [N]", "pivot.fy on rod [N]"})
      EXPECT_LT(relative_difference(a.column(name), b.column(name)), same_smooth) << name;
  }
}

TEST(SlotWithAngleHeld, IsAPrismaticJoint) {
  for (const double clearance : {0.0, 5e-4}) {
    SliderCrank o = striking();
    o.clearance = clearance;
    pintle::Scene s = scene(o);
    const Whole a = run(s);
    s.joints[3].kind = JointKind::slot;
    s.drivers = {angle_driver("square", "ground.O", "slider.P", law(0))};
    const Whole b = run(s);
    for (const char* name : {"crank.angle [rad]", "coupler.speed [rad/s]", "slider.x [m]"})
      EXPECT_LT(relative_difference(b.column(name), a.column(name)), same) << name;
    EXPECT_LT(relative_difference(b.column("guide.fy on slider [N]"), a.column("guide.fy on slider [N]")), 100 * same);
    EXPECT_EQ(b.ledger("square.work in [J]"), 0);
  }
}

TEST(VeryHeavyBody, CarriesAPinAsTheGroundDoes) {
  // Its share of the motion is the ratio of the masses, 1e-10.
  pintle_oracle::DoublePendulum p;
  p.inertia[0] = 0.1, p.inertia[1] = 0.2, p.gravity = 0;
  pintle::Scene s = double_pendulum(p, {0.3, 1.2, 4, -3});
  s.run.until = 1, s.run.tolerance = 1e-12;
  const Whole a = run(s);
  s.bodies.push_back(body("earth", 1e10, 1e10, {point("P", 0)}));
  s.joints[0].a = ref("earth.P");
  s.start_bodies.push_back(start_at("earth", 0, 0, 0, 0, 0, 0));
  const Whole b = run(s);
  for (const char* name : {"upper.angle [rad]", "lower.speed [rad/s]", "pivot.fx on upper [N]"})
    EXPECT_LT(relative_difference(b.column(name), a.column(name)), same) << name;
}

TEST(Clearance, TendingToZeroTendsToTheIdealPin) {
  const auto crank_and_slider = [](double clearance) {
    return run(scene(SliderCrank{.clearance = clearance, .until = 0.02, .tolerance = 1e-9}));
  };
  const Whole ideal = crank_and_slider(0);
  double speed_before = 1;
  for (const double c : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Whole w = crank_and_slider(c);
    const auto x = w.column("slider.x [m]"), x0 = ideal.column("slider.x [m]");
    // The slider is off by the gap and by what the crank lags: losses go as c, so does the lag.
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(std::abs(x[i] - x0[i]), 5 * c) << c;
    const double speed = relative_difference(w.column("crank.speed [rad/s]"), ideal.column("crank.speed [rad/s]"));
    EXPECT_LT(speed, 0.5 * speed_before) << c;
    speed_before = speed;
  }
  EXPECT_LT(speed_before, 1e-3);
}

}  // namespace
}  // namespace pintle_scenes::equivalence_test
