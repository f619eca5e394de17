// Static answers, loads and stresses, judged by closed forms of beams, rods, thick cylinders and
// the plate with a hole, and by equilibrium.

#include "framework/component/fe/statics.h"

#include "framework/component/fe/from_mesh.h"
#include "framework/component/fe/loads.h"
#include "tests/unit/component/fe_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace pintle::statics_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Relative. Some hundred dofs on beams of ten elements: condition 1e4 to 1e5 times 1e-16.
constexpr double rounding = 1e-10;

StaticSolution solve(const FeModel& m, const Supports& supports, const VectorXd& load) {
  return solve_static(m, Assembler(m).stiffness(), supports, load);
}

const BeamEuler euler{2e8, 1500, 8, 0};
const BeamTimoshenko timoshenko{2e8, 1500, 3e6, 8, 1e-3};

/// A beam from (1, 2) along `angle`, clamped at its start.
template <class E>
struct Cantilever {
  FeModel model;
  Supports supports;
  Vector2d along, across;

  Cantilever(const E& e, int count, double length, double angle) : along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x()) {
    const Vector2d from(1, 2);
    model = chain(e, count, from, from + length * along);
    add_ports(model, {{"tip", count}}, {});
    hold(supports, model, 0, true, true, true);
  }
};

// Elements EA n/L stiff along themselves move by the deflection w. Each entry of the stiffness and each product with it is off by
// some ten units in the last place, so a node's force by a few times that of EA n/L w; the reactions have those of all nodes.
// Across the beam, a force that is off bends it: EA L²/3EI n such units of the deflection.
TEST(Cantilever, EndLoadsAreMetExactlyByAnyNumberOfElements) {
  const double L = 1.7, P = 300, Q = 40, T = 25;
  for (const int count : {1, 2, 7})
    for (const double angle : {0.0, 0.8, -2.4}) {
      const double units = 40 * (count + 1) * std::numeric_limits<double>::epsilon();
      const double force = units * timoshenko.EA * count / L;  // for each metre of deflection
      const double bending = force * L * L * L / (3 * timoshenko.EI);
      const Cantilever c(timoshenko, count, L, angle);
      VectorXd f = VectorXd::Zero(c.model.n());
      add_force(f, *c.model.port("tip"), Q * c.along + P * c.across, T);
      const StaticSolution s = solve(c.model, c.supports, f);
      const Vector2d tip = s.u.segment<2>(3 * count);
      const double EI = timoshenko.EI;
      const double deflection = P * L * L * L / (3 * EI) + T * L * L / (2 * EI) + P * L / timoshenko.kGA;
      EXPECT_NEAR(tip.dot(c.across), deflection, bending * deflection);
      EXPECT_NEAR(tip.dot(c.along), Q * L / timoshenko.EA, units * count * deflection);
      EXPECT_NEAR(s.u[3 * count + 2], P * L * L / (2 * EI) + T * L / EI, 2 * bending * deflection / L);
      const Vector2d held = s.reactions.head<2>();
      EXPECT_LT((held + Q * c.along + P * c.across).norm(), force * deflection);
      EXPECT_NEAR(s.reactions[2], -P * L - T, force * deflection * L);
      EXPECT_NEAR(s.strain_energy, f.dot(s.u) / 2, bending * s.strain_energy);
      EXPECT_LT(s.residual * s.reactions.norm(), force * deflection);
    }
}

TEST(Cantilever, AnEvenLoadIsMetExactlyAtTheNodes) {
  const double L = 1.7, q = 120;
  for (const int count : {1, 4}) {
    const Cantilever c(euler, count, L, 0.8);
    const VectorXd f = line_load(c.model, q * c.across);
    const StaticSolution s = solve(c.model, c.supports, f);
    for (int i = 1; i <= count; ++i) {
      const double x = L * i / count;
      const double w = q * x * x * (6 * L * L - 4 * L * x + x * x) / (24 * euler.EI);
      EXPECT_NEAR(s.u.segment<2>(3 * i).dot(c.across), w, rounding * w);
    }
  }
}

// 1000 elements have condition 1e12, which leaves 1e-4; they are no mechanism.
TEST(Cantilever, AFineMeshOfASlenderBeamIsNotTakenForAMechanism) {
  const double L = 10, P = 1;
  const Cantilever c(euler, 1000, L, 0);
  VectorXd f = VectorXd::Zero(c.model.n());
  add_force(f, *c.model.port("tip"), {0, P}, 0);
  const double deflection = P * L * L * L / (3 * euler.EI);
  EXPECT_NEAR(solve(c.model, c.supports, f).u[3 * 1000 + 1], deflection, 1e-3 * deflection);
}

/// A rod of bars along x, hung at its start and guided across.
struct Rod {
  static constexpr double EA = 3e6, rhoA = 5, length = 2;
  static constexpr int count = 9;
  FeModel model = chain(Bar{EA, rhoA}, count, {0, 0}, {length, 0});
  Supports supports;
  Sparse M = Assembler(model).mass();
  Rod() {
    for (int i = 0; i <= count; ++i) hold(supports, model, i, i == 0, true, false);
  }
};

TEST(Rod, SpunAboutItsEndItStretchesAsItsFieldOfForceSays) {
  const Rod rod;
  const double w = 30;
  const StaticSolution s = solve(rod.model, rod.supports, spin_load(rod.model, rod.M, w, {0, 0}));
  const double L = Rod::length, stretch = Rod::rhoA * w * w * L * L * L / (3 * Rod::EA);
  EXPECT_NEAR(s.u[2 * Rod::count], stretch, rounding * stretch);
  EXPECT_NEAR(s.reactions[0], -Rod::rhoA * w * w * L * L / 2, rounding * Rod::rhoA * w * w);
}

TEST(Rod, HungItStretchesUnderItsWeight) {
  const Rod rod;
  const StaticSolution s = solve(rod.model, rod.supports, acceleration_load(rod.model, rod.M, {9.81, 0}));
  const double stretch = Rod::rhoA * 9.81 * Rod::length * Rod::length / (2 * Rod::EA);
  EXPECT_NEAR(s.u[2 * Rod::count], stretch, rounding * stretch);
}

TEST(SpinLoad, PullsTheMassCentreAwayFromTheAxis) {
  const FeModel m = chain(timoshenko, 3, {1, 2}, {3, 3}, {{3, {5, 0.1}}});
  const Sparse M = Assembler(m).mass();
  const Vector2d about(0.4, -0.3);
  const double rod = timoshenko.rhoA * std::sqrt(5.0), w = -7;
  const Vector2d pull = w * w * (rod * (Vector2d(2, 2.5) - about) + 5 * (Vector2d(3, 3) - about));
  const VectorXd f = spin_load(m, M, w, about);
  Vector2d sum(0, 0);
  for (int i = 0; i < 4; ++i) sum += f.segment<2>(3 * i);
  EXPECT_LT((sum - pull).norm(), rounding * pull.norm());
}

Vector2d resultant(const FeModel& m, const VectorXd& nodal_load) {
  Vector2d sum(0, 0);
  for (const int at : m.begin)
    if (at < m.N()) sum += nodal_load.segment<2>(at);
  return sum;
}
double moment(const FeModel& m, const VectorXd& nodal_load, const Vector2d& about) {
  double sum = 0;
  for (Eigen::Index i = 0; i < m.x.cols(); ++i) {
    const Vector2d r = m.x.col(i) - about, f = nodal_load.segment<2>(m.begin[static_cast<std::size_t>(i)]);
    sum += r.x() * f.y() - r.y() * f.x();
  }
  return sum;
}

// Pressure on a quarter arc pushes as it would on the arc's two projections.
TEST(PressureLoad, OnAQuarterOfABorePushesOutward) {
  const Quarter q(0.1, 0.3, 5, 2, CellShape::quadrilateral8, PlaneState::stress);
  const VectorXd f = pressure_load(q.model, q.plate.edge.at("bottom"), 4e6, 0.01);
  const double push = 4e6 * 0.01 * 0.1;
  EXPECT_LT((resultant(q.model, f) - Vector2d(push, push)).norm(), rounding * push);
  EXPECT_NEAR(moment(q.model, f, {0, 0}), 0, rounding * push * 0.1);
}

TEST(TractionLoad, OnAnEdgeIsItsAreaTimesTheTraction) {
  const Plate p = plate(3, 2, CellShape::triangle6, bent_rectangle(2, 1));
  const FeModel m = model_of(p, steel(PlaneState::stress));
  const VectorXd f = traction_load(m, p.edge.at("right"), {3e6, -1e6}, 0.01);
  EXPECT_LT((resultant(m, f) - Vector2d(3e4, -1e4)).norm(), rounding * 3e4);
  EXPECT_NEAR(moment(m, f, {0, 0}), 2 * -1e4 - 0.5 * 3e4, rounding * 3e4);
}

/// A ring whose bore has a port in its middle; its outer edge may be held.
struct PortedRing {
  Plate plate;
  FeModel model;
  Supports outside;
  std::vector<int> rim;
  std::vector<double> weights;
};
PortedRing ported_ring(Coupling coupling) {
  const Vector2d center(0.4, -0.2);
  PortedRing r;
  r.plate = plate(12, 3, CellShape::quadrilateral8, ring(0.1, 0.3, 0.3, 2 * M_PI, center), true);
  Group group{"hole", r.plate.nodes["bottom"], r.plate.edge["bottom"]};
  std::sort(group.nodes.begin(), group.nodes.end());
  r.rim = group.nodes;
  r.weights = rim_weights(r.plate.mesh, group);
  r.model = model_of(r.plate, steel(PlaneState::stress));
  add_ports(r.model, {}, {{"eye", center, r.rim, r.weights, coupling}});
  for (const int i : r.plate.nodes["top"]) hold(r.outside, r.model, i, true, true, false);
  return r;
}

// The elastic forces K u on the rim are what the coupling puts there: by weight, and for a torque
// by weight times arm about the middle.
TEST(AverageCoupling, SpreadsAForceAndATorqueOverTheRimByWeight) {
  const PortedRing r = ported_ring(Coupling::average);
  const Vector2d force(3e4, -2e4), center = r.model.port("eye")->x;
  const double torque = 700;
  VectorXd load = VectorXd::Zero(r.model.n());
  add_force(load, *r.model.port("eye"), force, torque);
  const Sparse K = Assembler(r.model).stiffness();
  const StaticSolution s = solve_static(r.model, K, r.outside, load);
  const VectorXd elastic = K * s.u;
  double length = 0, inertia = 0;
  for (std::size_t k = 0; k < r.rim.size(); ++k) {
    length += r.weights[k];
    inertia += r.weights[k] * (Vector2d(r.model.x.col(r.rim[k])) - center).squaredNorm();
  }
  for (std::size_t k = 0; k < r.rim.size(); ++k) {
    const Vector2d arm = Vector2d(r.model.x.col(r.rim[k])) - center;
    const Vector2d share = r.weights[k] * (force / length + torque / inertia * Vector2d(-arm.y(), arm.x()));
    EXPECT_LT((elastic.segment<2>(2 * r.rim[k]) - share).norm(), rounding * force.norm());
  }
}

TEST(AverageCoupling, ThePortEndsWhereTheRimIsOnAverage) {
  const PortedRing r = ported_ring(Coupling::average);
  VectorXd load = VectorXd::Zero(r.model.n());
  const Port& eye = *r.model.port("eye");
  add_force(load, eye, {3e4, -2e4}, 700);
  // ũ at the port, by the work that unit loads do there.
  const StaticSolution s = solve(r.model, r.outside, load);
  Vector2d mean(0, 0);
  double turn = 0, length = 0, inertia = 0;
  for (std::size_t k = 0; k < r.rim.size(); ++k) {
    const Vector2d arm = Vector2d(r.model.x.col(r.rim[k])) - eye.x, u = s.u.segment<2>(2 * r.rim[k]);
    mean += r.weights[k] * u;
    turn += r.weights[k] * (arm.x() * u.y() - arm.y() * u.x());
    length += r.weights[k];
    inertia += r.weights[k] * arm.squaredNorm();
  }
  const double work = (mean / length).dot(Vector2d(3e4, -2e4)) + turn / inertia * 700;
  EXPECT_NEAR(s.strain_energy, work / 2, rounding * work);
}

// A rigid rim is a constraint more: less strain energy under the same force (0.3 % in this thick
// ring).
TEST(RigidCoupling, IsStifferThanTheAverage) {
  const auto energy = [](Coupling coupling) {
    const PortedRing r = ported_ring(coupling);
    VectorXd load = VectorXd::Zero(r.model.n());
    add_force(load, *r.model.port("eye"), {3e4, 0}, 0);
    return solve(r.model, r.outside, load).strain_energy;
  };
  EXPECT_LT(energy(Coupling::rigid), (1 - 1e-6) * energy(Coupling::average));
}

TEST(Reactions, AtAPortBalanceLoadsInForceAndMoment) {
  for (const Coupling coupling : {Coupling::rigid, Coupling::average}) {
    const PortedRing r = ported_ring(coupling);
    const Port& eye = *r.model.port("eye");
    Supports supports;
    hold(supports, r.model, eye, true, true, true);
    std::vector<Cells> quarter = r.plate.edge.at("top");
    quarter[0].nodes.resize(3 * 3);
    quarter[0].numbers.resize(3);
    const VectorXd f = pressure_load(r.model, quarter, 2e6, 0.01) + acceleration_load(r.model, Assembler(r.model).mass(), {1, -9.81}) +
                       traction_load(r.model, quarter, {4e6, 1e6}, 0.01);
    const StaticSolution s = solve(r.model, supports, independent_load(r.model, f));
    const Vector2d held(s.reactions[eye.dof[0]], s.reactions[eye.dof[1]]);
    EXPECT_LT((held + resultant(r.model, f)).norm(), rounding * held.norm());
    EXPECT_NEAR(s.reactions[eye.dof[2]], -moment(r.model, f, eye.x), rounding * held.norm());
  }
}

TEST(Reactions, AlongAnEdgeBalanceLoadsInForceAndMoment) {
  const PortedRing r = ported_ring(Coupling::average);
  const VectorXd f = acceleration_load(r.model, Assembler(r.model).mass(), {0, -9.81});
  VectorXd load = independent_load(r.model, f);
  const Port& eye = *r.model.port("eye");
  const Vector2d force(100, 50);
  add_force(load, eye, force, 20);
  const StaticSolution s = solve(r.model, r.outside, load);
  VectorXd held = VectorXd::Zero(r.model.N());
  for (int i = 0; i < r.model.N(); ++i)
    if (const int k = r.model.independent_of(i); k >= 0) held[i] = s.reactions[k];
  const Vector2d sum = resultant(r.model, held) + resultant(r.model, f) + force;
  EXPECT_LT(sum.norm(), rounding * force.norm());
  const double turn = moment(r.model, held, eye.x) + moment(r.model, f, eye.x) + 20;
  EXPECT_NEAR(turn, 0, rounding * force.norm());
}

TEST(SolveStatic, SizesAndNumbersAreJudged) {
  const Cantilever c(euler, 2, 1, 0);
  const Sparse K = Assembler(c.model).stiffness();
  const VectorXd f = VectorXd::Zero(9);
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { solve_static(c.model, K, c.supports, VectorXd::Zero(8)); }), "must be 9"));
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] {
                     solve_static(c.model, restricted(K, {3, 4, 5}), c.supports, f);
                   }),
                   "must be 9 square"));
  const VectorXd bad = VectorXd::Constant(9, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(says(refusal<std::runtime_error>([&] { solve_static(c.model, K, c.supports, bad); }), "not finite"));
}

TEST(SolveStatic, NoLoadMovesNothing) {
  const Cantilever c(euler, 2, 1, 0);
  const StaticSolution s = solve(c.model, c.supports, VectorXd::Zero(9));
  EXPECT_EQ(s.u.norm(), 0);
  EXPECT_EQ(s.residual, 0);
}

TEST(Restricted, IsThePrincipalSubmatrix) {
  const Cantilever c(euler, 3, 1, 0.4);
  const Sparse K = Assembler(c.model).stiffness();
  const std::vector<int> keep = free_dofs(c.model, c.supports);
  ASSERT_EQ(keep.size(), 9u);
  const Eigen::MatrixXd whole(K), part(restricted(K, keep));
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) EXPECT_EQ(part(i, j), whole(keep[static_cast<std::size_t>(i)], keep[static_cast<std::size_t>(j)]));
}

TEST(LineLoad, OnAPlateIsRefused) {
  const FeModel m = model_of(plate(1, 1, CellShape::triangle3, rectangle(1, 1)), steel(PlaneState::stress));
  EXPECT_TRUE(says(refusal<std::invalid_argument>([&] { line_load(m, {1, 0}); }), "no beams or bars"));
}

}  // namespace
}  // namespace pintle::statics_test
