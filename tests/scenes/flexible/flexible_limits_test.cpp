// Flexible bodies where something else says what they do: the rigid mechanism as they stiffen, the
// whole finite-element model as shapes are added, two halves welded, the coupler of one element by
// its own derivation, and one mode as it dies away.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "framework/bodies/elastic_body.h"
#include "framework/build/build.h"
#include "framework/component/fe/assembly.h"
#include "tests/oracles/flexible_slider_crank.h"
#include "tests/scenes/flexible/flexible_scenes.h"

namespace pintle_scenes::flexible_limits_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using pintle::Status;

namespace pf = pintle_oracle::flexible;

constexpr double size = 0.17;  ///< of the slider-crank, both its links in a line [m]

Whole finished(const std::string& scene) {
  Whole w = run_text(scene);
  EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
  return w;
}

// --- stiffer and stiffer ---

TEST(FlexibleLimit, StiffCouplerTendsToTheRigidMechanismAsOneOverYoungsModulus) {
  // It vibrates about a deflected shape, by as much, and both are in proportion to the compliance.
  constexpr double order = 0.1;  // of a slope over two decades
  const auto moving = [](double young, const std::string& modes) {
    FlexibleBeam beam;
    beam.young = young, beam.modes = modes;
    FlexibleCrank crank{text(beam), 150, 1e-3, 1e-12};
    crank.angle = 1;
    return finished(text(crank));
  };
  const Whole rigid = moving(2e9, "");
  ASSERT_EQ(rigid.model.system.n(), 9);
  for (const char* frame : {"chord", "tangent", "mean axes"}) {
    std::vector<double> stiffer{1e2, 1e4, 1e6}, off;
    for (const double factor : stiffer) {
      const Whole w = moving(factor * 2e9, std::string("{frame: ") + frame + ", count: 2}");
      off.push_back(std::max(apart(w, rigid, "coupler.A"), apart(w, rigid, "coupler.B")));
    }
    for (const double slope : slopes(stiffer, off)) EXPECT_NEAR(slope, -1, order) << frame;
    EXPECT_LE(off.back(), 1e-8 * size) << frame;
  }
}

// --- more and more shapes ---

/// Force on a port of a body whose frame stays at rest: [N], at rad/s.
struct Shake {
  double x, y, omega;
  double at(double t) const { return (1 - std::cos(omega * t)) / 2; }
  std::string text() const {
    const auto law = [&](double f) { return "\"" + std::to_string(f) + "*(1 - cos(" + std::to_string(omega) + "*t))/2\""; };
    return "[" + law(x) + ", " + law(y) + "]";
  }
};

/// Displacement of port b of a body held at port a, in all its dofs by Newmark's average
/// acceleration, at rest at t = 0; every h, 2 × count + 1.
Eigen::Matrix2Xd newmark(const pintle::ElasticBody& e, const std::string& a, const std::string& b, const Shake& shake, double h,
                         int count) {
  const MatrixXd K = MatrixXd(pintle::independent(e.model, e.K)), M = MatrixXd(pintle::independent(e.model, e.M));
  const auto& held = e.model.port(a)->dof;
  const auto& shaken = e.model.port(b)->dof;
  MatrixXd V = MatrixXd::Identity(K.rows(), K.cols() - 3);  // dofs that are not held
  Eigen::Index n = 0;
  for (int i = 0; i < K.rows(); ++i)
    if (std::find(held, held + 3, i) == held + 3) V.col(n++) = VectorXd::Unit(K.rows(), i);
  const MatrixXd k = V.transpose() * K * V, m = V.transpose() * M * V;
  const VectorXd f = V.transpose() * (shake.x * VectorXd::Unit(K.rows(), shaken[0]) + shake.y * VectorXd::Unit(K.rows(), shaken[1]));
  const Eigen::LLT<MatrixXd> mass(m), solver(m + h * h / 4 * k);
  VectorXd u = VectorXd::Zero(n), v = u, acc = mass.solve(f * shake.at(0));
  Eigen::Matrix2Xd out(2, count + 1);
  for (int i = 0; i <= count; ++i) {
    if (i > 0) {
      const VectorXd reach = u + h * v + h * h / 4 * acc;
      const VectorXd next = solver.solve(f * shake.at(i * h) - k * reach);
      u = reach + h * h / 4 * next;
      v += h / 2 * (acc + next);
      acc = next;
    }
    out.col(i) << V.row(shaken[0]).dot(u), V.row(shaken[1]).dot(u);
  }
  return out;
}

/// The same with the leading error, of order h², taken out by a run with half the step.
Eigen::Matrix2Xd full_response(const pintle::ElasticBody& e, const Shake& shake, double until, int outputs) {
  constexpr int between = 200;
  const double h = until / (outputs * between);
  const Eigen::Matrix2Xd coarse = newmark(e, "A", "B", shake, h, outputs * between),
                         fine = newmark(e, "A", "B", shake, h / 2, 2 * outputs * between);
  Eigen::Matrix2Xd out(2, outputs + 1);
  for (int i = 0; i <= outputs; ++i) out.col(i) = (4 * fine.col(2 * i * between) - coarse.col(i * between)) / 3;
  return out;
}

/// Largest distance of point B from what the whole model does, relative to the largest
/// displacement, for each choice of shapes of a body welded to the ground at A.
std::vector<double> errors(const std::vector<std::string>& keeps, const Shake& shake, double until,
                           std::string (*keys)(const std::string& keep)) {
  constexpr int outputs = 40;
  std::vector<double> out;
  Eigen::Matrix2Xd expected;
  for (const std::string& keep : keeps) {
    const std::string scene = "ground: {points: {O: [0, 0]}}\nbodies:\n" + body_text("part", keys(keep)) +
                              "joints: {root: {weld: [ground.O, part.A]}}\nforces: {shake: {force: " + shake.text() +
                              ", at: part.B}}\nrun: {until: " + std::to_string(until) +
                              ", tolerance: 1e-12}\noutput: {every: " + std::to_string(until / outputs) + ", points: [part.B]}\n";
    const Whole w = finished(scene);
    if (expected.size() == 0) {
      const pintle::Scene s = scene_of(scene);
      expected = full_response(pintle::elastic_body(s, s.bodies[0]), shake, until, outputs);
    }
    const auto x = w.column("part.B.ux [m]"), y = w.column("part.B.uy [m]");
    double worst = 0;
    for (int i = 0; i <= outputs; ++i) {
      const auto k = static_cast<std::size_t>(i);
      worst = std::max(worst, (Eigen::Vector2d(x[k], y[k]) - expected.col(i)).norm());
    }
    out.push_back(worst / expected.colwise().norm().maxCoeff());
  }
  return out;
}

// What Newmark's method leaves after extrapolation, and a run at tolerance 1e-12 of the body's
// length where displacements are some 1e-3 of that.
constexpr double whole_model = 1e-7;

void expect_convergence(const std::vector<double>& errors) {
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) EXPECT_LT(errors[i + 1], errors[i]) << i;
  EXPECT_GT(errors.front(), 1e3 * whole_model);  // few shapes are not enough
  EXPECT_LE(errors.back(), whole_model);
}

TEST(FlexibleLimit, WeldedBeamWithMoreShapesMeetsTheWholeModel) {
  expect_convergence(
      errors({"count: 1", "count: 2", "count: 4", "count: 8", "keep: all"}, {2e3, 500, 3000}, 4e-3, [](const std::string& keep) {
        FlexibleBeam beam;
        beam.modes = "{frame: tangent, " + keep + "}";
        return text(beam);
      }));
}

TEST(FlexibleLimit, PlateWeldedByAHoleWithMoreShapesMeetsTheWholeModel) {
  expect_convergence(errors({"count: 1", "count: 2", "count: 4", "count: 8", "count: 16", "count: 32", "keep: all"}, {2e3, 500, 3000}, 1e-3,
                            [](const std::string& keep) { return holed_plate("{frame: {tangent: A}, " + keep + "}"); }));
}

TEST(FlexibleLimit, MovingCouplerWithMoreShapesMeetsTheCompleteBasis) {
  constexpr double same = 1e-9;  // twelve shapes are all there are
  const auto moving = [](const std::string& keep) {
    FlexibleBeam beam;
    beam.modes = "{frame: chord, " + keep + "}";
    FlexibleCrank crank{text(beam), 150, 4e-3};
    crank.angle = 1;
    crank.points = "coupler.M, coupler.B";
    return finished(text(crank));
  };
  const Whole all = moving("keep: all");
  std::vector<double> off;
  for (const char* keep : {"count: 1", "count: 2", "count: 4", "count: 8", "count: 12"}) {
    const Whole few = moving(keep);
    off.push_back(std::max(apart(few, all, "coupler.M"), apart(few, all, "coupler.B")) / size);
  }
  for (std::size_t i = 0; i + 1 < off.size(); ++i) EXPECT_LT(off[i + 1], off[i]) << i;
  EXPECT_GT(off.front(), 1e3 * same);
  EXPECT_LE(off.back(), same);
}

// --- halves ---

/// Largest distance between a point of one run and another point of another.
double distance(const Whole& a, const std::string& p, const Whole& b, const std::string& q) {
  const auto ax = a.column(p + ".x [m]"), ay = a.column(p + ".y [m]"), bx = b.column(q + ".x [m]"), by = b.column(q + ".y [m]");
  double most = 0;
  for (std::size_t i = 0; i < ax.size(); ++i) most = std::max(most, std::hypot(ax[i] - bx[i], ay[i] - by[i]));
  return most;
}

TEST(FlexibleLimit, HalvesWeldedTogetherMoveAsTheWhole) {
  // The frame of the far half turns with the cut, by an angle β in proportion to the force, and
  // takes the whole's linear strain for another at order β²: of deflections that is of order β.
  constexpr double linear = 1e-6;  // where β is 5e-7
  constexpr double order = 0.01;   // of a slope where the next power is 1e-3 of this one
  const auto whole = [](double force) {
    FlexibleBeam beam;
    beam.modes = "{frame: tangent, keep: all}";
    return "bodies:\n" + body_text("rod", text(beam)) +
           "joints: {root: {weld: [ground, rod.A]}}\nforces: {shake: {force: " + Shake{4 * force, force, 3000}.text() +
           ", at: rod.B}}\nrun: {until: 2e-3, tolerance: 1e-13}\noutput: {every: 5e-5, points: "
           "[rod.M, rod.B]}\n";
  };
  const auto halves = [](double force) {
    FlexibleBeam beam;
    beam.length = 0.06, beam.mass = 0.105, beam.elements = 2, beam.modes = "{frame: tangent, keep: all}";
    return "bodies:\n" + body_text("near", text(beam)) + body_text("far", text(beam) + "pose: {at: [0.06, 0]}\n") +
           "joints: {root: {weld: [ground, near.A]}, cut: {weld: [near.B, far.A]}}\nforces: "
           "{shake: {force: " +
           Shake{4 * force, force, 3000}.text() +
           ", at: far.B}}\nrun: {until: 2e-3, tolerance: 1e-13}\noutput: {every: 5e-5, points: "
           "[near.B, far.B]}\n";
  };
  std::vector<double> bent, off;
  for (const double force : {0.005, 0.5, 50.}) {
    const Whole one = finished(whole(force)), two = finished(halves(force));
    bent.push_back(deflection(one, "rod.B"));
    off.push_back(std::max(distance(one, "rod.M", two, "near.B"), distance(one, "rod.B", two, "far.B")));
  }
  EXPECT_LE(off.front(), linear * bent.front());
  for (const double slope : slopes(bent, off)) EXPECT_NEAR(slope, 2, order);
}

// --- the coupler of one element ---

TEST(FlexibleSliderCrank, OfOneElementMovesAsItsOwnDerivationSays) {
  constexpr double motion = 1e-7;  // of the largest value in the run
  for (const bool damped : {false, true}) {
    FlexibleBeam beam;
    beam.elements = 1;
    beam.modes = "{frame: chord, keep: all}";
    if (damped) beam.more = "damping: {rayleigh: {ratios: [0.04, 0.04]}}\n";
    beam.at = 0;  // no point between the ends
    const Whole w = finished(text(FlexibleCrank{text(beam), 150, 0.05, 1e-13}));
    pf::Params p{.clearance = 0};
    if (damped) p.zeta[0] = p.zeta[1] = 0.04;
    pf::Options options;
    options.tolerance = 1e-12;
    const auto oracle = pf::simulate(p, options, pf::start(p), w.column("t [s]"));
    ASSERT_TRUE(oracle.completed);
    // θ, φ, s, α_A, α_B, x
    const char* names[] = {"crank.angle [rad]",    "coupler.angle [rad]",  "coupler.B.ux [m]",
                           "coupler.A.turn [rad]", "coupler.B.turn [rad]", "slider.x [m]"};
    for (std::size_t i = 0; i < 6; ++i) {
      std::vector<double> expected;
      for (const pf::Sample& s : oracle.samples) expected.push_back(s.state.y[i]);
      EXPECT_LE(relative_difference(w.column(names[i]), expected), motion) << names[i] << (damped ? ", damped" : "");
    }
    std::vector<double> strain;
    for (const pf::Sample& s : oracle.samples) strain.push_back(s.strain);
    EXPECT_LE(relative_difference(w.run.ledger.column("strain [J]"), strain), motion);
    if (damped) {
      std::vector<double> lost;
      for (const pf::Sample& s : oracle.samples) lost.push_back(s.state.y[14]);
      EXPECT_LE(relative_difference(w.run.ledger.column("coupler.lost to damping [J]"), lost), motion);
    }
  }
}

// --- damping ---

/// η of a shape let go at 1, and its energy over that at the start.
struct Decay {
  double omega, zeta;
  double eta(double t) const {
    const double d = omega * std::sqrt(1 - zeta * zeta);
    return std::exp(-zeta * omega * t) * (std::cos(d * t) + zeta * omega / d * std::sin(d * t));
  }
  double energy(double t) const {
    const double d = omega * std::sqrt(1 - zeta * zeta);
    const double rate = -std::exp(-zeta * omega * t) * omega * omega / d * std::sin(d * t) / omega;
    return eta(t) * eta(t) + rate * rate;
  }
};

/// Lets body 0 of a scene go at rest in shapes of these amplitudes, which each die away by
/// themselves.
void expect_decay(const std::string& scene, const std::vector<double>& amplitudes) {
  constexpr double enough = 1e-8;  // of a run at tolerance 1e-12 where shapes move 1e-3 of a length
  const pintle::Scene s = scene_of(scene);
  Whole w;
  w.model = pintle::build(s);
  w.assembly = pintle::assemble(s, w.model);
  const auto& flex = *w.model.system.bodies[0].flex;
  const int begin = w.model.system.eta_begin[0];
  double largest = 0;
  for (const double a : amplitudes) largest = std::max(largest, std::abs(a));
  for (std::size_t i = 0; i < amplitudes.size(); ++i) w.assembly.start.y[begin + static_cast<int>(i)] = amplitudes[i];
  w.run = pintle::simulate(s, w.model, w.assembly);
  ASSERT_EQ(w.run.status, Status::finished);

  const auto t = w.column("t [s]");
  std::vector<double> energy(t.size());
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const auto eta = w.column("rod.mode " + std::to_string(i + 1) + " [m kg^0.5]");
    const Decay d{flex.omega[static_cast<int>(i)], flex.zeta[static_cast<int>(i)]};
    for (std::size_t k = 0; k < t.size(); ++k) {
      EXPECT_NEAR(eta[k], amplitudes[i] * d.eta(t[k]), enough * largest) << i << ", " << t[k];
      energy[k] += std::pow(d.omega * amplitudes[i], 2) / 2 * d.energy(t[k]);
    }
  }
  const auto lost = w.run.ledger.column("rod.lost to damping [J]");
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(lost[k], energy[0] - energy[k], enough * energy[0]) << t[k];
  EXPECT_GT(lost.back(), 0.1 * energy[0]);
  EXPECT_LE(std::abs(w.run.worst_unexplained), enough * energy[0]);
}

std::string damped_rod(const std::string& frame, const std::string& damping) {
  FlexibleBeam beam;
  beam.modes = "{frame: " + frame + ", count: 4}";
  beam.more = "damping: {" + damping + "}\n";
  return "run: {until: 4e-3, tolerance: 1e-12}\noutput: {every: 1e-4}\nbodies:\n" + body_text("rod", text(beam));
}

const char* const dampings[] = {"rayleigh: {ratios: [0.02, 0.05]}", "ratios: [0.1, 0.02, 0, 0.3]", "rayleigh: {alpha: 300, beta: 1e-6}"};

TEST(FlexibleDamping, ShapesOfAHeldBodyDieAwayEachByItsRatio) {
  for (const char* damping : dampings) {
    SCOPED_TRACE(damping);
    expect_decay(damped_rod("tangent", damping) + "joints: {root: {weld: [ground, rod.A]}}\n", {1e-3, 5e-4, -3e-4, 2e-4});
  }
}

TEST(FlexibleDamping, ShapeOfAFreeBodyDiesAwayByItsRatio) {
  // One at a time: two together would turn the frame.
  for (const char* damping : dampings)
    for (const std::size_t shape : {0u, 1u, 3u}) {
      SCOPED_TRACE(damping);
      std::vector<double> amplitudes(4);
      amplitudes[shape] = 1e-4;
      expect_decay(damped_rod("mean axes", damping), amplitudes);
    }
}

TEST(FlexibleDamping, LedgerOfAMovingCouplerCloses) {
  constexpr double closing = 1e-9;  // at tolerance 1e-10, over 1e3 to 1e4 steps
  for (const char* frame : {"chord", "tangent", "mean axes"}) {
    FlexibleBeam beam;
    beam.modes = std::string("{frame: ") + frame + ", count: 3}";
    beam.more = "damping: {rayleigh: {ratios: [0.04, 0.04]}}\n";
    const Whole w = finished(text(FlexibleCrank{text(beam), 150, 0.05, 1e-10}));
    EXPECT_LE(std::abs(w.run.worst_unexplained), closing * w.run.energy_in_play) << frame;
    // A loss a thousand times as large cannot be missing from it.
    EXPECT_GE(w.ledger("coupler.lost to damping [J]"), 1e3 * closing * w.run.energy_in_play) << frame;
  }
}

}  // namespace
}  // namespace pintle_scenes::flexible_limits_test
