// Whole runs by generalised-α against explicit ones and models by hand, and what `method: auto` chooses.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "framework/build/choose_method.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/reader.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/mechanisms.h"
#include "tests/refusal.h"

namespace pintle_scenes::implicit_test {
namespace {

namespace po = pintle_oracle;

// What a run may err by: the tolerance to the power ⅔, times what a mechanism magnifies it by, a few tens here.
double allowed(double tolerance) { return 30 * std::pow(tolerance, 2.0 / 3); }

Whole implicit(pintle::Scene s, double tolerance) {
  s.run.method = "generalized-alpha", s.run.constraints = "projection", s.run.tolerance = tolerance;
  return run(s);
}

TEST(Implicit, IdealSliderCrankTurnsAsTheModelByHandAndItsLedgerCloses) {
  const SliderCrank o{.clearance = 0, .until = 0.05};
  for (const double tolerance : {1e-5, 1e-7}) {
    const Whole w = implicit(scene(o), tolerance);
    ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
    const std::vector<double> times = w.column("t [s]"), angle = w.column("crank.angle [rad]");
    for (const std::size_t i : {times.size() / 3, times.size() - 1})
      EXPECT_NEAR(angle[i], po::ideal_at(oracle(o), times[i]).angle, allowed(tolerance)) << tolerance;
    EXPECT_LT(std::abs(w.run.worst_unexplained), allowed(tolerance) * w.run.energy_in_play) << tolerance;
    EXPECT_NE(w.ledger("scheme.lost to numerical dissipation [J]"), 0);
  }
}

TEST(Implicit, DoublePendulumSwingsAsTheModelByHand) {
  const po::DoublePendulum p{.inertia = {0.1, 0.2}};
  const po::Vec<4> start{1.2, -0.4, 0.5, 2};
  pintle::Scene s = double_pendulum(p, start);
  s.run.until = 1;
  const Whole w = implicit(s, 1e-8);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  const po::Vec<4> end = po::evaluate(p, start, 1);
  const Whole exact = run(s);
  EXPECT_NEAR(w.last("upper.angle [rad]"), exact.last("upper.angle [rad]"), allowed(1e-8));
  EXPECT_NEAR(w.last("upper.speed [rad/s]"), end[2], 10 * allowed(1e-8));
  EXPECT_NEAR(w.last("lower.speed [rad/s]"), end[3], 10 * allowed(1e-8));
}

TEST(Implicit, AndrewsMechanismEndsWhereTheExplicitRunDoes) {
  pintle::Scene s = andrews();
  s.output.every = 0.01;
  const Whole w = implicit(s, 1e-8);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  s.run.method = "dopri5", s.run.constraints = "projection", s.run.tolerance = 1e-11;
  const Whole exact = run(s);
  for (const char* name : {"K1.angle [rad]", "K2.angle [rad]", "K7.angle [rad]"})
    EXPECT_LT(relative_difference(w.column(name), exact.column(name)), allowed(1e-8)) << name;
}

// Rows at the very ends of steps and a rest of the run shorter than any: nothing there is told from rounding.
TEST(Implicit, TorqueOfADriverIsThatOfTheExplicitRunInEveryRow) {
  pintle::Scene s = pintle::read_scene_text(R"(
gravity: [0, -9.81]
ground: {points: {R: [0.25, 0]}}
bodies:
  crank: {rigid: {mass: 0.5, inertia: 4e-4, center: [25 mm, 0]}, points: {O: [0, 0], A: [50 mm, 0]}, pose: {angle: 90 deg}}
  coupler: {rigid: {mass: 0.3, inertia: 1e-3, center: [0.1, 0]}, points: {A: [0, 0], B: [0.2, 0]}, pose: {at: [0, 50 mm], angle: 20 deg}}
  rocker: {rigid: {mass: 0.4, inertia: 8e-4, center: [75 mm, 0]}, points: {R: [0, 0], B: [0.15, 0]}, pose: {at: [0.25, 0], angle: 110 deg}}
joints:
  main: {revolute: [ground, crank.O]}
  pin A: {revolute: [crank.A, coupler.A]}
  pin B: {revolute: [coupler.B, rocker.B]}
  pivot: {revolute: [ground.R, rocker.R]}
drivers: {motor: {angle: [ground, crank], law: "90 deg + 30*t"}}
run: {until: 0.02}
output: {every: 10 us}
)",
                                            "driven.yaml");
  s.run.method = "dopri5";
  const std::vector<double> wanted = run(s).column("motor.torque on crank [N m]");
  for (const double tolerance : {1e-6, 1e-8}) {
    const std::vector<double> torque = implicit(s, tolerance).column("motor.torque on crank [N m]");
    ASSERT_EQ(torque.size(), wanted.size());
    for (std::size_t i = 0; i < torque.size(); ++i) ASSERT_NEAR(torque[i], wanted[i], 1e-4) << i << " " << tolerance;
  }
}

TEST(Implicit, FirstImpactsAreThoseOfTheExplicitRun) {
  SliderCrank o{.clearance = 0.5e-3, .until = 8e-3, .tolerance = 1e-11};
  const Whole exact = run(scene(o)), w = implicit(scene(o), 1e-8);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  ASSERT_GE(exact.run.impacts.size(), 3u);
  ASSERT_EQ(w.run.impacts.size(), exact.run.impacts.size());
  // Relative to the finest length; each impact magnifies by about ten.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(w.run.impacts[i].begin, exact.run.impacts[i].begin, 1e-6) << i;
    EXPECT_NEAR(w.run.impacts[i].peak_force, exact.run.impacts[i].peak_force, 2e-3 * exact.run.impacts[i].peak_force) << i;
  }
}

pintle::Scene flexible_crank(const char* method, double tolerance, double young = 207e9) {
  FlexibleBeam beam;
  beam.young = young;
  beam.modes = "{frame: chord, keep: all}";
  FlexibleCrank crank{.coupler = text(beam), .until = 0.01, .tolerance = tolerance};
  pintle::Scene s = scene_of(text(crank));
  s.run.method = method;
  return s;
}

TEST(Implicit, FlexibleSliderCrankMovesAsTheExplicitRunDoes) {
  const Whole exact = run(flexible_crank("dopri5", 1e-10)), w = run(flexible_crank("generalized-alpha", 1e-8));
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  EXPECT_LT(relative_difference(w.column("crank.angle [rad]"), exact.column("crank.angle [rad]")), allowed(1e-8));
  EXPECT_LT(apart(w, exact, "coupler.B"), allowed(1e-8) * 0.17);
  EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-3 * w.run.energy_in_play);
}

// A coupler so stiff that what it rings with from its undeformed start is below the tolerance runs at the step of
// the rigid one, far above what its modes allow an explicit pair.
TEST(Implicit, AnAllButRigidCouplerRunsAtTheStepOfTheRigidOne) {
  const Whole rigid = implicit(scene(SliderCrank{.clearance = 0, .until = 0.01}), 1e-6);
  pintle::Scene s = flexible_crank("generalized-alpha", 1e-6, 207e17);
  const Whole stiff = run(s);
  ASSERT_EQ(stiff.run.status, pintle::Status::finished) << stiff.run.reason;
  EXPECT_LT(stiff.run.counts.steps, 2 * rigid.run.counts.steps);
}

// The paper's coupler with more shapes than a run follows, from its undeformed start at full speed.
pintle::Scene damped_coupler(const char* method, double tolerance) {
  FlexibleBeam beam;
  beam.elements = 8, beam.modes = "{frame: chord, count: 8}", beam.more = "damping: {ratios: 0.02}";
  pintle::Scene s = scene_of(text(FlexibleCrank{.coupler = text(beam), .until = 0.03, .tolerance = tolerance}));
  s.run.method = method;
  return s;
}

TEST(Implicit, AnUndeformedStartAtSpeedCostsAFlexibleCouplerNoAccuracy) {
  const Whole exact = run(damped_coupler("verner87", 1e-9));
  std::vector<double> error;
  const std::vector<double> tolerances{1e-4, 1e-5, 1e-6};
  for (const double tolerance : tolerances) {
    const Whole w = run(damped_coupler("generalized-alpha", tolerance));
    ASSERT_EQ(w.run.status, pintle::Status::finished) << tolerance << w.run.reason;
    error.push_back(relative_difference(w.column("crank.angle [rad]"), exact.column("crank.angle [rad]")));
    EXPECT_LT(error.back(), allowed(tolerance)) << tolerance;
  }
  EXPECT_GT(slopes(tolerances, error).back(), 0.5) << error.front() << " to " << error.back();
}

// ---- method: auto --------------------------------------------------------------------------------

pintle::Scene sprung(double stiffness, double damping) {
  pintle::Scene s = scene(SliderCrank{.clearance = 0, .until = 0.005, .method = "auto"});
  s.loads.push_back(spring("buffer", "ground.O", "slider", stiffness, damping, 0.1));
  return s;
}

TEST(Auto, TakesAnExplicitPairForWhatIsNotStiffAndSaysSo) {
  const pintle::Model model = pintle::build(sprung(1e3, 1));
  ASSERT_NE(model.scheme.tableau, nullptr);
  EXPECT_NE(model.scheme.reason.find("steps a second"), std::string::npos) << model.scheme.reason;
}

std::string taken(pintle::Scene s, double tolerance, double until, double every, int frames = 0) {
  s.run.tolerance = tolerance, s.run.until = until, s.output.every = every, s.output.frames = frames;
  return pintle::name(pintle::build(s).scheme);
}

TEST(Auto, TakesHighOrderWhereTheMotionIsSmoothTheToleranceFineAndStepsAreMany) {
  const pintle::Scene smooth = scene(SliderCrank{.clearance = 0, .method = "auto"}),
                      worn = scene(SliderCrank{.clearance = 5e-4, .method = "auto"});
  EXPECT_EQ(taken(smooth, 1e-8, 10, 1), "verner87");
  EXPECT_EQ(taken(smooth, 1e-8, 0.1, 0.1), "dopri5");
  EXPECT_EQ(taken(smooth, 1e-5, 10, 1), "dopri5");
  EXPECT_EQ(taken(worn, 1e-8, 10, 1), "dopri5");
  EXPECT_EQ(taken(flexible_crank("auto", 1e-8, 207e9), 1e-8, 1, 0.1), "verner87");
}

// Of eight shapes with 2 % damping the fastest make an explicit pair twenty times as dear; what generalised-α errs by is what it promises.
TEST(Auto, AtALooseToleranceAFlexibleCouplerEndsAsNearAsItsMethodPromises) {
  pintle::Scene s = damped_coupler("auto", 1e-4);
  s.run.until = 0.1;
  const Whole chosen = run(s);
  EXPECT_EQ(chosen.model.scheme.tableau, nullptr);
  s.run.method = "verner87", s.run.tolerance = 1e-9;
  EXPECT_LT(relative_difference(chosen.column("crank.angle [rad]"), run(s).column("crank.angle [rad]")), std::pow(1e-4, 2.0 / 3));
}

/// Evaluations of a run, which must end.
long evaluations(const Whole& w) {
  EXPECT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  return w.run.counts.evaluations;
}
Whole by(pintle::Scene s, const char* method, double tolerance) {
  s.run.method = method, s.run.tolerance = tolerance;
  return run(s);
}

/// A rod on a hinge, and a disc on a stiff shaft at its end, which rings after a blow for a part of the run.
pintle::Scene struck_shaft() {
  return pintle::read_scene_text(
      "bodies: {rod: {rigid: {mass: 0.5, inertia: 0.01}, points: {O: [-0.2, 0], P: [0.2, 0]}},\n"
      "  disc: {rigid: {mass: 0.5, inertia: 0.01}, pose: {at: [0.2, 0]}}}\n"
      "joints: {hinge: {revolute: [ground, rod.O]}, axle: {revolute: [rod.P, disc]}}\n"
      "parameters: {blow: 1e5 N m}\n"
      "forces: {push: {torque: 1, on: rod}, shaft: {torsion spring: [rod, disc], stiffness: 1e8, damping: 30},\n"
      "  there: {torque: \"blow*if(t < 0.05 s, 0, 1)\", on: disc}, back: {torque: \"-blow*if(t < 0.05 s, 0, 1)\", on: rod}}\n"
      "run: {until: 0.15}\noutput: {frames: 0, every: 0.01}\n",
      "scene.yaml");
}

// The slider-crank brought up to speed, its coupler with many shapes: those that do not ring hold explicit steps by stability alone.
TEST(Auto, GoesOnImplicitlyWhereATrialIsCheaper) {
  FlexibleBeam beam;
  beam.elements = 16, beam.modes = "{frame: chord, count: 24}", beam.more = "damping: {ratios: 0.02}";
  const pintle::Scene s = scene_of(text(FlexibleCrank{.coupler = text(beam), .speed = 0, .until = 0.015}) +
                                   "drivers: {motor: {angle: [ground, crank], law: \"150*if(t < 0.01, t^2/0.02, t - 0.005)\"}}\n");
  const Whole chosen = by(s, "auto", 1e-6), pair = by(s, "verner87", 1e-6);
  EXPECT_NE(chosen.model.scheme.tableau, nullptr);
  EXPECT_NE(chosen.run.switched.find("generalized-alpha"), std::string::npos) << chosen.model.scheme.reason;
  EXPECT_LT(2 * evaluations(chosen), evaluations(pair));
  EXPECT_LT(apart(chosen, pair, "coupler.B"), allowed(1e-6) * 0.17);
}

// With a clearance, the coupler's highest shapes decay fast, and the trial goes on until the journal strikes.
TEST(Auto, GoesOnImplicitlyThroughImpactsWhereADecayLimitsTheSteps) {
  FlexibleBeam beam;
  beam.elements = 32, beam.modes = "{frame: {tangent: A}, count: 30}", beam.more = "damping: {rayleigh: {alpha: 0 1/s, beta: 20 us}}";
  const pintle::Scene s = scene_of(text(FlexibleCrank{.coupler = text(beam), .until = 0.01, .clearance = 1e-5}));
  const Whole chosen = by(s, "auto", 1e-6);
  EXPECT_NE(chosen.model.scheme.tableau, nullptr);
  EXPECT_NE(chosen.run.switched.find("generalized-alpha"), std::string::npos) << chosen.model.scheme.reason;
  EXPECT_LT(evaluations(chosen), 1.5 * evaluations(by(s, "generalized-alpha", 1e-6)));
  EXPECT_LT(apart(chosen, by(s, "generalized-alpha", 1e-8), "coupler.B"), allowed(1e-6) * 0.17);
}

// What the blow leaves is far above the tolerance, and generalised-alpha would follow it by more evaluations.
TEST(Auto, GoesBackToItsPairWhileAccuracyLimitsTheSteps) {
  const Whole chosen = by(struck_shaft(), "auto", 1e-5);
  pintle_test::expect_says(chosen.run.switched, {"generalized-alpha from", "; dopri5 from t = 0.05", "; generalized-alpha from"});
  EXPECT_LT(2 * evaluations(chosen), evaluations(by(struck_shaft(), "dopri5", 1e-5)));
  EXPECT_LT(evaluations(chosen), 1.2 * evaluations(by(struck_shaft(), "generalized-alpha", 1e-5)));
  EXPECT_LT(std::abs(chosen.run.worst_unexplained), chosen.run.ledger_bound * chosen.run.energy_in_play);
}

TEST(Auto, StaysWithItsPairWhereAccuracyLimitsTheSteps) {
  const Whole chosen = by(damped_coupler("auto", 1e-9), "auto", 1e-9);
  EXPECT_EQ(chosen.run.switched, "");
  EXPECT_LT(evaluations(chosen), 1.01 * evaluations(by(damped_coupler("auto", 1e-9), pintle::name(chosen.model.scheme).c_str(), 1e-9)));
}

TEST(Auto, TakesTheSameMethodWhateverIsWrittenOut) {
  const pintle::Scene smooth = scene(SliderCrank{.clearance = 0, .method = "auto"});
  for (const double until : {0.1, 1.0, 3.0, 10.0})
    for (const auto& [every, frames] : {std::pair{until, 0}, {until / 1e5, 0}, {until, 100'000}})
      EXPECT_EQ(taken(smooth, 1e-8, until, every, frames), taken(smooth, 1e-8, until, 0)) << until << " " << every << " " << frames;
}

TEST(Auto, TakesGeneralizedAlphaForAStiffSpringOrDamperAndNamesIt) {
  for (const auto& [k, c] : {std::pair{1e14, 1e6}, {0.0, 1e9}}) {
    const pintle::Model model = pintle::build(sprung(k, c));
    EXPECT_EQ(model.scheme.tableau, nullptr) << k << " " << c;
    EXPECT_NE(model.scheme.reason.find("buffer"), std::string::npos) << model.scheme.reason;
    EXPECT_EQ(model.system.integrals.back().account, pintle::Account::scheme);
  }
}

// The rate of a spring on a free body is known: √(k/m).
TEST(Auto, SpectrumOfOneBodyOnASpringIsItsFrequency) {
  pintle::Scene s;
  s.bodies = {body("mass", 2, 0.1, {})};
  s.loads = {spring("spring", "ground", "mass", 8, 3, 1)};
  s.run.until = 1;
  const pintle::Model model = pintle::build(s);
  const pintle::RateSpectrum found = pintle::spectrum(s, model.system);
  EXPECT_DOUBLE_EQ(found.fastest.rate, 2);
  EXPECT_DOUBLE_EQ(found.most_damped.decay, 1.5);
  EXPECT_EQ(found.motion, 2);  // nothing else moves it
}

// Nothing that decays fast says how fast the motion is that is to be followed: one rod, pushed from rest, each stiff in its own way.
pintle::Scene pushed_rod(const std::string& what) {
  return pintle::read_scene_text(
      "ground: {points: {G: [0.1, 0.5]}}\nbodies: {rod: {rigid: {mass: 0.5, inertia: 0.01}, points: {O: [-0.2, 0], P: [0.2, 0]}},\n"
      "  twin: {rigid: {mass: 0.5, inertia: 0.01}, points: {P: [0.3, 0]}, pose: {at: [0.2, 0]}}}\n"
      "joints: {hinge: {revolute: [ground, rod.O]}, axle: {revolute: [rod.P, twin]}}\n" +
          what + "\nrun: {until: 0.2}\noutput: {frames: 0, every: 0.1}\n",
      "scene.yaml");
}
const std::vector<std::string> stiff_parts{
    "states: {lag: {rate: \"(sin(3*t) - lag)/(1 us)\"}}\nforces: {push: {torque: 1 N m*lag, on: rod}}",
    "states: {p: {rate: \"1e6*(sin(3*t) - q)\"}, q: {rate: 1e6*(p - q)}}\nforces: {push: {torque: 1 N m*q, on: rod}}",
    "forces: {push: {torque: 1, on: rod}, d: {spring: [ground.G, rod.P], damping: 1e6}}",
    "forces: {push: {torque: 1, on: rod}, d: {spring: [ground.G, twin.P], stiffness: 1e4, damping: 1e6, free length: 0.5}}",
    "forces: {push: {torque: 1, on: rod}, d: {torsion spring: [rod, twin], damping: 1e4}}",
    "forces: {push: {torque: 1, on: rod}, d: {torque: -1e4 N m s/rad*twin.speed, on: twin}}",
    "forces: {push: {torque: 1, on: rod}, d: {spring: [ground.G, twin.P], law: 1e6 N s/m*d.rate}}",
    "forces: {push: {torque: 1, on: rod}, d: {belt: [rod.O, twin], radii: [0.05, 0.05], stiffness: 1e4, damping: 1e5, pretension: 1}}",
};

TEST(Auto, NeedsFewStepsWhateverDecaysFastAndNamesIt) {
  for (const std::string& part : stiff_parts) {
    const Whole w = run(pushed_rod(part));
    EXPECT_EQ(w.run.status, pintle::Status::finished) << part << w.run.reason;
    EXPECT_EQ(w.model.scheme.tableau, nullptr) << part;
    EXPECT_LT(w.run.counts.steps, 5000) << part;  // of 2e5 that stability would ask for of a pair
    EXPECT_NE(w.model.scheme.reason.find("1/s"), std::string::npos) << w.model.scheme.reason;
  }
}

TEST(Auto, SeesNoHurryInStatesThatFollowEachOtherSlowly) {  // fast by the units of their numbers alone: eigenvalues ±1i
  const pintle::Scene s = pushed_rod("states: {p: {rate: 1e9*q}, q: {rate: -1e-9*p}}\nforces: {push: {torque: 1, on: rod}}");
  const pintle::RateSpectrum found = pintle::spectrum(s, pintle::build(s).system);
  EXPECT_NEAR(found.fastest.rate, 1, 0.05);
  EXPECT_EQ(found.most_damped.decay, 0);
}

TEST(Method, WarnsWhereStabilityHoldsItsStepsAndNotOtherwise) {
  const auto warned = [](const char* damping, const char* method, const std::string& more = "") {
    pintle::Scene s =
        pushed_rod("forces: {push: {torque: 1, on: rod}, d: {spring: [ground.G, rod.P], damping: " + std::string(damping) + "}}");
    s.run.method = method, s.run.tolerance = 1e-6;
    if (!more.empty()) s.run.constraints = more;
    std::string all;
    for (const std::string& w : run(s).run.warnings) all += w;
    return all;
  };
  for (const char* method : {"dopri5", "rkf45", "verner87"}) {
    pintle_test::expect_says(warned("1e5", method), {"stability, not accuracy", "the spring \"d\"", "take method: auto"});
    EXPECT_EQ(warned("2", method), "") << method;
  }
  pintle_test::expect_says(warned("1e5", "dopri5", "partitioning"), {"remove constraints: partitioning"});
  EXPECT_EQ(warned("1e5", "generalized-alpha"), "");
}

TEST(Auto, ChoosesTheSameForTheSameSceneAndRunsToItsEnd) {
  const Whole a = run(sprung(1e14, 1e6)), b = run(sprung(1e14, 1e6));
  ASSERT_EQ(a.run.status, pintle::Status::finished) << a.run.reason;
  EXPECT_EQ(a.run.trajectory.data, b.run.trajectory.data);
}

TEST(Method, RefusesConstraintsThatItCannotKeep) {
  const auto rejected = [](const char* method, const char* constraints) {
    pintle::Scene s = scene(SliderCrank{.clearance = 0});
    s.run.method = method, s.run.constraints = constraints;
    return pintle_test::refusal_by([&] { pintle::build(s); });
  };
  EXPECT_NE(rejected("generalized-alpha", "partitioning").find("partitioning"), std::string::npos);
  EXPECT_NE(rejected("generalized-alpha", "index 3").find("write projection"), std::string::npos);
  EXPECT_NE(rejected("dopri6", "projection").find("Did you mean"), std::string::npos) << rejected("dopri6", "projection");
  EXPECT_EQ(rejected("auto", "partitioning"), "accepted");
}

TEST(Method, ConstraintsAtIndexThreeAreRefusedWithTheRemedy) {
  const char* text = "bodies: {a: {rigid: {mass: 1, inertia: 1}}}\nrun:\n  until: 1\n  constraints: index 3\n";
  pintle_test::expect_refused([&] { pintle::read_scene_text(text, "old.yaml"); }, {"old.yaml:4", "use projection"});
}

}  // namespace
}  // namespace pintle_scenes::implicit_test
