// Impacts that add energy to a motion: the ledger closes, so a warning has to say it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::impact_gain_test {
namespace {

using pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;

std::string warning_of_gain(const Whole& w) {
  const auto found = std::ranges::find_if(w.run.warnings, [](const std::string& s) { return s.starts_with("impacts added "); });
  return found == w.run.warnings.end() ? "" : *found;
}
double gained(const Whole& w) {
  double out = 0;
  for (const Impact& i : w.run.impacts) out -= std::min(i.lost, 0.0);
  return out;
}

// The double pendulum of Kane (1984), whose tip strikes a rough floor. It sticks: what it gains, by hand.
struct Pendulum {
  double a = 16.8 * std::numbers::pi / 180, b = 27.1 * std::numbers::pi / 180, u = -0.68, v = -0.911, e = 0.563, mu = 0.45;

  std::string scene(const std::string& law, const std::string& method = "dopri5") const {
    return "gravity: [0, 0]\n"
           "ground: {points: {O: [0, 0]}, profiles: {floor: {path: [[-5, -d], [5, -d]], material: right}}}\n"
           "parameters: {d: " +
           number(std::cos(a) + std::cos(b) + 1e-3 + 1e-7) +
           "}\n"
           "bodies:\n"
           "  one: {rigid: {mass: 1 kg, inertia: 1/12}, points: {O: [-0.5, 0], A: [0.5, 0]}}\n"
           "  two: {rigid: {mass: 1 kg, inertia: 1/12}, points: {A: [-0.5, 0]}, profiles: {tip: {disc: [0.5, 0], radius: 1 mm}}}\n"
           "joints: {O: {revolute: [ground.O, one.O]}, A: {revolute: [one.A, two.A]}}\n"
           "contacts: {hit: {between: [two.tip, ground.floor], model: impact, restitution: " +
           number(e) + ", friction: {coulomb: {coefficient: " + number(mu) + "}}" + law +
           "}}\n"
           "start: {one: {angle: " +
           number(a - std::numbers::pi / 2) + ", speed: " + number(u) + "}, two: {angle: " + number(b - std::numbers::pi / 2) +
           ", speed: " + number(v) + "}}\nrun: {until: 2 us, method: " + method + "}\noutput: {every: 1 us, frames: 0}\n";
  }
  double gain() const {
    const double m = 4. / 3, k = std::cos(a - b) / 2, l = 1. / 3, det = m * l - k * k;
    const auto response = [&](double p, double q, double r, double s) { return (l * p * r - k * (p * s + q * r) + m * q * s) / det; };
    const double xa = std::cos(a), xb = std::cos(b) + 1e-3, ya = std::sin(a), yb = std::sin(b);
    const double x = xa * u + xb * v, y = ya * u + yb * v;  // of the lowest point of the tip, 1 mm below its centre, before
    // The impact stops the slip and reverses y: W (along, normal) = (-x, -(1 + e) y).
    const double xx = response(xa, xb, xa, xb), xy = response(xa, xb, ya, yb), yy = response(ya, yb, ya, yb), of_w = xx * yy - xy * xy;
    const double along = (-x * yy + (1 + e) * y * xy) / of_w, normal = (-(1 + e) * y * xx + x * xy) / of_w;
    EXPECT_LT(std::abs(along), mu * normal);
    return normal * y * (1 - e) / 2 + along * x / 2;
  }
};

TEST(ImpactGain, OfNewtonsLawWithFrictionIsSaid) {
  const Pendulum kane;
  const Whole w = run(kane.scene(""));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_GT(kane.gain(), 0);
  EXPECT_NEAR(gained(w), kane.gain(), 1e-5);
  const std::string warning = warning_of_gain(w);
  EXPECT_NE(warning.find("at \"hit\""), std::string::npos) << warning;
  EXPECT_NE(warning.find("restitution law: poisson"), std::string::npos) << warning;
}

TEST(ImpactGain, DoesNotComeByPoissonsLaw) {
  const Whole w = run(Pendulum{}.scene(", restitution law: poisson"));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_FALSE(w.run.impacts.empty());
  EXPECT_EQ(gained(w), 0);
  EXPECT_EQ(warning_of_gain(w), "");
}

// However short the steps.
TEST(ImpactGain, OfNewtonsLawIsNotAnErrorOfTheSteps) {
  for (const char* step : {"{moreau: {step: 0.2 us}}", "{moreau: {step: 0.02 us}}"}) {
    const Whole w = run(Pendulum{}.scene("", step));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_NEAR(gained(w), Pendulum{}.gain(), 1e-4);
    const std::string warning = warning_of_gain(w);
    EXPECT_NE(warning.find("if this does not help: Newton's law"), std::string::npos) << warning;
  }
}

// A rod falls and turns onto discs at its two ends: by Poisson's law energy goes from one contact to the other within the impact, which as a
// whole takes some.
TEST(ImpactGain, IsNotWhatOneContactOfAnImpactGivesToTheOther) {
  const Whole w =
      run("gravity: [0, 0]\n"
          "ground: {profiles: {floor: {path: [[-5, -0.1], [5, -0.1]], material: right}}}\n"
          "bodies: {rod: {rigid: {mass: 1 kg, inertia: 1/12}, profiles: {left: {disc: [-0.5, 0], radius: 0.1 m}, "
          "right: {disc: [0.5, 0], radius: 0.1 m}}}}\n"
          "contacts:\n"
          "  a: {between: [rod.left, ground.floor], model: impact, restitution: 0.3, restitution law: poisson}\n"
          "  b: {between: [rod.right, ground.floor], model: impact, restitution: 0.9, restitution law: poisson}\n"
          "start: {rod: {vy: -0.5, speed: 0.5}}\n"
          "run: {until: 1 ms, method: dopri5}\noutput: {every: 1 ms, frames: 0}\n");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_EQ(w.run.impacts.size(), 2u);
  EXPECT_GT(gained(w), 0.01);
  EXPECT_EQ(w.run.impacts[0].begin, w.run.impacts[1].begin);
  EXPECT_GT(w.run.impacts[0].lost + w.run.impacts[1].lost, 0.05);
  EXPECT_EQ(warning_of_gain(w), "");
}

// A driven eccentric lifts a mass against a stiff spring, without friction: long steps gain what short ones do not.
TEST(ImpactGain, OfLongStepsIsSaidWithTheRemedy) {
  const auto cam = [](const std::string& method) {
    return run(
        "gravity: [0, -9.81]\n"
        "ground: {points: {top: [0, 0.5 m], below: {at: [0, -1 m], angle: 90 deg}, axle: [0, 0]}}\n"
        "bodies:\n"
        "  cam: {rigid: {mass: 2 kg, inertia: 0.01}, profiles: {rim: {disc: [20 mm, 0], radius: 60 mm}}, points: {axle: [0, 0]}}\n"
        "  ball: {points: {c: [0, 0]}, rigid: {mass: 1 kg, inertia: 1e-3}, profiles: {rim: {disc: [0, 0], radius: 10 mm}}}\n"
        "joints: {axle: {revolute: [ground.axle, cam.axle]}, tube: {prismatic: [ground.below, ball], angle: -90 deg}}\n"
        "drivers: {shaft: {angle: [ground, cam], law: 150 rad/s*t}}\n"
        "forces: {s: {spring: [ground.top, ball.c], stiffness: 200 N/mm, free length: 480 mm}}\n"
        "contacts: {hit: {between: [ball.rim, cam.rim], model: impact, restitution: 0.3}}\n"
        "start: {ball: {y: 81 mm, vy: 0}}\n"
        "run: {until: 2 s, method: " +
        method + "}\noutput: {every: 0.1 s, frames: 0}\n");
  };
  const Whole coarse = cam("{moreau: {step: 0.1 ms}}"), fine = cam("{moreau: {step: 0.02 ms}}"), located = cam("dopri5");
  for (const Whole* w : {&coarse, &fine, &located}) ASSERT_EQ(w->run.status, Status::finished) << w->run.reason;
  EXPECT_GT(gained(coarse), 1e-3 * coarse.run.energy_in_play);
  EXPECT_NE(warning_of_gain(coarse).find("shorten moreau.step"), std::string::npos) << warning_of_gain(coarse);
  EXPECT_EQ(warning_of_gain(fine), "");
  EXPECT_EQ(gained(located), 0);
}

}  // namespace
}  // namespace pintle::impact_gain_test
