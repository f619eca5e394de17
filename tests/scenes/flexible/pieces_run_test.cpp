// Beams that bend far, cut into pieces, and beams spun up, against the geometrically exact beam.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "framework/bodies/segments.h"
#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"
#include "tests/oracles/exact_beam.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/analyses/linearised.h"

namespace pintle_scenes::pieces_run_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using pintle_oracle::BeamFrame;
using pintle_oracle::ExactBeam;
using pintle_oracle::Hold;
constexpr double pi = std::numbers::pi;

// A slope between two refinements, first terms of the next order included.
constexpr double order = 0.1;

// ---- a slender beam of unit length, mass and EI ----

ExactBeam exact(double EA = 1e4) { return {.length = 1, .EA = EA, .EI = 1, .GA = 0.375 * EA, .rhoA = 1, .rhoI = 1 / EA, .a = {}, .b = {}}; }

/// The same as body `rod`, ends A and B, middle M.
struct Rod {
  int pieces = 1;
  std::string stiffening = "none", conditions = "chord";
  double EA = 1e4;
  double x = 0;  ///< of A at the start
};
std::string text(const Rod& rod) {
  std::ostringstream s;
  s.precision(17);
  s << "  rod:\n"
       "    beam: {from: A, to: B, elements: 16, pieces: "
    << rod.pieces << ", young: " << rod.EA
    << ", poisson: 0, density: 1,\n"
       "           section: {area: 1, second moment: "
    << 1 / rod.EA
    << ", shear factor: 0.75}}\n"
       "    points: {A: [0, 0], M: [0.5, 0], B: [1, 0]}\n"
       "    modes: {frame: "
    << rod.conditions
    << ", craig-bampton: {count: 0}}\n"
       "    stiffening: "
    << rod.stiffening
    << "\n"
       "    pose: {at: ["
    << rod.x << ", 0]}\n";
  return s.str();
}
/// A point on the k-th of the pieces as the results name it.
std::string on_piece(const std::string& body, int pieces, int k, const std::string& point) {
  return body + (pieces > 1 ? " " + std::to_string(k) : "") + "." + point;
}

std::vector<double> times(double until, int outputs) {
  std::vector<double> out;
  for (int i = 0; i <= outputs; ++i) out.push_back(until * i / outputs);
  return out;
}
std::vector<Vector2d> path(const Whole& w, const std::string& point) {
  const std::vector<double> x = w.column(point + ".x [m]"), y = w.column(point + ".y [m]");
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < x.size(); ++i) out.emplace_back(x[i], y[i]);
  return out;
}
std::vector<Vector2d> path(const ExactBeam& beam, const std::vector<BeamFrame>& frames, double s) {
  std::vector<Vector2d> out;
  for (const BeamFrame& f : frames) out.push_back(place_at(beam, f.place, s).head<2>());
  return out;
}
/// Largest distance at the same time; not a number if one ended early.
double apart(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b) {
  if (a.size() != b.size()) return std::nan("");
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

// ---- static: cantilever under a dead load across its tip ----

/// Distance of the tip from where the exact beam has it.
double elastica_error(double load, const Rod& rod) {
  std::ostringstream s;
  s << "bodies:\n"
    << text(rod) << "joints: {wall: {weld: [ground, rod.A]}}\n"
    << "forces: {load: {force: [0, " << load << "*t], at: rod.B}}\nrun: {until: 1}\noutput: {points: [rod.B]}\n";
  const pintle::Scene scene = scene_of(s.str());
  const pintle::Model model = build(scene);
  pintle::State state = assemble(scene, model).start;
  const int steps = static_cast<int>(std::ceil(load));
  for (int i = 1; i <= steps; ++i) {
    state.t = static_cast<double>(i) / steps;
    state = steady_state(model.system, state);
  }
  ExactBeam beam = exact(rod.EA);
  beam.elements = 16;
  beam.a.hold = Hold::clamp;
  beam.b.load = {0, load, 0};
  const Vector2d want = static_shape(beam, pintle_oracle::rigid_start(Vector3d::Zero()), 20 * steps).rightCols<1>().head<2>();
  return (place_of(model, state, on_piece("rod", rod.pieces, rod.pieces, "B")) - want).norm();
}

TEST(Pieces, OfALoadedCantileverConvergeToTheElasticaWithOrderTwo) {
  const std::vector<double> pieces{2, 4, 8};  // tip at 0.30 of the length
  std::vector<double> errors;
  for (const double n : pieces) errors.push_back(elastica_error(1, {.pieces = static_cast<int>(n), .EA = 1e6}));
  for (const double slope : slopes(pieces, errors)) EXPECT_NEAR(slope, -2, order);
}

TEST(Pieces, OfACantileverBentOverComeNearTheElastica) {
  const double load = 10;  // tip at 0.81 of the length
  const double one = elastica_error(load, {.pieces = 1, .EA = 1e6}), four = elastica_error(load, {.pieces = 4, .EA = 1e6});
  EXPECT_GT(one, 0.1);
  EXPECT_LT(four, one / 16);
}

// With second-order displacement each piece's own bending is met as well.
TEST(Pieces, ThatStiffenConvergeToTheElasticaWithOrderFour) {
  const std::vector<double> pieces{2, 4, 8};
  std::vector<double> errors;
  for (const double n : pieces) errors.push_back(elastica_error(1, {.pieces = static_cast<int>(n), .stiffening = "axial", .EA = 1e6}));
  for (const double slope : slopes(pieces, errors)) EXPECT_NEAR(slope, -4, order);
}

// ---- a pendulum dropped from level ----

TEST(Pieces, OfAPendulumConvergeToTheExactBeamWithOrderTwo) {
  const double g = 10, until = 1.2, step = 0.005;
  const int outputs = 40;
  ExactBeam beam = exact();
  beam.a.hold = Hold::hinge;
  beam.gravity = {0, -g};
  const auto frames = simulate(beam, pintle_oracle::rigid_start(Vector3d::Zero()), times(until, outputs), step);
  double bent = 0;  // tip from the tangent at the hinge
  for (const BeamFrame& f : frames) {
    const double angle = f.place(2, 0);
    const Vector2d tip = f.place.rightCols<1>().head<2>();
    bent = std::max(bent, std::abs(std::cos(angle) * tip.y() - std::sin(angle) * tip.x()));
  }
  EXPECT_GT(bent, 0.2);
  const std::vector<double> pieces{4, 8};
  std::vector<double> errors;
  for (const double n : pieces) {
    const Rod rod{.pieces = static_cast<int>(n)};
    std::ostringstream s;
    s << "gravity: [0, " << -g << "]\nbodies:\n"
      << text(rod) << "joints: {pin: {revolute: [ground, rod.A]}}\n"
      << "run: {until: " << until << "}\noutput: {every: " << until / outputs << ", points: [rod.B]}\n";
    errors.push_back(apart(path(run_text(s.str()), on_piece("rod", rod.pieces, rod.pieces, "B")), path(beam, frames, 1)));
  }
  EXPECT_NEAR(slopes(pieces, errors)[0], -2, order);
  EXPECT_LT(errors[1], 0.01 * bent);
}

// ---- a slider–crank whose coupler bends ----

/// Crank of 0.3 set off from rest by angle(t) = 3 t³, slider of half the coupler's mass.
struct BendingCoupler {
  static constexpr double radius = 0.3, slider = 0.5, drive = 3, until = 1;
  static constexpr int outputs = 40;
  ExactBeam beam = exact();
  std::vector<BeamFrame> frames;
  BendingCoupler() {
    beam.a = {.hold = Hold::hinge, .law = pintle_oracle::crank_pin({0, 0}, radius, [](double t) {
                                     return Vector3d(drive * t * t * t, 3 * drive * t * t, 6 * drive * t);
                                   })};
    beam.b = {.hold = Hold::slide, .law = {}, .line = {1, 0}, .mass = slider};
    frames = simulate(beam, pintle_oracle::rigid_start({radius, 0, 0}), times(until, outputs), 0.01);
  }
  /// Largest distance of the coupler's middle from where the exact beam has it.
  double error(Rod rod) const {
    rod.x = radius;
    std::ostringstream s;
    s << "bodies:\n  crank: {rigid: {mass: 1, inertia: 1}, points: {A: [" << radius << ", 0]}}\n"
      << text(rod) << "  slider: {rigid: {mass: " << slider << ", inertia: 1}, pose: {at: [" << 1 + radius
      << ", 0]}}\n"
         "joints:\n"
         "  axle: {revolute: [ground, crank]}\n"
         "  pin: {revolute: [crank.A, rod.A]}\n"
         "  gudgeon: {revolute: [rod.B, slider]}\n"
         "  guide: {prismatic: [ground, slider]}\n"
         "drivers: {motor: {angle: [ground, crank], law: "
      << drive
      << "*t^3}}\n"
         "run: {until: "
      << until << "}\noutput: {every: " << until / outputs << ", points: [rod.M]}\n";
    return apart(path(run_text(s.str()), on_piece("rod", rod.pieces, std::max(1, rod.pieces / 2), "M")), path(beam, frames, 0.5));
  }
};

TEST(Pieces, OfACouplerConvergeToTheExactBeamWithOrderTwo) {
  const BendingCoupler coupler;
  const std::vector<double> pieces{2, 4, 8};
  std::vector<double> errors;
  for (const double n : pieces) errors.push_back(coupler.error({.pieces = static_cast<int>(n)}));
  for (const double slope : slopes(pieces, errors)) EXPECT_NEAR(slope, -2, order);
  double off = 0;  // middle from the chord
  for (const BeamFrame& f : coupler.frames) {
    const Vector2d a = f.place.col(0).head<2>(), along = (f.place.rightCols<1>().head<2>() - a).normalized();
    const Vector2d middle = place_at(coupler.beam, f.place, 0.5).head<2>() - a;
    off = std::max(off, std::abs(along.x() * middle.y() - along.y() * middle.x()));
  }
  EXPECT_GT(off, 0.15);
  EXPECT_LT(errors.back(), 0.01 * off);
}

TEST(Pieces, ThatStiffenConvergeFaster) {
  const BendingCoupler coupler;
  const std::vector<double> pieces{2, 4};
  std::vector<double> errors;
  for (const double n : pieces) {
    const Rod rod{.pieces = static_cast<int>(n), .stiffening = "axial"};
    errors.push_back(coupler.error(rod));
    Rod linear = rod;
    linear.stiffening = "none";
    EXPECT_LT(errors.back(), 0.2 * coupler.error(linear)) << n;
  }
  EXPECT_LT(slopes(pieces, errors)[0], -3.5);
}

// ---- spin-up ----

/// The spin-up of Simo and Vu-Quoc (1986): L = 10, ρA = 1.2, EI = 1.4e4, first frequency 3.8 rad/s,
/// from rest to 6 rad/s in 15 s.
struct SpinUp {
  static constexpr double length = 10, EI = 1.4e4, mass = 1.2, speed = 6, rise = 15, until = 20;
  double EA = 2.8e7;
  std::string modes = "{frame: {tangent: A}, count: 4}", stiffening = "rotation";
  int pieces = 1;
  double end = until;

  /// Angle, its rate and acceleration.
  static Vector3d turn(double t) {
    const double k = 2 * pi / rise;
    if (t >= rise) return {speed * (t - rise / 2), speed, 0};
    return {speed / rise * (t * t / 2 + (std::cos(k * t) - 1) / (k * k)), speed / rise * (t - std::sin(k * t) / k),
            speed / rise * (1 - std::cos(k * t))};
  }
};
constexpr double interval = 0.1;

/// How far the tip is ahead of the line through the root that turns as the driver says, at each
/// output.
std::vector<double> lead(const std::vector<Vector2d>& tip) {
  std::vector<double> out;
  for (std::size_t i = 0; i < tip.size(); ++i) {
    const double angle = SpinUp::turn(interval * static_cast<double>(i))[0];
    out.push_back(std::cos(angle) * tip[i].y() - std::sin(angle) * tip[i].x());
  }
  return out;
}
std::vector<double> lead(const SpinUp& o) {
  std::ostringstream s;
  s.precision(17);
  s << "bodies:\n"
       "  blade:\n"
       "    beam: {from: A, to: B, theory: euler, rotary inertia: false, elements: 40, pieces: "
    << o.pieces
    << ",\n"
       "           section: {area: 1, second moment: "
    << o.EI / o.EA << "}, young: " << o.EA << ", poisson: 0, density: " << o.mass
    << "}\n"
       "    points: {A: [0, 0], B: ["
    << o.length
    << ", 0]}\n"
       "    modes: "
    << o.modes
    << "\n"
       "    stiffening: "
    << o.stiffening
    << "\n"
       "joints: {axle: {revolute: [ground, blade.A]}}\n"
       "drivers:\n"
       "  motor:\n"
       "    angle: [ground, blade.A]\n"
       "    law: if(t < 15, 0.4*(t^2/2 + (15/(2*pi))^2*(cos(2*pi*t/15) - 1)), 6*(t - 7.5))\n"
       "run: {until: "
    << o.end
    << "}\n"
       "output: {every: "
    << interval << ", points: [blade.B]}\n";
  return lead(path(run_text(s.str()), on_piece("blade", o.pieces, o.pieces, "B")));
}
std::vector<double> exact_lead(double EA) {
  ExactBeam beam{.length = SpinUp::length,
                 .EA = EA,
                 .EI = SpinUp::EI,
                 .GA = 0.4 * EA,
                 .rhoA = SpinUp::mass,
                 .rhoI = SpinUp::mass * SpinUp::EI / EA,
                 .a = {},
                 .b = {}};
  beam.elements = 3;
  beam.a = {.hold = Hold::clamp, .law = pintle_oracle::crank_pin({0, 0}, 0, SpinUp::turn)};
  const int outputs = static_cast<int>(std::lround(SpinUp::until / interval));
  return lead(path(beam, simulate(beam, pintle_oracle::rigid_start(Vector3d::Zero()), times(SpinUp::until, outputs), 0.01), beam.length));
}
double largest(const std::vector<double>& values, double from = 0) {
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (interval * static_cast<double>(i) > from) most = std::max(most, std::abs(values[i]));
  return most;
}
double largest_difference(std::vector<double> a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::nan("");
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return largest(a);
}

TEST(SpinUp, ABladeThatStiffensBendsBackAndReturnsToItsLine) {
  const std::vector<double> want = exact_lead(SpinUp{}.EA);
  const double lag = largest(want);
  // Slopes reach 1.4 times deflection over length; what second order leaves is their square.
  const double tolerance = std::pow(1.4 * lag / SpinUp::length, 2) * lag;
  const SpinUp ways[] = {{},
                         {.modes = "{frame: {chord: [A, B]}, craig-bampton: {count: 4}}"},
                         {.modes = "{frame: mean axes, craig-bampton: {count: 4}}", .stiffening = "axial"}};
  for (const SpinUp& way : ways) {
    const std::vector<double> got = lead(way);
    EXPECT_LT(largest_difference(got, want), tolerance) << way.modes;
    EXPECT_LT(*std::ranges::min_element(got), -0.99 * lag) << way.modes;
    EXPECT_LT(largest(got, SpinUp::rise), 0.01 * lag) << way.modes;
  }
}

TEST(SpinUp, ABladeThatDoesNotStiffenDivergesAboveItsFirstFrequency) {
  EXPECT_GT(largest(lead(SpinUp{.stiffening = "none", .end = 11})), SpinUp::length);
}

// A hundred times less stiff along, so that waves along it do not rule the step; strain is below 1
// %.
TEST(SpinUp, ABladeInPiecesReturnsWithoutStiffening) {
  const double EA = 2.8e5;
  const std::vector<double> want = exact_lead(EA);
  const double lag = largest(want);
  SpinUp o{.EA = EA, .modes = "{frame: chord, craig-bampton: {count: 0}}", .stiffening = "none", .pieces = 2};
  const double coarse = largest_difference(lead(o), want);
  o.pieces = 4;
  const std::vector<double> got = lead(o);
  const double fine = largest_difference(got, want);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(fine, 0.03 * lag);
  EXPECT_LT(largest(got, SpinUp::rise), 0.02 * lag);
}

// The points of a beam in pieces keep its name in laws and outputs, whichever piece they belong to.
TEST(Pieces, SignalsOfTheirPointsGoByTheNameOfTheBeam) {
  const pintle::Scene scene = pintle::read_scene_text(
      "bodies:\n  bm:\n    beam: {from: A, to: B, section: {rectangle: [10 mm, 10 mm]}, young: 200 GPa, poisson: 0.3, density: 8000 "
      "kg/m^3, "
      "pieces: 2}\n    points: {A: [0, 0], B: [1 m, 0]}\n    modes: {frame: chord, craig-bampton: {count: 1}}\n"
      "joints: {a: {revolute: [ground, bm.A]}}\nstart: {bm: {angle: 0, speed: 2 rad/s}}\n"
      "outputs: {place: bm.B.x, pull: bm.B.ay, spin: bm 2.speed}\n"
      "forces: {drag: {force: [\"-1 N s/m*bm.B.vx\", \"-1 N s/m*bm.B.vy\"], at: bm.B}}\n"
      "events: {passed: {when: bm.B.y > 0.05 m, do: {set: {seen: 1}}}}\nstates: {seen: {rate: 0, start: 0}}\n"
      "run: {until: 0.1 s}\noutput: {points: [bm.B]}\n",
      "pieces.yaml");
  const pintle::Scene cut = pintle::with_pieces(scene);
  const pintle::Model model = build(cut);
  const pintle::Run run = simulate(cut, model, assemble(cut, model));
  ASSERT_EQ(run.status, pintle::Status::finished) << run.reason;
  const auto last = [&](const std::string& column) { return run.trajectory.column(column).back(); };
  EXPECT_EQ(last("place [m]"), last("bm 2.B.x [m]"));
  EXPECT_EQ(last("pull [m/s^2]"), last("bm 2.B.ay [m/s^2]"));
  EXPECT_EQ(last("spin [rad/s]"), last("bm 2.speed [rad/s]"));
  EXPECT_EQ(last("seen [1]"), 1);
  EXPECT_LT(last("bm 2.B.vy [m/s]"), 2);
}

}  // namespace
}  // namespace pintle_scenes::pieces_run_test
