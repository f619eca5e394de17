// The exam every scheme sits: a tableau with a treatment of the constraints. A new tableau joins by
// being in tableaus().

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <initializer_list>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "framework/integration/integrator.h"
#include "framework/integration/step.h"
#include "framework/integration/tableau.h"
#include "tests/oracles/runge_kutta.h"
#include "tests/oracles/slider_crank_clearance.h"

namespace pintle {

inline void PrintTo(const Tableau& tableau, std::ostream* out) {
  *out << tableau.name;
}

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// Tolerances.
// Sums of a dozen fractions below 10.
constexpr double rounding = 1e-13;
// Of a measured slope: the next order's term is up to 15 % of the leading one at the steps used,
// except where the pair makes the leading one so small that a greater slope is seen.
constexpr double order_slack = 0.2;
// Scaled constraint violations; the corrections stop at 1e-13.
constexpr double on_constraints = 1e-12;

// ---- tableaus by themselves -------------------------------------------------------------------

struct Coefficients {
  Eigen::MatrixXd A;
  VectorXd b, lower, c;  // lower: weights of the embedded solution, b − e
};
Coefficients coefficients(const Tableau& t) {
  const int s = t.stages();
  Coefficients k{Eigen::MatrixXd::Zero(s, s), VectorXd::Zero(s), VectorXd::Zero(s),
                 VectorXd::Zero(s)};
  for (int i = 0; i < s; ++i) {
    const auto& row = t.a[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < row.size(); ++j) k.A(i, static_cast<Eigen::Index>(j)) = row[j];
    k.b[i] = t.b.data()[i];
    k.c[i] = t.c.data()[i];
    k.lower[i] = t.b.data()[i] - t.e.data()[i];
  }
  return k;
}

// What weights w leave of the conditions of each order: one a rooted tree, 1, 1, 2, 4 and 9 of
// orders 1 to 5.
std::array<double, 6> left_of_order(const Coefficients& k, const VectorXd& w) {
  const auto& A = k.A;
  const Eigen::ArrayXd c = k.c.array();
  const auto apply = [&](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
    return (A * x.matrix()).array();
  };
  const Eigen::ArrayXd one = Eigen::ArrayXd::Ones(c.size()), Ac = apply(c), Acc = apply(c * c),
                       AAc = apply(Ac);
  using Trees = std::initializer_list<Eigen::ArrayXd>;
  const auto worst = [&](Trees trees, std::initializer_list<int> density) {
    double left = 0;
    for (std::size_t i = 0; i < trees.size(); ++i)
      left = std::max(left, std::abs(w.dot(trees.begin()[i].matrix()) - 1.0 / density.begin()[i]));
    return left;
  };
  const Trees fifth{c * c * c * c,    c * c * Ac,    Ac * Ac,    c * Acc,   c * AAc,
                    apply(c * c * c), apply(c * Ac), apply(Acc), apply(AAc)};
  return {0,
          worst({one}, {1}),
          worst({c}, {2}),
          worst({c * c, Ac}, {3, 6}),
          worst({c * c * c, c * Ac, Acc, AAc}, {4, 8, 12, 24}),
          worst(fifth, {5, 10, 20, 15, 30, 20, 40, 60, 120})};
}

class TableauContract : public testing::TestWithParam<Tableau> {};

TEST_P(TableauContract, StagesAreConsistent) {
  const Coefficients k = coefficients(GetParam());
  EXPECT_LT((k.A.rowwise().sum() - k.c).lpNorm<Eigen::Infinity>(), rounding);
  EXPECT_EQ(k.A.triangularView<Eigen::Upper>().toDenseMatrix().norm(), 0);
}
TEST_P(TableauContract, WeightsMeetEveryOrderConditionUpToItsOrder) {
  const Coefficients k = coefficients(GetParam());
  for (int p = 1; p <= GetParam().order; ++p)  // throws above 5: then add the trees
    EXPECT_LT(left_of_order(k, k.b).at(static_cast<std::size_t>(p)), rounding) << p;
}
// Of exactly the lower order: an estimate of nothing would accept every step.
TEST_P(TableauContract, ErrorIsTheDistanceToASolutionOfTheLowerOrder) {
  const Tableau& t = GetParam();
  const auto left = left_of_order(coefficients(t), coefficients(t).lower);
  for (int p = 1; p <= t.error_order; ++p)
    EXPECT_LT(left[static_cast<std::size_t>(p)], rounding) << p;
  EXPECT_LT(t.error_order, t.order);
  EXPECT_GT(left[static_cast<std::size_t>(t.error_order) + 1], 1e-5);
}
TEST_P(TableauContract, IfItClosesTheLastStageIsTheEnd) {
  if (!GetParam().closes) return;
  const Coefficients k = coefficients(GetParam());
  EXPECT_EQ(k.A.bottomRows(1).transpose(), k.b);
  EXPECT_EQ(k.c[k.c.size() - 1], 1);
}

// ---- mechanisms -------------------------------------------------------------------------------

// What is compared with the truth: an angle, its rate, two components of λ, then integrals.
struct Case {
  System system;
  State start;
  VectorXd (*seen)(const VectorXd& y, const Equations&);
  VectorXd (*truth)(double t);
};

// A link on a hinge with a damper, under gravity and a torque; angle from +x. By an ODE of our own.
namespace link {
constexpr double m = 1.3, J = 0.04, arm = 0.3, g = 9.81, c = 0.05, torque = 0.6, theta0 = 0.4,
                 w0 = 3;
double acceleration(double theta, double w) {
  return (torque - c * w - m * g * arm * std::cos(theta)) / (J + m * arm * arm);
}
VectorXd seen(const VectorXd& y, const Equations& eq) {
  return (VectorXd(6) << y[2], y[5], eq.lambda, y[6], y[7]).finished();
}
VectorXd truth(double t) {
  const auto f = [](const pintle_oracle::Vec<4>& y, pintle_oracle::Vec<4>& dy) {
    dy = {y[1], acceleration(y[0], y[1]), c * y[1] * y[1], torque * y[1]};
  };
  const auto y = pintle_oracle::integrate_tightly<4>(f, {theta0, w0, 0, 0}, t, 1e-14, {1, 1, 1, 1});
  const Vector2d u(std::cos(y[0]), std::sin(y[0]));
  const Vector2d a = arm * (acceleration(y[0], y[1]) * perp(u) - y[1] * y[1] * u);
  const Vector2d lambda = m * (Vector2d(0, -g) - a);  // hinge force on the ground
  return (VectorXd(6) << y[0], y[1], lambda, y[2], y[3]).finished();
}
Case make() {
  Case k{{}, {}, seen, truth};
  k.system.gravity = {0, -g};
  k.system.bodies = {{"link", m, J}};
  k.system.markers = {{ground, {0.2, 0.1}, 0}, {0, {-arm, 0}, 0}};
  k.system.joints = {Revolute{0, 1}};
  const auto law = [](double) { return Jet{torque, 0, 0}; };
  k.system.forces = {TorsionSpring{0, 1, 0, c, 0}, Torque{0, 1, law}};
  k.system.length = arm;
  number(k.system);
  k.start.y.setZero(k.system.n_y());
  const Vector2d u(std::cos(theta0), std::sin(theta0));
  k.start.y.head<3>() << Vector2d(0.2, 0.1) + arm * u, theta0;
  k.start.y.segment<3>(3) << w0 * arm * perp(u), w0;
  return k;
}
}  // namespace link

// The free slider-crank of the oracle, which integrates its one freedom tightly.
namespace crank {
pintle_oracle::Params params() {
  pintle_oracle::Params p;
  p.speed = 12;
  p.start_angle = 0.6;
  return p;
}
VectorXd seen(const VectorXd& y, const Equations& eq) {
  return (VectorXd(4) << y[2], y[11], eq.lambda[4], eq.lambda[5]).finished();
}
VectorXd truth(double t) {
  const auto i = pintle_oracle::ideal_at(params(), t, 1e-14);
  // λ of the gudgeon pin is the slider's force on the coupler.
  return (VectorXd(4) << i.angle, i.speed, i.pin_force[0], i.pin_force[1]).finished();
}
Case make() {
  const auto p = params();
  const auto now = pintle_oracle::evaluate_ideal(p, p.start_angle, p.speed);
  Case k{{}, {}, seen, truth};
  k.system.gravity = {0, -p.gravity};
  k.system.bodies = {{"crank", p.crank_mass, p.crank_inertia},
                     {"coupler", p.coupler_mass, p.coupler_inertia},
                     {"slider", p.slider_mass, 1e-4}};
  const double half1 = p.crank / 2, half2 = p.coupler / 2;
  k.system.markers = {{ground, {0, 0}, 0}, {0, {-half1, 0}, 0}, {0, {half1, 0}, 0},
                      {1, {-half2, 0}, 0}, {1, {half2, 0}, 0},  {2, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}, Revolute{2, 3}, Revolute{4, 5}, Prismatic{0, 5, 0}};
  k.system.length = p.coupler;
  number(k.system);
  const Vector2d u(std::cos(p.start_angle), std::sin(p.start_angle)),
      v(std::cos(now.phi), std::sin(now.phi));
  k.start.y.setZero(k.system.n_y());
  k.start.y.head<9>() << half1 * u, p.start_angle, p.crank * u + half2 * v, now.phi, now.x, 0, 0;
  k.start.y.segment<9>(9) << half1 * p.speed * perp(u), p.speed,
      p.crank * p.speed * perp(u) + half2 * now.phi_rate * perp(v), now.phi_rate, now.x_rate, 0, 0;
  return k;
}
}  // namespace crank

// ---- schemes ----------------------------------------------------------------------------------

// Slope of log y over log x, by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  using Data = Eigen::Map<const Eigen::ArrayXd>;
  Eigen::ArrayXd lx = Data(x.data(), n).log();
  const Eigen::ArrayXd ly = Data(y.data(), n).log();
  lx -= lx.mean();
  return (lx * ly).sum() / lx.square().sum();
}
void expect_order(double order, const std::vector<double>& h, const std::vector<double>& error) {
  EXPECT_GT(slope(h, error), order - order_slack)
      << "errors from " << error.front() << " to " << error.back();
}
class SchemeContract : public testing::TestWithParam<std::tuple<Tableau, Constraints>> {
 protected:
  const Tableau& tableau_ = *find_tableau(std::get<0>(GetParam()).name);
  Constraints constraints_ = std::get<1>(GetParam());

  // n equal steps. `errors`, if asked for: of all that is seen, root mean square over the ten
  // tenths of the span, because at one instant alone they may happen to cancel.
  Step march(const Case& k, double span, int n, VectorXd* errors = nullptr) const {
    Equations eq(k.system);
    Stages stages(k.system, tableau_, constraints_);
    Step step;
    step.to.state = k.start;
    step.to.dy.setZero(k.system.n_y());
    step.from = step.to;
    EXPECT_TRUE(stages.settle(k.system, step.to, eq));
    for (int i = 1; i <= n; ++i) {
      std::swap(step.from, step.to);
      EXPECT_TRUE(stages.attempt(k.system, span / n, step, eq));
      if (errors && 10 * i % n == 0) {
        const VectorXd e = k.seen(step.to.state.y, eq) - k.truth(i * span / n);
        *errors = (errors->array().square() + e.array().square() / 10).sqrt();
      }
      stages.refresh(k.system, eq);
    }
    return step;
  }
  void expect_order_in_all_seen(const Case& k, double span, int steps, Eigen::Index count) const {
    std::vector<double> h;
    std::vector<std::vector<double>> error(static_cast<std::size_t>(count));
    for (int n : {steps, 2 * steps, 4 * steps}) {
      VectorXd e = VectorXd::Zero(count);
      march(k, span, n, &e);
      h.push_back(span / n);
      for (std::size_t i = 0; i < error.size(); ++i)
        error[i].push_back(e[static_cast<Eigen::Index>(i)]);
    }
    for (const auto& of_one : error) expect_order(tableau_.order, h, of_one);
  }
  Integrator integrator(const Case& k, double tolerance) const {
    const Scheme scheme{.tableau = &tableau_, .tolerance = tolerance, .constraints = constraints_};
    return Integrator(k.system, scheme, k.start);
  }
};

TEST_P(SchemeContract, PendulumConvergesWithItsOrderInPositionSpeedMultipliersAndLedger) {
  expect_order_in_all_seen(link::make(), 1, 40, 6);
}
TEST_P(SchemeContract, SliderCrankConvergesWithItsOrderInPositionSpeedAndMultipliers) {
  expect_order_in_all_seen(crank::make(), 0.6, 160, 4);  // a turn
}

// Inside one step from exact values: the quintic's q is left at h⁶, its derivative at h⁵, z at h⁴.
TEST_P(SchemeContract, DenseOutputHasTheOrderOfItsPolynomials) {
  const Case k = link::make();
  const std::vector<double> h{0.06, 0.03, 0.015};
  std::vector<double> q, s, z;
  for (double span : h) {
    const Step step = march(k, span, 1);
    for (auto* worst : {&q, &s, &z}) worst->push_back(0);
    State dense;
    for (int tenth = 1; tenth < 10; ++tenth) {
      interpolate(k.system, step, tenth * span / 10, dense);
      const VectorXd truth = k.truth(tenth * span / 10);
      q.back() = std::max(q.back(), std::abs(dense.y[2] - truth[0]));
      s.back() = std::max(s.back(), std::abs(dense.y[5] - truth[1]));
      z.back() = std::max(z.back(), std::abs(dense.y[6] - truth[4]));
    }
  }
  expect_order(6, h, q);
  expect_order(5, h, s);
  expect_order(4, h, z);
}

TEST_P(SchemeContract, DenseOutputMeetsBothEnds) {
  const Case k = crank::make();
  const Step step = march(k, 0.01, 3);
  State dense;
  for (const State* end : {&step.from.state, &step.to.state}) {
    interpolate(k.system, step, end->t, dense);
    EXPECT_LT((dense.y - end->y).norm(), 1e-12 * end->y.norm());
  }
}

// Steps come out where the estimate equals the tolerance, and the estimate is of a step's error.
TEST_P(SchemeContract, ErrorFallsInProportionToTheTolerance) {
  const Case k = crank::make();
  const std::vector<double> tolerances{1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
  std::vector<double> error;
  for (double tolerance : tolerances) {
    Integrator run = integrator(k, tolerance);
    double sum = 0;
    for (int i = 1; i <= 10; ++i) {
      const double t = 0.06 * i;
      while (run.state().t < t) ASSERT_TRUE(run.advance(t)) << run.failure();
      sum += std::pow(run.state().y[2] - k.truth(t)[0], 2) / 10;
    }
    error.push_back(std::sqrt(sum));
    // A hundred steps or two, each in error by the tolerance at most.
    EXPECT_LT(error.back(), 100 * tolerance);
  }
  // Steps change by 1.6 a decade, so the mechanism is met at other instants: a factor 2 or 3 of
  // scatter at either end of five decades.
  EXPECT_NEAR(slope(tolerances, error), 1, 0.2) << error.front() << " to " << error.back();
}

TEST_P(SchemeContract, ConstraintsHoldAtEveryStepAndSample) {
  const Case k = crank::make();
  Integrator run = integrator(k, 1e-7);
  State sample;
  while (run.state().t < 3) {
    ASSERT_TRUE(run.advance(3)) << run.failure();
    ASSERT_TRUE(run.sample(run.last().from.state.t + 0.4 * run.last().h, sample));
    ASSERT_LT(position_violation(k.system, run.equations()), on_constraints);
    ASSERT_LT(velocity_violation(k.system, sample.y, run.equations()), on_constraints);
    run.restore();
  }
  EXPECT_LT(run.worst_position(), on_constraints);
  EXPECT_LT(run.worst_velocity(), on_constraints);
}

// θ̈ = −ω²θ, the hinge at the mass centre: each step multiplies θ + iθ̇/ω by the tableau's
// stability function R(z) = 1 + z bᵀ(1 − zA)⁻¹1, z = −iωh. Amplitude and phase follow it to
// rounding, and R stays by exp(z) to the tableau's order.
TEST_P(SchemeContract, UndampedOscillatorHasTheAmplitudeAndPhaseOfTheory) {
  const double J = 0.02, stiffness = 8, omega = std::sqrt(stiffness / J), h = 0.3 / omega;
  const int n = 200;
  Case k{};
  k.system.bodies = {{"wheel", 1.0, J}};
  k.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}};
  k.system.forces = {TorsionSpring{0, 1, stiffness, 0, 0}};
  number(k.system);
  k.start.y.setZero(k.system.n_y());
  k.start.y[2] = 1;
  const VectorXd y = march(k, n * h, n).to.state.y;

  using C = std::complex<double>;
  const Coefficients t = coefficients(tableau_);
  const C z(0, -omega * h);  // (θ, θ̇/ω) turns clockwise
  const Eigen::MatrixXcd M = Eigen::MatrixXcd::Identity(t.A.rows(), t.A.cols()) - z * t.A;
  const Eigen::VectorXcd stages = M.partialPivLu().solve(Eigen::VectorXcd::Ones(t.b.size()));
  const C R = 1.0 + z * (t.b.transpose() * stages).value();
  const C expected = std::pow(R, n), found(y[2], y[5] / omega);
  EXPECT_NEAR(std::abs(found), std::abs(expected), n * rounding);
  EXPECT_NEAR(std::arg(found / expected), 0, n * rounding);
  EXPECT_LT(std::abs(R - std::exp(z)), std::pow(std::abs(z), tableau_.order + 1) / 120);
}

// Speeds turned round, a mechanism without losses goes back to where it came from, and as it was.
TEST_P(SchemeContract, ConservativeRunReverses) {
  const Case k = crank::make();
  const double tolerance = 1e-10, span = 0.8;
  Integrator forth = integrator(k, tolerance);
  while (forth.state().t < span) ASSERT_TRUE(forth.advance(span)) << forth.failure();
  Case turned = k;
  turned.start = forth.state();
  turned.start.t = 0;
  turned.start.y.segment(9, 9) *= -1;
  Integrator back = integrator(turned, tolerance);
  while (back.state().t < span) ASSERT_TRUE(back.advance(span)) << back.failure();
  // Errors of a free turning crank grow with time: 100 tolerances in 0.6 s as in the test of the
  // tolerance, over 1.6 s; those of the speeds, of up to 12 rad/s, alike.
  const VectorXd &y = back.state().y, &start = k.start.y;
  EXPECT_LT((y - start).head(9).lpNorm<Eigen::Infinity>(), 400 * tolerance);
  EXPECT_LT((y + start).tail(9).lpNorm<Eigen::Infinity>(), 12 * 400 * tolerance);
}

const auto all = testing::ValuesIn(tableaus().begin(), tableaus().end());
INSTANTIATE_TEST_SUITE_P(Each, TableauContract, all,
                         [](const auto& each) { return std::string(each.param.name); });
const auto both = testing::Values(Constraints::projection, Constraints::partitioning);
INSTANTIATE_TEST_SUITE_P(Each, SchemeContract, testing::Combine(all, both), [](const auto& each) {
  const bool projection = std::get<1>(each.param) == Constraints::projection;
  return std::string(std::get<0>(each.param).name) + (projection ? "Projection" : "Partitioning");
});

}  // namespace
}  // namespace pintle
