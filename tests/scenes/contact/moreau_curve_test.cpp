// Steps of one length along curved surfaces: bodies stay on them, and what is lost there is what friction takes, by the second order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::moreau_curve_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::struck, pintle_scenes::Whole;

constexpr double g = 9.81;

std::string run_by(double step, double until, double every) {
  return "run: {until: " + number(until) + ", method: {moreau: {step: " + number(step) + "}}}\noutput: {every: " + number(every) +
         ", frames: 0}\n";
}
double deepest(const Whole& w) {
  double out = 0;
  for (const Impact& i : w.run.impacts) out = std::max(out, i.deepest);
  return out;
}

// ---- round a hollow, of which the disc's centre is 0.5 m from the middle ------------------------

constexpr double radius = 0.5, speed = 2;

std::string in_a_hole(double step, double turns, const std::string& laws) {
  return "ground: {profiles: {hole: {hole: [0, 0], radius: 0.6}}}\nbodies:\n" + pintle_scenes::disc("disc") + "contacts:\n" +
         struck("wall", "disc.rim", "ground.hole", laws) + "start: {disc: {at: [0, -0.5], velocity: [" + number(speed) + ", 0]}}\n" +
         run_by(step, turns * 2 * M_PI * radius / speed, turns * 2 * M_PI * radius / speed / 16);
}

// Each step takes two tangents that meet in its middle, tan α = vh/(2ρ), for an arc: so of the angle a (vh/ρ)²/12 is missing, and the
// chord on which a row in the middle of a step is read lies α² ρ/2 inside. Nothing is lost, and it sinks by what three orders leave.
TEST(MoreauCurve, ADiscGoesRoundInAHollowAtItsSpeed) {
  for (const double e : {0.0, 0.5, 1.0}) {
    SCOPED_TRACE(e);
    std::vector<double> behind;
    for (const double step : {4e-3, 2e-3, 1e-3}) {
      SCOPED_TRACE(step);
      const double turns = 3, a = speed * step / radius;
      const Whole w = run(in_a_hole(step, turns, "restitution: " + number(e)));
      expect_sound(w);
      const auto x = w.column("disc.x [m]"), y = w.column("disc.y [m]"), vx = w.column("disc.vx [m/s]"), vy = w.column("disc.vy [m/s]");
      for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(std::hypot(x[i], y[i]), radius, a * a / 4 * radius) << i;
        EXPECT_NEAR(std::hypot(vx[i], vy[i]), speed, a * a * speed) << i;
      }
      EXPECT_NEAR(w.ledger("wall.lost to hysteresis [J]"), 0, 2 * M_PI * turns * a * a * speed * speed / 2);
      EXPECT_EQ(w.run.impacts.size(), 1u);
      EXPECT_LT(deepest(w), a * a * radius);
      const double angle = std::remainder(std::atan2(x.back(), -y.back()), 2 * M_PI);
      EXPECT_LT(std::abs(angle), 2 * 2 * M_PI * turns * a * a / 12);
      behind.push_back(std::abs(angle));
    }
    EXPECT_NEAR(std::log2(behind[1] / behind[2]), 2, 0.2);
  }
}

// Rolling, its slip is held as its gap is; sliding, friction μ m v²/ρ slows it to v = v₀ e^(−μφ), φ the angle gone.
TEST(MoreauCurve, FrictionInAHollowIsOfItsPressure) {
  const double mu = 0.1, step = 1e-3, phi = std::log(1 + mu * speed / radius * 0.5) / mu;  // after 0.5 s, sliding all the time
  std::string text = in_a_hole(step, 1, "restitution: 0, friction: {coulomb: {coefficient: 0.1}}");
  text = text.substr(0, text.find("run:")) + run_by(step, 0.5, 0.5);
  const Whole w = run(text);
  expect_sound(w);
  const double slow = speed * std::exp(-mu * phi), order = std::pow(step * speed / radius, 2);
  const double angle = std::atan2(w.last("disc.x [m]"), -w.last("disc.y [m]"));
  ASSERT_GT(slow + 0.1 * w.last("disc.speed [rad/s]"), 0);
  EXPECT_NEAR(std::hypot(w.last("disc.vx [m/s]"), w.last("disc.vy [m/s]")), slow, order * speed);
  EXPECT_NEAR(angle, phi, order * phi);
}

// Let go at 60°, frictionless, it is a pendulum: a quarter of its period later it is at the bottom. T = 2π √(L/g)/agm(1, cos 30°).
TEST(MoreauCurve, ADiscSlidesInABowlAsAPendulumSwings) {
  double one = 1, other = std::cos(M_PI / 6);
  for (int i = 0; i < 6; ++i) one = (one + other) / 2, other = std::sqrt((2 * one - other) * other);
  const double quarter = M_PI / 2 * std::sqrt(radius / g) / one, fastest = std::sqrt(2 * g * radius * (1 - std::cos(M_PI / 3)));
  std::vector<double> late, gained;
  for (const int steps : {100, 200, 400}) {
    const double step = quarter / steps, a = fastest * step / radius;
    const Whole w =
        run("gravity: [0, -9.81]\nground: {profiles: {bowl: {hole: [0, 0], radius: 0.6}}}\nbodies:\n" + pintle_scenes::disc("disc") +
            "contacts:\n" + struck("wall", "disc.rim", "ground.bowl", "restitution: 0.5") + "start: {disc: {at: [" +
            number(-radius * std::sin(M_PI / 3)) + ", " + number(-radius * std::cos(M_PI / 3)) + "]}}\n" + run_by(step, quarter, quarter));
    expect_sound(w);
    EXPECT_EQ(w.run.impacts.size(), 1u);
    late.push_back(std::abs(w.last("disc.x [m]")));
    gained.push_back(std::abs(w.last("disc.vx [m/s]") - fastest));
    EXPECT_LT(late.back(), a * a * radius);
    EXPECT_LT(gained.back(), a * a * fastest);
    EXPECT_LT(std::abs(w.ledger("wall.lost to hysteresis [J]")), a * a * fastest * fastest / 2);
  }
  EXPECT_GT(std::log2(late[1] / late[2]), 1.8);
  EXPECT_GT(std::log2(gained[1] / gained[2]), 1.8);
}

// ---- over a hump: the disc's centre is 0.5 m from its middle -------------------------------------

// From 0.1 rad beside the top it slides down without friction, and leaves where cos θ = ⅔ cos θ₀.
TEST(MoreauCurve, ADiscLeavesAHumpWhereItsPressureEnds) {
  const double first = 0.1, last = std::acos(2. / 3 * std::cos(first));
  // t = ∫ dθ/√(2 g/L (cos θ₀ − cos θ)); θ = θ₀ + u² takes its root away.
  double t = 0;
  constexpr int parts = 4000;
  const double end = std::sqrt(last - first);
  for (int i = 0; i <= parts; ++i) {
    const double u = end * i / parts, theta = first + u * u;
    const double by_u =
        u > 0 ? 2 * u / std::sqrt(2 * g / radius * (std::cos(first) - std::cos(theta))) : 2 / std::sqrt(2 * g / radius * std::sin(first));
    t += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * by_u * end / parts / 3;
  }
  for (const double step : {1e-3, 2.5e-4}) {
    SCOPED_TRACE(step);
    const Whole w =
        run("gravity: [0, -9.81]\nground: {profiles: {hump: {disc: [0, 0], radius: 0.4}}}\nbodies:\n" + pintle_scenes::disc("disc") +
            "contacts:\n" + struck("wall", "disc.rim", "ground.hump", "restitution: 1") + "start: {disc: {at: [" +
            number(radius * std::sin(first)) + ", " + number(radius * std::cos(first)) + "]}}\n" + run_by(step, 1.1 * t, t / 50));
    expect_sound(w);
    ASSERT_EQ(w.run.impacts.size(), 1u);
    EXPECT_NEAR(w.run.impacts[0].end, t, 3 * step);
    const double v = std::sqrt(2 * g * radius * (std::cos(first) - std::cos(last))), a = v * step / radius;
    EXPECT_LT(std::abs(w.ledger("wall.lost to hysteresis [J]")), a * a * v * v / 2);
  }
}

// ---- a roller on a driven cam -------------------------------------------------------------------

// y = a sin ωt + √((R + r)² − (a cos ωt)²); it is read at ends of steps, between which it may lie off the rim by aω²h²/8.
TEST(MoreauCurve, ARollerFollowsItsCam) {
  const double a = 8e-3, R = 0.03, r = 0.01, omega = 31.41592653589793, turn = 2 * M_PI / omega;
  std::vector<double> worst;
  for (const int steps : {200, 400, 800}) {
    Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/cam_roller.yaml");
    s.contacts[0].impact = SceneImpact{.restitution = 0.5};
    s.contacts[0].friction.reset();
    s.start_bodies[0].y = std::sqrt((R + r) * (R + r) - a * a);
    s.run.method = "moreau", s.run.step = turn / steps, s.run.until = 2 * turn;
    s.output.every = turn / 50, s.output.frames = 0;
    const Whole w = run(s);
    expect_sound(w);
    const auto t = w.column("t [s]"), y = w.column("follower.y [m]");
    double off = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double x = a * std::cos(omega * t[i]);
      off = std::max(off, std::abs(y[i] - a * std::sin(omega * t[i]) - std::sqrt((R + r) * (R + r) - x * x)));
    }
    const double angle = 2 * M_PI / steps;
    EXPECT_LT(off, (a + a * a / (R + r)) * angle * angle) << steps;
    worst.push_back(off);
    EXPECT_EQ(w.run.impacts.size(), 1u) << steps;
    EXPECT_LT(std::abs(w.ledger("rolling.lost to hysteresis [J]")), 0.35 * a * omega * a * omega * angle) << steps;
  }
}

}  // namespace
}  // namespace pintle::moreau_curve_test
