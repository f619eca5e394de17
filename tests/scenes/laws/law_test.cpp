// Laws of time in whole runs: nothing of them is passed over, nothing of them is lost, and a smooth one costs no steps.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "framework/build/build.h"
#include "framework/scene/units/expression.h"
#include "framework/scene/units/table.h"
#include "tests/scenes/mechanisms.h"
#include "tests/refusal.h"

namespace pintle_scenes::law_test {
namespace {

using pintle_test::says;

using namespace pintle;

Law torque_law(const std::string& text) { return read_law(text, dimension::torque); }
Law angle_law(const std::string& text) { return read_law(text, dimension::angle); }

// A wheel of 1 kg m² on a pin.
Scene wheel(double until) {
  Scene s;
  s.ground = {point("O", 0)};
  s.bodies = {body("wheel", 1, 1, {point("O", 0)})};
  s.joints = {joint("pin", JointKind::revolute, "ground.O", "wheel.O")};
  s.run.until = until, s.run.method = "dopri5", s.run.tolerance = 1e-8;
  s.output.every = until / 10;
  return s;
}
Scene pushed(const Law& law, double until = 1) {
  Scene s = wheel(until);
  s.loads = {torque("push", "wheel", law)};
  return s;
}
Scene driven(const Law& law, double until = 1) {
  Scene s = wheel(until);
  s.drivers = {angle_driver("motor", "ground.O", "wheel.O", law)};
  s.drivers[0].place = {17, "drivers.motor"};
  return s;
}
std::string refusal(const Scene& s) {
  return pintle_test::refusal_by([&] { build(s); });
}

const std::vector<std::string> methods{"rkf45", "dopri5", "verner87", "generalized-alpha", "auto"};

// An angular momentum of 1 N m s, in a ten-millionth of the run.
TEST(TimeLaws, NoMethodMissesAPulseHoweverShort) {
  struct Pulse {
    std::string law;
    double momentum, error;  // of what is smooth, of the order of the tolerance for each of its steps
  };
  for (const Pulse& p : std::vector<Pulse>{{"if(t >= 0.3 && t < 0.3 + 1e-7, 1e7, 0)", 1, 1e-8},
                                           {"if(abs(t - 0.3) < 1e-3, 500, 0)", 1, 1e-8},
                                           {"1e7*(step(t, 0.3, 0.3 + 1e-7) - step(t, 0.3 + 2e-7, 0.3 + 3e-7))", 2, 1e-6},
                                           {"1e7*exp(-((t - 0.3)/1e-7)^2)", std::sqrt(std::numbers::pi), 1e-5}})
    for (const std::string& method : methods) {
      Scene s = pushed(torque_law(p.law));
      s.run.method = method;
      const Whole w = run(s);
      EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
      const double within = method == "generalized-alpha" && p.error > 1e-8 ? 1e-3 : p.error;
      // Breaks of the law are known to some roundings of the time; of a short pulse that is much.
      EXPECT_NEAR(w.last("wheel.speed [rad/s]"), p.momentum, within * p.momentum) << p.law << " " << method;
      EXPECT_LT(w.run.counts.steps, method == "generalized-alpha" ? 20'000 : 600) << p.law << " " << method;
    }
}

// At rest nothing but the law tells how long a step may be; these are nothing at the start and at the end of the run.
TEST(TimeLaws, NoMethodPassesOverAWholeWaveFromRest) {
  struct Wave {
    std::string law;
    double speed, angle;
  };
  const double pi = std::numbers::pi;
  for (const Wave& wave : std::vector<Wave>{{"sin(2*pi*t)", 0, 1 / (2 * pi)},
                                            {"sin(pi*t)^2", 1. / 2, 1. / 4},
                                            {"t^2*(1 - t)^2", 1. / 30, 1. / 60},
                                            {"if(t < 0.5, 0, sin(2*pi*(t - 0.5))^2)", 1. / 4, 1. / 16}})
    for (const std::string& method : methods) {
      Scene s = pushed(torque_law(wave.law));
      s.run.method = method;
      const Whole w = run(s);
      EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
      const double within = method == "generalized-alpha" ? 1e-5 : 1e-7;  // about the tolerance, and its power ⅔
      EXPECT_NEAR(w.last("wheel.speed [rad/s]"), wave.speed, within) << wave.law << " " << method;
      EXPECT_NEAR(w.last("wheel.angle [rad]"), wave.angle, within) << wave.law << " " << method;
    }
}

TEST(TimeLaws, PulsesOfATableAreMet) {
  Scene s = pushed({Polyline({{0, 0.5, 0.5 + 1e-7, 0.5 + 2e-7, 1}, {0, 0, 1e7, 0, 0}}), "table", false});
  EXPECT_NEAR(run(s).last("wheel.speed [rad/s]"), 1, 1e-7);
}

// Of a constant torque from 0.25 s on, ½ (t − 0.25)² at every output, and no step that does not meet the jump.
TEST(TimeLaws, AJumpOfALoadIsMetToTheLastDigit) {
  for (const std::string& method : methods) {
    Scene s = pushed(torque_law("if(t < 0.25, 0, 1)"));
    s.run.method = method;
    s.output.every = 0.05;
    const Whole w = run(s);
    const auto t = w.column("t [s]"), angle = w.column("wheel.angle [rad]");
    for (std::size_t i = 0; i < t.size(); ++i)
      EXPECT_NEAR(angle[i], t[i] < 0.25 ? 0 : std::pow(t[i] - 0.25, 2) / 2, 1e-12) << method << " " << t[i];
    EXPECT_LT(w.run.counts.steps + w.run.counts.rejected, 60) << method;
  }
}

// A square wave: every jump is an end of a step.
TEST(TimeLaws, ManyJumpsAreMetAsOneIs) {
  Scene s = pushed(torque_law("if(sin(40*pi*t) >= 0, 1, -1)"));  // twenty periods of 0.05 s: from rest to rest, a way of h²/4 each
  const Whole w = run(s);
  EXPECT_NEAR(w.last("wheel.speed [rad/s]"), 0, 1e-11);
  EXPECT_NEAR(w.last("wheel.angle [rad]"), 20 * 0.05 * 0.05 / 4, 1e-11);
}

TEST(TimeLaws, ADriverWhoseLawJumpsInPlaceOrSpeedIsRefusedWithItsTime) {
  struct Case {
    std::string law, what, when;
  };
  for (const Case& c : std::vector<Case>{{"if(t < 0.4, 0, 5*(t - 0.4))", "speed", "0.4"},
                                         {"if(t < 0.4, 5*t, 2)", "speed", "0.4"},
                                         {"max(0, 5*(t - 0.125))", "speed", "0.125"},
                                         {"abs(t - 0.75)", "speed", "0.75"},
                                         {"min(2*t, 0.5)", "speed", "0.25"},
                                         {"if(t > 0, 3*t, 0)", "speed", "t = "},
                                         {"if(abs(t - 0.5) < 1e-8, 1, 0)", "value", "0.49999999"}}) {
    const std::string message = refusal(driven(angle_law(c.law)));
    EXPECT_TRUE(says(message, "17") && says(message, "drivers.motor")) << c.law << ": " << message;
    EXPECT_TRUE(says(message, c.what) && says(message, c.when) && says(message, "step(t")) << c.law << ": " << message;
  }
}

TEST(TimeLaws, AnyWhoseValueHasAPoleIsRefusedWithItsTime) {
  struct Case {
    std::string law, when;
  };
  for (const Case& c : std::vector<Case>{{"tan(3*t)", "t = 0.52359877"},
                                         {"1/(t - 0.5003)", "t = 0.5003 s"},
                                         {"7 + 1e-6/(t - 0.5003)^2", "t = 0.5003 s"},
                                         {"1/sqrt(abs(t - 0.123))", "t = 0.123 s"},
                                         {"1/sin(pi*(t + 0.3))", "t = 0.7 s"},
                                         {"sqrt((t - 0.7)^2 - 1e-12)", "t = 0.699999 s"},
                                         {"if(t > 0.4, 1/(t - 0.4003), 0)", "t = 0.4003 s"}})
    for (const bool driver : {true, false}) {
      const std::string message = refusal(driver ? driven(angle_law(c.law)) : pushed(torque_law(c.law)));
      EXPECT_TRUE(says(message, c.law) && says(message, c.when) && says(message, "finite")) << c.law << ": " << message;
      EXPECT_EQ(says(message, ":17: drivers.motor"), driver) << message;
    }
  for (const char* law : {"sqrt(abs(t - 0.5003))", "log(abs(t - 0.5003))"})
    EXPECT_TRUE(says(refusal(driven(angle_law(law))), "0.5003")) << law;
}

TEST(TimeLaws, OnesThatStayFiniteAreNoPoles) {
  for (const char* law : {"tan(t)", "1/(t + 1e-3)", "1/((t - 0.5)^2 + 1e-4)", "if(t < 0.4, 1/(t - 0.4 - 1e-3), -1000)", "sqrt((t - 0.5)^2)",
                          "if(abs(t - 0.5) < 1e-3, 1000, 1/abs(t - 0.5))", "log(abs(t - 0.5003))", "t/(t + 1)", "sqrt(abs(t - 0.5003))"})
    EXPECT_EQ(refusal(pushed(torque_law(law))), "accepted") << law;
  for (const char* law : {"tan(t)", "1/(t + 1e-2)", "abs(t - 0.3)^1.7", "atan(100*(t - 0.5))"})
    EXPECT_EQ(refusal(driven(angle_law(law))), "accepted") << law;
}

// The host's own functions cannot be looked into: there the run ends at the pole and names the law.
TEST(TimeLaws, APoleThatOnlyTheRunMeetsIsNamedWithItsLine) {
  const auto tangent = [](double t) {
    const double x = std::tan(3 * t), slope = 3 * (1 + x * x);
    return Jet{x, slope, 6 * x * slope};
  };
  Scene s = driven({tangent, "tan(3 t)", false});
  s.run.tolerance = 1e-3;
  const Whole w = run(s);
  EXPECT_EQ(w.run.status, Status::failed);
  EXPECT_TRUE(says(w.run.reason, "t = 0.523") && says(w.run.reason, "tan(3 t)") && says(w.run.reason, "\"motor\"") &&
              says(w.run.reason, ":17)"))
      << w.run.reason;
  const auto ends = [](double t) { return t < 0.6 ? Jet{t, 1, 0} : Jet{std::nan(""), 0, 0}; };
  const Whole n = run(driven({ends, "mine", false}));
  EXPECT_EQ(n.run.status, Status::failed);
  EXPECT_TRUE(says(n.run.reason, "mine") && says(n.run.reason, ":17)") && says(n.run.reason, "finite")) << n.run.reason;
}

// Jumps of the acceleration are no impacts: half a turn, quickening for the first half of the time and slowing for the other.
TEST(TimeLaws, ADriverMayJumpInAcceleration) {
  for (const std::string& method : methods) {
    Scene s = driven(angle_law("if(t < 0.5, 2*pi*t^2, pi - 2*pi*(1 - t)^2)"));
    s.run.method = method;
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_NEAR(w.last("wheel.angle [rad]"), std::numbers::pi, 1e-9) << method;
    EXPECT_NEAR(w.ledger("motor.work in [J]"), 0, 1e-8) << method;  // all that it gave it takes back
    EXPECT_LT(w.run.counts.steps, 100) << method;
  }
}

TEST(TimeLaws, ADriverThatBeginsWithASpeedStartsTheMechanismWithIt) {
  const Whole w = run(driven(angle_law("3*t")));
  EXPECT_EQ(w.column("wheel.speed [rad/s]").front(), 3);
  EXPECT_EQ(w.ledger("motor.work in [J]"), 0);
}

// Nothing of these laws asks for more steps than their mechanism does.
TEST(TimeLaws, SmoothOnesLimitNoStep) {
  for (const char* law : {"150*t", "2*t + 3*t^2", "0.3 + t^3"}) {
    const Scene s = driven(angle_law(law));
    const Model model = build(s);
    EXPECT_TRUE(model.scheme.changes.empty() && model.scheme.pieces.empty() && std::isinf(model.scheme.max_step)) << law;
  }
  const SliderCrank crank{.until = 0.04};  // 150 rad/s: a turn
  Scene s = scene(crank);
  for (SceneJoint& j : s.joints) j.clearance.reset();
  s.start_journals.clear();
  s.run.method = "auto", s.run.tolerance = 1e-8;
  EXPECT_LT(run(s).run.counts.steps, 100);
}

// On for half of each of 20 000 periods. In each of 40 000 steps the error may be the tolerance.
TEST(TimeLaws, ThatSwitchOftenAreFollowed) {
  Scene s = pushed(torque_law("if(sin(2*pi*1000*t) > 0, 1, 0)"), 20);
  for (const char* method : {"rkf45", "dopri5", "generalized-alpha"}) {
    s.run.method = method;
    EXPECT_NEAR(run(s).last("wheel.speed [rad/s]"), 10, 40e3 * s.run.tolerance) << method;
  }
}

TEST(TimeLaws, ThatSwitchTooOftenToBeListedLimitTheStepsWithAWarning) {
  Scene s = pushed(torque_law("if(sin(2*pi*1e5*t) > 0, 1, 0)"), 20);
  s.loads[0].place = {17, "forces.push"};
  const Model model = build(s);
  ASSERT_EQ(model.warnings.size(), 1u);
  for (const char* part : {":17)", "of \"push\" (", "too often", "run.max step"}) EXPECT_TRUE(says(model.warnings[0], part)) << part;
  EXPECT_LT(model.scheme.max_step, 2.6e-6);
  EXPECT_GT(model.scheme.max_step, 1e-6);
  s.run.max_step = 1e-4;
  EXPECT_TRUE(build(s).warnings.empty());
}

// (cos(x) − 1) of so small an x is rounding: nothing to follow, and nothing to warn of.
TEST(TimeLaws, ThatAreRoundingInAShortRunAskForNoMoreThanAThousandth) {
  Scene s = driven(angle_law("t^2/30 + 15/(2*pi)^2*(cos(2*pi*t/15) - 1)"), 1e-3);
  const Model model = build(s);
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_GE(model.scheme.max_step, 1e-6);
}

// What cannot be looked into may do nothing for long and then act.
TEST(TimeLaws, OfTheHostsOwnFunctionsNoThousandthIsPassedOver) {
  const Law law{[](double t) { return Jet{std::abs(t - 0.5) < 2e-3 ? 1.0 : 0.0, 0, 0}; }, "mine", false};
  const Scene s = pushed(law);
  EXPECT_EQ(build(s).scheme.max_step, 1e-3);
  EXPECT_NEAR(run(s).last("wheel.speed [rad/s]"), 4e-3, 1e-6);
}

}  // namespace
}  // namespace pintle_scenes::law_test
