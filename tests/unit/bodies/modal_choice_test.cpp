// Which modes a scene needs, what is said of those that are kept, and when a reader is warned.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/preliminary_run.h"
#include "framework/scene/yaml/reader.h"

namespace pintle::modal_choice_test {
namespace {

constexpr double pi = std::numbers::pi;
/// Twenty elements resolve the lowest modes of a beam to this.
constexpr double mesh = 2e-3;

const std::string steel = "young: 200 GPa, poisson: 0.3, density: 8000 kg/m^3, theory: euler, rotary inertia: false";

/// A rod of 1 m, 20 mm high and 10 mm wide, from A to B.
std::string rod(const std::string& rest) {
  return "bodies:\n  rod:\n    beam: {from: A, to: B, section: {rectangle: [20 mm, 10 mm]}, " + steel +
         "}\n    points: {A: [0, 0], B: [1, 0]}\n" + rest;
}
std::string clamped(const std::string& modes, const std::string& rest) {
  return rod("    modes: " + modes + "\njoints: {root: {weld: [ground, rod.A]}}\n" + rest);
}
const double EI = 200e9 * 0.01 * 8e-6 / 12, rhoA = 8000 * 2e-4;
double cantilever(double beta) { return beta * beta * std::sqrt(EI / rhoA); }  // [rad/s], L = 1 m

Model built(const std::string& text) { return build(with_pieces(read_scene_text(text, "test.yaml"))); }
Model with_preliminary_run(const std::string& text) { return build_with_preliminary_run(with_pieces(read_scene_text(text, "test.yaml"))); }

Run ran(const std::string& text) {
  const Scene scene = read_scene_text(text, "test.yaml");
  const Model model = build(scene);
  return simulate(scene, model, assemble(scene, model));
}

bool warns(const std::vector<std::string>& warnings, const std::string& of) {
  for (const std::string& w : warnings)
    if (w.find(of) != std::string::npos) return true;
  return false;
}

std::string crank(const std::string& modes) {
  return "bodies:\n"
         "  crank: {rigid: {mass: 0.2, inertia: 1e-4}, points: {O: [0, 0], A: [50 mm, 0]}}\n"
         "  rod:\n    beam: {from: A, to: B, section: {circle: 6 mm}, elements: 12, " +
         steel + "}\n    points: {A: [0, 0], M: [150 mm, 0], B: [300 mm, 0]}\n    modes: " + modes +
         "\n    damping: {ratios: 0.02}\n"
         "  slider: {rigid: {mass: 0.1, inertia: 1e-4}}\n"
         "joints:\n  main: {revolute: [ground, crank.O]}\n  pin: {revolute: [crank.A, rod.A]}\n  gudgeon: {revolute: [rod.B, slider]}\n"
         "  guide: {prismatic: [ground, slider]}\n"
         "drivers: {motor: {angle: [ground, crank], law: 3000 rpm*t}}\n"
         "start: {crank: {angle: 0}}\nrun: {until: 25 ms, tolerance: 1e-6}\noutput: {points: [rod.M]}\n";
}
// η̈ + 2ζω η̇ + ω²η = Q by many small Runge–Kutta steps.
double integrated(double omega, double zeta, double t_end, double q0, double q1) {
  const int n = 20000;
  const double h = t_end / n;
  double x = 0, v = 0;
  const auto a = [&](double t, double xx, double vv) { return q0 + (q1 - q0) * t / t_end - 2 * zeta * omega * vv - omega * omega * xx; };
  for (int i = 0; i < n; ++i) {
    const double t = i * h;
    const double k1 = v, l1 = a(t, x, v), k2 = v + h / 2 * l1, l2 = a(t + h / 2, x + h / 2 * k1, v + h / 2 * l1);
    const double k3 = v + h / 2 * l2, l3 = a(t + h / 2, x + h / 2 * k2, v + h / 2 * l2), k4 = v + h * l3,
                 l4 = a(t + h, x + h * k3, v + h * l3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return x;
}

TEST(OscillatorResponse, IsExactForLoadsLinearInTimeWhateverTheDamping) {
  const std::vector<double> t{0, 0.1, 0.35, 0.7};
  const Eigen::Vector4d omega(9, 9, 9, 9), zeta(0, 0.3, 1, 2.5);
  Eigen::MatrixXd Q(4, 4);
  for (int k = 0; k < 4; ++k) Q.col(k).setConstant(2 + 5 * t[static_cast<std::size_t>(k)]);
  const Eigen::MatrixXd eta = oscillator_response(omega, zeta, t, Q);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(eta(i, 3), integrated(9, zeta[i], 0.7, 2, 5.5), 1e-11) << zeta[i];  // of 0.1
  EXPECT_NEAR(eta(0, 1), 2 / 81. * (1 - std::cos(0.9)) + 5 / 81. * (0.1 - std::sin(0.9) / 9), 1e-15);
}

TEST(OscillatorResponse, StaysFiniteWhereDampingIsOvercriticalByFar) {
  const std::vector<double> t{0, 1, 2};
  const Eigen::MatrixXd eta =
      oscillator_response(Eigen::VectorXd::Constant(1, 1e6), Eigen::VectorXd::Constant(1, 1e3), t, Eigen::MatrixXd::Ones(1, 3));
  EXPECT_TRUE(eta.allFinite());
  EXPECT_NEAR(eta(0, 2), 1e-12, 1e-15);  // the static answer
}

TEST(RigidRun, LoadsOnABodyAreInEquilibriumWhateverHoldsIt) {
  const Scene scene = read_scene_text(
      "gravity: [1, -9.81]\nground: {points: {C: [0.2, 0.5], W: [1, 0]}}\n" +
          rod("    modes: {frame: chord, count: 2}\n"
              "  bob: {rigid: {mass: 0.5, inertia: 1e-3}, points: {P: [0.1, 0]}, pose: {at: [1, 0]}}\n"
              "joints:\n  root: {revolute: [rod.A, ground]}\n"
              "  pin: {revolute: [rod.B, bob], clearance: {radial: 1 mm, bearing radius: 20 mm, bearing: rod, normal: {hertz: {stiffness: "
              "1e9}}, friction: {ambrosio: {coefficient: 0.2}}}}\n"
              "drivers: {swing: {angle: [rod.A, ground], law: 0.3 rad*sin(20*t)}}\n"
              "forces:\n  s: {spring: [ground.C, rod.B], stiffness: 400, damping: 3, free length: 0.4}\n  r: {torsion spring: [rod.B, "
              "bob], stiffness: 2}\n"
              "  q: {torque: 3*t, on: bob, from: rod.B}\n  f: {force: [5, 3], at: rod.B, follows: true}\nrun: {until: 0.3 s}\n"),
      "t");
  const ElasticBody e = elastic_body(scene, scene.bodies[0]);
  const RigidRun run = rigid_run(scene, {&e, nullptr});
  EXPECT_EQ(run.trouble, "");
  ASSERT_GT(run.steps, 100);
  const Eigen::MatrixXd resultant = rigid_motions(e.model).transpose() * loads_on(e), &W = run.bodies[0].factor;
  const Eigen::MatrixXd sum = resultant * W, terms = resultant.cwiseAbs() * W.cwiseAbs();
  EXPECT_LE((sum.array() / terms.array()).abs().maxCoeff(), 1e-9);  // rounding of the accelerations
  for (Eigen::Index i = 0; i < W.rows(); ++i) EXPECT_GT(W.row(i).lpNorm<Eigen::Infinity>(), 0) << "load " << i << " is missing";
}

TEST(ModalChoice, MovesTheRodAsTwiceTheModesDo) {
  for (const std::string method : {"", "craig-bampton", "free"}) {
    const auto keeping = [&](const std::string& rule) {
      return crank("{frame: chord, " + (method.empty() ? rule : method + ": {" + rule + "}") + "}");
    };
    const int count = built(keeping("keep: auto")).flexible[0].choice->count;
    EXPECT_LE(count, 12) << method;
    const auto chosen = ran(keeping("keep: auto")), many = ran(keeping("count: " + std::to_string(2 * count)));
    const auto u = chosen.trajectory.column("rod.M.uy [m]"), v = many.trajectory.column("rod.M.uy [m]");
    double most = 0, error = 0;
    for (std::size_t i = 0; i < u.size(); ++i) most = std::max(most, std::abs(v[i])), error = std::max(error, std::abs(u[i] - v[i]));
    EXPECT_GT(most, 1e-5) << method;
    EXPECT_LE(error, 2 * negligible_part * most) << method;  // what is negligible, and as much for what follows from it
  }
}

TEST(ModalChoice, SaysOfEachConsideredModeWhatIsLeftOut) {
  const Model model = built(crank("{frame: chord, keep: auto}"));
  const ModalChoice& c = *model.flexible[0].choice;
  ASSERT_EQ(c.considered.size(), static_cast<std::size_t>(considered_modes));
  for (std::size_t k = 0; k < c.considered.size(); ++k) EXPECT_EQ(c.considered[k].kept, k < static_cast<std::size_t>(c.count));
  const ConsideredMode& last = c.considered[static_cast<std::size_t>(c.count - 1)];
  EXPECT_LE(last.left_energy, c.beyond_energy + negligible_part);
  EXPECT_LE(last.left_displacement, c.beyond_displacement + negligible_part);
  if (c.count > 1) {
    const ConsideredMode& before = c.considered[static_cast<std::size_t>(c.count - 2)];
    EXPECT_TRUE(before.left_energy > c.beyond_energy + negligible_part ||
                before.left_displacement > c.beyond_displacement + negligible_part);
  }
}

TEST(ModalChoice, FindsNothingLeftOutByAllModesOfABody) {
  constexpr double rounding = 1e-8;  // of K⁻¹, and of differences of energies
  for (const char* way : {"keep: auto", "craig-bampton: {keep: auto}", "free: {keep: auto}"}) {
    std::string text = clamped("{frame: {tangent: A}, " + std::string(way) + "}",
                               "gravity: [1, -9.81]\nforces: {p: {force: [100, \"20*sin(300*t)\"], at: rod.B}}\nrun: {until: 0.2}\n");
    text.insert(text.find("theory"), "elements: 5, ");
    const ModalChoice c = *built(text).flexible[0].choice;
    EXPECT_LT(c.considered.size(), static_cast<std::size_t>(considered_modes));
    EXPECT_LE(c.beyond_energy, rounding) << way;
    EXPECT_LE(c.beyond_displacement, rounding) << way;
  }
}

TEST(ModalChoice, NeedsTheModeThatAForceShakes) {
  const auto count = [](double frequency) {
    return built(clamped("{frame: {tangent: A}, keep: auto}", "forces: {p: {force: [0, \"10 N*sin(2*pi*" + std::to_string(frequency) +
                                                                  "/s*t)\"], at: rod.B}}\nrun: {until: 0.5 s}\n"))
        .flexible[0]
        .choice->count;
  };
  const double third = cantilever(7.8547574382) / (2 * pi);
  EXPECT_GE(count(third), 3);
  EXPECT_LT(count(1), count(third));
}

TEST(ModalChoice, LeavesStaticShapesInPlace) {
  const Model fixed = built(crank("{frame: chord, craig-bampton: {keep: auto}}")),
              free = built(crank("{frame: chord, free: {keep: auto}}"));
  const Model plain = built(crank("{frame: chord, keep: auto}"));
  EXPECT_LT(plain.flexible[0].compliance, 0.999);
  EXPECT_NEAR(fixed.flexible[0].compliance, 1, 1e-6);
  EXPECT_NEAR(free.flexible[0].compliance, 1, 1e-6);
  EXPECT_LE(fixed.flexible[0].choice->count, plain.flexible[0].choice->count);
}

TEST(ModalChoice, KeepsOneModeWhereNothingLoadsTheBody) {
  const Model model = built(rod("    modes: {keep: auto}\nrun: {until: 1}\n"));
  EXPECT_EQ(model.flexible[0].shapes, 1);
  EXPECT_NE(model.flexible[0].choice->reason.find("no load acts"), std::string::npos);
}

TEST(ModalChoice, FallsBackOnARuleWhereTheRigidMechanismIsOverconstrained) {
  const Model model =
      built(rod("    modes: {frame: chord, craig-bampton: {keep: auto}}\nground: {points: {C: [1, 0]}}\n"
                "joints: {a: {revolute: [ground, rod.A]}, b: {revolute: [ground.C, rod.B]}}\nrun: {until: 1}\n"));
  EXPECT_EQ(model.flexible[0].choice->count, without_a_run);
  EXPECT_NE(model.flexible[0].choice->reason.find("by the default rule"), std::string::npos);
  EXPECT_NE(model.preliminary_run->trouble.find("\"b\" (x) is implied"), std::string::npos);
}

TEST(ModalChoice, IsMadeForEachPiece) {
  const std::string text =
      rod("    modes: {frame: chord, craig-bampton: {keep: auto}}\ngravity: [0, -9.81]\njoints: {a: {revolute: [ground, rod.A]}}\nrun: "
          "{until: 0.1}\n");
  std::string cut = text;
  cut.insert(cut.find("theory"), "pieces: 3, ");
  const Model model = built(cut);
  ASSERT_EQ(model.flexible.size(), 3u);
  for (const FlexibleReport& r : model.flexible) EXPECT_GE(r.choice->count, 1);
}

TEST(FlexibleReport, CoversTheClosedFormsSharesOfACantilever) {
  const Model one = built(clamped("{frame: {tangent: A}, count: 1}", "forces: {p: {force: [1, 0], at: rod.B}}\nrun: {until: 1}\n"));
  const FlexibleReport& r = one.flexible[0];
  EXPECT_NEAR(r.lowest, cantilever(1.8751040687) / (2 * pi), mesh * r.lowest);
  EXPECT_NEAR(r.mass->y(), 0.61308, mesh);  // of the first mode
  EXPECT_NEAR(r.compliance, 0, 1e-12);      // no mode stretches the rod
  // The first stretching mode, ω = π/2 √(E/ρ), has 8/π² of the compliance at the end.
  const double stretch = std::sqrt(200e9 / 8000) / 4;
  const Model two = built(clamped("{frame: {tangent: A}, below: " + std::to_string(1.1 * stretch) + "}",
                                  "forces: {p: {force: [1, 0], at: rod.B}}\nrun: {until: 1}\n"));
  EXPECT_NEAR(two.flexible[0].compliance, 8 / (pi * pi), mesh);
  EXPECT_EQ(two.flexible[0].compliance_at, "B, x");
}

TEST(FlexibleReport, CoversEverythingWithACompleteBasis) {
  for (const char* frame : {"{tangent: A}", "chord", "mean axes"}) {
    const Model model = built(clamped("{frame: " + std::string(frame) + ", keep: all}", "run: {until: 1}\n"));
    EXPECT_NEAR(model.flexible[0].compliance, 1, 1e-6) << frame;
    EXPECT_EQ(model.flexible[0].mass.has_value(), std::string(frame) != "mean axes");
  }
}

TEST(PreliminaryRun, IsForCheckAndForChoosingAlone) {
  const std::string text = clamped("{frame: {tangent: A}, count: 2}", "run: {until: 1}\n");
  EXPECT_FALSE(built(text).preliminary_run);
  EXPECT_TRUE(with_preliminary_run(text).preliminary_run);
  EXPECT_TRUE(built(clamped("{frame: {tangent: A}, keep: auto}", "run: {until: 1}\n")).preliminary_run);
  EXPECT_FALSE(with_preliminary_run("bodies: {b: {rigid: {mass: 1, inertia: 1}}}\nrun: {until: 1}\n").preliminary_run);
}

// The bodies are rigid there: nothing has a deflection.
TEST(PreliminaryRun, IsDoneWithoutOutputsThatReadDeflections) {
  const Model model = with_preliminary_run(crank("{frame: chord, count: 2}") + "outputs: {sag: rod.M.uy}\n");
  EXPECT_EQ(model.preliminary_run->trouble, "");
  EXPECT_GT(model.preliminary_run->steps, 0);
}

TEST(PreliminaryRun, SaysThatThereIsNoneWhereALawReadsADeflection) {
  const Model model =
      with_preliminary_run(crank("{frame: chord, count: 2}") + "forces: {push: {force: [\"1 N - rod.M.uy*1 N/mm\", 0], at: slider}}\n");
  EXPECT_NE(model.preliminary_run->trouble.find("rod.M.uy"), std::string::npos) << model.preliminary_run->trouble;
  EXPECT_EQ(model.preliminary_run->steps, 0);
}

TEST(PreliminaryRun, EstimatesTheDeflectionOfASuddenWeight) {
  const Model model = with_preliminary_run("gravity: [0, -9.81]\n" + clamped("{frame: {tangent: A}, count: 4}", "run: {until: 1}\n"));
  const double still = rhoA * 9.81 / (8 * EI);
  // Twice the static deflection in the first mode, which has 97 % of it; others beat with it.
  EXPECT_NEAR(model.flexible[0].motion->deflection / (2 * still), 1, 0.05);
}

TEST(PreliminaryRun, TellsTheFrequencyThatAForceExcites) {
  const Model model = with_preliminary_run(
      clamped("{frame: {tangent: A}, count: 4}", "forces: {p: {force: [0, \"10 N*sin(2*pi*40/s*t)\"], at: rod.B}}\nrun: {until: 1 s}\n"));
  EXPECT_NEAR(model.flexible[0].motion->excited_up_to, 40, 2);  // a window's width
}

TEST(Imposed, FrequencyIsThatOfTurningOrOfTheAcceleration) {
  const Scene scene = read_scene_text(
      "bodies: {a: {rigid: {mass: 1, inertia: 1}}, b: {rigid: {mass: 1, inertia: 1}}}\n"
      "drivers:\n  motor: {angle: [ground, a], law: 3000 rpm*t}\n  shaker: {angle: [ground, b], law: 0.1 rad*sin(2*pi*30/s*t)}\nrun: "
      "{until: 2}\n",
      "t");
  const std::vector<Imposed> found = imposed_frequencies(scene);
  EXPECT_NEAR(found[0].frequency, 50, 1e-9);
  EXPECT_TRUE(found[0].turns && found[0].even);
  EXPECT_NEAR(found[1].frequency, 30, 0.5);  // one line of the spectrum
  EXPECT_FALSE(found[1].turns || found[1].even);
}

TEST(Doubt, OnModesThatEndBelowTheDriver) {
  const auto turning = [](const char* count) {
    return built(rod("    modes: {frame: {tangent: A}, count: " + std::string(count) +
                     "}\n    stiffening: rotation\njoints: {root: {revolute: [ground, rod.A]}}\n"
                     "drivers: {motor: {angle: [ground, rod.A], law: 3000 rpm*t}}\nrun: {until: 0.1}\n"))
        .warnings;
  };
  EXPECT_TRUE(warns(turning("1"), "Hz, but driver \"motor\" turns at 50 Hz; keep more"));
  EXPECT_FALSE(warns(turning("2"), "keep more"));
}

TEST(Doubt, OnStiffeningThatSpinWouldBring) {
  // Southwell: ω² = ω₀² + 1.193 Ω² for the first mode of a blade clamped on its axis, by stretching alone.
  const double first = cantilever(1.8751040687), spin = 0.5 * first, raised = std::sqrt(1 + 1.193 * 0.25) - 1;
  const auto blade = [&](double w, const std::string& more) {
    return rod("    modes: {frame: {tangent: A}, count: 3}\n" + more +
               "joints: {root: {revolute: [ground, rod.A]}}\nstart: {rod: {angle: 0, speed: " + std::to_string(w) +
               "}}\nrun: {until: 0.1}\n");
  };
  const Model quick = built(blade(spin, "")), seen = with_preliminary_run(blade(spin, ""));
  EXPECT_TRUE(warns(quick.warnings, "raise its first frequency by 13.9 %; add stiffening: rotation")) << raised;
  EXPECT_TRUE(warns(seen.warnings, "add stiffening: rotation"));
  EXPECT_NEAR(seen.flexible[0].motion->by_all_loads, raised, 5e-3);
  EXPECT_FALSE(warns(built(blade(spin, "    stiffening: rotation\n")).warnings, "stiffening"));
  EXPECT_FALSE(warns(built(blade(0.05 * first, "")).warnings, "stiffening"));
}

TEST(Doubt, OnStiffeningThatForcesAtPointsWouldBring) {
  // Euler: π²EI/4 at the free end. A pull of a twentieth of that raises ω₁ by some 2.5 %.
  const double pull = pi * pi * EI / 80;
  const auto text = [&](double force, const std::string& more) {
    return clamped("{frame: {tangent: A}, count: 4}",
                   more + "forces: {p: {force: [" + std::to_string(force) + ", 0], at: rod.B}}\nrun: {until: 0.01}\n");
  };
  const Model pulled = with_preliminary_run(text(pull, ""));
  EXPECT_TRUE(warns(pulled.warnings, "add stiffening: axial"));
  EXPECT_NEAR(pulled.flexible[0].motion->by_all_loads, 0.025, 5e-3);
  EXPECT_LT(with_preliminary_run(text(-pull, "")).flexible[0].motion->by_all_loads, -0.02);
  EXPECT_TRUE(warns(with_preliminary_run(text(-25 * pull, "")).warnings, "buckle"));
}

TEST(Doubt, OnBendingTooFarForOneFrame) {
  std::string soft = "gravity: [0, -9.81]\n" + clamped("{frame: {tangent: A}, count: 2}", "run: {until: 0.3, tolerance: 1e-6}\n");
  EXPECT_FALSE(warns(with_preliminary_run(soft).warnings, "pieces"));
  EXPECT_FALSE(warns(ran(soft).warnings, "pieces"));
  soft.replace(soft.find("200 GPa"), 7, "2 GPa");
  EXPECT_TRUE(warns(with_preliminary_run(soft).warnings, "\"rod\" would bend by"));
  EXPECT_TRUE(warns(ran(soft).warnings, "\"rod\" bent by"));
}

TEST(Doubt, OnModesThatKeepNothing) {
  const Model model = built(clamped("{frame: {tangent: A}, below: 1 Hz}", "run: {until: 1}\n"));
  EXPECT_TRUE(warns(model.warnings, "\"rod\" stays rigid"));
}

}  // namespace
}  // namespace pintle::modal_choice_test
