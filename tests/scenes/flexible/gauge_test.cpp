// The frame of a flexible body is a gauge: with every shape kept, what ties it to the body changes
// no motion in the world.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/scenes/flexible/flexible_scenes.h"

namespace pintle_scenes::gauge_test {
namespace {

using pintle::Status;

constexpr double size = 0.17;  ///< of the slider-crank, both its links in a line [m]

// To the mechanism's size. A frame that has turned by β against another sees the same body as
// stretched by β²/2, for its strain is linear: where ties differ by an angle β, places differ by
// parts of β². Couplers are so stiff and slow here that sections turn by less than 5e-5. Runs are
// at a tolerance of 1e-11.
constexpr double same = 1e-8;
constexpr double seen = 1e-6;  // what couplers bend by at least: a hundred times as much

/// The runs of one mechanism under each tie.
template <class Text>
std::vector<Whole> runs(const std::vector<std::string>& frames, Text text_of) {
  std::vector<Whole> out;
  for (const std::string& frame : frames) {
    out.push_back(run_text(text_of(frame)));
    EXPECT_EQ(out.back().run.status, Status::finished) << frame << ": " << out.back().run.reason;
  }
  return out;
}

/// Every run puts the points where the first does, and `bending` displaces one by far more than
/// that.
void expect_same(const std::vector<Whole>& runs, const std::vector<std::string>& points, double bending) {
  for (std::size_t i = 1; i < runs.size(); ++i)
    for (const std::string& point : points) EXPECT_LE(apart(runs[i], runs[0], point), same * size) << "tie " << i << ", " << point;
  EXPECT_GE(bending, seen * size);
}

/// Stiff against what the speed of 60 rad/s asks of it, see `same`.
FlexibleBeam stiff_beam(const std::string& frame) {
  FlexibleBeam beam;
  beam.diameter = 0.02;
  beam.elements = 2;
  beam.modes = "{frame: " + frame + ", keep: all}";
  return beam;
}

/// Let go where cranks and couplers stand at an angle, so that inertia bends the coupler at once.
FlexibleCrank tilted(const std::string& coupler, double until) {
  FlexibleCrank crank{coupler, 60, until};
  crank.angle = 1;
  return crank;
}

TEST(Gauge, BeamCouplerMovesAlikeUnderEveryTie) {
  const auto all = runs({"chord", "tangent", "mean axes"}, [](const std::string& frame) {
    FlexibleCrank crank = tilted(text(stiff_beam(frame)), 0.005);
    crank.points = "coupler.A, coupler.M, coupler.B";
    return text(crank);
  });
  expect_same(all, {"coupler.A", "coupler.M", "coupler.B"}, deflection(all[0], "coupler.M"));
}

TEST(Gauge, BeamCouplerWithClearanceMovesAlikeThroughItsFirstImpact) {
  const auto all = runs({"chord", "tangent", "mean axes"}, [](const std::string& frame) {
    FlexibleCrank crank = tilted(text(stiff_beam(frame)), 8e-4);
    crank.points = "coupler.A, coupler.M, coupler.B";
    crank.clearance = 1e-5;
    return text(crank);
  });
  expect_same(all, {"coupler.A", "coupler.M", "coupler.B"}, deflection(all[0], "coupler.M"));
  for (const Whole& w : all) {
    ASSERT_GE(w.run.impacts.size(), 1u);
    EXPECT_FALSE(std::isnan(w.run.impacts[0].end));
  }
}

TEST(Gauge, MeshedPlateWithHolesMovesAlikeUnderEveryTie) {
  const auto all = runs({"{chord: [A, B]}", "{tangent: A}", "mean axes"},
                        [](const std::string& frame) { return text(tilted(holed_plate("{frame: " + frame + ", keep: all}"), 0.001)); });
  expect_same(all, {"coupler.A", "coupler.B"}, deflection(all[1], "coupler.B"));
}

TEST(Gauge, PlateHeldAtNodesMovesAlikeUnderEveryTieThatNodesAllow) {
  const auto all = runs({"{chord: [A, B]}", "mean axes"}, [](const std::string& frame) {
    FlexibleCrank crank = tilted(
        "plate: {thickness: 0.01, young: 207e9, poisson: 0.3, mass: 0.21, element: quadrilateral4, "
        "grid: {corners: [[0, -0.01], [0.12, -0.01], [0.12, 0.01], [0, 0.01]], cells: [4, 2]}}\n"
        "points: {A: [0, 0], M: [0.06, 0.01], B: [0.12, 0]}\n"
        "modes: {frame: " +
            frame + ", keep: all}\n",
        0.001);
    crank.points = "coupler.A, coupler.M, coupler.B";
    return text(crank);
  });
  expect_same(all, {"coupler.A", "coupler.M", "coupler.B"}, deflection(all[0], "coupler.M"));
}

/// A rod clamped on an axle that turns at an eighth of its lowest frequency, pushed across its end.
std::vector<Whole> rotors(int elements, const std::string& stiffening) {
  return runs({"tangent", "chord", "mean axes"}, [&](const std::string& frame) {
    FlexibleBeam beam = stiff_beam(frame);
    beam.elements = elements, beam.more = "stiffening: " + stiffening + "\n";
    return "ground: {points: {O: [0, 0]}}\nbodies:\n" + body_text("rod", text(beam)) +
           "joints: {axle: {revolute: [ground.O, rod.A]}}\n"
           "drivers: {motor: {angle: [ground.O, rod.A], law: 1000*t}}\n"
           "forces: {push: {force: [0, 100*sin(10000*t)], at: rod.B}}\n"
           "run: {until: 1e-3, tolerance: 1e-11}\n"
           "output: {every: 2e-5, points: [rod.M, rod.B]}\n";
  });
}

/// Largest difference between ties at the rod's end, of its deflection.
double unlike(const std::vector<Whole>& rotors) {
  return std::max(apart(rotors[1], rotors[0], "rod.B"), apart(rotors[2], rotors[0], "rod.B")) / deflection(rotors[0], "rod.B");
}

TEST(Gauge, FastRotorsTiesMeetAsItsMeshIsRefinedIfItStiffens) {
  // Tension N and a frame that has turned by β make an energy Nβ²/2 for each length, of second
  // order in bending as bending's own. Linear strain has it wrong, in each frame by another amount,
  // up to the square of spin over frequency. Stiffening by all loads puts it right, with the
  // tension of each element constant along it: errors fall with the square of the elements' length.
  constexpr double little = 1e-3, order = 0.2;
  const std::vector<double> elements{2, 6}, off{unlike(rotors(2, "axial")), unlike(rotors(6, "axial"))};
  EXPECT_LE(off[1], little);
  EXPECT_NEAR(slopes(elements, off)[0], -2, order);
  EXPECT_GE(unlike(rotors(6, "none")), 10 * little);  // else there was nothing to put right
}

TEST(Gauge, TiesDifferByTheSquareOfTheDeflection) {
  constexpr double order = 0.01;  // of a slope where the next power is 1e-3 of this one
  // A beam on a pin and a slide, shaken where its halves bend unlike. Its chord stays where it is;
  // the other frames turn, by angles in proportion to the force.
  const auto shaken = [](const std::string& frame, double force) {
    FlexibleBeam beam = stiff_beam(frame);
    beam.elements = 4, beam.at = 0.25;
    return run_text("ground: {points: {O: [0, 0]}}\nbodies:\n" + body_text("rod", text(beam)) +
                    "joints:\n  pin: {revolute: [ground.O, rod.A]}\n  slide: {slot: [ground.O, rod.B]}\n"
                    "forces: {push: {force: [0, \"" +
                    std::to_string(force) +
                    "*sin(20000*t)\"], at: rod.M}}\nrun: {until: 4e-4, tolerance: 1e-12}\n"
                    "output: {every: 2e-5, points: [rod.M, rod.B]}\n");
  };
  for (const char* frame : {"tangent", "mean axes"}) {
    std::vector<double> bent, differ;
    for (const double force : {300., 1000., 3000.}) {
      const Whole chord = shaken("chord", force), other = shaken(frame, force);
      bent.push_back(deflection(chord, "rod.M"));
      differ.push_back(apart(chord, other, "rod.M"));
    }
    for (const double slope : slopes(bent, differ)) EXPECT_NEAR(slope, 2, order) << frame;
  }
}

}  // namespace
}  // namespace pintle_scenes::gauge_test
