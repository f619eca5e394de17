// Bodies that stiffen, in whole mechanisms: rotating beams and columns, from the library's own
// accelerations, against published figures and an independent model of the rotating beam.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "framework/configuration/assemble.h"
#include "tests/oracles/rotating_beam.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/analyses/linearised.h"

namespace pintle_scenes::stiffening_test {
namespace {

using Eigen::VectorXd;
using pintle::State;
using pintle_oracle::BeamFrameTie;
using pintle_oracle::RotatingBeam;
constexpr double pi = std::numbers::pi;

// Pull that varies along beams of n elements is constant in each: of order 2, and the error of a
// frequency not above 1/(2n²) at the spins used here.
double mesh(int n) { return 0.5 / (n * n); }
// The last of the published figures: 5e-5 of 4.1 and 5e-5 of 22.
constexpr double published = 1.3e-5;
// Differences of accelerations over a step of 1e-5: 1e-10 of truncation, 1e-16/1e-5 of rounding
// times the span of frequencies squared, 1e3 among the shapes used.
constexpr double difference = 1e-7;

// ---- the independent model ----

struct Published {
  double w, first, second;
};
const Published spins[] = {{2, 4.1373, 22.6149}, {6, 7.3604, 26.8091}, {10, 11.2023, 33.6404}};

TEST(RotatingCantilever, IndependentModelHasThePublishedFrequencies) {
  for (const Published& spin : spins) {
    const VectorXd in_plane = squares(RotatingBeam{spin.w});
    const double w2 = spin.w * spin.w, tolerance = 2 * published;
    EXPECT_NEAR(in_plane[0] + w2, spin.first * spin.first, tolerance * spin.first * spin.first);
    EXPECT_NEAR(in_plane[1] + w2, spin.second * spin.second, tolerance * spin.second * spin.second);
  }
}

// ---- scenes ----

/// Its beam on a hub of any inertia, driven.
struct Blade {
  double w = 0, hub = 0;
  std::string conditions = "tangent", keep = "craig-bampton: {count: 8}", stiffening = "rotation";
  int elements = 80;
  double EA = 1e6;
};
std::string frame(const std::string& conditions) {
  if (conditions == "tangent") return "{tangent: A}";
  return conditions == "chord" ? "{chord: [A, B]}" : conditions;
}
std::string text(const Blade& b) {
  std::ostringstream s;
  s.precision(17);
  s << "bodies:\n"
       "  hub: {rigid: {mass: 1, inertia: 1}, points: {P: ["
    << b.hub
    << ", 0]}}\n"
       "  blade:\n"
       "    beam: {from: A, to: B, theory: euler, rotary inertia: false, elements: "
    << b.elements
    << ",\n"
       "           section: {area: 1, second moment: "
    << 1 / b.EA << "}, young: " << b.EA
    << ", poisson: 0, density: 1}\n"
       "    points: {A: [0, 0], B: [1, 0]}\n"
       "    modes: {frame: "
    << frame(b.conditions) << ", " << b.keep
    << "}\n"
       "    stiffening: "
    << b.stiffening
    << "\n"
       "    pose: {at: ["
    << b.hub
    << ", 0]}\n"
       "joints:\n"
       "  axle: {revolute: [ground, hub]}\n"
       "  root: {weld: [hub.P, blade.A]}\n"
       "drivers: {motor: {angle: [ground, hub], law: "
    << b.w
    << "*t}}\n"
       "run: {until: 1}\n"
       "output: {points: [blade.B]}\n";
  return s.str();
}

/// A scene at rest or in steady rotation, and its small motion.
struct Steady {
  explicit Steady(const std::string& scene_text, double w = 0) {
    const pintle::Scene scene = scene_of(scene_text);
    model = build(scene);
    state = steady_state(model.system, assemble(scene, model).start, w);
    motion = linearised(model.system, state, w);
  }
  pintle::Model model;
  State state;
  SmallMotion motion;
};
Steady spun(const Blade& b) { return Steady(text(b), b.w); }

// ---- rotating cantilever ----

const std::vector<std::pair<std::string, std::string>> complete_stiffening = {
    {"tangent", "rotation"}, {"chord", "rotation"}, {"tangent", "axial"}, {"chord", "axial"}, {"mean axes", "axial"}};

TEST(RotatingCantilever, HasThePublishedFrequenciesUnderEveryTie) {
  for (const auto& [conditions, stiffening] : complete_stiffening)
    for (const Published& spin : spins) {
      SCOPED_TRACE(conditions + ", " + stiffening + ", " + std::to_string(spin.w));
      const Blade blade{.w = spin.w, .conditions = conditions, .stiffening = stiffening};
      const VectorXd f = frequencies(spun(blade).motion);
      // Bending alone: chord² = flap² − w². The pull's error is relative to flap².
      const double tolerance = 2 * (mesh(blade.elements) + published);
      EXPECT_NEAR(f[0] * f[0], spin.first * spin.first - spin.w * spin.w, tolerance * spin.first * spin.first);
      EXPECT_NEAR(f[1] * f[1], spin.second * spin.second - spin.w * spin.w, tolerance * spin.second * spin.second);
    }
}

TEST(RotatingCantilever, OnAHubOfItsOwnLengthAgreesWithTheIndependentModel) {
  for (const auto& [conditions, stiffening] : complete_stiffening)
    for (const double w : {2.0, 10.0}) {
      SCOPED_TRACE(conditions + ", " + stiffening + ", " + std::to_string(w));
      const Blade blade{.w = w, .hub = 1, .conditions = conditions, .keep = "craig-bampton: {count: 20}", .stiffening = stiffening};
      const VectorXd f = frequencies(spun(blade).motion), want = squares(RotatingBeam{w, 1, blade.EA});
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(f[k] * f[k], want[k], 2 * mesh(blade.elements) * (want[k] + w * w)) << k;
    }
}

TEST(RotatingCantilever, ConvergesWithOrderTwoInTheMesh) {
  const double want = squares(RotatingBeam{10, 1, 1e6})[1];
  std::vector<double> errors;
  for (const int n : {10, 20, 40}) {
    const Blade blade{.w = 10, .hub = 1, .conditions = "chord", .keep = "craig-bampton: {count: 20}", .elements = n};
    const double f = frequencies(spun(blade).motion)[1];
    errors.push_back(std::abs(f * f - want));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.1);
}

// Stretch, whose first frequency is (π/2)√EA, takes 4w²/(π²EA/4) of the first square by Coriolis'
// forces. Without stiffening that is all it does; its pull is then lacking in the independent model
// too.
TEST(RotatingCantilever, CoriolisForcesCoupleBendingWithStretch) {
  const double w = 3;
  for (const double EA : {1e4, 1e6}) {
    const RotatingBeam stiff = without_stiffening({w}, BeamFrameTie::tangent);
    RotatingBeam soft = stiff;
    soft.EA = EA;
    const VectorXd bending = squares(stiff), want = squares(soft);
    const Blade blade{.w = w, .keep = "keep: all", .stiffening = "none", .elements = 20, .EA = EA};
    const VectorXd f = frequencies(spun(blade).motion);
    const double coupling = 4 * w * w / (pi * pi / 4 * EA);
    EXPECT_NEAR((bending[0] - f[0] * f[0]) / bending[0], coupling, 0.2 * coupling) << EA;  // the next modes' share
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(f[k] * f[k], want[k], (std::pow(blade.elements, -4) + coupling * mesh(blade.elements)) * want[k]) << EA;
  }
}

TEST(RotatingCantilever, WithoutStiffeningSoftensAndDivergesAboveItsFirstFrequency) {
  const double first = 3.5160152685;  // cos x cosh x = −1
  for (const double w : {1.0, 3.0, 5.0, 10.0}) {
    const SmallMotion motion = spun({.w = w, .stiffening = "none"}).motion;
    const double square = first * first - w * w;
    if (square > 0) {
      EXPECT_NEAR(std::pow(frequencies(motion)[0], 2), square, difference * first * first);
      EXPECT_LT(growth(motion), difference);
    } else {
      EXPECT_NEAR(std::pow(growth(motion), 2), -square, difference * w * w);
    }
  }
}

// The floating frame is a gauge only where everything of second order counts. Without stiffening
// a frame that follows the bending has part of it by itself: the pull acts on slopes from the clamp
// but is lacking on slopes from the frame.
TEST(RotatingCantilever, WithoutStiffeningIsAsSoftAsItsTieMakesIt) {
  const std::pair<std::string, BeamFrameTie> ties[] = {
      {"tangent", BeamFrameTie::tangent}, {"chord", BeamFrameTie::chord}, {"mean axes", BeamFrameTie::mean_axes}};
  for (const auto& [conditions, modelled] : ties)
    for (const double w : {2.0, 6.0, 10.0})
      for (const double hub : {0.0, 1.0}) {
        SCOPED_TRACE(conditions + ", " + std::to_string(w) + ", " + std::to_string(hub));
        const VectorXd want = squares(without_stiffening({w, hub}, modelled));
        const Blade blade{.w = w, .hub = hub, .conditions = conditions, .keep = "keep: all", .stiffening = "none", .elements = 20};
        const SmallMotion motion = spun(blade).motion;
        // Stretch couples too, by less than 2e-4 of w² or of the square.
        const double tolerance = 2e-4 + std::pow(blade.elements, -4);
        const double f = frequencies(motion)[0], g = growth(motion);
        EXPECT_NEAR(want[0] > 0 ? f * f : -g * g, want[0], tolerance * (std::abs(want[0]) + 2 * w * w));
      }
}

// Under mean axes a body's inertia is in equilibrium with itself; what pulls it at the root is a
// load at a point, which `rotation` does not count.
TEST(RotatingCantilever, UnderMeanAxesStiffensWithoutThePullOfItsRootUnlessAxial) {
  for (const double w : {2.0, 6.0, 10.0}) {
    const VectorXd want = squares(without_pull_of_clamp(RotatingBeam{w}));
    const Blade blade{.w = w, .conditions = "mean axes", .stiffening = "rotation"};
    const VectorXd f = frequencies(spun(blade).motion);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(f[k] * f[k], want[k], 2 * mesh(blade.elements) * (want[k] + 2 * w * w)) << w;
    EXPECT_LT(f[0] * f[0], squares(RotatingBeam{w})[0] - 0.05 * w * w);
  }
}

// EA u″ + w² (s + u) = 0: 1 + u = tan(k)/k, k = w/√EA, at the tip. A straight bar that only stretches has no displacement of
// second order, so that stiffening changes nothing.
TEST(RotatingCantilever, StretchesAsItsClosedForm) {
  for (const std::string conditions : {"tangent", "chord", "mean axes"})
    for (const double w : {1.0, 20.0})
      for (const std::string stiffening : {"none", "axial"}) {
        const Blade blade{.w = w, .conditions = conditions, .keep = "keep: all", .stiffening = stiffening, .elements = 20, .EA = 1e4};
        const double k = w / std::sqrt(blade.EA), small = w * w / (3 * blade.EA);
        const Steady s = spun(blade);
        EXPECT_NEAR(place_of(s.model, s.state, "blade.B").norm(), std::tan(k) / k, (k * k * mesh(blade.elements) + difference) * small)
            << conditions << w << stiffening;
      }
}

// ---- column ----

/// A beam of EI = ρA = L = 1 hinged at both ends, one sliding, pushed there by P.
std::string column(double P, const std::string& conditions, const std::string& stiffening, int pieces = 1) {
  std::ostringstream s;
  s.precision(17);
  s << "bodies:\n"
       "  column:\n"
       "    beam: {from: A, to: B, theory: euler, rotary inertia: false, elements: 16, pieces: "
    << pieces
    << ",\n"
       "           section: {area: 1, second moment: 1e-6}, young: 1e6, poisson: 0, density: 1}\n"
       "    points: {A: [0, 0], B: [1, 0]}\n"
       "    modes: {frame: "
    << frame(conditions)
    << ", keep: all}\n"
       "    stiffening: "
    << stiffening
    << "\n"
       "joints:\n"
       "  foot: {revolute: [ground, column.A]}\n"
       "  head: {slot: [ground, column.B]}\n"
       "forces: {push: {force: ["
    << -P
    << ", 0], at: column.B}}\n"
       "run: {until: 1}\n";
  return s.str();
}
// Of a square, bending and pull together: elements of order 4; some strains under load, 2e-5.
const double column_error = 2 * std::pow(pi / 16, 4) / 720 + 1e-4;

TEST(Column, LoadAlongItChangesTheSquareOfItsFrequencyInProportion) {
  const double euler = pi * pi;
  for (const std::string conditions : {"chord", "tangent", "mean axes"})
    for (const double share : {-2.0, 0.0, 0.5, 0.95}) {
      const VectorXd f = frequencies(Steady(column(share * euler, conditions, "axial")).motion);
      EXPECT_NEAR(f[0] * f[0], std::pow(pi, 4) * (1 - share), column_error * std::pow(pi, 4) * (1 + std::abs(share)))
          << conditions << share;
      EXPECT_NEAR(f[1] * f[1], std::pow(2 * pi, 4) * (1 - share / 4), column_error * std::pow(2 * pi, 4)) << conditions << share;
    }
}

TEST(Column, BeyondEulersLoadGrows) {
  for (const std::string conditions : {"chord", "tangent", "mean axes"})
    for (const double share : {1.05, 1.5}) {
      const double g = growth(Steady(column(share * pi * pi, conditions, "axial")).motion);
      EXPECT_NEAR(g * g, std::pow(pi, 4) * (share - 1), column_error * std::pow(pi, 4)) << conditions << share;
    }
}

// Along its chord a linear body does not feel a push at its ends.
TEST(Column, StiffeningByRotationAloneDoesNotBuckle) {
  for (const std::string stiffening : {"none", "rotation"}) {
    const VectorXd f = frequencies(Steady(column(2 * pi * pi, "chord", stiffening)).motion);
    EXPECT_NEAR(f[0], pi * pi, column_error * pi * pi);
  }
}

// The frames of pieces lean as the column does: slopes from chord to axis are lacking, of second
// order.
TEST(Column, InPiecesBucklesWithoutStiffeningAndConvergesWithOrderTwo) {
  const double share = 0.5, want = std::pow(pi, 4) * (1 - share);
  std::vector<double> pieces{4, 8, 16}, errors;
  for (const double n : pieces) {
    const VectorXd f = frequencies(Steady(column(share * pi * pi, "chord", "none", static_cast<int>(n))).motion);
    errors.push_back(f[0] * f[0] - want);
  }
  for (const double slope : slopes(pieces, errors)) EXPECT_NEAR(slope, -2, 0.1);
  EXPECT_GT(growth(Steady(column(1.05 * pi * pi, "chord", "none", 8)).motion), 1);
}

}  // namespace
}  // namespace pintle_scenes::stiffening_test
