// Small motion about a state: frequencies, damping and state space against closed forms, an independent
// linearisation by differences, models in minimal coordinates and the simulation itself.
#include "framework/analysis/linearize/linearize.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"
#include "tests/oracles/four_bar.h"
#include "tests/oracles/pendulum.h"
#include "tests/oracles/rotating_beam.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/scenes/analyses/linearised.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::linearize_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = pintle::LinearMode::Kind;
namespace po = pintle_oracle;
constexpr double pi = std::numbers::pi;
// Sums of some ten terms, relative to what is summed; square roots of them are better still.
constexpr double rounding = 1e-11;

/// A scene and its linearisation about the assembled start, or about the state of a run.
struct About {
  explicit About(const pintle::Scene& scene, double t = 0) : model(build(scene)) {
    state = state_at(model, assemble(scene, model).start, t);
    lin = linearize(scene, model, state);
  }
  explicit About(const std::string& text) : About(scene_of(text)) {}
  bool notes(const std::string& words) const {
    return std::ranges::any_of(lin.notes, [&](const std::string& n) { return n.find(words) != std::string::npos; });
  }
  /// Angular frequencies |Im root| of the modes that oscillate, ascending.
  std::vector<double> frequencies() const {
    std::vector<double> out;
    for (const pintle::LinearMode& m : lin.modes)
      if (m.root.imag() > 0) out.push_back(m.root.imag());
    return out;
  }
  Eigen::Index output(const std::string& name) const { return index(lin.space.outputs, name); }
  Eigen::Index input(const std::string& name) const { return index(lin.space.inputs, name); }

  pintle::Model model;
  pintle::State state;
  pintle::Linearization lin;

 private:
  static Eigen::Index index(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::out_of_range(name);
    return found - names.begin();
  }
};

/// A body of mass m that slides along x on a spring and damper.
std::string slider(double m, double k, double c) {
  return "bodies: {block: {rigid: {mass: " + std::to_string(m) +
         ", inertia: 1}, pose: {at: [1, 0]}}}\n"
         "joints: {guide: {prismatic: [ground, block]}}\n"
         "forces: {k: {spring: [ground, block], stiffness: " +
         std::to_string(k) + ", damping: " + std::to_string(c) + ", free length: 1}}\n";
}

// ---- closed forms ----

TEST(Linearize, PendulumSwingsWithItsClosedFormAndNoDampingAtAll) {
  const About a(
      "gravity: [0, -9.81]\n"
      "bodies: {rod: {rigid: {mass: 2, inertia: 0.3}, points: {P: [0, 0.7]}}}\n"
      "joints: {hinge: {revolute: [ground, rod.P]}}\n");
  ASSERT_EQ(a.lin.modes.size(), 1U);
  EXPECT_NEAR(a.lin.modes[0].root.imag(), std::sqrt(2 * 9.81 * 0.7 / (0.3 + 2 * 0.49)), rounding);
  EXPECT_EQ(a.lin.modes[0].root.real(), 0);
  EXPECT_EQ(a.lin.coefficients, pintle::Coefficients::constant);
}

TEST(Linearize, DoublePendulumHasTheRootsOfItsTwoByTwoProblem) {
  po::DoublePendulum p;
  p.mass[0] = 1.3, p.mass[1] = 0.7, p.centre[0] = 0.5, p.centre[1] = 0.4, p.inertia[0] = 0.1, p.inertia[1] = 0.05;
  const About a(double_pendulum(p, {0, 0, 0, 0}));
  Eigen::Matrix2d M, K = Eigen::Matrix2d::Zero();
  M(0, 0) = p.inertia[0] + p.mass[0] * p.centre[0] * p.centre[0] + p.mass[1] * p.length * p.length;
  M(0, 1) = M(1, 0) = p.mass[1] * p.length * p.centre[1];
  M(1, 1) = p.inertia[1] + p.mass[1] * p.centre[1] * p.centre[1];
  K(0, 0) = p.gravity * (p.mass[0] * p.centre[0] + p.mass[1] * p.length);
  K(1, 1) = p.gravity * p.mass[1] * p.centre[1];
  const Eigen::Vector2d squares = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(K, M).eigenvalues();
  const std::vector<double> f = a.frequencies();
  ASSERT_EQ(f.size(), 2U);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(f[static_cast<std::size_t>(k)], std::sqrt(squares[k]), rounding * 10);
}

TEST(Linearize, DamperGivesTheDampingRatioAndBeyondItTwoDecays) {
  const double m = 2, k = 50, natural = std::sqrt(k / m);
  const About weak(slider(m, k, 4));
  ASSERT_EQ(weak.lin.modes.size(), 1U);
  EXPECT_EQ(weak.lin.modes[0].kind, Kind::oscillating);
  EXPECT_NEAR(weak.lin.modes[0].natural(), natural / (2 * pi), rounding);
  EXPECT_NEAR(weak.lin.modes[0].damping(), 4 / (2 * m * natural), rounding);
  EXPECT_NEAR(weak.lin.modes[0].frequency(), std::sqrt(k / m - 1) / (2 * pi), rounding);
  const About strong(slider(m, k, 40));
  ASSERT_EQ(strong.lin.modes.size(), 2U);
  for (const int sign : {1, -1}) {
    const pintle::LinearMode& mode = strong.lin.modes[sign > 0 ? 0 : 1];
    EXPECT_EQ(mode.kind, Kind::decaying);
    EXPECT_EQ(mode.roots, 1);
    EXPECT_NEAR(mode.root.real(), -10 + sign * std::sqrt(75.0), 100 * rounding);
  }
}

TEST(Linearize, InvertedPendulumGrowsByName) {
  const About a(
      "gravity: [0, -9.81]\n"
      "bodies: {rod: {rigid: {mass: 1, inertia: 0.02}, points: {P: [0, -0.5]}, pose: {at: [0, 0.5]}}}\n"
      "joints: {hinge: {revolute: [ground, rod.P]}}\n");
  ASSERT_EQ(a.lin.modes.size(), 2U);
  int growing = 0;
  for (const pintle::LinearMode& m : a.lin.modes) {
    EXPECT_NEAR(std::abs(m.root.real()), std::sqrt(9.81 * 0.5 / 0.27), rounding);
    growing += m.kind == Kind::growing;
  }
  EXPECT_EQ(growing, 1);
  EXPECT_TRUE(a.notes("unstable"));
}

TEST(Linearize, WhatNothingHoldsIsNamedZeroBesideStiffModes) {
  const About a(
      "bodies:\n"
      "  a: {rigid: {mass: 1, inertia: 0.1}}\n"
      "  b: {rigid: {mass: 3, inertia: 0.1}, pose: {at: [1, 0]}}\n"
      "forces: {k: {spring: [a, b], stiffness: 3e9, free length: 1}}\n");
  int roots = 0;
  for (const pintle::LinearMode& m : a.lin.modes) {
    if (m.kind != Kind::zero) continue;
    roots += m.roots;
    EXPECT_EQ(m.root, 0.0);
  }
  EXPECT_EQ(roots, 10);  // of 12: but for the stretch, all six dofs are free
  const std::vector<double> f = a.frequencies();
  ASSERT_EQ(f.size(), 1U);
  EXPECT_NEAR(f[0], std::sqrt(3e9 * (1 + 1.0 / 3)), rounding * f[0]);
}

// ---- a state that moves ----

/// A function's derivative by p, given as functions of another parameter: central, of fourth order.
using Function = std::function<double(double)>;
Function by(const Function& p, const Function& f) {
  return [=](double x) {
    constexpr double h = 2e-3;
    const auto d = [&](const Function& g) { return (8 * (g(x + h) - g(x - h)) - (g(x + 2 * h) - g(x - 2 * h))) / (12 * h); };
    return d(f) / d(p);
  };
}

// In one coordinate p: M p̈ + ½M′ṗ² + V′ = 0, so M δp̈ + M′ṗ δṗ + (M′p̈ + ½M″ṗ² + V″) δp = 0.
TEST(Linearize, MovingFourBarHasTheCoefficientsOfItsOneCoordinate) {
  const po::LinkMass links[3] = {{1.0, 0.01, 0.5}, {2.0, 0.1, 0.4}, {1.5, 0.05, 0.6}};
  const po::FourBar f{1.0, 0.3, 0.9, 0.7, true};
  const double start = 0.9, spin = 2.5;
  pintle::Scene s = four_bar(f, links, 9.81, start, 0, 0);
  s.drivers.clear();
  s.start_bodies = {start_angle("crank", start, spin)};
  const About a(s);
  ASSERT_EQ(a.lin.independent.size(), 1U);
  ASSERT_EQ(a.lin.independent[0] % 3, 2) << "an angle is expected to lead: " << a.lin.space.states[0];
  const int leads = a.lin.independent[0] / 3;
  const auto turn = [&](const po::Turn& crank) {
    const po::FourBarMotion m = evaluate(f, crank);
    return leads == 0 ? crank : leads == 1 ? m.coupler : m.rocker;
  };
  const Function p = [&](double x) { return turn({x, 0, 0}).angle; };
  const Function V = [&](double x) { return energy(f, {x, 0, 0}, links, 9.81); };
  const Function M = [&](double x) { return 2 * (energy(f, {x, 1, 0}, links, 9.81) - V(x)) / std::pow(turn({x, 1, 0}).rate, 2); };
  const double m = M(start), m1 = by(p, M)(start), m2 = by(p, by(p, M))(start), v1 = by(p, V)(start), v2 = by(p, by(p, V))(start);
  const double rate = turn({start, spin, 0}).rate, accel = -(m1 * rate * rate / 2 + v1) / m;
  const double differences = 1e-6;  // of fourth order, nested, over 2e-3 of links that turn as much
  EXPECT_NEAR(a.lin.motion.M(0, 0), m, rounding * m);
  EXPECT_NEAR(a.lin.motion.D(0, 0), m1 * rate, differences * std::abs(m1 * rate));
  const double k = m1 * accel + m2 * rate * rate / 2 + v2;
  EXPECT_NEAR(a.lin.motion.K(0, 0), k, differences * (std::abs(m1 * accel) + std::abs(m2 * rate * rate) + std::abs(v2)));
  EXPECT_EQ(a.lin.coefficients, pintle::Coefficients::frozen);
  EXPECT_TRUE(a.notes("frozen"));
}

TEST(Linearize, FourBarRestingOnASpringHasTheFrequencyOfItsEnergy) {
  const po::LinkMass links[3] = {{1.0, 0.01, 0.5}, {2.0, 0.1, 0.4}, {1.5, 0.05, 0.6}};
  const po::FourBar f{1.0, 0.3, 0.9, 0.7, true};
  const double start = 0.9, k = 40;
  const Function V = [&](double x) { return energy(f, {x, 0, 0}, links, 9.81); }, x = [](double t) { return t; };
  pintle::Scene s = four_bar(f, links, 9.81, start, 0, 0);
  s.drivers.clear();
  s.start_bodies = {start_angle("crank", start, 0)};
  s.loads = {{"hold", pintle::SceneTorsionSpring{ref("ground"), ref("crank"), k, 0, start + by(x, V)(start) / k}, {}}};
  const About a(s);
  const double M = 2 * (energy(f, {start, 1, 0}, links, 9.81) - V(start));
  const std::vector<double> found = a.frequencies();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0], std::sqrt((by(x, by(x, V))(start) + k) / M), 1e-7 * found[0]);
}

// A bead of mass m on a spring k in a slot that turns at w: ω² = k/m − w². Seen from the world its coordinate turns.
std::string bead(double w) {
  const double k = 12.5, m = 0.5, r = 0.64;
  return "bodies:\n"
         "  arm: {rigid: {mass: 1, inertia: 0.2}}\n"
         "  bead: {rigid: {mass: 0.5, inertia: 0.01}, pose: {at: [0.64, 0]}}\n"
         "joints: {axle: {revolute: [ground, arm]}, slide: {prismatic: [arm, bead]}}\n"
         "drivers: {motor: {angle: [ground, arm], law: " +
         std::to_string(w) +
         "*t}}\n"
         "forces: {k: {spring: [arm, bead], stiffness: 12.5, free length: " +
         std::to_string(r - m * w * w * r / k) +
         "}}\n"
         "start: {bead: {at: [0.64, 0]}}\n";
}

TEST(Linearize, BeadInATurningSlotIsSofterByTheSquareOfTheSpin) {
  for (const double w : {0.0, 1.0, 3.0, 4.5}) {
    const About a(bead(w));
    const std::vector<double> f = a.frequencies();
    ASSERT_EQ(f.size(), 1U) << w;
    EXPECT_NEAR(f[0] * f[0], 25 - w * w, 1e-9 * 25) << w;
    EXPECT_EQ(a.lin.coefficients, w == 0 ? pintle::Coefficients::constant : pintle::Coefficients::turning);
    EXPECT_NEAR(a.lin.turn, w, rounding);
  }
}

// Along the slot m r̈ = … + 2 m w r u̇; on the motor d/dt of (J + m r²)(w + u̇).
TEST(Linearize, DriverOffsetActsThroughItsRateAndTheMotorFeelsTheBead) {
  const double w = 3, m = 0.5, r = 0.64;
  const About a(bead(w));
  const auto& s = a.lin.space;
  EXPECT_NEAR(s.B(1, a.input("motor.offset [rad]")), 0, 1e-9);
  EXPECT_NEAR(s.B(1, a.input("motor.offset rate [rad/s]")), 2 * w * r, 1e-9);
  EXPECT_NEAR(s.B(1, a.input("motor.offset acceleration [rad/s^2]")), 0, 1e-9);
  const Eigen::Index torque = a.output("motor.torque [N m]");
  EXPECT_NEAR(s.C(torque, 0), 0, 1e-9);
  EXPECT_NEAR(s.C(torque, 1), 2 * m * r * w, 1e-9);
  EXPECT_NEAR(s.D(torque, a.input("motor.offset acceleration [rad/s^2]")), 0.2 + 0.01 + m * r * r, 1e-9);
  EXPECT_NEAR(s.D(a.output("bead.y [m]"), a.input("motor.offset [rad]")), r, rounding);
}

// ---- flexible bodies ----

std::string blade(double w, const std::string& stiffening) {
  return "bodies:\n"
         "  hub: {rigid: {mass: 1, inertia: 1}, points: {P: [1, 0]}}\n"
         "  blade:\n"
         "    beam: {from: A, to: B, theory: euler, rotary inertia: false, elements: 20,\n"
         "           section: {area: 1, second moment: 1e-6}, young: 1e6, poisson: 0, density: 1}\n"
         "    points: {A: [0, 0], B: [1, 0]}\n"
         "    modes: {frame: {tangent: A}, craig-bampton: {count: 5}}\n"
         "    stiffening: " +
         stiffening +
         "\n"
         "    pose: {at: [1, 0]}\n"
         "joints: {axle: {revolute: [ground, hub]}, root: {weld: [hub.P, blade.A]}}\n"
         "drivers: {motor: {angle: [ground, hub], law: " +
         std::to_string(w) +
         "*t}}\n"
         "run: {until: 1}\n";
}

TEST(Linearize, CantileverHasItsFrequencies) {
  const std::vector<double> f = About(blade(0, "none")).frequencies();
  const double want[] = {3.516015268, 22.03449156, 61.69721441};                   // (βL)², cos βL cosh βL = −1
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(f[k], want[k], 2e-5 * want[k]);  // 20 elements: (βL/20)⁴/720 at most
}

TEST(Linearize, SpunBladeAgreesWithDifferencesAndWithTheIndependentModel) {
  for (const std::string stiffening : {"rotation", "axial"})
    for (const double w : {2.0, 10.0}) {
      const pintle::Scene scene = scene_of(blade(w, stiffening));
      const pintle::Model model = build(scene);
      const pintle::State state = steady_state(model.system, assemble(scene, model).start, w);
      const pintle::Linearization lin = linearize(scene, model, state);
      const VectorXd want = frequencies(linearised(model.system, state, w));
      std::vector<double> f;
      for (const pintle::LinearMode& m : lin.modes)
        if (m.root.imag() > 0) f.push_back(m.root.imag());
      ASSERT_EQ(static_cast<Eigen::Index>(f.size()), want.size());
      // Differences over 1e-5 leave 1e-10 and rounding over it, among frequencies to 1e3 squared.
      for (std::size_t k = 0; k < f.size(); ++k) EXPECT_NEAR(f[k], want[static_cast<Eigen::Index>(k)], 1e-6 * f[k]) << stiffening << w;
      EXPECT_NE(lin.coefficients, pintle::Coefficients::frozen) << lin.drift;
      const VectorXd independent = squares(po::RotatingBeam{w, 1, 1e6});
      EXPECT_NEAR(f[0] * f[0], independent[0], (1.0 / (20 * 20) + 1e-4) * (independent[0] + w * w));
    }
}

// ---- against runs ----

// Crossings of a damped oscillation are half a period apart, and the speed at them falls by exp(−decay · half).
// What is left of the spin-up's vibration changes the coefficients by 1e-9 in a fiftieth of a radian. That is no growth.
TEST(Linearize, ABladeBroughtUpToSpeedIsNotCalledUnstable) {
  const About about(pintle::read_scene(std::filesystem::path(PINTLE_SOURCE_DIR) / "examples/rotating_beam.yaml"), 18);
  ASSERT_NE(about.lin.coefficients, pintle::Coefficients::frozen);
  ASSERT_EQ(about.lin.modes.size(), 4u);
  for (const pintle::LinearMode& mode : about.lin.modes) EXPECT_EQ(mode.kind, Kind::oscillating) << mode.root;
}

TEST(Linearize, FrequencyAndDecayAreThoseOfASimulatedFreeMotion) {
  pintle::Scene s = four_bar({1.0, 0.3, 0.9, 0.7, true}, {{1.0, 0.01, 0.5}, {2.0, 0.1, 0.4}, {1.5, 0.05, 0.6}}, 0, 0.9, 0, 0);
  s.drivers.clear();
  s.loads = {{"hold", pintle::SceneTorsionSpring{ref("ground"), ref("crank"), 40, 0.4, 0.9}, {}}};
  s.start_bodies = {start_angle("crank", 0.9, 0)};
  const About a(s);
  ASSERT_EQ(a.lin.modes.size(), 1U);
  const std::complex<double> root = a.lin.modes[0].root;
  const double small = 1e-5;  // second order bends frequencies by as much
  s.start_bodies = {start_angle("crank", 0.9, small * std::abs(root))};
  s.run.until = 4 * 2 * pi / root.imag(), s.run.tolerance = 1e-13, s.output.every = s.run.until / 4000;
  const Whole w = run(s);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  const auto t = w.column("t [s]"), x = w.column("crank.angle [rad]"), v = w.column("crank.speed [rad/s]");
  std::vector<double> when, speed;
  for (std::size_t i = 1; i + 1 < t.size(); ++i)
    if ((x[i] - 0.9) * (x[i + 1] - 0.9) < 0) {
      const double part = (0.9 - x[i]) / (x[i + 1] - x[i]);
      when.push_back(t[i] + part * (t[i + 1] - t[i]));
      speed.push_back(std::abs(v[i] + part * (v[i + 1] - v[i])));
    }
  ASSERT_GE(when.size(), 6U);
  const double span = when.back() - when.front();
  EXPECT_NEAR(pi * static_cast<double>(when.size() - 1) / span, root.imag(), 1e-4 * root.imag());
  EXPECT_NEAR(std::log(speed.front() / speed.back()) / span, -root.real(), 1e-4 * std::abs(root.imag()));
}

TEST(Linearize, StateSpaceForetellsTheAnswerToASmallStep) {
  po::DoublePendulum p;
  p.inertia[0] = 0.1, p.inertia[1] = 0.2;
  pintle::Scene s = double_pendulum(p, {0, 0, 0, 0});
  s.bodies[1].points.push_back(point("T", 0.5));
  s.output.points = {ref("lower.T")};
  s.loads = {force("push", "lower.T", law(0), law(0))};
  const About a(s);
  const double F = 1e-5, t = 1.7;  // moves it by 1e-6: what is not linear is a millionth of it
  s.loads = {force("push", "lower.T", law(F), law(0))};
  s.run.until = t, s.run.tolerance = 1e-13;
  const Whole w = run(s);
  const auto& m = a.lin.space;
  const Eigen::Index n = m.A.rows();
  MatrixXd whole = MatrixXd::Zero(n + 1, n + 1);  // x' = A x + B F, F' = 0
  whole.topLeftCorner(n, n) = m.A;
  whole.topRightCorner(n, 1) = m.B.col(a.input("push.fx [N]"));
  const VectorXd x = F * MatrixXd(MatrixXd(whole * t).exp()).topRightCorner(n, 1);
  for (const std::string name : {"lower.T.x [m]", "lower.T.vx [m/s]", "upper.angle [rad]"}) {
    const std::vector<double> found = w.column(name);
    const double want = m.C.row(a.output(name)).dot(x);
    EXPECT_NEAR(found.back() - found.front(), want, 1e-5 * std::abs(want)) << name;
    EXPECT_GT(std::abs(want), 1e-8);
  }
}

// ---- files ----

TEST(Linearize, FilesNameStatesInputsAndOutputsWithUnits) {
  namespace fs = std::filesystem;
  const pintle::Scene scene = scene_of(bead(2));
  const About a(scene);
  const fs::path folder = fs::path(testing::TempDir()) / "linearize_files";
  fs::create_directories(folder);
  write_linearization(folder, scene, a.model, a.lin, 6);
  const auto first_line = [&](const char* name) {
    std::ifstream in(folder / name);
    std::string line;
    std::getline(in, line);
    return line;
  };
  EXPECT_EQ(first_line("A.csv"), "rate of," + a.lin.space.states[0] + "," + a.lin.space.states[1]);
  EXPECT_NE(first_line("A.csv").find(" rate [m/s]"), std::string::npos);
  EXPECT_NE(first_line("B.csv").find("motor.offset acceleration [rad/s^2]"), std::string::npos);
  EXPECT_EQ(first_line("C.csv").rfind("output,", 0), 0U);
  for (const char* name : {"D.csv", "linearized.csv", "shapes.csv", "linearized.json"}) EXPECT_FALSE(first_line(name).empty()) << name;
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pintle_scenes::linearize_test
