// What a run says of a flexible body that its model does not do justice to, and what stands in for what a scene leaves out.
// Numbers are closed forms of uniform beams.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framework/configuration/equilibrium.h"
#include "framework/output/results.h"
#include "tests/scenes/flexible/unit_beam.h"

namespace pintle::flexible_traps_test {
namespace {

using namespace unit_beam_scenes;

// ---- stiffening that a run sees ----

std::string column(double push, const std::string& stiffening) {
  return unit_beam("{frame: chord, count: 4}", "    stiffening: " + stiffening + "\n") +
         "joints: {foot: {revolute: [ground, beam.A]}, head: {slot: [ground, beam.B]}}\nforces: {push: {force: [" + std::to_string(-push) +
         ", 0], at: beam.B}}\nrun: {until: 0.01}\n";
}

TEST(FlexibleTraps, ARunWarnsByHowMuchLoadsSoftenAColumnThatDoesNotFeelThem) {
  // Half of Euler's load: ω² falls to a half.
  const std::string words = "its points lower its first frequency by ";
  const Ran linear = ran(column(pi * pi / 2, "none"));
  EXPECT_NEAR(said(linear.run.warnings, words), 100 * (1 - std::sqrt(0.5)), 2 * last_digit);
  EXPECT_TRUE(warns(linear.run.warnings, "add stiffening: axial"));
  EXPECT_EQ(said(linear.run.warnings, words), said(build_with_preliminary_run(scene_of(column(pi * pi / 2, "none"))).warnings, words));
  EXPECT_FALSE(warns(ran(column(pi * pi / 2, "axial")).run.warnings, "stiffening"));
  EXPECT_FALSE(warns(ran(column(0.01 * pi * pi, "none")).run.warnings, "stiffening"));  // half a percent
  EXPECT_TRUE(warns(ran(column(2 * pi * pi, "none")).run.warnings, "buckle"));
}

TEST(FlexibleTraps, ARunWarnsOfASpinThatComesInItsCourse) {
  // A torque brings the blade, hinged where its frame is clamped, to half of its first frequency; no key tells that spin.
  const auto spun = [](const std::string& stiffening) {
    return ran(unit_beam("{frame: {tangent: A}, count: 3}", "    stiffening: " + stiffening + "\n") +
               "joints: {axle: {revolute: [ground, beam.A]}}\nforces: {motor: {torque: \"" + std::to_string(first / 2 / 3 / 17.5) +
               "*step(t, 0, 5)\", on: beam.A}}\nrun: {until: 20, tolerance: 1e-6}\n");
  };
  const Ran linear = spun("none");
  ASSERT_NEAR(linear.column("beam.speed [rad/s]").back(), first / 2, 0.02 * first);
  // Southwell: stretching adds 1.193 Ω² to ω².
  EXPECT_NEAR(said(linear.run.warnings, "raise its first frequency by "), 100 * (std::sqrt(1 + 1.193 / 4) - 1), 1);
  EXPECT_TRUE(warns(linear.run.warnings, "add stiffening: rotation"));
  EXPECT_FALSE(warns(spun("rotation").run.warnings, "add stiffening"));
}

TEST(FlexibleTraps, ARunEndsWhereABodyBendsByMoreThanItsSize) {
  const auto blade = [](const std::string& stiffening) {
    return ran(
        unit_beam("{frame: {tangent: A}, count: 3}", "    stiffening: " + stiffening + "\n") +
        "joints: {axle: {revolute: [ground, beam.A]}}\ndrivers: {motor: {angle: [ground, beam.A], law: " + std::to_string(1.2 * first) +
        "*t}}\nforces: {side: {force: [0, 3e-3], at: beam.B, follows: true}}\nrun: {until: 8, tolerance: 1e-6}\n");
  };
  const Ran linear = blade("none");
  EXPECT_EQ(linear.run.status, Status::failed);
  EXPECT_NE(linear.run.reason.find("\"beam\" bent by"), std::string::npos) << linear.run.reason;
  // Grows from u = 1e-3/(1.44 − 1) by cosh(√0.44 ω t): past 1 before the hundredth row, past 1e12 by the end.
  EXPECT_LT(linear.run.t_end, 4);
  EXPECT_GT(linear.run.trajectory.rows(), 100u);
  EXPECT_EQ(blade("rotation").run.status, Status::finished);
}

// ---- shapes that a contact or inertia misses ----

std::string struck(const std::string& modes, const std::string& law) {
  return "bodies:\n"
         "  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [0, 0], A: [50 mm, 0]}}\n"
         "  rod:\n    beam: {from: A, to: B, section: {circle: 10 mm}, theory: euler, rotary inertia: false, elements: 40, young: 207 GPa, "
         "poisson: 0.3, mass: 0.21}\n"
         "    points: {A: [0, 0], B: [120 mm, 0]}\n    modes: " +
         modes +
         "\n"
         "  slider: {rigid: {mass: 0.14, inertia: 1e-4}}\n"
         "joints:\n  main: {revolute: [ground, crank.O]}\n  pin: {revolute: [crank.A, rod.A]}\n"
         "  gudgeon: {revolute: [rod.B, slider], clearance: {radial: 0.01 mm, bearing radius: 10 mm, bearing: slider, normal: "
         "{lankarani-nikravesh: {restitution: 0.9, " +
         law +
         "}}}}\n"
         "  guide: {prismatic: [ground, slider]}\nstart: {crank: {angle: 0, speed: 150}}\nrun: {until: 1 ms}\n";
}
const char* const steel = "young: 207 GPa, poisson: 0.3";

TEST(FlexibleTraps, AContactWhoseBodyCannotYieldThereIsDoubted) {
  // Four chord modes hold one of stretch, sin(πx/2L). A blow at the free end strains the free rod by x/L:
  // of ∫x² = 1/3 that takes 2 (∫x cos(πx/2))².
  const double taken = 2 / pi - 4 / (pi * pi), mesh = 0.1;
  const std::vector<std::string> few = build(scene_of(struck("{frame: chord, count: 4}", steel))).warnings;
  EXPECT_NEAR(said(few, "\"gudgeon\" strikes \"rod\" where its shapes cover only "), 100 * 6 * taken * taken, last_digit + mesh);
  EXPECT_TRUE(warns(few, "along its x axis: peak forces and hysteresis will be wrong; use craig-bampton"));
  EXPECT_FALSE(warns(build(scene_of(struck("{frame: chord, craig-bampton: {count: 2}}", steel))).warnings, "strikes"));
  EXPECT_FALSE(warns(build(scene_of(struck("{frame: chord, count: 8}", steel))).warnings, "strikes"));
  EXPECT_FALSE(warns(build(scene_of(struck("{frame: chord, count: 4}", "stiffness: 1e6"))).warnings, "strikes"));  // a soft bush
}

/// Held at A and at M, so much of the length from B.
std::string overhung(double length, int count) {
  const std::string from = std::to_string(1 / (1 + length));
  std::string text = unit_beam("{frame: {chord: [A, M]}, craig-bampton: {count: " + std::to_string(count) + "}}") +
                     "joints: {foot: {revolute: [ground, beam.A]}, head: {slot: [ground, beam.M]}}\nrun: {until: 1}\n";
  text.replace(text.find("B: [1, 0]}"), 10, "M: [" + from + ", 0], B: [1, 0]}");
  return text;
}

TEST(FlexibleTraps, AFreeEndThatStaticShapesLeaveRigidIsDoubted) {
  // A load even along span 1 and overhang a: moments ½[(1 − a²)x − x²] and ½s², energies ∫M². Shapes straight in M between
  // the ends leave out 1/720 of the span's, and all of the overhang's.
  const double a = 0.5, c = 1 - a * a, span = (c * c / 3 - c / 2 + 1. / 5) / 4, beyond = std::pow(a, 5) / 20;
  const std::string words = "the shapes of \"beam\" cover only ";
  const std::vector<std::string> warnings = build(scene_of(overhung(a, 0))).warnings;
  EXPECT_NEAR(said(warnings, words), 100 * (span - 1. / 720) / (span + beyond), last_digit + 0.05);
  EXPECT_TRUE(warns(warnings, "increase the count of craig-bampton until its shapes, which now end at "));
  EXPECT_FALSE(warns(build(scene_of(overhung(a, 1))).warnings, words));
  EXPECT_FALSE(warns(build(scene_of(overhung(1e-3, 0))).warnings, words));
}

// Bending comes first, so that one shape does nothing for an overhang that is pulled. The remedy must not name a count that cannot help.
TEST(FlexibleTraps, ARigidOverhangAlongItsAxisIsNotSaidToBeMendedByOneShape) {
  const std::string words = "of its deformation under acceleration along x";
  const std::vector<std::string> warnings = build(scene_of(overhung(10, 3))).warnings;
  EXPECT_TRUE(warns(warnings, words));
  EXPECT_FALSE(warns(warnings, "to 1 or more"));
  EXPECT_TRUE(warns(warnings, "increase the count of craig-bampton until"));
  EXPECT_FALSE(warns(build(scene_of(overhung(10, 40))).warnings, words));
}

TEST(FlexibleTraps, ARecordedStressWithoutAShapeThatStretchesIsDoubtedOnce) {
  const std::string words = "no shape of \"beam\" stretches it: its section force N is recorded as 0";
  const auto warnings_of = [&](const std::string& modes, const std::string& output) {
    const std::vector<std::string> all =
        build(scene_of(unit_beam(modes) +
                       "joints: {foot: {revolute: [ground, beam.A]}, head: {slot: [ground, beam.B]}}\nrun: {until: 1}\n" + output))
            .warnings;
    return std::count_if(all.begin(), all.end(), [&](const std::string& w) { return w.find(words) != std::string::npos; });
  };
  EXPECT_EQ(warnings_of("{frame: {chord: [A, B]}, count: 3}", "output: {stress: [beam.A, beam.B]}\n"), 1);
  EXPECT_EQ(warnings_of("{frame: {chord: [A, B]}, count: 3}", ""), 0);
  EXPECT_EQ(warnings_of("{frame: {chord: [A, B]}, craig-bampton: {count: 2}}", "output: {stress: [beam.A, beam.B]}\n"), 0);
}

// ---- what is recorded ----

TEST(FlexibleTraps, ARecordedPointOfABodyThatStiffensComesNearerAsItBends) {
  // Under a force at its end w = δ(3x² − x³)/2, and ½∫w′² = 0.6 δ².
  const double force = 0.03, bent = force / 3;
  for (const char* stiffening : {"rotation", "axial", "none"}) {
    const Scene scene = scene_of(
        unit_beam("{frame: {tangent: A}, craig-bampton: {count: 0}}", std::string("    stiffening: ") + stiffening + "\n") + clamp +
        "forces: {side: {force: [0, " + std::to_string(force) + "], at: beam.B}}\nrun: {until: 1}\noutput: {points: [beam.B]}\n");
    const Model model = build(scene);
    const Equilibrium rest = find_equilibrium(scene, model, assemble(scene, model));
    ASSERT_TRUE(rest.found) << rest.reason;
    const double shorter = std::string(stiffening) == "none" ? 0 : 0.6 * bent * bent;
    EXPECT_NEAR(rest.table.column("beam.B.y [m]")[0], bent, 1e-3 * bent) << stiffening;  // the pull adds δ² beside 1
    EXPECT_NEAR(rest.table.column("beam.B.x [m]")[0], 1 - shorter, 1e-3 * 0.6 * bent * bent) << stiffening;
  }
}

TEST(FlexibleTraps, ARecordedPointThatAJointHoldsIsWhereTheJointIs) {
  const Ran r = ran(unit_beam("{frame: chord, craig-bampton: {count: 1}}", "    stiffening: rotation\n") +
                    "  block: {rigid: {mass: 1, inertia: 1}, pose: {at: [1, 0]}}\n"
                    "joints: {foot: {revolute: [ground, beam.A]}, head: {revolute: [beam.B, block]}, guide: {prismatic: [ground, block]}}\n"
                    "forces: {turn: {torque: 0.1, on: beam.A}}\nrun: {until: 0.5}\noutput: {points: [beam.B]}\n");
  const auto x = r.column("beam.B.x [m]"), block = r.column("block.x [m]");
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], block[i], 1e-11);
}

TEST(FlexibleTraps, RunJsonListsTheFrequencyAndDampingOfEachShape) {
  const Scene scene =
      scene_of(unit_beam("{frame: {tangent: A}, count: 2}", "    damping: {ratios: [0.01, 0.03]}\n") + clamp + "run: {until: 0.01}\n");
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  const auto body = nlohmann::json::parse(run_json(scene, model, assembly, simulate(scene, model, assembly)))["flexible bodies"][0];
  const double mesh = 1e-5;  // (βh)⁴/720 with βh = 0.23
  ASSERT_EQ(body["frequencies [Hz]"].size(), 2u);
  EXPECT_NEAR(body["frequencies [Hz]"][0].get<double>() * 2 * pi, first, mesh * first);
  EXPECT_NEAR(body["frequencies [Hz]"][1].get<double>() * 2 * pi, 4.6940911330 * 4.6940911330, mesh * 22.03);
  EXPECT_EQ(body["damping ratios"], nlohmann::json::parse("[0.01, 0.03]"));
}

// ---- what a scene leaves out ----

TEST(BuiltOrder, NamesTheSameThingsInSceneAndSystem) {
  const std::string gap = "clearance: {radial: 1 mm, bearing radius: 20 mm, bearing: b, normal: {hertz: {stiffness: 1e9}}";
  const Scene scene = scene_of(
      "bodies: {a: {rigid: {mass: 1, inertia: 1}}, b: {rigid: {mass: 1, inertia: 1}}, c: {rigid: {mass: 1, inertia: 1}}}\n"
      "joints:\n  one: {revolute: [a, b], " +
      gap + "}}\n  two: {revolute: [ground, a]}\n  three: {revolute: [b, c], " + gap +
      ", model: massless link}}\n"
      "  four: {slot: [ground, c]}\n  five: {revolute: [ground, b], " +
      gap +
      "}}\n"
      "drivers: {six: {angle: [ground, a], law: t}, seven: {angle: [ground, c], law: t}}\n"
      "forces: {eight: {force: [1, 0], at: a}, nine: {torque: 1, on: b}, ten: {spring: [ground, b], stiffness: 3, free length: 0.1}}\nrun: "
      "{until: 1}\n");
  const Model model = build(scene);
  ASSERT_EQ(model.order.joints.size(), scene.joints.size());
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const auto& names = scene.joints[i].clearance ? model.system.contact_names : model.system.joint_names;
    EXPECT_EQ(names[static_cast<std::size_t>(model.order.joints[i])], scene.joints[i].name);
  }
  ASSERT_EQ(model.order.drivers.size(), scene.drivers.size());
  for (std::size_t i = 0; i < scene.drivers.size(); ++i)
    EXPECT_EQ(model.system.joint_names[static_cast<std::size_t>(model.order.drivers[i])], scene.drivers[i].name);
  ASSERT_EQ(model.order.loads.size(), scene.loads.size());
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    EXPECT_EQ(model.system.force_names[static_cast<std::size_t>(model.order.loads[i])], scene.loads[i].name);
}

TEST(ModesLeftOut, AreThoseThatTheSceneExcites) {
  const auto shapes = [](const std::string& modes) {
    return build(scene_of(unit_beam(modes) + "joints: {foot: {revolute: [ground, beam.A]}, head: {slot: [ground, beam.B]}}\n"
                                             "forces: {side: {force: [0, \"sin(3*t)\"], at: beam.B}}\nrun: {until: 1}\n"))
        .flexible.at(0);
  };
  const FlexibleReport unsaid = shapes("{frame: chord}"), automatic = shapes("{frame: chord, keep: auto}");
  ASSERT_TRUE(unsaid.choice);
  EXPECT_LE(unsaid.shapes, considered_modes);
  EXPECT_EQ(unsaid.frequencies, automatic.frequencies);
  EXPECT_EQ(shapes("{frame: chord, keep: all}").shapes, 60);
}

TEST(FrameLeftOut, IsTiedToWhatHoldsTheBodyWhereModesAreChosenByTheScene) {
  const auto basis = [](const std::string& modes, const std::string& joints) {
    return build(scene_of(unit_beam(modes) + "joints: {" + joints + "}\ngravity: [0, -1]\nrun: {until: 0.1}\n")).flexible.at(0).basis;
  };
  const std::string pins = "foot: {revolute: [ground, beam.A]}, head: {slot: [ground, beam.B]}", clamps = "root: {weld: [ground, beam.A]}",
                    hinge = "foot: {revolute: [ground, beam.A]}";
  EXPECT_EQ(basis("{keep: auto}", pins), "normal modes, chord frame");
  EXPECT_EQ(basis("{}", pins), "normal modes, chord frame");
  EXPECT_EQ(basis("{craig-bampton: {keep: auto}}", clamps), "Craig-Bampton, tangent frame");
  EXPECT_EQ(basis("{keep: auto}", hinge), "normal modes, mean axes");
  EXPECT_EQ(basis("{frame: mean axes, keep: auto}", pins), "normal modes, mean axes");
  EXPECT_EQ(basis("{count: 4}", pins), "normal modes, mean axes");
}

}  // namespace
}  // namespace pintle::flexible_traps_test
