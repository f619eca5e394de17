// Laws with a stiffness tend to impacts of rigid bodies as it grows, at the order of the time of contact, (m/k)^⅖ v^-⅕: bounces, the end
// of all bounces, and a block that slides into a wall. Judged by closed forms and by an integration of one impact written here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_limit_test {
namespace {

using pintle_scenes::disc, pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::number, pintle_scenes::run,
    pintle_scenes::struck, pintle_scenes::Whole;

constexpr double g = 9.81;

// ---- one impact, by itself --------------------------------------------------------------------

/// Above zero where a free impact with this factor gives back more than e: χ (1 + e) = ln[(1 + χ)/(1 − χ e)].
double surplus(double chi, double e) { return chi * (1 + e) - std::log((1 + chi) / (1 - chi * e)); }
template <class F>
double root(double above, double below, const F& f) {
  for (int i = 0; i < 200; ++i) (f((above + below) / 2) > 0 ? above : below) = (above + below) / 2;
  return above;
}
double delivered(double chi) {
  return root(0, std::min(1.0, 1 / chi), [&](double e) { return surplus(chi, e); });
}
double exact(double e) {
  return root(0, 1 / e, [&](double chi) { return surplus(chi, e); });
}

struct Law {
  const char* name;
  double asked, chi;
};
const std::vector<Law> laws{{"exact", 0.5, exact(0.5)},
                            {"exact", 0.8, exact(0.8)},
                            {"hunt-crossley", 0.5, 3 * (1 - 0.5) / 2},
                            {"flores", 0.7, 8 * (1 - 0.7) / (5 * 0.7)}};

struct Parting {
  double time, speed;  ///< after it began; 0 if it never ends
};
/// Of 1 kg from a depth of 0 at `speed` under f = k δ^1.5 (1 + χ δ̇/max δ̇), pressed on by `load(δ̇)`: Runge and Kutta's steps, some
/// 10⁵ in a contact, after each of which max δ̇ is raised.
template <class Load>
Parting impact(double k, double chi, double speed, const Load& load) {
  constexpr double in_unit_time = 20000;
  const double h = std::pow(k, -0.4) * std::pow(speed, -0.2) / in_unit_time;
  double depth = 0, rate = speed, fastest = speed;
  const auto slope = [&](double d, double v) {
    return load(v) - std::max(0.0, k * std::pow(std::max(d, 0.0), 1.5) * (1 + chi * v / std::max(fastest, v)));
  };
  for (double t = 0; t < 40 * in_unit_time * h; t += h) {
    const double a1 = slope(depth, rate), v2 = rate + h / 2 * a1, a2 = slope(depth + h / 2 * rate, v2), v3 = rate + h / 2 * a2,
                 a3 = slope(depth + h / 2 * v2, v3), v4 = rate + h * a3, a4 = slope(depth + h * v3, v4);
    const double next = depth + h / 6 * (rate + 2 * v2 + 2 * v3 + v4);
    if (next <= 0) {
      const double left = 2 * depth / (-rate + std::sqrt(rate * rate - 2 * a1 * depth));  // depth + rate t + a1 t²/2 = 0
      return {t + left, -(rate + left * a1)};
    }
    depth = next, rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), fastest = std::max(fastest, rate);
  }
  return {0, 0};
}

// ---- a ball bounces until it rests ------------------------------------------------------------

constexpr double height = 0.5, tolerance = 1e-10;
const double fall = std::sqrt(2 * height / g);

/// When its impacts begin; the last is the one that it stays in.
std::vector<double> begins(double k, double chi) {
  const auto weight = [](double) { return g; };
  std::vector<double> out{fall};
  for (Parting p = impact(k, chi, g * fall, weight); p.speed > 0; p = impact(k, chi, p.speed, weight))
    out.push_back(out.back() + p.time + 2 * p.speed / g);
  return out;
}
Whole bounces(double k, const Law& law, double until) {
  const std::string asks = law.chi > 0 ? "restitution: " + number(law.asked) + ", " : "";
  return run(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n  foot: {between: [ball.rim, ground.floor], normal: {" + law.name +
             ": {" + asks + "stiffness: " + number(k) + "}}}\nstart: {ball: {at: [0, " + number(0.1 + height) + "]}}\nrun: {until: " +
             number(until) + ", tolerance: " + number(tolerance) + "}\noutput: {every: " + number(until) + ", frames: 0}\n");
}
/// √(2h/g) (1 + e)/(1 − e), where bounces of a rigid ball end.
double end_of_all(double e) { return fall * (1 + e) / (1 - e); }
/// How long the ball takes for its impact over how long it takes to come back, at its first one: what a limit is wrong by beside 1.
double small(double k) { return std::pow(k, -0.4) * std::pow(g * fall, -1.2) * g; }
double order(double at_k, double at_more, double more) { return std::log(at_k / at_more) / std::log(more); }

// Each step may err by the tolerance of a speed, which moves what follows by that part of the time that is left.
TEST(RigidLimit, ABallBouncesAsItsLawSaysUntilItRests) {
  for (const Law& law : laws)
    for (const double k : {1e5, 1e7, 1e9}) {
      SCOPED_TRACE(std::string(law.name) + " " + number(law.asked) + ", k = " + number(k));
      const double end = end_of_all(delivered(law.chi));
      const std::vector<double> expected = begins(k, law.chi);
      const Whole w = bounces(k, law, 1.2 * end);
      expect_sound(w);
      const std::vector<Impact>& all = w.run.impacts;
      ASSERT_EQ(all.size(), expected.size());
      for (std::size_t n = 0; n < all.size(); ++n)
        EXPECT_NEAR(all[n].begin, expected[n], tolerance * static_cast<double>(w.run.counts.steps) * end) << n;
      EXPECT_TRUE(std::isnan(all.back().end));
    }
}

// Without loss each impact takes τ = 2.943 (5/4)^⅖ (m/k)^⅖ v^-⅕, and nothing else is late.
TEST(RigidLimit, ABallWithoutLossIsLateByItsTimesOfContact) {
  for (const double k : {1e7, 1e10}) {
    const double v = g * fall, lasts = 2.9432750 * std::pow(1.25 / k, 0.4) * std::pow(v, -0.2);
    const Whole w = bounces(k, {"hertz", 1, 0}, 12 * fall);
    expect_sound(w);
    ASSERT_GE(w.run.impacts.size(), 6u);
    for (std::size_t n = 1; n < 6; ++n) {
      const double late = w.run.impacts[n].begin - fall * static_cast<double>(2 * n + 1);
      EXPECT_NEAR(late / (static_cast<double>(n) * lasts), 1, small(k)) << k << ", " << n;
    }
  }
}

// The third impact comes late by three times of contact and by what the weight takes from two restitutions: all of order (m/k)^⅖.
TEST(RigidLimit, BouncesTendToThoseOfRigidBodiesAsTimesOfContact) {
  constexpr double k = 1e7, more = 1000;
  for (const Law& law : laws) {
    const double e = delivered(law.chi), rigid = fall * (1 + 2 * e + 2 * e * e);
    const auto late = [&](double stiffness) { return bounces(stiffness, law, 1.01 * rigid).run.impacts.at(2).begin - rigid; };
    EXPECT_NEAR(order(late(k), late(k * more), more), 0.4, 5 * small(k) / std::log(more)) << law.name;
  }
}

// The last impacts take longest: those at v ~ g^⅚ (m/k)^⅓, from which the ball does not come up again. So it rests A (m/k)^⅓ + B (m/k)^⅖
// from where rigid bounces end, A the same for stiffnesses that differ by e⁻³ to some power: then the last impacts are at like speeds.
TEST(RigidLimit, ABallRestsWhereBouncesOfRigidBodiesEnd) {
  constexpr double k = 1e5;
  for (const Law& law : laws) {
    const double e = delivered(law.chi), end = end_of_all(e), more = std::pow(e, -3 * std::round(std::log(0.01) / (3 * std::log(e))));
    double off[3];
    for (int i = 0; i < 3; ++i) off[i] = bounces(k * std::pow(more, i), law, 1.2 * end).run.impacts.back().begin - end;
    const double a = std::pow(more, -1.0 / 3), b = std::pow(more, -0.4);
    EXPECT_NEAR(((a + b) * off[1] - a * b * off[0]) / off[2], 1, small(k)) << law.name;
  }
}

// ---- a block slides into a wall ---------------------------------------------------------------

constexpr double mu = 0.3, way = 0.9, begins_at = 3;
Whole slide(const std::string& wall) {
  return run(
      "gravity: [0, -9.81]\nground: {profiles: {floor: {path: [[-50, 0], [50, 0]], material: right}, wall: {path: [[1, -1], [1, 1]], "
      "material: right}}}\n"
      "bodies: {box: {rigid: {mass: 2 kg, inertia: 0.02}, profiles: {sides: {path: [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, "
      "0.1]], closed: true}}}}\ncontacts:\n" +
      struck("foot", "box.sides", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: " + number(mu) + "}}") +
      "  wall: {between: [box.sides, ground.wall], " + wall + "}\nstart: {box: {at: [0, 0.1], velocity: [" + number(begins_at) +
      ", 0]}}\nrun: {until: 2, tolerance: " + number(tolerance) + "}\noutput: {every: 0.1, frames: 0}\n");
}

// It comes to the wall at v, leaves it at e v and stops e² v²/(2 μ g) before it.
TEST(RigidLimit, ABlockThatSlidesIntoAWallStopsWhereARigidOneDoes) {
  const double v = std::sqrt(begins_at * begins_at - 2 * mu * g * way);
  const auto stops = [&](double speed) { return way - speed * speed / (2 * mu * g); };
  for (const Law& law : laws) {
    SCOPED_TRACE(law.name);
    const double e = delivered(law.chi);
    const Whole rigid = slide("model: impact, restitution: " + number(e));
    expect_sound(rigid);
    EXPECT_NEAR(rigid.last("box.x [m]"), stops(e * v), 1e-10);
    const auto rests = [&](double k) {
      const Whole w =
          slide(std::string("normal: {") + law.name + ": {restitution: " + number(law.asked) + ", stiffness: " + number(k) + "}}");
      expect_sound(w);
      const Parting p = impact(2 * k / 2, law.chi, v, [](double rate) { return rate > 0 ? -mu * g : mu * g; });  // two corners, 2 kg
      EXPECT_NEAR(w.last("box.x [m]"), stops(p.speed), tolerance * static_cast<double>(w.run.counts.steps)) << k;
      EXPECT_NEAR(w.last("box.angle [rad]"), 0, 1e-9);
      return w.last("box.x [m]");
    };
    const double k = 1e7, more = 1000, off = rests(k) - stops(e * v), less = rests(k * more) - stops(e * v);
    EXPECT_NEAR(order(off, less, more), 0.4, 5 * small(k) / std::log(more));
  }
}

}  // namespace
}  // namespace pintle::rigid_limit_test
