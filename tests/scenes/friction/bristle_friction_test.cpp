// Friction by bristles in whole runs, of contacts and in joints: against closed forms and integrations of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "tests/contracts/scheme_cases.h"
#include "tests/scenes/friction/friction_scenes.h"

namespace pintle::bristle_friction_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::number, pintle_scenes::Oscillator, pintle_scenes::run,
    pintle_scenes::Whole;

const std::array methods{Method{"Dopri5", "dopri5", 1e-8, 1e-6}, Method{"Rkf45", "rkf45", 1e-8, 1e-6},
                         Method{"Verner87", "verner87", 1e-8, 1e-6}, Method{"GeneralizedAlpha", "generalized-alpha", 1e-8, 1e-4}};

class Bristles : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(By, Bristles, testing::ValuesIn(methods), pintle_scenes::name_of);

constexpr double g = 9.81;

// A slider on a guide that presses it by 10 N, drawn by a driver at v.
std::string drawn(const std::string& friction, double v, double until) {
  return "bodies: {slider: {rigid: {mass: 1, inertia: 1e-3}}}\nground: {points: {S: [-1, 0]}}\n"
         "joints: {guide: {prismatic: [ground, slider], friction: {" +
         friction +
         ", length: 0.1, preload: 10 N}}}\n"
         "drivers: {motor: {distance: [ground.S, slider], law: 1 m + " +
         number(v) + " m/s*t}}\nrun: {until: " + number(until) + "}\noutput: {every: " + number(until / 100) + "}\n";
}

// The same of two profiles: a shoe on a belt that the driver draws away under it.
std::string drawn_belt(const std::string& friction, double v, double until) {
  constexpr double stiffness = 1e9, radius = 0.02;
  const double y = radius - std::pow(10 / stiffness, 2.0 / 3);
  return "bodies:\n  slider: {rigid: {mass: 1, inertia: 1e-3}, profiles: {shoe: {disc: [0, 0], radius: 20 mm}}}\n"
         "  belt: {rigid: {mass: 1, inertia: 1}, profiles: {face: {path: [[50, 0], [-50, 0]]}}}\n"
         "ground: {points: {G: [0, " +
         number(y) +
         "], Z: [-100, 0]}}\njoints: {hold: {weld: [ground.G, slider]}, bed: {prismatic: [ground, belt]}}\n"
         "drivers: {motor: {distance: [ground.Z, belt], law: 100 m + " +
         number(v) + " m/s*t}}\ncontacts: {guide: {between: [slider.shoe, belt.face], normal: {hertz: {stiffness: 1e9}}, friction: {" +
         friction + "}}}\nrun: {until: " + number(until) + "}\noutput: {every: " + number(until / 100) + "}\n";
}

// Bent so slowly that g = μ_s: σ0 z = μ_s (1 − exp(−σ0 x/μ_s)). Of v/v_s = 0.01, g is μ_s less 1e-4 of what is between.
TEST_P(Bristles, BendAsTheWayIsGoneUntilTheyGiveWay) {
  constexpr double holds = 0.4, stiffness = 1e5, v = 1e-5;
  for (const auto& scene : {drawn, drawn_belt}) {
    const Whole w =
        run(scene("lugre: {coefficient: 0.3, static: 0.4, bristle stiffness: 1e5 1/m, bristle damping: 0 s/m}", v, 2.5), GetParam());
    expect_sound(w, 1e-15);
    const auto t = w.column("t [s]"), f = w.column("guide.friction [N]"), z = w.column("guide.bristle [m]");
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double deflection = -holds / stiffness * std::expm1(-stiffness * v * t[i] / holds);
      ASSERT_NEAR(std::abs(z[i]), deflection, (1e-4 + GetParam().near) * holds / stiffness) << t[i];
      ASSERT_NEAR(std::abs(f[i]), 10 * stiffness * deflection, (1e-4 + GetParam().near) * 10 * holds) << t[i];
    }
  }
}

TEST_P(Bristles, SlideSteadilyAlongStribecksCurve) {
  for (const auto& scene : {drawn, drawn_belt})
    for (const double v : {2e-3, 8e-3, 0.05}) {
      const Whole w = run(scene("lugre: {coefficient: 0.2, static: 0.5, stribeck speed: 8 mm/s, bristle stiffness: 1e4 1/m, viscous: 0.7 "
                                "s/m}",
                                v, 0.06 / std::sqrt(v)),
                          GetParam());
      expect_sound(w, 1e-15);
      const double curve = 0.2 + 0.3 * std::exp(-std::pow(v / 8e-3, 2)) + 0.7 * v;
      EXPECT_NEAR(std::abs(w.last("guide.friction [N]")), 10 * curve, 10 * curve * (GetParam().near + std::exp(-60 * std::sqrt(v))));
    }
}

// What has rested for t gives way at μ + (μ_s − μ)(1 − exp(−t/τ)); drawn at v/v_s = 0.01 from the start.
TEST_P(Bristles, HoldMoreWhatHasRestedLonger) {
  for (const auto& scene : {drawn, drawn_belt}) {
    const Whole w =
        run(scene("gonthier: {coefficient: 0.2, static: 0.5, bristle stiffness: 1e5 1/m, dwell time: 2 s}", 1e-5, 5), GetParam());
    expect_sound(w, 1e-15);
    const auto t = w.column("t [s]"), f = w.column("guide.friction [N]"), d = w.column("guide.dwell [-]");
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double rested = -std::expm1(-t[i] / 2), holds = 0.2 + 0.3 * rested, bends = 1e5 * 1e-5 * t[i];
      ASSERT_NEAR(d[i], rested, 2e-4 + GetParam().near);
      if (std::abs(bends - holds) > 0.01) {
        ASSERT_NEAR(std::abs(f[i]), 10 * std::min(bends, holds), 10 * (1e-2 + GetParam().near)) << t[i];
      }
    }
  }
}

// The stick–slip oscillator of Canudas de Wit et al. (1995), Fig. 7: m = 1, k = 2, σ0 = 1e5, σ1 = √1e5, σ2 = 0.4, F_C = 1, F_S = 1.5,
// v_s = 0.001, drawn at 0.1 m/s; seen from the point that draws it.
TEST_P(Bristles, StickAndSlipAsThePaperOf1995) {
  constexpr double k = 2, s0 = 1e5, s2 = 0.4, V = 0.1, until = 20;
  const double s1 = std::sqrt(s0);
  std::string text = Oscillator{.N = 1,
                                .k = k,
                                .V = V,
                                .until = until,
                                .law =
                                    "lugre: {coefficient: 1, static: 1.5, stribeck speed: 1 mm/s, bristle stiffness: 1e5, bristle "
                                    "damping: 316.22776601683796, damping speed: 1e9, viscous: 0.4}"}
                         .text();
  text.replace(text.find("every: 1 ms"), 11, "every: 0.1");
  const Whole w = run(text, GetParam());
  expect_sound(w);
  std::array<double, 3> y{0, V, 0};  // place, speed, deflection
  const auto rate = [&](const std::array<double, 3>& at) {
    const double v = at[1] - V, curve = 1 + 0.5 * std::exp(-std::pow(v / 1e-3, 2)), bends = v - s0 * std::abs(v) / curve * at[2];
    return std::array{at[1], -k * at[0] - s0 * at[2] - s1 * bends - s2 * v, bends};
  };
  const auto x = w.column("slider.x [m]"), t = w.column("t [s]");
  constexpr double h = 2e-5;
  const auto along = [](const std::array<double, 3>& from, double by, const std::array<double, 3>& d) {
    return std::array{from[0] + by * d[0], from[1] + by * d[1], from[2] + by * d[2]};
  };
  long step = 0;
  double least = 1, most = -1;
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (; static_cast<double>(step) * h < t[i] - h / 2; ++step) {
      const auto a = rate(y), b = rate(along(y, h / 2, a)), c = rate(along(y, h / 2, b)), d = rate(along(y, h, c));
      for (std::size_t j = 0; j < 3; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    }
    ASSERT_NEAR(x[i], y[0], 1e-3) << t[i];
    if (t[i] > 8) least = std::min(least, x[i]), most = std::max(most, x[i]);
  }
  EXPECT_GT(most - least, 0.3);  // it slips, by some twice (F_S − F_C)/k
}

// A block that runs out: with the stiffness the law tends to Coulomb's, which stops it after v²/2μg.
TEST(LuGreBristles, TendToCoulombsLawAsTheyStiffen) {
  constexpr double mu = 0.3, v = 0.5;
  std::vector<double> soft, off;
  for (const double stiffness : {1e3, 4e3, 1.6e4}) {
    const Whole w =
        run("gravity: [0, -9.81]\nbodies: {block: {rigid: {mass: 1, inertia: 1e-3}}}\n"
            "joints: {guide: {prismatic: [ground, block], friction: {lugre: {coefficient: 0.3, bristle stiffness: " +
                number(stiffness) + "}, length: 1}}}\nstart: {block: {vx: 0.5}}\nrun: {until: 2}\noutput: {every: 0.1}\n",
            Method{"", "verner87", 1e-10, 0});
    expect_sound(w);
    soft.push_back(1 / stiffness);
    off.push_back(std::abs(w.last("block.x [m]") - v * v / (2 * mu * g)));
  }
  EXPECT_NEAR(scheme_cases::slope(soft, off), 1, 0.1);
  EXPECT_LT(off.back(), mu * soft.back());
}

// Stuck under N, the slider is held by N σ0 beside its spring.
TEST(LuGreBristles, LinearizeToTheirStiffnessAndDamping) {
  const Scene s = read_scene_text(
      Oscillator{.V = 0, .law = "lugre: {coefficient: 0.3, bristle stiffness: 1e4, bristle damping: 20}"}.text(), "scene.yaml");
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model));
  ASSERT_TRUE(rest.found) << rest.reason;
  const Linearization lin = linearize(s, model, rest.state);
  EXPECT_NE(std::ranges::find(lin.space.states, "rub.bristle [m]"), lin.space.states.end());
  const double N = 10, stiffness = 400 + N * 1e4, damping = N * 20;  // of 1 kg
  const std::complex<double> root(-damping / 2, std::sqrt(stiffness - damping * damping / 4));
  double nearest = 1e300, zero = 1e300;
  for (const LinearMode& mode : lin.modes)
    nearest = std::min(nearest, std::abs(mode.root - root)), zero = std::min(zero, std::abs(mode.root));
  EXPECT_LT(nearest, 1e-6 * std::abs(root));
  EXPECT_NEAR(zero, 0, 1e-6);
}

// A ball that hops along: each touch begins with straight bristles, and the books close.
TEST_P(Bristles, BeginStraightAtEachTouch) {
  for (const char* law : {"lugre: {coefficient: 0.3, static: 0.4, bristle stiffness: 1e4}",
                          "gonthier: {coefficient: 0.3, static: 0.4, bristle stiffness: 1e4, dwell time: 1 s}"}) {
    const Whole w = run(std::string("gravity: [0, -9.81]\nbodies: {ball: {rigid: {mass: 1, inertia: 4e-4}, profiles: {rim: {disc: [0, 0], "
                                    "radius: 30 mm}}}}\nground: {profiles: {floor: {path: [[20, 0], [-20, 0]]}}}\n"
                                    "contacts: {rub: {between: [ball.rim, ground.floor], normal: {hunt-crossley: {restitution: 0.8, "
                                    "stiffness: 1e7}}, friction: {") +
                            law + "}}}\nstart: {ball: {y: 80 mm, vx: 1}}\nrun: {until: 0.5}\noutput: {every: 1 ms}\n",
                        GetParam());
    expect_sound(w);
    const auto N = w.column("rub.normal [N]"), z = w.column("rub.bristle [m]"), f = w.column("rub.friction [N]");
    bool bent = false;
    for (std::size_t i = 0; i < N.size(); ++i) {
      if (N[i] == 0) {
        ASSERT_EQ(z[i], 0) << i;
      }
      bent = bent || z[i] != 0;
      ASSERT_LE(std::abs(f[i]), 2 * 0.4 * N[i]);
    }
    EXPECT_TRUE(bent);
  }
}

TEST_P(Bristles, GoOnFromASavedStateBitForBit) {
  Scene s = read_scene_text(
      Oscillator{.until = 0.3, .law = "gonthier: {coefficient: 0.2, static: 0.3, bristle stiffness: 1e4, dwell time: 0.1 s}"}.text(),
      "scene.yaml");
  s.run.method = GetParam().words, s.run.tolerance = 1e-6, s.output.states = 0.11;
  const Model model = build(s);
  const Assembly start = assemble(s, model);
  std::vector<SavedState> saved;
  Listeners listeners;
  listeners.state = [&](const SavedState& state) { saved.push_back(state); };
  const pintle::Run whole = simulate(s, model, start, listeners);
  ASSERT_GT(saved.size(), 1u);
  const auto all = whole.trajectory.data, part = simulate(s, model, start, {}, &saved.front()).trajectory.data;
  ASSERT_LT(part.size(), all.size());
  ASSERT_GT(part.size(), 0u);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), all.end() - static_cast<std::ptrdiff_t>(part.size())));
}

// A pendulum whose pin rubs by bristles, pressed by what the pin bears: integrated here.
TEST_P(Bristles, InAPinAreBentUnderWhatItBears) {
  constexpr double m = 2, l = 0.5, J = 0.04, r = 0.03, mu = 0.3, s0 = 1e3, start = 1.2, until = 1.4;
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {bob: {rigid: {mass: 2, inertia: 0.04}, points: {P: [0, 0.5]}}}\n"
          "joints: {pin: {revolute: [ground, bob.P], friction: {lugre: {coefficient: 0.3, bristle stiffness: 1e3, bristle "
          "damping: 0}, radius: 30 mm}}}\nstart: {bob: {angle: 1.2}}\nrun: {until: 1.4}\noutput: {every: 0.1}\n",
          GetParam());
  expect_sound(w);
  const auto rate = [&](const std::array<double, 3>& y) {  // angle, its rate, deflection
    const double v = r * y[1];
    double a = 0;
    for (int i = 0; i < 60; ++i) {  // N of the acceleration that it makes
      const double along = m * (l * y[1] * y[1] + g * std::cos(y[0])), across = m * (l * a + g * std::sin(y[0]));
      a = (-m * g * l * std::sin(y[0]) - r * s0 * y[2] * std::hypot(along, across)) / (J + m * l * l);
    }
    return std::array{y[1], a, v - s0 * std::abs(v) / mu * y[2]};
  };
  std::array<double, 3> y{start, 0, 0};
  const auto along = [](const std::array<double, 3>& from, double by, const std::array<double, 3>& d) {
    return std::array{from[0] + by * d[0], from[1] + by * d[1], from[2] + by * d[2]};
  };
  constexpr double h = 1e-5;
  for (long i = 0; i < std::lround(until / h); ++i) {
    const auto a = rate(y), b = rate(along(y, h / 2, a)), c = rate(along(y, h / 2, b)), d = rate(along(y, h, c));
    for (std::size_t j = 0; j < 3; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
  }
  EXPECT_NEAR(w.last("bob.angle [rad]"), y[0], 10 * GetParam().near);
  EXPECT_NEAR(w.last("pin.bristle [m]"), y[2], 100 * GetParam().near * mu / s0);
}

}  // namespace
}  // namespace pintle::bristle_friction_test
