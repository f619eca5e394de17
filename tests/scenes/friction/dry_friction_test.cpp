// Dry friction that sticks and slips, in whole runs: against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "framework/scene/yaml/reader.h"
#include "tests/scenes/friction/friction_scenes.h"

namespace pintle::dry_friction_test {
namespace {

using pintle_scenes::block_on_ramp, pintle_scenes::dopri5, pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::number,
    pintle_scenes::Oscillator, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81, pi = std::numbers::pi;

const std::array methods{dopri5, Method{"Rkf45", "rkf45", 1e-9, 1e-6}, Method{"Verner87", "verner87", 1e-7, 2e-5},
                         Method{"GeneralizedAlpha", "generalized-alpha", 1e-8, 2e-4}};

class DryFriction : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(By, DryFriction, testing::ValuesIn(methods), pintle_scenes::name_of);

// It sticks from one static deflection, μ_s N/k, back to the other of the swing, and slides through π + 2φ of a harmonic motion.
TEST_P(DryFriction, StickSlipHasItsClosedFormPeriod) {
  const Oscillator o;
  const double omega = std::sqrt(o.k), D = (o.holds - o.slides) * o.N / o.k, middle = o.slides * o.N / o.k;
  const double sticks = 2 * D / o.V, slides = (pi + 2 * std::atan2(o.V / omega, D)) / omega;
  const double first = (middle + D) / o.V, period = sticks + slides;
  const Whole w = run(o.text(), GetParam());
  expect_sound(w);
  const std::vector<double> t = w.column("t [s]"), x = w.column("slider.x [m]"), v = w.column("slider.vx [m/s]");
  const double amplitude = std::hypot(D, o.V / omega);
  int stuck = 0, slid = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double in = t[i] < first ? 0 : std::fmod(t[i] - first, period);
    const bool slipping = t[i] >= first && in < slides;
    const double expected = t[i] < first ? o.V * t[i]
                            : slipping   ? middle + amplitude * std::cos(omega * in - std::atan2(o.V / omega, D))
                                         : middle - D + o.V * (in - slides);
    ASSERT_NEAR(x[i], expected, 30 * GetParam().near * amplitude) << "t = " << t[i];
    if (slipping)
      ++slid;
    else if (t[i] > first + 0.01 && in > slides + 2e-3 && in < period - 2e-3) {
      ASSERT_NEAR(v[i], o.V, 1e-9) << "t = " << t[i];
      ++stuck;
    }
  }
  EXPECT_GT(stuck, 500);
  EXPECT_GT(slid, 500);
  // Each swing loses what friction takes while it slides: μ N times the slip.
  const double whole_swings = std::floor((o.until - first) / period), slip = o.V * slides + 2 * D;
  EXPECT_NEAR(w.ledger("rub.lost to friction [J]"), o.slides * o.N * slip * whole_swings, o.slides * o.N * slip);
}

// Above μ_s the block goes at once at g (sin α − μ cos α); below it stays where it is.
TEST_P(DryFriction, ABlockStaysBelowTheFrictionAngle) {
  const Whole w = run(block_on_ramp(std::atan(0.35), 2), GetParam());
  expect_sound(w);
  const std::vector<double> x = w.column("block.x [m]"), t = w.column("t [s]");
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] > 0.1) {
      ASSERT_NEAR(x[i], x.back(), 1e-10) << "t = " << t[i];
    }
  EXPECT_LT(std::abs(x.back()), 1e-4);
}

TEST_P(DryFriction, ABlockSlidesAboveTheFrictionAngle) {
  const double angle = std::atan(0.41), a = g * (std::sin(angle) - 0.3 * std::cos(angle));
  const Whole w = run(block_on_ramp(angle, 1), GetParam());
  expect_sound(w);
  EXPECT_NEAR(w.last("block.vx [m/s]"), -a, 2e-3 * a);  // what it sinks in at first holds it for a moment
  const std::vector<double> v = w.column("block.vx [m/s]"), t = w.column("t [s]");
  const std::size_t half = t.size() / 2;
  EXPECT_NEAR((v.back() - v[half]) / (t.back() - t[half]), -a, 10 * GetParam().near * a);
}

// All of its kinetic energy goes to friction in v²/(2 μ g), and there it stays.
TEST_P(DryFriction, ASlidingBlockStopsAndLosesItsKineticEnergy) {
  const double v = 1.5, mu = 0.3;
  const Whole w = run(block_on_ramp(0, 1, ", vx: " + number(v)), GetParam());
  expect_sound(w);
  EXPECT_NEAR(w.last("block.x [m]"), v * v / (2 * mu * g), 2e-3 * v * v / (2 * mu * g));  // its weight bounces a little at first
  EXPECT_NEAR(w.ledger("rest.lost to friction [J]"), 0.5 * 2 * v * v, 1e-3 * v * v);
  const std::vector<double> x = w.column("block.x [m]"), t = w.column("t [s]");
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] > v / (mu * g) + 0.02) {
      ASSERT_NEAR(x[i], x.back(), 1e-10) << "t = " << t[i];
    }
}

// Pulled harder and harder it goes when the pull is μ_s m g: both its corners at once, whatever each of them bears.
TEST_P(DryFriction, APulledBlockGoesWhenThePullIsWhatFrictionHolds) {
  std::string text = block_on_ramp(0, 1.2);
  text += "forces: {pull: {force: [10 N/s*t, 0], at: block}}\n";
  const Whole w = run(text, GetParam());
  expect_sound(w);
  const double breaks = 0.4 * 2 * g / 10;
  const std::vector<double> v = w.column("block.vx [m/s]"), t = w.column("t [s]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] > 0.1 && t[i] < breaks - 1e-3) {
      ASSERT_NEAR(v[i], 0, 1e-6) << "t = " << t[i];
    }
    const double after = t[i] - breaks, expected = (10 * (t[i] * t[i] - breaks * breaks) / 2 - 0.3 * 2 * g * after) / 2;
    if (after > 1e-3) {
      ASSERT_NEAR(v[i], expected, 3e-4) << "t = " << t[i];
    }
  }
}

// A disc that slides at first rolls from v₀/(3 μ g) on, at ⅔ v₀; a third of its energy is gone, and no more goes.
TEST_P(DryFriction, ADiscComesToRollAtTwoThirdsOfItsSpeed) {
  const double v = 2, mu = 0.25, m = 0.5, r = 0.05;
  const Whole w = run("gravity: [0, -9.81]\nbodies: {disc: {rigid: {mass: 0.5, inertia: " + number(m * r * r / 2) +
                          "}, profiles: {rim: {disc: [0, 0], radius: 50 mm}}}}\nground: {profiles: {floor: {path: [[50, 0], [-50, 0]]}}}\n"
                          "contacts: {roll: {between: [disc.rim, ground.floor], normal: {spring-damper: {stiffness: 1e6, damping: 500}}, "
                          "friction: {coulomb: {coefficient: 0.25}}}}\nstart: {disc: {y: 50 mm, vx: 2}}\n"
                          "run: {until: 1}\noutput: {every: 5 ms}\n",
                      GetParam());
  expect_sound(w);
  EXPECT_NEAR(w.last("disc.vx [m/s]"), 2 * v / 3, 1e-3 * v);
  EXPECT_NEAR(w.last("disc.speed [rad/s]") * r, -w.last("disc.vx [m/s]"), 1e-4);  // it has sunk in by a millionth of a metre
  EXPECT_NEAR(w.ledger("roll.lost to friction [J]"), m * v * v / 6, 2e-3 * m * v * v);
  const std::vector<double> lost = w.run.ledger.column("roll.lost to friction [J]"), t = w.column("t [s]");
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] > v / (3 * mu * g) + 0.02) {
      ASSERT_NEAR(lost[i], lost.back(), 1e-12);
    }
}

// On a slope it rolls where tan α < 3 μ, at ⅔ of its free fall, else it slides.
TEST(DryFriction, ADiscRollsDownASlopeWithoutLoss) {
  const double r = 0.05, angle = 0.5, mu = 0.3;  // tan 0.5 = 0.55 < 3 μ: it rolls
  const auto text = [&](double coefficient) {
    return "gravity: [" + number(g * std::sin(angle)) + ", " + number(-g * std::cos(angle)) +
           "]\nbodies: {disc: {rigid: {mass: 0.5, inertia: " + number(0.5 * r * r / 2) +
           "}, profiles: {rim: {disc: [0, 0], radius: 50 mm}}}}\nground: {profiles: {floor: {path: [[50, 0], [-50, 0]]}}}\n"
           "contacts: {roll: {between: [disc.rim, ground.floor], normal: {spring-damper: {stiffness: 1e6, damping: 500}}, "
           "friction: {coulomb: {coefficient: " +
           number(coefficient) + "}}}}\nstart: {disc: {y: 50 mm}}\nrun: {until: 1}\noutput: {every: 5 ms}\n";
  };
  const Whole rolls = run(text(mu), dopri5);
  expect_sound(rolls);
  const auto slope = [](const Whole& w, const std::string& of) {
    const std::vector<double> v = w.column(of), t = w.column("t [s]");
    return (v.back() - v[v.size() / 2]) / (t.back() - t[t.size() / 2]);
  };
  EXPECT_NEAR(slope(rolls, "disc.vx [m/s]"), 2 * g * std::sin(angle) / 3, 1e-4 * g);
  const Whole slides = run(text(0.15), dopri5);
  expect_sound(slides);
  EXPECT_NEAR(slope(slides, "disc.vx [m/s]"), g * (std::sin(angle) - 0.15 * std::cos(angle)), 1e-4 * g);
  EXPECT_NEAR(slope(slides, "disc.speed [rad/s]"), -2 * 0.15 * g * std::cos(angle) / r, 1e-4 * g / r);
}

// A journal that is turned slowly climbs in its bearing, rolling, until the contact stands at the friction angle, and slides there.
TEST(DryFriction, AJournalClimbsToTheFrictionAngle) {
  const double mu = 0.35;
  const Whole w =
      run("gravity: [0, -9.81]\nbodies:\n  shaft: {rigid: {mass: 1, inertia: 1e-3}}\n"
          "  rider: {rigid: {mass: 2, inertia: 1}, points: {C: [0, 0], T: [0, -2]}}\n"
          "joints:\n  axle: {revolute: [ground, shaft]}\n"
          "  eye: {revolute: [shaft, rider.C], clearance: {radial: 1 mm, bearing radius: 20 mm, bearing: rider, "
          "normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e9, approach speed: largest}}, friction: {coulomb: {coefficient: " +
              number(mu) +
              "}}}}\n"
              "drivers: {motor: {angle: [ground, shaft], law: 2 rad/s*t}}\n"
              "forces: {settle: {spring: [ground.S, rider.T], stiffness: 1e-3, damping: 3, free length: 1}}\n"
              "ground: {points: {S: [5, -2]}}\n"
              "start: {eye: {eccentricity: [0, 1 mm]}}\nrun: {until: 6}\noutput: {every: 10 ms}\n",
          dopri5);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const double ex = w.last("eye.ex [m]"), ey = w.last("eye.ey [m]");
  EXPECT_NEAR(w.last("eye.friction [N]") / w.last("eye.normal [N]"), mu * (w.last("eye.friction [N]") > 0 ? 1 : -1), 1e-9);
  EXPECT_GT(std::abs(std::atan2(ex, ey)), 0.05);
}

// It is there after eleven days.
TEST(DryFriction, ABlockStaysForAMillionSeconds) {
  const Whole w = run(block_on_ramp(std::atan(0.35), 1e6), methods[3]);
  expect_sound(w);
  const std::vector<double> x = w.column("block.x [m]");
  for (std::size_t i = 1; i < x.size(); ++i) ASSERT_NEAR(x[i], x.back(), 1e-10);
  EXPECT_LT(w.run.counts.steps, 5000);
}

// 400 N press the shoe: sliding it takes 0.35 · 400 N · 0.15 m of the drum, 15 N m the load.
TEST_P(DryFriction, ADrumBrakeStopsItsLoadAndHoldsIt) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/drum_brake.yaml");
  s.output.frames = 0;
  const Whole w = run(s, GetParam());
  expect_sound(w);
  EXPECT_NEAR(w.last("drum.angle [rad]"), 15, 0.01);  // the shoe bounces a little at first
  const std::vector<double> speed = w.column("drum.speed [rad/s]"), t = w.column("t [s]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < 0.49) {
      EXPECT_NEAR(speed[i], 60 - 120 * t[i], 0.06) << t[i];
    }
    if (t[i] > 0.51) {
      EXPECT_NEAR(speed[i], 0, 1e-12) << t[i];
    }
  }
  EXPECT_NEAR(w.ledger("brake.lost to friction [J]"), 90 + 15 * 15, 0.3);
  EXPECT_NEAR(w.last("brake.friction [N]") * (w.last("brake.friction [N]") > 0 ? 1 : -1), 100, 1e-3);  // 15 N m over 0.15 m
}

// A block on one corner comes down to its base in the time that a rigid one takes about a corner that neither slips nor lifts:
// I θ″ = −m g R sin(α − θ).
TEST(DryFriction, ABlockRocksAboutItsCorner) {
  const double b = 0.05, h = 0.2, m = 4, I = m * (b * b + h * h) / 3, R = std::hypot(b, h), alpha = std::atan2(b, h), start = 0.1;
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {block: {rigid: {mass: 4, inertia: " + number(I) +
              "}, profiles: {outline: {path: [[-5 cm, -20 cm], [5 cm, -20 cm], [5 cm, 20 cm], [-5 cm, 20 cm]], closed: true}}}}\n"
              "ground: {profiles: {floor: {path: [[5, 0], [-5, 0]]}}}\n"
              "contacts: {rest: {between: [block.outline, ground.floor], normal: {spring-damper: {stiffness: 1e8, damping: 2e4}}, "
              "friction: {coulomb: {coefficient: 0.7}}}}\n"
              "start: {block: {angle: " +
              number(-start) + ", x: " + number(R * std::sin(start - alpha)) + ", y: " + number(R * std::cos(alpha - start) - 4 * g / 1e8) +
              "}}\nrun: {until: 0.4}\noutput: {every: 1 ms}\n",
          dopri5);
  expect_sound(w);
  double theta = start, rate = 0, time = 0;
  const double step = 1e-6, inertia = I + m * R * R;
  for (; theta > 0; time += step) {
    rate -= step * m * g * R * std::sin(alpha - theta) / inertia;
    theta += step * rate;
  }
  const std::vector<double> angle = w.column("block.angle [rad]"), t = w.column("t [s]");
  std::size_t i = 0;
  while (i + 1 < t.size() && angle[i] < 0) ++i;
  const double down = t[i - 1] + (t[i] - t[i - 1]) * angle[i - 1] / (angle[i - 1] - angle[i]);
  EXPECT_NEAR(down, time, 2e-3 * time);
}

// With one coefficient all that share the load give way together: the box's corners, at any height of the pull, and several pads.
TEST_P(DryFriction, WhatSharesALoadGivesWayTogether) {
  for (const double height : {0.0, -0.02, 0.01}) {
    std::string text = block_on_ramp(0, 1.2, "", "coulomb: {coefficient: 0.3}");
    text.replace(text.find("profiles: {outline"), 18, "points: {p: [0, " + number(height) + "]}, profiles: {outline");
    const Whole w = run(text + "forces: {pull: {force: [10 N/s*t, 0], at: block.p}}\n", GetParam());
    expect_sound(w);
    const double breaks = 0.3 * 2 * g / 10;
    const std::vector<double> v = w.column("block.vx [m/s]"), t = w.column("t [s]");
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t[i] > breaks + 1e-3) {
        ASSERT_NEAR(v[i], 10 * std::pow(t[i] - breaks, 2) / 4, 3e-4) << "t = " << t[i];
      }
  }
}
TEST_P(DryFriction, TwoPadsOfOneCalliperHoldTogether) {
  const Whole w =
      run("bodies:\n  drum: {rigid: {mass: 2, inertia: 0.1}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}\n"
          "  left: {rigid: {mass: 1, inertia: 0.1}, profiles: {face: {path: [[0, -0.1], [0, 0.1]], material: left}}}\n"
          "  right: {rigid: {mass: 1, inertia: 0.1}, profiles: {face: {path: [[0, 0.1], [0, -0.1]], material: left}}}\n"
          "joints: {axle: {revolute: [ground, drum]}, a: {prismatic: [ground, left]}, b: {prismatic: [ground, right]}}\n"
          "forces: {p: {force: [500, 0], at: left}, q: {force: [-400, 0], at: right}, turn: {torque: 60 N m/s*t, on: drum}}\n"
          "contacts:\n  l: {between: [left.face, drum.rim], normal: {spring-damper: {stiffness: 1e7, damping: 5e3}}, friction: {coulomb: "
          "{coefficient: 0.5}}}\n"
          "  r: {between: [right.face, drum.rim], normal: {spring-damper: {stiffness: 1e7, damping: 5e3}}, friction: {coulomb: "
          "{coefficient: 0.5}}}\n"
          "start: {left: {x: -99.95 mm}, right: {x: 99.96 mm}}\nrun: {until: 1.2}\noutput: {every: 10 ms}\n",
          GetParam());
  expect_sound(w);
  const double breaks = 0.5 * 900 * 0.1 / 60;
  const std::vector<double> speed = w.column("drum.speed [rad/s]"), t = w.column("t [s]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double after = std::max(t[i] - breaks, 0.0);
    ASSERT_NEAR(speed[i], 60 * after * after / 2 / 0.1, 0.02) << "t = " << t[i];
  }
}

// Sharp boxes on a sharp pedestal: a corner that has come through one side is not taken for one that is deep under another, wherever
// it lies and however it comes there.
TEST(DryFriction, ASharpBoxSlidesOverAPedestalFromEndToEnd) {
  for (const double height : {0.0, 1e-4})
    for (const double x : {-0.45, -0.3, -0.05, 0.07})
      for (const double speed : {0.0, 0.9}) {
        const double y = 0.05 + height - (height > 0 ? 0 : g * 2 / 2 / 1e6);
        const Whole w =
            run("gravity: [0, -9.81]\nbodies: {box: {rigid: {mass: 2, inertia: 1e-2}, profiles: {outline: {path: "
                "[[-10 cm, -5 cm], [10 cm, -5 cm], [10 cm, 5 cm], [-10 cm, 5 cm]], closed: true}}}}\n"
                "ground: {profiles: {top: {path: [[-60 cm, -40 cm], [60 cm, -40 cm], [60 cm, 0], [-60 cm, 0]], closed: true}}}\n"
                "contacts: {rest: {between: [box.outline, ground.top], normal: {spring-damper: {stiffness: 1e6, damping: 1e3}}, "
                "friction: {coulomb: {coefficient: 0.1}}}}\nstart: {box: {x: " +
                    number(x) + ", y: " + number(y) + ", vx: " + number(speed) + "}}\nrun: {until: 1}\noutput: {every: 10 ms}\n",
                dopri5);
        expect_sound(w);
        for (const Impact& i : w.run.impacts) EXPECT_LT(i.deepest, 1e-3) << x << ", " << speed << ", " << height;
        EXPECT_NEAR(w.last("box.x [m]"), x + speed * speed / 2 / 0.1 / g, 3e-3) << speed << ", " << height;
        EXPECT_NEAR(w.last("box.angle [rad]"), 0, 1e-3);
      }
}

// A mechanism a thousand times as slow, all else alike, is as right.
TEST(DryFriction, ASlowBeltIsAsRightAsAFastOne) {
  const auto lost = [](double slower) {
    const Oscillator o{.N = 10 / slower / slower, .k = 400 / slower / slower, .V = 0.1 / slower, .until = 4 * slower};
    std::string text = o.text();
    text.replace(text.find("every: 1 ms"), 11, "every: " + number(0.01 * slower));
    const Whole w = run(text, dopri5);
    expect_sound(w);
    return w.ledger("rub.lost to friction [J]") * slower * slower;
  };
  EXPECT_NEAR(lost(1000), lost(1), 1e-6 * lost(1));
}

// The first accelerations after a disc has come to stick on a bar that turns are those of the explicit pairs.
TEST(DryFriction, GeneralizedAlphaBeginsToStickWithTheRightForce) {
  const std::string text =
      "gravity: [0, -9.81]\nbodies:\n  arm: {rigid: {mass: 1.2, inertia: 0.05, center: [0.2, 0]}, points: {tip: [0.4, 0]}, "
      "profiles: {tip: {disc: [0.4, 0], radius: 50 mm}}}\n  belt: {rigid: {mass: 5, inertia: 1}, profiles: {face: {path: [[3, 0], [-3, "
      "0]]}}}\n"
      "ground: {points: {P: [0, 0.2], Z: [-10, 0]}}\njoints: {hinge: {revolute: [ground.P, arm]}, bed: {prismatic: [ground, belt]}}\n"
      "drivers: {motor: {distance: [ground.Z, belt], law: 10 m + 0.1 m*sin(12 rad/s*t)}}\n"
      "contacts: {rub: {between: [arm.tip, belt.face], normal: {spring-damper: {stiffness: 2e4, damping: 50}}, friction: {coulomb: "
      "{coefficient: 0.35, static: 0.5}}}}\n"
      "start: {arm: {angle: -0.35}}\nrun: {until: 0.8}\noutput: {every: 0.2 ms}\n";
  const Whole w = run(text, {"", "generalized-alpha", 1e-8, 0}), reference = run(text, {"", "dopri5", 1e-11, 0});
  expect_sound(w);
  const std::vector<double> T = w.column("rub.friction [N]"), expected = reference.column("rub.friction [N]");
  double most = 0;
  for (const double x : expected) most = std::max(most, std::abs(x));
  int far = 0;
  for (std::size_t i = 0; i < T.size(); ++i) far += std::abs(T[i] - expected[i]) > 2e-4 * most;
  EXPECT_GT(most, 1);
  EXPECT_LT(far, 12);  // rows beside a jump
}

}  // namespace
}  // namespace pintle::dry_friction_test
