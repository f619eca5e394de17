// Impacts of rigid bodies against closed forms: discs that bounce, slip and lie on each other, a block that rocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_impact_test {
namespace {

using pintle_scenes::at, pintle_scenes::disc, pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::impacts,
    pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number, pintle_scenes::run, pintle_scenes::run_for, pintle_scenes::struck,
    pintle_scenes::struck_by, pintle_scenes::Whole;

constexpr double g = 9.81, r = 0.1, J = 0.005;

// How far from the closed form rounding takes the begin of an impact at this speed, after so many flights: each flight is integrated
// exactly but for the last digits of its steps and their weights, and the floor is met to some last digits of a metre, which moves the
// later bounces by 1/(1 − e) of that as well.
double rounding(double t, std::size_t flights, double speed, double e = 0) {
  constexpr double flight = 1e-13, place = 4e-15;
  return flight * static_cast<double>(flights) * t + place / speed * (1 + 1 / (1 - e));
}

class RigidImpact : public testing::TestWithParam<Method> {
 protected:
  Whole run_it(const std::string& text) const { return run(text, GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(All, RigidImpact, testing::ValuesIn(struck_by), name_of);

std::string ball(double height, const std::string& laws, const std::string& speed, double until, double every) {
  return floor_under() + "bodies:\n" + disc("ball") + "contacts:\n" + struck("foot", "ball.rim", "ground.floor", laws) +
         "start: {ball: {at: [0, " + number(r + height) + "], velocity: [" + speed + "]}}\n" + run_for(until, every);
}

// ---- it bounces -------------------------------------------------------------------------------

TEST_P(RigidImpact, ADiscComesToRestAfterInfinitelyManyBounces) {
  for (const double e : {0.8, 0.5, 0.99}) {
    SCOPED_TRACE(e);
    const double h = 1, fall = std::sqrt(2 * h / g), end = fall * (1 + e) / (1 - e);
    const Whole w = run_it(ball(h, "restitution: " + number(e), "0, 0", end + 1, 0.1));
    expect_sound(w);
    const std::vector<Impact>& all = w.run.impacts;
    double t = fall, v = g * fall;
    std::size_t n = 0;
    for (; n < all.size() && v > 1e-3; ++n, t += 2 * v / g) {
      const double fine = rounding(t, n + 1, v, e);
      ASSERT_NEAR(all[n].begin, t, fine) << n;
      ASSERT_EQ(all[n].end, all[n].begin) << n;
      ASSERT_NEAR(all[n].approach, v, g * fine) << n;
      ASSERT_NEAR(all[n].separation, e * all[n].approach, 1e-14 * v) << n;
      ASSERT_NEAR(all[n].impulse, (1 + e) * all[n].approach, 1e-14 * v) << n;
      v *= e;
    }
    EXPECT_LE(v, 1e-3);
    EXPECT_NEAR(all.back().begin, end, 1e-9 * end);
    EXPECT_TRUE(std::isnan(all.back().end));
    EXPECT_NEAR(w.last("foot.normal [N]"), g, 1e-12 * g);
    EXPECT_NEAR(w.last("ball.y [m]"), r, 1e-12);
    EXPECT_NEAR(w.last("ball.vy [m/s]"), 0, 1e-12);
    EXPECT_NEAR(w.ledger("foot.lost to hysteresis [J]"), g * h, 1e-10 * g * h);
  }
}

TEST_P(RigidImpact, WithoutLossADiscBouncesForEver) {
  const double h = 0.5, fall = std::sqrt(2 * h / g);
  const Whole w = run_it(ball(h, "restitution: 1", "0, 0", 100 * fall, fall));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 49u);
  for (std::size_t n = 0; n < 49; ++n)
    ASSERT_NEAR(w.run.impacts[n].begin, fall * static_cast<double>(2 * n + 1), rounding(100 * fall, n + 1, g * fall)) << n;
  EXPECT_EQ(w.ledger("foot.lost to hysteresis [J]"), 0);
}

TEST_P(RigidImpact, WithoutRestitutionADiscStaysDown) {
  const double h = 0.5, fall = std::sqrt(2 * h / g);
  const Whole w = run_it(ball(h, "restitution: 0", "1, 0", 1, 0.1));
  expect_sound(w);
  ASSERT_EQ(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, fall, rounding(fall, 1, g * fall));
  EXPECT_NEAR(w.run.impacts[0].impulse, g * fall, 1e-12);
  EXPECT_NEAR(w.last("ball.x [m]"), 1, 1e-12);  // no friction
  EXPECT_NEAR(w.last("foot.normal [N]"), g, 1e-12 * g);
}

// ---- it slips ---------------------------------------------------------------------------------

struct Flight {
  double vx, w;
};
// After each impact, of restitution 0.6 and friction 0.2: T = −v_T m/3 where that is held.
std::vector<Flight> flights(double vx, double fall, int count) {
  std::vector<Flight> out;
  Flight now{vx, 0};
  double v = g * fall;
  for (int i = 0; i < count; ++i, v *= 0.6) {
    const double slip = now.vx + r * now.w, most = 0.2 * 1.6 * v, T = std::clamp(-slip / 3, -most, most);
    now.vx += T, now.w += r * T / J;
    out.push_back(now);
  }
  return out;
}

TEST_P(RigidImpact, FrictionTurnsADiscUntilItRolls) {
  for (const double vx : {1.0, 5.0}) {
    SCOPED_TRACE(vx);
    const double fall = std::sqrt(2 * 0.5 / g), every = 1e-3, end = 4 * fall;
    const Whole w = run_it(ball(0.5, "restitution: 0.6, friction: {coulomb: {coefficient: 0.2}}", number(vx) + ", 0", 2, every));
    expect_sound(w);
    double t = fall, v = 0.6 * g * fall;
    for (const Flight& f : flights(vx, fall, 5)) {
      const double in_flight = every * std::round((t + v / g) / every);
      EXPECT_NEAR(at(w, "ball.vx [m/s]", in_flight), f.vx, 1e-12 * vx) << t;
      EXPECT_NEAR(at(w, "ball.speed [rad/s]", in_flight), f.w, 1e-12 * vx / r) << t;
      t += 2 * v / g, v *= 0.6;
    }
    const double rolls = 2 * vx / 3;
    EXPECT_NEAR(w.run.impacts.back().begin, end, 1e-9 * end);
    EXPECT_NEAR(w.last("ball.vx [m/s]"), rolls, 1e-12 * vx);
    EXPECT_NEAR(w.last("ball.speed [rad/s]"), -rolls / r, 1e-12 * vx / r);
    EXPECT_NEAR(w.last("foot.friction [N]"), 0, 1e-10);
    EXPECT_NEAR(w.ledger("foot.lost to friction [J]"), vx * vx / 2 - 0.75 * rolls * rolls, 1e-11 * vx * vx);
    EXPECT_NEAR(w.ledger("foot.lost to hysteresis [J]"), g * 0.5, 1e-10);
  }
}
TEST(RigidFriction, OfAFastDiscIsOverAtTheThirdImpact) {  // case of sliding, sliding, sticking
  const std::vector<Flight> f = flights(5, std::sqrt(1 / g), 3);
  EXPECT_NEAR(f[0].vx, 3.99773057514458718, 1e-14);
  EXPECT_NEAR(f[1].w, -32.0726215953732102, 1e-13);
  EXPECT_NEAR(f[2].vx, 10.0 / 3, 1e-14);
}

// A superball gives slip back as it gives back approach: it hops to and fro between two motions, and loses nothing.
TEST_P(RigidImpact, ASuperballReversesItsSlip) {
  const double fall = std::sqrt(2 * 0.5 / g), period = 2 * fall;
  const Whole w =
      run_it(ball(0.5, "restitution: 1, tangential restitution: 1, friction: {coulomb: {coefficient: 10}}", "1, 0", 8 * period, period));
  expect_sound(w);
  for (int n = 1; n <= 8; ++n) {  // at the top of each flight
    const bool turned = n % 2 == 1;
    EXPECT_NEAR(at(w, "ball.vx [m/s]", n * period), turned ? 1.0 / 3 : 1, 1e-12) << n;
    EXPECT_NEAR(at(w, "ball.speed [rad/s]", n * period), turned ? -4 / (3 * r) : 0, 1e-11) << n;
  }
  EXPECT_NEAR(w.ledger("foot.lost to friction [J]"), 0, 1e-13);
}
// Where friction cannot reverse the slip, it slides on.
TEST_P(RigidImpact, TangentialRestitutionIsWithinFriction) {
  const double fall = std::sqrt(2 * 0.5 / g), v = g * fall;
  const Whole w = run_it(
      ball(0.5, "restitution: 0.5, tangential restitution: 1, friction: {coulomb: {coefficient: 0.02}}", "1, 0", 1.5 * fall, fall / 2));
  EXPECT_NEAR(w.last("ball.vx [m/s]"), 1 - 0.02 * 1.5 * v, 1e-13);
}

// ---- discs on each other ----------------------------------------------------------------------

std::string stack(double low, double high, const std::string& of_foot, const std::string& of_pair, double until = 2) {
  return floor_under() + "bodies:\n" + disc("low") + disc("high") + "contacts:\n" + struck("foot", "low.rim", "ground.floor", of_foot) +
         struck("pair", "low.rim", "high.rim", of_pair) + "start:\n  low: {at: [0, " + number(low) + "]}\n  high: {at: [0, " +
         number(high) + "]}\n" + run_for(until, 0.01);
}
const std::string half = "restitution: 0.5";

TEST_P(RigidImpact, ADiscBouncesOnOneThatLies) {
  const double fall = std::sqrt(2 / g), v = g * fall, end = 3 * fall;
  const Whole w = run_it(stack(r, 3 * r + 1, half, half));
  expect_sound(w);
  const std::vector<Impact> pair = impacts(w, "pair"), foot = impacts(w, "foot");
  ASSERT_GE(pair.size(), 10u);
  EXPECT_NEAR(pair[0].begin, fall, rounding(fall, 1, v));
  EXPECT_NEAR(pair[0].separation, v / 2, 1e-12);
  EXPECT_NEAR(pair[0].impulse, 1.5 * v, 1e-12);
  EXPECT_NEAR(at(w, "low.vy [m/s]", 0.46), 0, 1e-12);
  EXPECT_NEAR(at(w, "high.vy [m/s]", 0.46), v / 2 - g * (0.46 - fall), 1e-12);
  EXPECT_NEAR(pair.back().begin, end, 1e-9 * end);
  ASSERT_EQ(foot.size(), 1u);                 // which stays closed
  EXPECT_NEAR(foot[0].impulse, 3 * v, 1e-4);  // 1.5 v Σ e^n, but for the last, which are forces
  EXPECT_NEAR(w.last("pair.normal [N]"), g, 1e-11 * g);
  EXPECT_NEAR(w.last("foot.normal [N]"), 2 * g, 1e-11 * g);
  EXPECT_NEAR(w.last("low.y [m]"), r, 1e-12);
  EXPECT_NEAR(w.last("high.y [m]"), 3 * r, 1e-12);
}

// Falling together they bounce together: the floor takes the impulse of both, the upper one that of one.
TEST_P(RigidImpact, TwoDiscsThatTouchFallAsOne) {
  const double fall = std::sqrt(2 / g), v = g * fall, end = 3 * fall;
  const Whole w = run_it(stack(r + 1, 3 * r + 1, half, half));
  expect_sound(w);
  const std::vector<Impact> foot = impacts(w, "foot");
  ASSERT_GE(foot.size(), 10u);
  EXPECT_NEAR(foot[0].begin, fall, rounding(fall, 1, v));
  EXPECT_NEAR(foot[0].impulse, 3 * v, 1e-12);
  for (const char* disc : {"low", "high"})
    EXPECT_NEAR(at(w, disc + std::string(".vy [m/s]"), 0.46), v / 2 - g * (0.46 - fall), 1e-12) << disc;
  EXPECT_NEAR(foot.back().begin, end, 1e-9 * end);
  EXPECT_NEAR(w.last("high.y [m]") - w.last("low.y [m]"), 2 * r, 1e-12);
  EXPECT_NEAR(w.last("foot.normal [N]"), 2 * g, 1e-11 * g);
}

// ---- a block that rocks -----------------------------------------------------------------------

// 0.2 m × 0.6 m, released at 5°; times and speeds by quadrature, and r = 1 − ¾·2 sin² α of Housner (1963).
TEST_P(RigidImpact, ABlockRocksAsHousnerSays) {
  const double angle = -5 * M_PI / 180, c = std::cos(angle), s = -std::sin(angle);
  const Whole w = run_it(floor_under() + "bodies: {block: {rigid: {mass: 1 kg, inertia: " + number(0.1 / 3) +
                         "}, profiles: {sides: {path: [[-0.1, -0.3], [0.1, -0.3], [0.1, 0.3], [-0.1, 0.3]], closed: true}}}}\ncontacts:\n" +
                         struck("foot", "block.sides", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: 2}}") +
                         "start: {block: {at: [" + number(0.3 * s - 0.1 * c + 0.1) + ", " + number(0.3 * c + 0.1 * s) +
                         "], angle: -5 deg}}\n" + run_for(4, 0.05));
  expect_sound(w);
  const double times[] = {0.174640603821287687, 0.452513392390458607, 0.67918862162897798,
                          0.866725482599959197, 1.02323543567883175,  1.15459088451610025};
  ASSERT_GE(w.run.impacts.size(), 7u);
  double speed = 1.05570436287433072;
  for (std::size_t n = 0; n < 6; ++n, speed *= 0.85) {
    const Impact& i = w.run.impacts[n + 1];  // the first is the corner that it starts on
    EXPECT_NEAR(i.begin, times[n], GetParam().near) << n;
    EXPECT_NEAR(i.approach / 0.2, speed, GetParam().near) << n;
  }
  EXPECT_NEAR(at(w, "block.speed [rad/s]", 0.2), 0.7167151369358576, GetParam().near);
  EXPECT_NEAR(w.last("block.angle [rad]"), 0, 1e-12);  // in the end it stands
  EXPECT_NEAR(w.last("foot.normal [N]"), g, 1e-10 * g);
}

// ---- restitution of impulses ------------------------------------------------------------------

TEST_P(RigidImpact, OfOneContactNewtonAndPoissonSayTheSame) {
  constexpr double rounding = 4e-16;  // of the height, which shifts an impact by itself over the speed [m]
  for (const std::string friction : {"", ", friction: {coulomb: {coefficient: 0.2}}"}) {
    const std::string laws = "restitution: 0.6" + friction, speed = friction.empty() ? "0, 0" : "0.1, 0";
    const Whole newton = run_it(ball(0.5, laws, speed, 2, 0.1)),
                poisson = run_it(ball(0.5, laws + ", restitution law: poisson", speed, 2, 0.1));
    expect_sound(poisson);
    ASSERT_EQ(newton.run.impacts.size(), poisson.run.impacts.size());
    for (std::size_t i = 0; i + 1 < newton.run.impacts.size(); ++i) {
      const double separation = newton.run.impacts[i].separation;
      EXPECT_NEAR(separation, poisson.run.impacts[i].separation, 1e-11 + g * rounding / separation) << i;
    }
  }
}

// A bar, 1 kg, J = ½ m a², falls on feet at ±a that have e = 0.5 and 0.6. Newton: they part at 0.5 v and 0.6 v. Poisson: each foot has
// taken ½ m v, gives back e of that; the centre rises at 0.55 v, the bar turns at ω a = a² (0.6 − 0.5) ½ m v/J = 0.1 v.
TEST_P(RigidImpact, OfTwoContactsAtOnceNewtonAndPoissonDiffer) {
  const double h = 0.5, v = std::sqrt(2 * g * h);
  for (const bool poisson : {false, true}) {
    const std::string law = poisson ? ", restitution law: poisson" : "";
    const Whole w = run_it(
        floor_under() +
        "bodies: {bar: {rigid: {mass: 1, inertia: 0.02}, profiles: {left: {disc: [-0.2, 0], radius: 0.05}, right: {disc: [0.2, 0], radius: "
        "0.05}}}}\ncontacts:\n" +
        struck("left", "bar.left", "ground.floor", "restitution: 0.5" + law) +
        struck("right", "bar.right", "ground.floor", "restitution: 0.6" + law) + "start: {bar: {at: [0, 0.55]}}\n" + run_for(0.33, 0.01));
    expect_sound(w);
    ASSERT_EQ(w.run.impacts.size(), 2u);
    EXPECT_NEAR(impacts(w, "left")[0].separation, (poisson ? 0.45 : 0.5) * v, 1e-12);
    EXPECT_NEAR(impacts(w, "right")[0].separation, (poisson ? 0.65 : 0.6) * v, 1e-12);
    EXPECT_NEAR(impacts(w, "left")[0].impulse, (poisson ? 0.75 : 0.7625) * v, 1e-12);
  }
}

// One disc falls on another that lies, e = 0.8 under it, 0.5 between. In compression both contacts take m v. Newton: the lower one stays,
// for it did not come near the floor. Poisson: the floor gives 0.8 m v back, of which the upper disc needs 0.5.
TEST_P(RigidImpact, OnlyPoissonPassesAnImpulseOn) {
  const double fall = std::sqrt(2 / g), v = g * fall, t = 0.46;
  for (const bool poisson : {false, true}) {
    const std::string law = poisson ? ", restitution law: poisson" : "";
    const Whole w = run_it(stack(r, 3 * r + 1, "restitution: 0.8" + law, "restitution: 0.5" + law, t));
    expect_sound(w);
    const double falls = g * (t - fall);
    EXPECT_NEAR(w.last("high.vy [m/s]"), 0.5 * v - falls, 1e-12);
    EXPECT_NEAR(w.last("low.vy [m/s]"), poisson ? 0.3 * v - falls : 0, 1e-12);
  }
}

}  // namespace
}  // namespace pintle::rigid_impact_test
