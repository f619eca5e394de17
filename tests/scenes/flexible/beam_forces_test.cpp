// Section forces, stress and stiffening of loaded beams in equilibrium, against beam theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"

namespace pintle_scenes::beam_forces_test {
namespace {

using namespace pintle;

Equilibrium rest_of(const std::string& text) {
  const Scene scene = ready_for_statics(read_scene_text(text, "beam.yaml"));
  const Model model = build(scene);
  return find_equilibrium(scene, model, assemble(scene, model), 0);
}
double value(const Equilibrium& rest, const std::string& column) { return rest.table.column(column).at(0); }
bool says(const std::vector<std::string>& lines, const std::string& words) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

// 10 mm x 10 mm, so that A = 1e-4 m2 and W = 1e-6/6 m3
const std::string steel = "section: {rectangle: [10 mm, 10 mm]}, theory: euler, young: 200 GPa, poisson: 0.3, density: 8000 kg/m^3";
double stress(double N, double M) { return std::abs(N) / 1e-4 + 6e6 * std::abs(M); }

// Held in the middle, loaded at one end: half of it carries nothing.
TEST(BeamForces, AtAJointAreThoseOfTheLoadedSide) {
  const Equilibrium rest = rest_of("bodies:\n  bm:\n    beam: {from: A, to: B, " + steel +
                                   "}\n    points: {A: [0, 0], Mi: [0.5 m, 0], B: [1 m, 0]}\n"
                                   "    modes: {frame: {tangent: Mi}, craig-bampton: {count: 2}}\n"
                                   "joints: {a: {weld: [ground.C, bm.Mi]}}\nground: {points: {C: [0.5 m, 0]}}\n"
                                   "forces: {push: {force: [1000 N, -10 N], at: bm.B}}\nrun: {until: 0.1 s}\n"
                                   "output: {stress: [bm.Mi, bm.A, bm.B]}\n");
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(value(rest, "bm.Mi.N [N]"), 1000, 1e-5);
  EXPECT_NEAR(std::abs(value(rest, "bm.Mi.V [N]")), 10, 1e-5);
  EXPECT_NEAR(std::abs(value(rest, "bm.Mi.M [N m]")), 5, 1e-6);
  EXPECT_NEAR(value(rest, "bm.Mi.stress [Pa]"), stress(1000, 5), 1e-6 * stress(1000, 5));
  EXPECT_NEAR(value(rest, "bm.A.stress [Pa]"), 0, 10);
}

// An angle of two legs: at the corner N of one leg is V of the other.
TEST(BeamForces, AtACornerAreThoseOfTheMoreStressedLeg) {
  const Equilibrium rest = rest_of("bodies:\n  bm:\n    beam: {through: [A, K, B], " + steel +
                                   "}\n    points: {A: [0, 0], K: [0.4 m, 0], B: [0.4 m, 0.3 m]}\n"
                                   "    modes: {frame: {tangent: A}, craig-bampton: {count: 2}}\n"
                                   "joints: {a: {weld: [ground, bm.A]}}\n"
                                   "forces: {push: {force: [100 N, -30 N], at: bm.B}}\nrun: {until: 0.1 s}\n"
                                   "output: {stress: [bm.K]}\n");
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(std::abs(value(rest, "bm.K.N [N]")), 100, 1e-4);
  EXPECT_NEAR(std::abs(value(rest, "bm.K.V [N]")), 30, 1e-4);
  EXPECT_NEAR(std::abs(value(rest, "bm.K.M [N m]")), 30, 1e-5);
  EXPECT_NEAR(value(rest, "bm.K.stress [Pa]"), stress(100, 30), 1e-6 * stress(100, 30));
}

// Loads on a linear body leave its stiffness as it is, which the answer has to say.
TEST(BeamForces, ThatWouldStiffenOrBuckleTheBeamAreWarnedOf) {
  const auto column = [](double N) {
    return "bodies:\n  bm:\n    beam: {from: A, to: B, " + steel +
           "}\n    points: {A: [0, 0], B: [0.5 m, 0]}\n    modes: {frame: {tangent: A}, craig-bampton: {count: 2}}\n"
           "joints: {a: {weld: [ground, bm.A]}}\nforces: {push: {force: [" +
           std::to_string(N) + " N, -10 N], at: bm.B}}\nrun: {until: 0.1 s}\n";
  };
  const double euler = std::numbers::pi * std::numbers::pi * 200e9 * 1e-8 / 12;  // π² E I/(2 L)², 2 L = 1 m
  EXPECT_TRUE(says(rest_of(column(-1.2 * euler)).warnings, "would buckle"));
  EXPECT_TRUE(says(rest_of(column(0.6 * euler)).warnings, "stiffening: axial"));
  EXPECT_FALSE(says(rest_of(column(0.001 * euler)).warnings, "stiffening"));
  const Scene scene = read_scene_text(column(-1.2 * euler), "beam.yaml");
  const Model model = build(scene);
  const Equilibrium rest = find_equilibrium(scene, model, assemble(scene, model), 0);
  EXPECT_TRUE(says(linearize(scene, model, rest.state, Laws::hold).notes, "would buckle"));
}

TEST(BeamForces, WithoutAFibreAreWarnedOf) {
  const std::string text =
      "bodies:\n  bm:\n    beam: {from: A, to: B, section: {area: 1e-4 m^2, second moment: 8e-10 m^4}, theory: euler, young: 200 GPa, "
      "poisson: 0.3, density: 8000 kg/m^3}\n    points: {A: [0, 0], B: [0.5 m, 0]}\n"
      "    modes: {frame: {tangent: A}, craig-bampton: {count: 2}}\njoints: {a: {weld: [ground, bm.A]}}\n"
      "forces: {push: {force: [0, -10 N], at: bm.B}}\nrun: {until: 0.1 s}\n";
  EXPECT_FALSE(says(rest_of(text).warnings, "fibre"));
  EXPECT_TRUE(says(rest_of(text + "output: {stress: [bm.A]}\n").warnings, "has no `fibre`"));
}

TEST(BeamForces, AreNotComputedWithAnElementLostInRounding) {
  const auto text = [](double gap) {
    return "bodies:\n  bm:\n    beam: {from: A, to: B, " + steel + "}\n    points: {A: [0, 0], M: [" + std::to_string(0.5 - gap) +
           ", 0], B: [0.5 m, 0]}\n    modes: {frame: {tangent: A}, craig-bampton: {count: 1}}\n"
           "joints: {a: {weld: [ground, bm.A]}}\nforces: {push: {force: [0, -10 N], at: bm.B}}\nrun: {until: 0.1 s}\n"
           "output: {points: [bm.B]}\n";
  };
  pintle_test::expect_says(pintle_test::refusal_by([&] { rest_of(text(1e-5)); }), {"bodies.bm", "shortest element", "rounding"});
  const double F = 10, L = 0.5, EI = 200e9 * 1e-8 / 12;
  for (const double gap : {1e-3, 1e-4}) {
    const Equilibrium rest = rest_of(text(gap));
    EXPECT_NEAR(value(rest, "bm.B.uy [m]"), -F * L * L * L / (3 * EI), 1e-3 * F * L * L * L / (3 * EI)) << gap;
  }
}

}  // namespace
}  // namespace pintle_scenes::beam_forces_test
