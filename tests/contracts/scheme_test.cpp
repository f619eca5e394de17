// The exam every scheme sits: a tableau with a treatment of the constraints. A new tableau joins by
// being in tableaus().

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <ostream>
#include <string>
#include <tuple>
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
    k.b[i] = t.b[static_cast<std::size_t>(i)];
    k.c[i] = t.c[static_cast<std::size_t>(i)];
    k.lower[i] = k.b[i] - t.e[static_cast<std::size_t>(i)];
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
  struct Tree {
    int order;
    Eigen::ArrayXd x;
    double density;
  };
  const std::vector<Tree> trees{
      {1, one, 1},
      {2, c, 2},
      {3, c * c, 3},
      {3, Ac, 6},
      {4, c * c * c, 4},
      {4, c * Ac, 8},
      {4, Acc, 12},
      {4, AAc, 24},
      {5, c * c * c * c, 5},
      {5, c * c * Ac, 10},
      {5, Ac * Ac, 20},
      {5, c * Acc, 15},
      {5, c * AAc, 30},
      {5, apply(c * c * c), 20},
      {5, apply(c * Ac), 40},
      {5, apply(Acc), 60},
      {5, apply(AAc), 120},
  };
  std::array<double, 6> left{};
  for (const Tree& tree : trees) {
    double& worst = left[static_cast<std::size_t>(tree.order)];
    worst = std::max(worst, std::abs(w.dot(tree.x.matrix()) - 1 / tree.density));
  }
  return left;
}

class TableauContract : public testing::TestWithParam<Tableau> {};

TEST_P(TableauContract, StagesAreConsistent) {
  const Coefficients k = coefficients(GetParam());
  EXPECT_LT((k.A.rowwise().sum() - k.c).lpNorm<Eigen::Infinity>(), rounding);
  EXPECT_EQ(k.A.triangularView<Eigen::Upper>().toDenseMatrix().norm(), 0);
}
TEST_P(TableauContract, WeightsMeetEveryOrderConditionUpToItsOrder) {
  const Tableau& t = GetParam();
  ASSERT_LE(t.order, 5) << "add the trees of higher order";
  const auto left = left_of_order(coefficients(t), coefficients(t).b);
  for (int p = 1; p <= t.order; ++p) EXPECT_LT(left[static_cast<std::size_t>(p)], rounding) << p;
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
  const Coefficients k = coefficients(GetParam());
  if (!GetParam().closes) return;
  EXPECT_EQ(k.A.bottomRows(1).transpose(), k.b);
  EXPECT_EQ(k.c[k.c.size() - 1], 1);
}

// ---- mechanisms -------------------------------------------------------------------------------

// What is compared with the truth: angle, its rate, two components of λ, then integrals.
struct Case {
  System system;
  State start;
  std::function<VectorXd(const VectorXd& y, const Equations&)> seen = {};
  std::function<VectorXd(double t)> truth = {};
};

// A link on a damped hinge under gravity and a torque: θ from +x, hinge at a tenth of the way.
namespace link {
constexpr double m = 1.3, J = 0.04, arm = 0.3, g = 9.81, c = 0.05, torque = 0.6, theta0 = 0.4,
                 w0 = 3.0;
double acceleration(double theta, double w) {
  return (torque - c * w - m * g * arm * std::cos(theta)) / (J + m * arm * arm);
}
Case make() {
  Case k;
  k.system.gravity = {0, -g};
  k.system.bodies = {{"link", m, J}};
  k.system.markers = {{ground, {0.2, 0.1}, 0}, {0, {-arm, 0}, 0}};
  k.system.joints = {Revolute{0, 1}};
  k.system.joint_names = {"hinge"};
  k.system.forces = {TorsionSpring{0, 1, 0, c, 0}, Torque{0, 1, [](double) {
                                                            return Jet{torque, 0, 0};
                                                          }}};
  k.system.force_names = {"damper", "torque"};
  k.system.length = arm;
  number(k.system);
  k.start.y.setZero(k.system.n_y());
  const Vector2d u(std::cos(theta0), std::sin(theta0));
  k.start.y.head<3>() << Vector2d(0.2, 0.1) + arm * u, theta0;
  k.start.y.segment<3>(3) << w0 * arm * perp(u), w0;
  return k;
}
// θ, w, loss, work of the torque; hinge force on the ground. By an ODE of our own.
struct Truth {
  double theta, w, loss, work;
  Vector2d lambda;
};
Truth at(double t) {
  const auto f = [](const pintle_oracle::Vec<4>& y, pintle_oracle::Vec<4>& dy) {
    dy = {y[1], acceleration(y[0], y[1]), c * y[1] * y[1], torque * y[1]};
  };
  const auto y = pintle_oracle::integrate_tightly<4>(f, {theta0, w0, 0, 0}, t, 1e-14, {1, 1, 1, 1});
  const Vector2d u(std::cos(y[0]), std::sin(y[0]));
  const Vector2d a = arm * (acceleration(y[0], y[1]) * perp(u) - y[1] * y[1] * u);
  return {y[0], y[1], y[2], y[3], m * (Vector2d(0, -g) - a)};
}
}  // namespace link

// The free slider-crank of the oracle, masses in the middle of the links.
namespace crank {
pintle_oracle::Params params() {
  pintle_oracle::Params p;
  p.speed = 12;
  p.start_angle = 0.6;
  return p;
}
Case make() {
  const auto p = params();
  const auto now = pintle_oracle::evaluate_ideal(p, p.start_angle, p.speed);
  Case k;
  k.system.gravity = {0, -p.gravity};
  k.system.bodies = {{"crank", p.crank_mass, p.crank_inertia},
                     {"coupler", p.coupler_mass, p.coupler_inertia},
                     {"slider", p.slider_mass, 1e-4}};
  const double half1 = p.crank / 2, half2 = p.coupler / 2;
  k.system.markers = {{ground, {0, 0}, 0},  {0, {-half1, 0}, 0}, {0, {half1, 0}, 0},
                      {1, {-half2, 0}, 0},  {1, {half2, 0}, 0},  {2, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}, Revolute{2, 3}, Revolute{4, 5}, Prismatic{0, 5, 0}};
  k.system.joint_names = {"bearing", "crank pin", "gudgeon pin", "guide"};
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

class SchemeContract : public testing::TestWithParam<std::tuple<Tableau, Constraints>> {
 protected:
  const Tableau& tableau_ = *find_tableau(std::get<0>(GetParam()).name);
  Constraints constraints_ = std::get<1>(GetParam());

  // n steps of equal size; `seen(i, y, equations)` after each tenth of the span, if n allows.
  template <class Seen>
  Step march(const Case& k, double span, int n, Seen seen) const {
    Equations eq(k.system);
    Stages stages(k.system, tableau_, constraints_);
    Step step;
    step.to.state = k.start;
    step.to.dy.setZero(k.system.n_y());
    step.from = step.to;
    EXPECT_TRUE(stages.settle(k.system, step.to, eq));
    for (int i = 0; i < n; ++i) {
      std::swap(step.from, step.to);
      EXPECT_TRUE(stages.attempt(k.system, span / n, step, eq));
      if (n % 10 == 0 && (i + 1) % (n / 10) == 0)
        seen((i + 1) / (n / 10) - 1, step.to.state.y, eq);
      stages.refresh(k.system, eq);
    }
    return step;
  }
  Step march(const Case& k, double span, int n) const {
    return march(k, span, n, [](int, const VectorXd&, const Equations&) {});
  }
  Integrator integrator(const Case& k, double tolerance) const {
    Scheme scheme;
    scheme.tableau = &tableau_;
    scheme.tolerance = tolerance;
    scheme.constraints = constraints_;
    return Integrator(k.system, scheme, k.start);
  }
};

// Slope of log error over log step, by least squares.
double slope(const std::vector<double>& h, const std::vector<double>& error) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(h.size());
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double lx = std::log(h[i]), ly = std::log(error[i]);
    x += lx, y += ly, xx += lx * lx, xy += lx * ly;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

// Errors at ten instants of a run, root mean square: at a single one they may happen to cancel.
class Errors {
 public:
  void add(double x) { sum_ += x * x / 10; }
  double operator()() const { return std::sqrt(sum_); }

 private:
  double sum_ = 0;
};
struct Convergence {
  std::vector<double> h, q, s, lambda, z;
  void add(double step, const Errors& of_q, const Errors& of_s, const Errors& of_lambda,
           const Errors& of_z = {}) {
    h.push_back(step);
    q.push_back(of_q());
    s.push_back(of_s());
    lambda.push_back(of_lambda());
    z.push_back(of_z());
  }
};
void expect_order(double order, const std::vector<double>& h, const std::vector<double>& error) {
  EXPECT_GT(slope(h, error), order - order_slack)
      << "errors from " << error.front() << " to " << error.back();
}

TEST_P(SchemeContract, PendulumConvergesWithItsOrderInPositionsSpeedsMultipliersAndLedger) {
  const Case k = link::make();
  const double span = 1;
  std::array<link::Truth, 10> truth;
  for (int i = 0; i < 10; ++i) truth[static_cast<std::size_t>(i)] = link::at((i + 1) * span / 10);
  Convergence found;
  for (int n : {40, 80, 160}) {
    Errors q, s, lambda, z;
    march(k, span, n, [&](int i, const VectorXd& y, const Equations& eq) {
      const link::Truth& t = truth[static_cast<std::size_t>(i)];
      q.add(y[2] - t.theta);
      s.add(y[5] - t.w);
      lambda.add((eq.lambda - t.lambda).norm());
      z.add(std::hypot(y[6] - t.loss, y[7] - t.work));
    });
    found.add(span / n, q, s, lambda, z);
  }
  expect_order(tableau_.order, found.h, found.q);
  expect_order(tableau_.order, found.h, found.s);
  expect_order(tableau_.order, found.h, found.lambda);
  expect_order(tableau_.order, found.h, found.z);
}

TEST_P(SchemeContract, SliderCrankConvergesWithItsOrderInPositionsSpeedsAndMultipliers) {
  const Case k = crank::make();
  const double span = 0.6;  // a turn
  std::array<pintle_oracle::Ideal, 10> truth;
  for (int i = 0; i < 10; ++i)
    truth[static_cast<std::size_t>(i)] =
        pintle_oracle::ideal_at(crank::params(), (i + 1) * span / 10, 1e-14);
  Convergence found;
  for (int n : {160, 320, 640}) {
    Errors q, s, lambda;
    march(k, span, n, [&](int i, const VectorXd& y, const Equations& eq) {
      const pintle_oracle::Ideal& t = truth[static_cast<std::size_t>(i)];
      q.add(y[2] - t.angle);
      s.add(y[11] - t.speed);
      // λ of the gudgeon pin is the slider's force on the coupler.
      lambda.add(std::hypot(eq.lambda[4] - t.pin_force[0], eq.lambda[5] - t.pin_force[1]));
    });
    found.add(span / n, q, s, lambda);
  }
  expect_order(tableau_.order, found.h, found.q);
  expect_order(tableau_.order, found.h, found.s);
  expect_order(tableau_.order, found.h, found.lambda);
}

// Inside one step from exact values: the quintic's q is left at h⁶, its derivative at h⁵, z at h⁴.
TEST_P(SchemeContract, DenseOutputHasTheOrderOfItsPolynomials) {
  const Case k = link::make();
  std::vector<double> h, q, s, z;
  for (double span : {0.06, 0.03, 0.015}) {
    const Step step = march(k, span, 1);
    double worst_q = 0, worst_s = 0, worst_z = 0;
    State dense;
    for (double x : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
      interpolate(k.system, step, x * span, dense);
      const link::Truth truth = link::at(x * span);
      worst_q = std::max(worst_q, std::abs(dense.y[2] - truth.theta));
      worst_s = std::max(worst_s, std::abs(dense.y[5] - truth.w));
      worst_z = std::max(worst_z, std::abs(dense.y[6] - truth.loss));
    }
    h.push_back(span);
    q.push_back(worst_q);
    s.push_back(worst_s);
    z.push_back(worst_z);
  }
  expect_order(6, h, q);
  expect_order(5, h, s);
  expect_order(4, h, z);
}

TEST_P(SchemeContract, DenseOutputMeetsBothEnds) {
  const Case k = crank::make();
  const Step step = march(k, 0.01, 3);
  State dense;
  for (const Node* end : {&step.from, &step.to}) {
    interpolate(k.system, step, end->state.t, dense);
    EXPECT_LT((dense.y - end->state.y).lpNorm<Eigen::Infinity>(), 1e-12 * end->state.y.norm());
  }
}

// Steps come out where the estimate equals the tolerance, and the estimate is of a step's error.
TEST_P(SchemeContract, ErrorFallsInProportionToTheTolerance) {
  const Case k = crank::make();
  const double span = 0.6;
  const std::vector<double> tolerances{1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
  std::vector<double> error;
  for (double tolerance : tolerances) {
    Integrator run = integrator(k, tolerance);
    Errors e;
    for (int i = 1; i <= 10; ++i) {
      while (run.state().t < i * span / 10) ASSERT_TRUE(run.advance(i * span / 10)) << run.failure();
      const auto truth = pintle_oracle::ideal_at(crank::params(), i * span / 10, 1e-14);
      e.add(run.state().y[2] - truth.angle);
    }
    error.push_back(e());
    // A hundred steps or two, each in error by the tolerance at most.
    EXPECT_LT(error.back(), 100 * tolerance);
  }
  // Steps change by 1.6 a decade, so the mechanism is met at other instants: a factor 2 or 3 of
  // scatter at either end of five decades.
  EXPECT_NEAR(slope(tolerances, error), 1, 0.2) << error.front() << " to " << error.back();
}

TEST_P(SchemeContract, ConstraintsHoldAtEveryStep) {
  const Case k = crank::make();
  Integrator run = integrator(k, 1e-7);
  while (run.state().t < 3) ASSERT_TRUE(run.advance(3)) << run.failure();
  EXPECT_LT(run.worst_position(), on_constraints);
  EXPECT_LT(run.worst_velocity(), on_constraints);
}

TEST_P(SchemeContract, SamplesAreOnTheConstraints) {
  const Case k = crank::make();
  Integrator run = integrator(k, 1e-6);
  State sample;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(run.advance(1));
    const Step& last = run.last();
    ASSERT_TRUE(run.sample(last.from.state.t + 0.4 * last.h, sample));
    EXPECT_LT(position_violation(k.system, run.equations()), on_constraints);
    EXPECT_LT(velocity_violation(k.system, sample.y, run.equations()), on_constraints);
    run.restore();
  }
}

// θ̈ = −ω²θ, the hinge at the mass centre: each step multiplies θ + i θ̇/ω's pair by the tableau's
// stability function R(iωh) = 1 + iωh bᵀ(1 − iωh A)⁻¹1. Amplitude and phase follow it to rounding,
// and R stays by exp(iωh) to the tableau's order.
TEST_P(SchemeContract, UndampedOscillatorHasTheAmplitudeAndPhaseOfTheory) {
  const double J = 0.02, stiffness = 8, omega = std::sqrt(stiffness / J), h = 0.3 / omega;
  const int n = 200;
  Case k;
  k.system.bodies = {{"wheel", 1.0, J}};
  k.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}};
  k.system.joint_names = {"axle"};
  k.system.forces = {TorsionSpring{0, 1, stiffness, 0, 0}};
  k.system.force_names = {"spring"};
  number(k.system);
  k.start.y.setZero(k.system.n_y());
  k.start.y[2] = 1;
  const VectorXd y = march(k, n * h, n).to.state.y;

  using C = std::complex<double>;
  const Coefficients t = coefficients(tableau_);
  const C z(0, -omega * h);  // θ̇ lags: θ − i… turns clockwise
  const Eigen::Index stages = t.b.size();
  const Eigen::MatrixXcd M = Eigen::MatrixXcd::Identity(stages, stages) - z * t.A.cast<C>();
  const Eigen::VectorXcd ones = Eigen::VectorXcd::Ones(stages);
  const C R = 1.0 + z * t.b.cast<C>().dot(Eigen::VectorXcd(M.partialPivLu().solve(ones)));
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
  VectorXd y = back.state().y;
  y.segment(9, 9) *= -1;
  // Errors of a free turning crank grow with time: 100 tolerances in 0.6 s as in the test of the
  // tolerance, over 1.6 s; those of the speeds, of up to 12 rad/s, alike.
  EXPECT_LT((y.head(9) - k.start.y.head(9)).lpNorm<Eigen::Infinity>(), 400 * tolerance);
  EXPECT_LT((y.segment(9, 9) - k.start.y.segment(9, 9)).lpNorm<Eigen::Infinity>(),
            12 * 400 * tolerance);
}

std::string tableau_name(const testing::TestParamInfo<Tableau>& info) {
  return std::string(info.param.name);
}
std::string case_name(const testing::TestParamInfo<std::tuple<Tableau, Constraints>>& info) {
  const bool projection = std::get<1>(info.param) == Constraints::projection;
  return std::string(std::get<0>(info.param).name) + (projection ? "Projection" : "Partitioning");
}
INSTANTIATE_TEST_SUITE_P(Each, TableauContract,
                         testing::ValuesIn(tableaus().begin(), tableaus().end()), tableau_name);
INSTANTIATE_TEST_SUITE_P(
    Each, SchemeContract,
    testing::Combine(testing::ValuesIn(tableaus().begin(), tableaus().end()),
                     testing::Values(Constraints::projection, Constraints::partitioning)),
    case_name);

}  // namespace
}  // namespace pintle
