// The exam every scheme sits: a tableau with a treatment of the constraints. A new tableau joins by
// being in tableaus().

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "framework/integration/dense_output.h"
#include "framework/integration/explicit/stages.h"
#include "framework/integration/explicit/tableau.h"
#include "framework/integration/integrator.h"
#include "tests/contracts/first_step.h"
#include "tests/contracts/scheme_cases.h"

namespace pintle {

inline void PrintTo(const Tableau& tableau, std::ostream* out) { *out << tableau.name; }

}  // namespace pintle

namespace pintle::scheme_test {
namespace {

using namespace scheme_cases;

// Tolerances.
constexpr double rounding = 1e-13;  // of sums of a dozen numbers near 1
// Of a tableau's conditions, whose products of a dozen numbers carry its largest.
double rounding_of(const Tableau& t) {
  double largest = 1;
  for (const auto& row : t.a)
    for (const double a : row) largest = std::max(largest, std::abs(a));
  return 0.1 * rounding * largest;
}
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
  Coefficients k{Eigen::MatrixXd::Zero(s, s), VectorXd::Zero(s), VectorXd::Zero(s), VectorXd::Zero(s)};
  for (int i = 0; i < s; ++i) {
    const auto& row = t.a[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < row.size(); ++j) k.A(i, static_cast<Eigen::Index>(j)) = row[j];
    k.b[i] = t.b.data()[i];
    k.c[i] = t.c.data()[i];
    k.lower[i] = t.b.data()[i] - t.e.data()[i];
  }
  return k;
}

// What weights w leave of the conditions of each order up to `most`, one a rooted tree τ of p nodes:
// w·Φ(τ) = 1/γ(τ). A tree is a root with a multiset of smaller ones: Φ is the product of their AΦ, γ
// is p times that of their γ. 1, 1, 2, 4, 9, 20, 48 and 115 trees of orders 1 to 8.
std::vector<double> left_of_order(const Coefficients& k, const VectorXd& w, int most) {
  struct Tree {
    int nodes;
    double density;
    Eigen::ArrayXd weight;  // Φ
  };
  std::vector<Tree> trees;
  std::vector<double> left(static_cast<std::size_t>(most) + 1, 0.0);
  for (int p = 1; p <= most; ++p) {
    const std::vector<Tree> smaller = trees;
    const auto grow = [&](auto&& self, std::size_t first, const Tree& root) -> void {
      if (root.nodes == p) {
        trees.push_back({p, p * root.density, root.weight});
        double& worst = left[static_cast<std::size_t>(p)];
        worst = std::max(worst, std::abs(w.dot(root.weight.matrix()) - 1 / trees.back().density));
        return;
      }
      for (std::size_t i = first; i < smaller.size() && root.nodes + smaller[i].nodes <= p; ++i)
        self(self, i,
             Tree{root.nodes + smaller[i].nodes, root.density * smaller[i].density,
                  root.weight * (k.A * smaller[i].weight.matrix()).array()});
    };
    grow(grow, 0, {1, 1.0, Eigen::ArrayXd::Ones(k.c.size())});
  }
  return left;
}

class TableauContract : public testing::TestWithParam<Tableau> {};

TEST_P(TableauContract, StagesAreConsistent) {
  const Coefficients k = coefficients(GetParam());
  EXPECT_LT((k.A.rowwise().sum() - k.c).lpNorm<Eigen::Infinity>(), rounding_of(GetParam()));
  EXPECT_EQ(k.A.triangularView<Eigen::Upper>().toDenseMatrix().norm(), 0);
}
TEST_P(TableauContract, WeightsMeetEveryOrderConditionUpToItsOrder) {
  const Coefficients k = coefficients(GetParam());
  for (const double left : left_of_order(k, k.b, GetParam().order)) EXPECT_LT(left, rounding_of(GetParam()));
}
// Of exactly the lower order: an estimate of nothing would accept every step.
TEST_P(TableauContract, ErrorIsTheDistanceToASolutionOfTheLowerOrder) {
  const Tableau& t = GetParam();
  auto left = left_of_order(coefficients(t), coefficients(t).lower, t.error_order + 1);
  EXPECT_LT(*std::max_element(left.begin(), left.end() - 1), rounding_of(t));
  EXPECT_LT(t.error_order, t.order);
  EXPECT_GT(left.back(), 1e-5);
}
TEST_P(TableauContract, IsStableAlongTheNegativeAxisAsFarAsItSaysAndNoFarther) {
  const Coefficients k = coefficients(GetParam());
  const auto growth = [&](double z) {  // |y₁/y₀| of ẏ = λy, z = hλ
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(k.A.rows(), k.A.cols()) - z * k.A;
    return std::abs(1 + z * k.b.dot(left.triangularView<Eigen::Lower>().solve(VectorXd::Ones(k.A.rows()))));
  };
  for (int i = 1; i <= 100; ++i) EXPECT_LE(growth(-GetParam().reach * i / 100), 1) << i;
  EXPECT_GT(growth(-1.02 * GetParam().reach), 1);
}

TEST_P(TableauContract, IfItClosesTheLastStageIsTheEnd) {
  if (!GetParam().closes) return;
  const Coefficients k = coefficients(GetParam());
  EXPECT_EQ(k.A.bottomRows(1).transpose(), k.b);
  EXPECT_EQ(k.c[k.c.size() - 1], 1);
}

// ---- schemes ----------------------------------------------------------------------------------

void expect_order(double order, const std::vector<double>& h, const std::vector<double>& error) {
  EXPECT_GT(slope(h, error), order - order_slack) << "errors from " << error.front() << " to " << error.back();
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
    EXPECT_TRUE(stages.project(k.system, step.to, eq));
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
    if (tableau_.order > 5) steps /= 4;  // errors still well above rounding
    std::vector<double> h;
    std::vector<std::vector<double>> error(static_cast<std::size_t>(count));
    for (int n : {steps, 2 * steps, 4 * steps}) {
      VectorXd e = VectorXd::Zero(count);
      march(k, span, n, &e);
      h.push_back(span / n);
      for (std::size_t i = 0; i < error.size(); ++i) error[i].push_back(e[static_cast<Eigen::Index>(i)]);
    }
    for (const auto& of_one : error) expect_order(tableau_.order, h, of_one);
  }
  Integrator integrator(const Case& k, double tolerance) const {
    return Integrator(k.system, {.tableau = &tableau_, .tolerance = tolerance, .constraints = constraints_}, k.start);
  }
};

TEST_P(SchemeContract, PendulumConvergesWithItsOrderInPositionSpeedMultipliersAndLedger) {
  expect_order_in_all_seen(link::make(), tableau_.order > 5 ? 2 : 1, 40, 6);
}
TEST_P(SchemeContract, SliderCrankConvergesWithItsOrderInPositionSpeedAndMultipliers) {
  expect_order_in_all_seen(crank::make(), 0.6, 160, 4);  // a turn
}

TEST_P(SchemeContract, InternalStatesConvergeWithItsOrderToo) {
  expect_order_in_all_seen(series::make(), tableau_.order > 5 ? 2 : 1, 40, 4);
  expect_order_in_all_seen(bristles::make(0.8), tableau_.order > 5 ? 2 : 1, 40, 4);
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
      interpolate_quintic(k.system, step, tenth * span / 10, dense.y);
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

class LedgerInsideSteps : public testing::TestWithParam<const char*> {};
class QuarticInsideSteps : public testing::TestWithParam<const char*> {};

TEST_P(QuarticInsideSteps, HasFifthOrder) {
  const Case k = link::make();
  const std::vector<double> h{0.06, 0.03, 0.015};
  std::vector<double> error;
  for (const double span : h) {
    Equations eq(k.system);
    Stages stages(k.system, *find_tableau(GetParam()), Constraints::projection);
    Step step;
    ASSERT_TRUE(first_step(k, span, stages, step, eq));
    error.push_back(0);
    State dense;
    for (int tenth = 1; tenth < 10; ++tenth) {
      begin_inside(step, tenth * span / 10, dense);
      interpolate_quintic(k.system, step, dense.t, dense.y);
      stages.refine_cubics(k.system, step, dense);
      const VectorXd truth = k.truth(tenth * span / 10);
      error.back() = std::max({error.back(), std::abs(dense.y[6] - truth[4]), std::abs(dense.y[7] - truth[5])});
    }
  }
  expect_order(5, h, error);
}
INSTANTIATE_TEST_SUITE_P(Each, QuarticInsideSteps, testing::Values("dopri5", "rkf45"),
                         [](const auto& each) { return std::string(each.param); });

// The cubic through the powers at both ends alone errs by a hundred times as much inside as at the ends, and more at finer tolerances.
TEST_P(LedgerInsideSteps, ErrsNoMoreThanAtTheirEnds) {
  const Case k = link::make();
  const std::string method = GetParam();
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    Integrator run(k.system, {.tableau = find_tableau(method), .tolerance = tolerance}, k.start);  // none: generalised-alpha
    State sample;
    double inside = 0, at_ends = 0;
    const auto off = [&](const State& state) {
      const VectorXd truth = k.truth(state.t);
      return std::max(std::abs(state.y[6] - truth[4]), std::abs(state.y[7] - truth[5]));
    };
    while (run.state().t < 0.5) {
      ASSERT_TRUE(run.advance(0.5)) << run.failure();
      for (const double x : {0.25, 0.5, 0.75}) {
        ASSERT_TRUE(run.sample(run.last().from.state.t + x * run.last().h, sample));
        inside = std::max(inside, off(sample));
      }
      at_ends = std::max(at_ends, off(run.state()));
    }
    EXPECT_LT(inside, 10 * at_ends) << tolerance;
  }
}
INSTANTIATE_TEST_SUITE_P(Each, LedgerInsideSteps, testing::Values("dopri5", "rkf45", "verner87", "generalized_alpha"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(SchemeContract, DenseOutputMeetsBothEnds) {
  const Case k = crank::make();
  const Step step = march(k, 0.01, 3);
  State dense;
  for (const State* end : {&step.from.state, &step.to.state}) {
    interpolate_quintic(k.system, step, end->t, dense.y);
    EXPECT_LT((dense.y - end->y).norm(), 1e-12 * end->y.norm());
  }
}

// Many turns from zero, places have lost what tells the speeds inside a short step; a cubic through speeds and accelerations of its ends has not.
TEST_P(SchemeContract, DenseOutputOfAShortStepManyTurnsOnHasSpeedsBetweenItsEnds) {
  const Case k = link::make();
  Step step = march(k, 1e-7, 1);
  for (State* end : {&step.from.state, &step.to.state}) end->y[2] += 1e6;
  const double s0 = step.from.state.y[5], s1 = step.to.state.y[5], a0 = step.from.dy[5], a1 = step.to.dy[5];
  const double allowed =
      std::abs(s1 - s0) + step.h * (std::abs(a0) + std::abs(a1)) + 8 * std::numeric_limits<double>::epsilon() * std::abs(s0);
  State dense;
  for (int tenth = 1; tenth < 10; ++tenth) {
    interpolate_quintic(k.system, step, step.from.state.t + tenth * step.h / 10, dense.y);
    EXPECT_NEAR(dense.y[5], s0, allowed) << tenth;
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
  // Steps change by 1.3 to 1.6 a decade, so the mechanism is met at other instants: a factor of up to 4 of
  // scatter at either end of five decades.
  EXPECT_NEAR(slope(tolerances, error), 1, std::get<0>(GetParam()).order > 5 ? 0.25 : 0.2) << error.front() << " to " << error.back();
}

TEST_P(SchemeContract, ConstraintsHoldAtEveryStepAndSample) {
  const Case k = crank::make();
  Integrator run = integrator(k, 1e-7);
  State sample;
  while (run.state().t < 3) {
    ASSERT_TRUE(run.advance(3)) << run.failure();
    ASSERT_TRUE(run.sample(run.last().from.state.t + 0.4 * run.last().h, sample));
    ASSERT_LT(position_violation(k.system, run.sampled()), on_constraints);
    ASSERT_LT(velocity_violation(k.system, sample.y, run.sampled()), on_constraints);
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
INSTANTIATE_TEST_SUITE_P(Each, TableauContract, all, [](const auto& each) { return std::string(each.param.name); });
const auto both = testing::Values(Constraints::projection, Constraints::partitioning);
INSTANTIATE_TEST_SUITE_P(Each, SchemeContract, testing::Combine(all, both), [](const auto& each) {
  const bool projection = std::get<1>(each.param) == Constraints::projection;
  return std::string(std::get<0>(each.param).name) + (projection ? "Projection" : "Partitioning");
});

}  // namespace
}  // namespace pintle::scheme_test
