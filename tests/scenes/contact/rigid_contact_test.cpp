// Rigid bodies that stay in contact: blocks on slopes, Painlevé's rod, and what compliant laws tend to.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_contact_test {
namespace {

using pintle_scenes::at, pintle_scenes::disc, pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::Method,
    pintle_scenes::name_of, pintle_scenes::number, pintle_scenes::run, pintle_scenes::run_for, pintle_scenes::struck,
    pintle_scenes::struck_by, pintle_scenes::Whole;

constexpr double g = 9.81, mu = 0.4, degree = M_PI / 180;

class RigidContact : public testing::TestWithParam<Method> {
 protected:
  Whole run_it(const std::string& text) const { return run(text, GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(All, RigidContact, testing::ValuesIn(struck_by), name_of);

// ---- a block on a slope, friction angle 21.8° -------------------------------------------------

std::string block(double slope, double speed, double until) {
  return floor_under(slope) +
         "bodies: {box: {rigid: {mass: 2, inertia: 0.02}, profiles: {sides: {path: [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]], "
         "closed: true}}}}\ncontacts:\n" +
         struck("foot", "box.sides", "ground.floor", "restitution: 0.3, friction: {coulomb: {coefficient: 0.4}}") +
         "start: {box: {at: [0, 0.1], velocity: [" + number(speed) + ", 0]}}\n" + run_for(until, until / 10);
}

TEST_P(RigidContact, ABlockOnAGentleSlopeStaysForEver) {
  const Whole w = run_it(block(20 * degree, 0, 1e6));
  expect_sound(w, 1e-12);
  EXPECT_NEAR(w.last("box.x [m]"), 0, 1e-12);
  EXPECT_NEAR(w.last("box.y [m]"), 0.1, 1e-12);
  EXPECT_NEAR(w.last("box.angle [rad]"), 0, 1e-12);
  EXPECT_NEAR(w.last("foot.normal [N]"), 2 * g * std::cos(20 * degree), 1e-10 * g);
  EXPECT_NEAR(std::abs(w.last("foot.friction [N]")), 2 * g * std::sin(20 * degree), 1e-10 * g);
  EXPECT_LT(w.run.counts.steps, 100);
}

// At the friction angle itself: a hundred-millionth of it less, and it stays for eleven days; as much more, and it slides.
TEST(RigidFriction, ABlockStaysJustBelowTheFrictionAngleAndSlidesJustAbove) {
  for (const double part : {1e-6, 1e-8}) {
    SCOPED_TRACE(part);
    const Whole stays = run(block(std::atan(mu) * (1 - part), 0, 1e6));
    expect_sound(stays, 1e-12);
    EXPECT_NEAR(stays.last("box.x [m]"), 0, 1e-12);
    const double angle = std::atan(mu) * (1 + part), a = g * (std::sin(angle) - mu * std::cos(angle)), t = 100;
    const Whole slides = run(block(angle, 0, t));
    expect_sound(slides, 1e-12);
    EXPECT_NEAR(slides.last("box.x [m]"), a * t * t / 2, 1e-15 / part * a * t * t);  // a is known to 1e-16 g
  }
}

// It leaves more slowly than shows, and comes back before its gap opens.
TEST_P(RigidContact, ABallThatLeavesASlightOverlapSlowlyDoesNotFallThrough) {
  for (const double speed : {1e-7, 1e-5, 1e-3}) {
    SCOPED_TRACE(speed);
    const Whole w = run_it(
        "gravity: [0, -9.81]\nground: {profiles: {floor: {path: [[-1, 0], [1, 0]], material: right}}}\n"
        "bodies: {ball: {rigid: {mass: 1, inertia: 1e-3}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}}\ncontacts:\n" +
        struck("foot", "ball.rim", "ground.floor", "restitution: 0.5") + "start: {ball: {y: " + number(0.1 - 1e-12) +
        ", vy: " + number(speed) + "}}\n" + run_for(0.1, 0.01));
    expect_sound(w, 1e-9);
    EXPECT_NEAR(w.last("ball.y [m]"), 0.1, 1e-11);
    EXPECT_NEAR(w.last("foot.normal [N]"), 9.81, 1e-9);
  }
}

// ---- a ball without restitution on a vibrating table, A ω² = γ g ------------------------------

// It leaves where the table falls with g, and lands where its parabola meets the table: one flight a period, however long the steps are.
TEST_P(RigidContact, ABallThatATableThrowsLandsOnItOncePerPeriod) {
  constexpr double omega = 100, period = 2 * M_PI / omega;
  for (const double gamma : {1.1, 1.5, 2.5})
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      SCOPED_TRACE("gamma " + number(gamma) + ", tolerance " + number(tolerance));
      const double A = gamma * g / (omega * omega), leaves = std::asin(1 / gamma) / omega;
      const auto gap = [&](double t) {
        const double theta = omega * leaves;
        return A * std::sin(theta) + A * omega * std::cos(theta) * t - g * t * t / 2 - A * std::sin(theta + omega * t);
      };
      double low = 0.02 * std::sqrt(gamma - 1) * period, high = period;  // it is open at the first and closed at the second
      ASSERT_GT(gap(low), 0);
      ASSERT_LT(gap(high), 0);
      for (int i = 0; i < 60; ++i) (gap((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
      const Whole w =
          run("gravity: [0, -9.81]\nground: {points: {below: {at: [0, -1], angle: 90 deg}}}\nbodies:\n"
              "  table: {rigid: {mass: 100, inertia: 1}, profiles: {top: {path: [[-1, 0], [1, 0]], material: right}}}\n" +
                  disc("ball") +
                  "joints: {guide: {prismatic: [ground.below, table], angle: -90 deg}, tube: {prismatic: [ground.below, ball], "
                  "angle: -90 deg}}\ndrivers: {shaker: {distance: [ground.below, table], law: \"1 m + " +
                  number(A) + " m*sin(100 rad/s*t)\"}}\ncontacts:\n" + struck("foot", "ball.rim", "table.top", "restitution: 0") +
                  "start: {ball: {y: 0.1}}\n" + run_for(leaves + low + 8.5 * period, 0.01),
              {GetParam().name, GetParam().words, tolerance, 0});
      ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
      const std::vector<Impact>& all = w.run.impacts;  // the first at the start
      ASSERT_EQ(all.size(), 10u);
      for (std::size_t i = 1; i < all.size(); ++i) {
        EXPECT_NEAR(all[i].begin, leaves + low + static_cast<double>(i - 1) * period, 1e-8 * period);
        EXPECT_LT(all[i].deepest, 1e-8 * A);
      }
    }
}

TEST_P(RigidContact, ABlockSlidesDownASteepSlope) {
  const double slope = 30 * degree, a = g * (std::sin(slope) - mu * std::cos(slope)), t = 1;
  const Whole w = run_it(block(slope, 0, t));
  expect_sound(w);
  EXPECT_NEAR(w.last("box.vx [m/s]"), a * t, 1e-10);
  EXPECT_NEAR(w.last("box.x [m]"), a * t * t / 2, 1e-10);
  EXPECT_NEAR(w.ledger("foot.lost to friction [J]"), mu * 2 * g * std::cos(slope) * a / 2, 1e-9);
}

// Slower by g (μ cos − sin) and at rest then.
TEST_P(RigidContact, ABlockComesToRestOnAGentleSlope) {
  const double slope = 10 * degree, slower = g * (mu * std::cos(slope) - std::sin(slope)), v = 1, rests = v / slower;
  const Whole w = run_it(block(slope, v, 1));
  expect_sound(w);
  ASSERT_LT(rests, 1);
  EXPECT_NEAR(w.last("box.x [m]"), v * v / (2 * slower), 1e-9);
  EXPECT_NEAR(w.last("box.vx [m/s]"), 0, 1e-12);
  const double during = 0.1 * std::floor(rests / 0.1);
  EXPECT_NEAR(at(w, "box.vx [m/s]", during), v - slower * during, 1e-10);
  EXPECT_NEAR(at(w, "box.x [m]", during + 0.1), v * v / (2 * slower), 1e-9);
}

// Pushed up it stops after v/(g (sin + μ cos)), and stays, or slides back.
TEST_P(RigidContact, ABlockPushedUpStaysOrSlidesBack) {
  for (const double slope : {15 * degree, 30 * degree}) {
    SCOPED_TRACE(slope);
    const double v = 2, slower = g * (std::sin(slope) + mu * std::cos(slope)), stops = v / slower, up = v * v / (2 * slower);
    const double back = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope))), left = 1 - stops;
    const Whole w = run_it(block(slope, -v, 1));
    expect_sound(w);
    EXPECT_NEAR(w.last("box.x [m]"), -up + back * left * left / 2, 1e-9);
    EXPECT_NEAR(w.last("box.vx [m/s]"), back * left, 1e-9);
  }
}

// ---- Painlevé's rod: 2 m, 1 kg, its sharp end on the ground ahead of its centre -----------------

/// @param ahead  1: to the right, −1: the mirror image
std::string rod(double friction, double speed, int ahead) {
  return floor_under() + "bodies: {rod: {rigid: {mass: 1, inertia: " + number(1.0 / 3) +
         "}, profiles: {tip: {path: [[1, 0], [0.9, 1 mm], [0.9, -1 mm]], closed: true}}}}\ncontacts:\n" +
         struck("tip", "rod.tip", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: " + number(friction) + "}}") +
         "start: {rod: {at: [0, " + number(std::sin(1.0)) + "], angle: " + number(ahead > 0 ? -1 : M_PI + 1) + ", velocity: [" +
         number(ahead * speed) + ", 0]}}\n" + run_for(1e-3, 1e-3);
}

TEST_P(RigidContact, PainlevesRodSlidesUnderAGreatForce) {
  for (const int ahead : {1, -1}) {
    const Whole w = run_it(rod(1, 1, ahead)), pulled = run_it(rod(2, -1, ahead));
    expect_sound(w);
    expect_sound(pulled);
    EXPECT_NEAR(w.column("tip.normal [N]").front(), 19.1663851402163, 1e-11);  // 2 m g for μ = 0
    EXPECT_NEAR(std::abs(w.column("tip.friction [N]").front()), 19.1663851402163, 1e-11);
    EXPECT_NEAR(pulled.column("tip.normal [N]").front(), 2.13090766356263578, 1e-11);
  }
}

TEST_P(RigidContact, PainlevesRodThatJamsEndsTheRunWithItsReason) {
  for (const int ahead : {1, -1}) {
    const Whole w = run_it(rod(2, 1, ahead));
    EXPECT_EQ(w.run.status, Status::failed);
    pintle_test::expect_says(w.run.reason, {"contact \"tip\"", "Painlevé", "stiffness", "less friction"});
  }
}

// ---- a rod on a pin meets a stop with so much friction that it locks: the impact has a solution, and it stays ----

TEST_P(RigidContact, ALeverLocksAtItsStop) {
  for (const double friction : {0.3, 3.0}) {
    const Whole w = run_it(
        "ground: {points: {O: {at: [0, 0.5]}}, profiles: {floor: {path: [[-50, 0], [50, 0]], material: right}}}\n"
        "bodies: {lever: {rigid: {mass: 1, inertia: 0.1}, profiles: {end: {disc: [0.6, 0], radius: 1 mm}}}}\n"
        "joints: {pin: {revolute: [ground.O, lever]}}\ncontacts:\n" +
        struck("stop", "lever.end", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: " + number(friction) + "}}") +
        "start: {lever: {angle: -45 deg, speed: -1}}\n" + run_for(0.5, 0.1));
    expect_sound(w);
    EXPECT_NEAR(w.last("lever.speed [rad/s]"), 0, 1e-12) << friction;
    EXPECT_NEAR(w.last("lever.y [m]") + 0.6 * std::sin(w.last("lever.angle [rad]")), 1e-3, 1e-9) << friction;
  }
}

// ---- what gives way less and less tends to what does not -----------------------------------------

TEST(RigidLimit, BouncesOfStifferAndStifferContactsTendToIt) {
  const auto height = [](const std::string& laws) {
    const Whole w = run(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n  foot: {between: [ball.rim, ground.floor], " + laws +
                        "}\nstart: {ball: {at: [0, 0.6]}}\nrun: {until: 0.7 s, tolerance: 1e-9}\noutput: {every: 1 ms}\n");
    double top = 0;
    const auto y = w.column("ball.y [m]"), t = w.column("t [s]");
    for (std::size_t i = 0; i < y.size(); ++i)
      if (t[i] > 0.4) top = std::max(top, y[i] - 0.1);
    return top;
  };
  const double rigid = height("model: impact, restitution: 0.7");
  EXPECT_NEAR(rigid, 0.49 * 0.5, 2e-6);  // rows are 1 ms apart: g (½ ms)²/2
  double before = 1;
  for (const char* stiffness : {"1e7", "1e9", "1e11"}) {
    const double error = std::abs(height(std::string("normal: {exact: {restitution: 0.7, stiffness: ") + stiffness + "}}") - rigid);
    EXPECT_LT(error, before / 3) << stiffness;  // the depth falls by 100^0.4 = 6.3
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

// A key's flank lifts a pin by its chamfer of the same slope. Where the upper ends of both faces pass each other, the key's corner also comes
// to the pin's side and the pin's to the key's back, but they move on along the faces.
TEST_P(RigidContact, FacesThatSlideOverEachOthersEndsStrikeNothing) {
  constexpr double key = 0.05, pin = 0.02, load = 1, speed = 1, start = -0.02, ends_meet = -0.012;  // [kg], [N], [m/s], [m]
  for (const double degrees : {30.0, 45.0, 55.0})
    for (const std::string friction : {"", ", friction: {coulomb: {coefficient: 0}}"}) {
      SCOPED_TRACE(number(degrees) + friction);
      const double slope = std::tan(degrees * M_PI / 180), low = -0.011 - 0.004 * slope;
      const Whole w = run_it(
          "ground: {points: {G: {at: [0, 0], angle: 90 deg}, K: {at: [0, 0], angle: 0}}}\nbodies:\n  pin:\n"
          "    rigid: {mass: 20 g, inertia: 2e-6}\n    points: {O: {at: [0, 0], angle: 90 deg}}\n"
          "    profiles: {outline: {path: [[-4 mm, -11 mm], [0, " +
          number(low) + "], [4 mm, -11 mm], [4 mm, 15 mm], [-4 mm, 15 mm]], closed: true}}\n  key:\n" +
          "    rigid: {mass: 50 g, inertia: 1e-5}\n    points: {O: {at: [0, 0], angle: 0}}\n    profiles: {bit: {path: [[28 mm, " +
          number(-0.005 - 0.02 * slope) + "], [8 mm, -5 mm], [-60 mm, -5 mm]], material: left}}\n" +
          "joints: {guide: {prismatic: [ground.G, pin.O]}, slide: {prismatic: [ground.K, key.O]}}\n"
          "forces: {load: {force: [0, -1 N], at: pin}}\n"
          "contacts: {nose: {between: [key.bit, pin.outline], model: impact, restitution: 0.2" +
          friction + "}}\nstart: {key: {at: [-20 mm, 0], vx: 1}, pin: {at: [0, " + number(0.006 - 0.008 * slope) +
          "], angle: 0, vy: " + number(slope) + "}}\nrun: {until: 11 ms}\noutput: {every: 0.1 ms, frames: 0}\n");
      expect_sound(w);
      const double slows = load * slope / (key + pin * slope * slope);  // both together
      const std::vector<double> t = w.column("t [s]"), x = w.column("key.x [m]");
      EXPECT_GT(x.back(), ends_meet + 1e-3);
      for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(x[i], start + speed * t[i] - slows * t[i] * t[i] / 2, 1e-11) << t[i];
      EXPECT_NEAR(w.ledger("nose.lost to hysteresis [J]"), 0, 1e-12);
    }
}

// Whatever faces a sharp corner, it must not pass.
TEST_P(RigidContact, ASharpCornerLandsOnEveryKindOfSurface) {
  const std::string surfaces[] = {"path: [[-1, 0], [1, 0]], material: right",
                                  "path: [[-1, -0.05], [0, 0.05], [1, -0.05]], material: right",
                                  "disc: [0, -0.5], radius: 0.55",
                                  "hole: [0, 0.5], radius: 0.55",
                                  "spline: [[-1, 0], [-0.5, 0.06], [0, 0.08], [0.5, 0.06], [1, 0]], material: right",
                                  "spline: [[-1, 0.1], [-0.5, 0.02], [0, 0], [0.5, 0.02], [1, 0.1]], material: right",
                                  "polar: [[0, 0.1], [90 deg, 0.08], [180 deg, 0.1], [270 deg, 0.08]]"};
  for (const std::string& surface : surfaces)
    for (const std::string law : {"model: impact, restitution: 0.3", "normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e8}}"})
      for (const double degrees : {5.0, 45.0, 80.0}) {
        SCOPED_TRACE(surface + ", " + law + ", " + number(degrees) + " deg");
        const Whole w =
            run_it("gravity: [0, -9.81]\nground: {profiles: {under: {" + surface +
                   "}}}\nbodies: {box: {rigid: {mass: 1, inertia: 2e-3}, profiles: {sides: {path: [[-0.05, -0.05], [0.05, -0.05], "
                   "[0.05, 0.05], [-0.05, 0.05]], closed: true}}}}\ncontacts: {fall: {between: [box.sides, ground.under], " +
                   law + ", friction: {coulomb: {coefficient: 0.5}}}}\nstart: {box: {at: [0.02, 0.2], angle: " + number(degrees) +
                   " deg}}\n" + run_for(0.3, 0.01));
        ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
        EXPECT_GE(w.run.impacts.size(), 1u);
        EXPECT_GT(w.last("box.y [m]"), -0.03);  // in free fall it would be at −0.24
      }
}

// The point of a curve that is farthest from the middle of a hole touches it; without gravity and losses, and with the middle of the egg at
// that of its mass, it strikes for ever and stays inside.
TEST_P(RigidContact, AnEggStaysInARoundHole) {
  constexpr double hole = 0.25, flat = 0.02, slender = 0.03;
  std::string egg;
  for (int k = 0; k < 24; ++k) {
    const double phi = k * M_PI / 12, r = slender * flat / std::hypot(flat * std::cos(phi), slender * std::sin(phi));
    egg += (k > 0 ? ", [" : "[") + number(phi) + ", " + number(r) + "]";
  }
  const Whole w = run_it(
      "ground: {profiles: {hole: {hole: [0, 0], radius: 0.25}}}\nbodies: {egg: {rigid: {mass: 1, inertia: 3e-4}, profiles: "
      "{shell: {polar: [" +
      egg + "]}}}}\ncontacts:\n" + struck("wall", "egg.shell", "ground.hole", "restitution: 1") +
      "start: {egg: {at: [-0.1, -0.05], velocity: [2, -1.5], speed: 15}}\n" + run_for(2, 0.005));
  expect_sound(w);
  EXPECT_GE(w.run.impacts.size(), 8u);  // it crosses the hole in 0.2 s at most
  const std::vector<double> x = w.column("egg.x [m]"), y = w.column("egg.y [m]"), angle = w.column("egg.angle [rad]");
  for (std::size_t i = 0; i < x.size(); ++i) {
    double farthest = 0;  // of the ellipse, which the spline follows to h⁴/384 of its fourth derivative, less than a thousandth
    for (double phi = 0; phi < 2 * M_PI; phi += 0.01)
      farthest =
          std::max(farthest, std::hypot(x[i] + slender * std::cos(phi) * std::cos(angle[i]) - flat * std::sin(phi) * std::sin(angle[i]),
                                        y[i] + slender * std::cos(phi) * std::sin(angle[i]) + flat * std::sin(phi) * std::cos(angle[i])));
    EXPECT_LT(farthest, hole + 1e-3 * slender) << i;
  }
}

}  // namespace
}  // namespace pintle::rigid_contact_test
