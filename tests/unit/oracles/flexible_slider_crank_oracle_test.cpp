// The flexible slider-crank of tests/oracles against the definitions it was derived from, the rigid
// one and closed forms. Nothing of the framework is in here.
#include "tests/oracles/flexible_slider_crank.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pintle_oracle::flexible::flexible_slider_crank_oracle_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Relative to the size of the terms.
constexpr double rounding = 1e-12;
constexpr double difference = 1e-7;  // central, over 1e-5 of a radian, a length or a second
constexpr double closing = 1e-9;     // of the ledger in a run at tolerance 1e-10, some 1e4 steps
constexpr double order = 0.1;        // of a slope over two decades
// A loss that is a thousand times what a ledger may be open by cannot be missing from it [J].
constexpr double plain = 1e3 * closing * 5.2;
// Vibration of a coupler 1e5 times as stiff: its speeds fall as the root of that.
constexpr double vibration = 3e-3;

/// Any state of a bent coupler, open; deflections of a size that makes each term count.
Y bent(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Y y{};
  const double size_of[dynamic] = {3,   3,   0.02, 0.3, 0.3, 0.2,  // m and rad
                                   100, 100, 10,   100, 100, 10};
  for (std::size_t i = 0; i < dynamic; ++i) y[i] = size_of[i] * unit(random);
  return y;
}

/// Of the coupler's axis, as the header defines it.
Vector2d axis(const Params& p, const Y& y, double xi) {
  const double n2 = xi - 2 * xi * xi + xi * xi * xi, n4 = xi * xi * xi - xi * xi;
  const Vector2d u((p.coupler + y[2]) * xi, p.coupler * (n2 * y[3] + n4 * y[4]));
  return Vector2d(p.crank * std::cos(y[0]), p.crank * std::sin(y[0])) + Eigen::Rotation2Dd(y[1]) * u;
}

/// ∫ f dξ by Simpson's rule, which leaves 1e-9 of polynomials of degree six.
template <class F>
double along_axis(F f) {
  constexpr int panels = 200;
  double sum = 0;
  for (int i = 0; i <= panels; ++i) sum += (i == 0 || i == panels ? 1 : 2 + 2 * (i % 2)) * f(static_cast<double>(i) / panels);
  return sum / (3 * panels);
}

/// By differences of where the points are.
double kinetic_energy(const Params& p, const Y& y, const Vector6& rate) {
  const double h = 1e-7;  // 1e-5 of a radian or a length at the rates in use here
  Y before = y, after = y;
  for (std::size_t i = 0; i < dofs; ++i) {
    before[i] -= h * rate[static_cast<int>(i)];
    after[i] += h * rate[static_cast<int>(i)];
  }
  const double coupler = along_axis([&](double xi) { return ((axis(p, after, xi) - axis(p, before, xi)) / (2 * h)).squaredNorm(); });
  const double crank = p.crank_inertia + p.crank_mass * p.crank * p.crank / 4;
  return 0.5 * (p.coupler_mass * coupler + crank * rate[0] * rate[0] + p.slider_mass * rate[5] * rate[5]);
}

double gravity_energy(const Params& p, const Y& y) {
  const double coupler = along_axis([&](double xi) { return axis(p, y, xi).y(); });
  return p.gravity * (p.coupler_mass * coupler + p.crank_mass * p.crank / 2 * std::sin(y[0]));
}

Y moved(Y y, std::size_t i, double by) {
  y[i] += by;
  return y;
}

std::vector<double> instants(double end, int count) {
  std::vector<double> t;
  for (int i = 0; i <= count; ++i) t.push_back(end * i / count);
  return t;
}

/// Largest departure of the ledger from its first value, relative to that.
double opening(const Result& run) {
  double worst = 0;
  for (const Sample& s : run.samples) worst = std::max(worst, std::abs(s.ledger / run.samples.front().ledger - 1));
  return worst;
}

TEST(FlexibleSliderCrankOracle, StartsWithTheEnergyOfARodForACoupler) {
  // ½ (I₁ + m₁L₁²/4 + m₂L₁²/3) ω²: the coupler turns about its end B.
  EXPECT_NEAR(evaluate(Params{}, start({})).ledger, 5.203125, rounding * 5.203125);
}

TEST(FlexibleSliderCrankOracle, MassMatrixIsThatOfTheMovingPoints) {
  const Params p;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Y y = bent(seed);
    const Matrix6 M = inertia(p, y).mass;
    for (int i = 0; i < dofs; ++i)
      for (int j = 0; j < dofs; ++j) {
        // Scaled such that all six directions move some point by as much.
        const double a = 1 / std::sqrt(M(i, i)), b = 1 / std::sqrt(M(j, j));
        const Vector6 u = a * Vector6::Unit(i), v = b * Vector6::Unit(j);
        const double product = 0.5 * (kinetic_energy(p, y, u + v) - kinetic_energy(p, y, u - v));
        EXPECT_NEAR(a * b * M(i, j), product, difference) << i << ", " << j;
      }
  }
}

TEST(FlexibleSliderCrankOracle, VelocityTermsAreThoseOfLagrangesEquations) {
  const Params p;
  const double h = 1e-5;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Y y = bent(seed);
    const Vector6 rate = Eigen::Map<const Vector6>(y.data() + dofs);
    Vector6 expected = Vector6::Zero();  // Ṁ q̇ − ∂T/∂q
    for (std::size_t i = 0; i < dofs; ++i) {
      const int row = static_cast<int>(i);
      const Matrix6 slope = (inertia(p, moved(y, i, h)).mass - inertia(p, moved(y, i, -h)).mass) / (2 * h);
      expected += rate[row] * (slope * rate);
      expected[row] -= 0.5 * rate.dot(slope * rate);
    }
    const Vector6 found = inertia(p, y).velocity;
    for (int i = 0; i < dofs; ++i) EXPECT_NEAR(found[i], expected[i], difference * expected.cwiseAbs().maxCoeff()) << i;
  }
}

TEST(FlexibleSliderCrankOracle, WeightIsTheFallOfGravitysEnergy) {
  const Params p;
  const double h = 1e-5;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    State s;
    s.y = bent(seed);
    const Vector6 found = inertia(p, s.y).weight;
    const double size_of = found.cwiseAbs().maxCoeff();
    EXPECT_NEAR(evaluate(p, s).gravity, gravity_energy(p, s.y), difference * size_of);
    for (std::size_t i = 0; i < dofs; ++i)
      EXPECT_NEAR(found[static_cast<int>(i)], -(gravity_energy(p, moved(s.y, i, h)) - gravity_energy(p, moved(s.y, i, -h))) / (2 * h),
                  difference * size_of)
          << i;
  }
}

TEST(FlexibleSliderCrankOracle, FrequenciesAreThoseOfOneElementOnPins) {
  const Params p;
  const double bending = std::sqrt(p.ei / (p.rho_a * std::pow(p.coupler, 4)));
  const double axial = std::sqrt(p.ea / p.rho_a) / p.coupler;
  const Vector3d expected(std::sqrt(120) * bending, std::sqrt(2520) * bending, std::sqrt(3) * axial);
  EXPECT_LE((beam(p).omega - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), rounding);
}

TEST(FlexibleSliderCrankOracle, DampingRatiosAreThoseAskedFor) {
  Params p;
  p.zeta[0] = 0.03, p.zeta[1] = 0.07;
  const Beam b = beam(p);
  const Vector3d shapes[] = {{0, 1, -1}, {0, 1, 1}};  // one and two half waves
  for (int i = 0; i < 2; ++i) {
    const Vector3d& v = shapes[i];
    const double ratio = v.dot(b.damping * v) / (2 * b.omega[i] * v.dot(b.mass * v));
    EXPECT_NEAR(ratio, p.zeta[i], rounding) << i;
  }
}

TEST(FlexibleSliderCrankOracle, AccelerationsKeepAnIdealPinOnTheSlide) {
  const Params p{.clearance = 0};
  State s;
  s.y = {1, 0, 1e-3, 0.1, -0.05, 0, 150, 0, 0.5, 20, -30, 0};
  close_loop(p, s.y);
  Y dy;
  rhs(p, s, dy);
  const double h = 1e-7;  // 1e-5 of a radian of the crank
  Y before = s.y, after = s.y;
  for (std::size_t i = 0; i < size; ++i) before[i] -= h * dy[i], after[i] += h * dy[i];
  close_loop(p, before);
  close_loop(p, after);
  for (const std::size_t i : {7u, 11u}) EXPECT_NEAR(dy[i], (after[i] - before[i]) / (2 * h), difference * std::abs(dy[i])) << i;
  EXPECT_NEAR(p.slider_mass * dy[11], -evaluate(p, s).pin_force.x(), rounding * std::abs(p.slider_mass * dy[11]));
}

TEST(FlexibleSliderCrankOracle, LedgerOfAnIdealPinCloses) {
  const Params p{.zeta = {0.04, 0.04}, .clearance = 0};
  const Result run = simulate(p, {}, start(p), instants(0.05, 50));
  ASSERT_TRUE(run.completed);
  EXPECT_LE(opening(run), closing);
  EXPECT_GT(run.end.y[14], plain);
}

TEST(FlexibleSliderCrankOracle, LedgerOfAClearancePinClosesThroughImpacts) {
  for (const bool bearing_on_slider : {true, false})
    for (const Slip slip : {Slip::material, Slip::geometric}) {
      const Params p{.zeta = {0.04, 0.04}, .mu = 0.1, .slip = slip, .bearing_on_slider = bearing_on_slider};
      const Result run = simulate(p, {}, start(p), instants(2e-3, 40));
      ASSERT_TRUE(run.completed);
      EXPECT_GE(run.impacts.size(), 4u);
      EXPECT_LE(opening(run), closing);
      for (const std::size_t loss : {12u, 13u, 14u}) EXPECT_GT(std::abs(run.end.y[loss]), plain) << loss;  // the geometric slip's is a gain
    }
}

TEST(FlexibleSliderCrankOracle, ImpactsBeginWhereTheGapCloses) {
  const Params p{.mu = 0.1};
  const Result whole = simulate(p, {}, start(p), {1e-3});
  ASSERT_GE(whole.impacts.size(), 4u);
  for (const Impact& impact : whole.impacts) {
    const Sample s = simulate(p, {}, start(p), {impact.begin}).samples.back();
    // Another row of steps, each impact magnifying what they differ by.
    EXPECT_NEAR(s.depth, 0, difference * p.clearance);
    EXPECT_NEAR(s.rate, impact.approach, difference * impact.approach);
  }
}

TEST(FlexibleSliderCrankOracle, RunContinuedIsTheSameRun) {
  const Params p{.mu = 0.1};
  const Result whole = simulate(p, {}, start(p), {5e-4});
  const Impact& second = whole.impacts.at(1);
  const Result part = simulate(p, {}, start(p), {0.5 * (second.begin + second.end)});
  ASSERT_TRUE(part.end.touching);
  const Result rest = simulate(p, {}, part.end, {5e-4});
  for (std::size_t i = 0; i < dynamic; ++i) EXPECT_NEAR(rest.end.y[i], whole.end.y[i], difference * std::abs(whole.end.y[i])) << i;
}

/// The rigid mechanism with the same bodies.
pintle_oracle::Params rigid(const Params& p) {
  return {.crank = p.crank,
          .coupler = p.coupler,
          .crank_mass = p.crank_mass,
          .coupler_mass = p.coupler_mass,
          .slider_mass = p.slider_mass,
          .crank_inertia = p.crank_inertia,
          .coupler_inertia = p.coupler_mass * p.coupler * p.coupler / 12,
          .gravity = p.gravity,
          .clearance = p.clearance,
          .bearing_radius = p.bearing_radius,
          .stiffness = p.stiffness,
          .chi = p.chi,
          .mu = p.mu,
          .v0 = p.v0,
          .v1 = p.v1,
          .slip = p.slip,
          .bearing_on_slider = p.bearing_on_slider,
          .speed = p.speed,
          .start_angle = p.start_angle};
}

TEST(FlexibleSliderCrankOracle, ContactOfAStraightCouplerIsThatOfARigidOne) {
  for (const bool bearing_on_slider : {true, false})
    for (const Slip slip : {Slip::material, Slip::geometric}) {
      const Params p{.mu = 0.1, .slip = slip, .bearing_on_slider = bearing_on_slider, .start_angle = 1, .start_e = {6e-6, 9e-6}};
      State s = start(p);
      ASSERT_TRUE(s.touching);
      s.latch = 0.2;
      s.y[6] = 140, s.y[7] = -25, s.y[11] = -7;
      pintle_oracle::State same;
      same.y = {s.y[0], s.y[1], s.y[5], s.y[6], s.y[7], s.y[11]};
      same.touching = true, same.latch = s.latch;
      const Sample found = evaluate(p, s);
      const pintle_oracle::Sample expected = pintle_oracle::evaluate(rigid(p), same);
      // e is what is left of lengths that are 1e4 as long, depth of e once more.
      const double left = 1e6 * rounding;
      EXPECT_GT(std::abs(expected.friction), 1);
      EXPECT_NEAR(found.depth, expected.depth, left * expected.depth);
      EXPECT_NEAR(found.slip, expected.slip, left * std::abs(expected.slip));
      EXPECT_NEAR(found.normal, expected.normal, left * expected.normal);
      EXPECT_NEAR(found.friction, expected.friction, left * std::abs(expected.friction));
      EXPECT_NEAR(found.kinetic + found.gravity, expected.energy, rounding * expected.energy);
      EXPECT_NEAR(found.contact, expected.stored, left * expected.stored);
    }
}

TEST(FlexibleSliderCrankOracle, SurfaceOfTheCouplersEndTurnsWithItsSection) {
  const Params p;
  State s = start(p);
  const double before = evaluate(p, s).slip;
  s.y[10] = 50;
  const double journal = p.bearing_radius - p.clearance;
  EXPECT_NEAR(evaluate(p, s).slip - before, journal * 50, rounding * journal * 50);
}

TEST(FlexibleSliderCrankOracle, StiffCouplerTendsToTheRigidMechanism) {
  // Let go straight, it vibrates about its deflected shape: the angle is off by the compliance, the
  // speed by the square root of it.
  double off[3], speed_off[3];
  for (int i = 0; i < 3; ++i) {
    Params p{.clearance = 0, .start_angle = 1};
    p.ea *= std::pow(100, i + 1), p.ei *= std::pow(100, i + 1);
    off[i] = speed_off[i] = 0;
    for (const Sample& s : simulate(p, {}, start(p), instants(2e-4, 50)).samples) {
      const Ideal rigid_one = ideal_at(rigid(p), s.state.t);
      off[i] = std::max(off[i], std::abs(s.state.y[0] - rigid_one.angle));
      speed_off[i] = std::max(speed_off[i], std::abs(s.state.y[6] - rigid_one.speed));
    }
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::log10(off[i] / off[i + 1]), 2, order);
    EXPECT_NEAR(std::log10(speed_off[i] / speed_off[i + 1]), 1, order);
  }
}

TEST(FlexibleSliderCrankOracle, FirstImpactOfAStiffCouplerIsTheRigidOnes) {
  const double until = 1.7e-4;
  Params p{.mu = 0.1};
  pintle_oracle::State state = pintle_oracle::start(rigid(p));
  std::vector<pintle_oracle::Impact> impacts;
  pintle_oracle::simulate(rigid(p), {}, until, state, [&](const pintle_oracle::Impact& i) { impacts.push_back(i); });
  const pintle_oracle::Impact& expected = impacts.at(0);
  p.ea *= 1e5, p.ei *= 1e5;
  const Impact found = simulate(p, {}, start(p), {until}).impacts.at(0);
  EXPECT_TRUE(found.finished);
  const double duration = expected.end - expected.begin;
  EXPECT_NEAR(found.begin, expected.begin, vibration * duration);
  EXPECT_NEAR(found.end, expected.end, vibration * duration);
  EXPECT_NEAR(found.approach, expected.approach, vibration * expected.approach);
  EXPECT_NEAR(found.separation, expected.separation, vibration * expected.separation);
  EXPECT_NEAR(found.deepest, expected.deepest, vibration * expected.deepest);
  EXPECT_NEAR(found.loss, expected.loss, vibration * expected.loss);
  EXPECT_NEAR(found.friction_loss, expected.friction_loss, vibration * expected.friction_loss);
}

}  // namespace
}  // namespace pintle_oracle::flexible::flexible_slider_crank_oracle_test
