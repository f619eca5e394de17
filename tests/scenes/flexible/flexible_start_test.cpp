// Flexible bodies that start bent, at rest, or turning steadily. Numbers are closed forms of uniform beams.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "framework/analysis/linearize/linearize.h"
#include "framework/configuration/equilibrium.h"
#include "tests/scenes/flexible/unit_beam.h"
#include "tests/refusal.h"

namespace pintle::flexible_start_test {
namespace {

using namespace unit_beam_scenes;

// ---- bent and resting starts ----

TEST(BentStart, SwingsFromTheShapeThatDisplacesAPointWithTheLeastStrain) {
  const double bent = 1e-3;
  const auto released = [&](int count) {
    return ran(unit_beam("{frame: {tangent: A}, count: " + std::to_string(count) + "}") + clamp +
               "start: {beam: {deflection: {B: [0, 1 mm]}}}\n" +
               "run: {until: 4, tolerance: 1e-11, method: dopri5}\noutput: {every: 0.05, points: [beam.B]}\n");
  };
  const Ran one = released(1);
  const double omega = 2 * pi * one.model.flexible[0].frequencies[0];
  const auto t = one.column("t [s]"), u = one.column("beam.B.uy [m]");
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(u[i], bent * std::cos(omega * t[i]), 1e-7 * bent);
  // Compliance at the end: 1/3, of which modes hold 12/β⁴ each; the shape of three is that of a force there but for the rest.
  const Ran three = released(3);
  double held = 0;
  for (const double beta : {1.8751040687, 4.6940911330, 7.8547574382}) held += 4 / std::pow(beta, 4);
  EXPECT_NEAR(three.column("beam.B.uy [m]").front(), bent, 1e-15);
  EXPECT_NEAR(three.run.ledger.column("strain [J]").front(), bent * bent / (2 * held), 1e-5 * bent * bent / (2 * held));
}

TEST(BentStart, TakesModalCoordinates) {
  const Ran r = ran(unit_beam("{frame: {tangent: A}, count: 3}") + clamp + "start: {beam: {modes: [0, 2e-3]}}\nrun: {until: 0.01}\n");
  EXPECT_EQ(r.column("beam.mode 1 [m kg^0.5]").front(), 0);
  EXPECT_EQ(r.column("beam.mode 2 [m kg^0.5]").front(), 2e-3);
  EXPECT_EQ(r.column("beam.mode 3 [m kg^0.5]").front(), 0);
}

TEST(BentStart, SaysWhatItRefuses) {
  const auto starting = [](const std::string& start, const std::string& modes = "{frame: {tangent: A}, count: 3}") {
    return complaint(unit_beam(modes) + clamp + "start: {beam: {" + start + "}}\nrun: {until: 0.01}\n");
  };
  EXPECT_NE(starting("deflection: {A: [0, 1 mm]}")
                .find("start.beam.deflection.A: the shapes of \"beam\" cannot displace it by (0, 0.001) m; the nearest possible "
                      "displacement is (0, 0) m"),
            std::string::npos)
      << starting("deflection: {A: [0, 1 mm]}");
  EXPECT_NE(starting("modes: [1, 2, 3, 4]").find("gives 4 modal coordinates, but \"beam\" keeps 3 shapes"), std::string::npos);
  EXPECT_NE(starting("modes: [1], deflection: {B: [0, 1]}").find("keep one of them"), std::string::npos);
  EXPECT_NE(starting("deflection: {C: [0, 1]}").find("has no point \"C\""), std::string::npos) << starting("deflection: {C: [0, 1]}");
  EXPECT_NE(starting("deflecton: {B: [0, 1]}").find("Did you mean \"deflection\"?"), std::string::npos);
  EXPECT_NE(
      complaint("bodies: {b: {rigid: {mass: 1, inertia: 1}}}\nstart: {b: {modes: [1]}}\nrun: {until: 1}\n").find("needs a flexible body"),
      std::string::npos);
  EXPECT_NE(
      complaint("bodies: {b: {rigid: {mass: 1, inertia: 1}}}\nstart: equilibrum\nrun: {until: 1}\n").find("Did you mean \"equilibrium\"?"),
      std::string::npos);
}

TEST(BentStart, IsKeptInTheSceneAsFilledIn) {
  for (const char* start :
       {"start: equilibrium\n", "start: {beam: {deflection: {B: [0, 1e-3]}}}\n", "start: {beam: {modes: [1e-3, 2e-3]}}\n"}) {
    const Scene scene = scene_of(unit_beam("{frame: {tangent: A}, count: 3}") + clamp + start + "run: {until: 1}\n");
    const Scene again = read_scene_text(scene.filled_in, "again.json");
    EXPECT_EQ(again.filled_in, scene.filled_in);
    EXPECT_EQ(again.start_at_rest, scene.start_at_rest);
    EXPECT_EQ(assemble(again, build(again)).start.y, assemble(scene, build(scene)).start.y) << start;
  }
}

TEST(RestingStart, StaysWhereTheMechanismRests) {
  // Its own weight and a force at the end bend the cantilever by ρAg/8 + P/3 of EI, less what four modes leave out: 1e-3.
  const Ran r = ran("gravity: [0, -0.08]\n" + unit_beam("{frame: {tangent: A}, count: 4}") + clamp +
                    "forces: {side: {force: [0, -0.03], at: beam.B}}\nstart: equilibrium\nrun: {until: 20, tolerance: 1e-8}\noutput: "
                    "{points: [beam.B]}\n");
  const auto u = r.column("beam.B.uy [m]");
  EXPECT_NEAR(u.front(), -0.02, 2e-3 * 0.02);
  for (const double now : u) EXPECT_NEAR(now, u.front(), 1e-9 * 0.02);
  EXPECT_LE(r.run.last.kinetic, 1e-18 * r.run.last.strain);
}

TEST(RestingStart, MovesAsDriversHaveIt) {
  const Ran r =
      ran("bodies: {arm: {rigid: {mass: 1, inertia: 0.1}, points: {O: [0, 0]}}}\njoints: {pin: {revolute: [ground, arm.O]}}\n"
          "drivers: {motor: {angle: [ground, arm], law: 3*t}}\nstart: equilibrium\nrun: {until: 1}\n");
  EXPECT_NEAR(r.column("arm.speed [rad/s]").front(), 3, 1e-12);
}

TEST(RestingStart, SaysWhereThereIsNone) {
  const Scene scene = scene_of("gravity: [0, -9.81]\nbodies: {b: {rigid: {mass: 1, inertia: 1}}}\nstart: equilibrium\nrun: {until: 1}\n");
  pintle_test::expect_refused<AssemblyError>([&] { assemble(scene, build(scene)); }, {"there is no equilibrium to start from"});
}

// ---- linearization of what turns steadily ----

TEST(LinearizedStart, OfASpinningBladeHasThePublishedFrequencies) {
  // Wright et al. (1982), flapping: in the plane of turning less w². Pull is constant in an element: of order 2.
  const double mesh = 0.5 / (20 * 20), published = 1.3e-5;
  for (const char* stiffening : {"rotation", "axial"})
    for (const auto& [w, flap] : {std::pair{2.0, 4.1373}, {6.0, 7.3604}}) {
      const Scene scene =
          scene_of(unit_beam("{frame: {tangent: A}, craig-bampton: {count: 8}}", std::string("    stiffening: ") + stiffening + "\n") +
                   "  hub: {rigid: {mass: 1, inertia: 1}}\njoints: {axle: {revolute: [ground, hub]}, root: {weld: [hub, beam.A]}}\n"
                   "drivers: {motor: {angle: [ground, hub], law: " +
                   std::to_string(w) + "*t}}\nrun: {until: 1}\n");
      const Model model = build(scene);
      const Linearization lin = linearize(scene, model, linearized_start(scene, model, assemble(scene, model)).state);
      double lowest = 1e300;
      for (const LinearMode& m : lin.modes) lowest = std::min(lowest, 2 * pi * m.frequency());
      EXPECT_NEAR(lowest * lowest, flap * flap - w * w, 2 * (mesh + published) * flap * flap) << stiffening << ", " << w;
    }
}

TEST(LinearizedStart, SaysWhatBendingItLeavesOutWhereNothingIsSteady) {
  const Scene scene = scene_of(
      unit_beam("{frame: {tangent: A}, count: 2}") +
      "joints: {axle: {revolute: [ground, beam.A]}}\ndrivers: {motor: {angle: [ground, beam.A], law: t + 0.5*t^2}}\nrun: {until: 1}\n");
  const Model model = build(scene);
  const LinearizedStart start = linearized_start(scene, model, assemble(scene, model));
  // A load α x ρA bends the end by 11/120 of α; two modes leave out a thousandth.
  EXPECT_NEAR(said({start.note}, "(\"beam\" by some "), 100 * 11. / 120, 0.1);
}

}  // namespace
}  // namespace pintle::flexible_start_test
