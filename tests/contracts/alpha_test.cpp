// The exam of the implicit scheme, beside that of the explicit ones in scheme_test.cpp: order, stability,
// constraints, energy, stiffness, impacts.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "framework/dynamics/equations/energy.h"
#include "framework/integration/implicit/alpha.h"
#include "framework/integration/integrator.h"
#include "tests/contracts/loose_crank.h"
#include "tests/contracts/scheme_cases.h"

namespace pintle::alpha_test {
namespace {

using namespace scheme_cases;

constexpr double order = 2, order_slack = 0.15;  // the next order's term at the steps used
constexpr double on_constraints = 1e-12;         // scaled, as for the explicit schemes

Step march(const Case& k, double rho, double span, int n, VectorXd* errors = nullptr) {
  Equations eq(k.system);
  Alpha alpha(k.system, eq, rho, 0);
  alpha.validate_by(k.system.length, 1);
  Step step;
  step.to.state = k.start;
  step.to.dy.setZero(k.system.n_y());
  step.from = step.to;
  EXPECT_TRUE(alpha.project(k.system, step.to, eq));
  for (int i = 1; i <= n; ++i) {
    std::swap(step.from, step.to);
    EXPECT_TRUE(alpha.attempt(k.system, span / n, step, eq)) << alpha.trouble();
    EXPECT_LT(position_violation(k.system, eq), on_constraints);
    EXPECT_LT(velocity_violation(k.system, step.to.state.y, eq), on_constraints);
    if (errors && 10 * i % n == 0) {
      const VectorXd e = k.seen(step.to.state.y, eq) - k.truth(i * span / n);
      *errors = (errors->array().square() + e.array().square() / 10).sqrt();
    }
  }
  return step;
}

void expect_second_order(const Case& k, double rho, double span, int steps, Eigen::Index count) {
  std::vector<double> h;
  std::vector<std::vector<double>> error(static_cast<std::size_t>(count));
  for (const int n : {steps, 2 * steps, 4 * steps}) {
    VectorXd e = VectorXd::Zero(count);
    march(k, rho, span, n, &e);
    h.push_back(span / n);
    for (std::size_t i = 0; i < error.size(); ++i) error[i].push_back(e[static_cast<Eigen::Index>(i)]);
  }
  for (const auto& of_one : error)
    EXPECT_NEAR(slope(h, of_one), order, order_slack) << "errors from " << of_one.front() << " to " << of_one.back();
}

TEST(Alpha, PendulumConvergesWithSecondOrderInPositionSpeedMultipliersAndLedger) {
  for (const double rho : {0.5, 0.8, 0.95}) expect_second_order(link::make(), rho, 1, 40, 6);
}
TEST(Alpha, SliderCrankConvergesWithSecondOrderInPositionSpeedAndMultipliers) {
  for (const double rho : {0.5, 0.8}) expect_second_order(crank::make(), rho, 0.6, 160, 4);
}

TEST(Alpha, InternalStatesConvergeWithSecondOrder) {
  for (const double rho : {0.5, 0.8, 0.95}) {
    expect_second_order(series::make(), rho, 1, 80, 4);
    expect_second_order(bristles::make(0.3), rho, 1, 80, 4);
  }
}

// θ̈ = −ω²θ on a hinge at the mass centre.
Case oscillator(double omega, double damping = 0) {
  constexpr double J = 0.02;
  Case k{};
  k.system.bodies = {{"wheel", 1.0, J}};
  k.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}};
  k.system.forces = {TorsionSpring{0, 1, J * omega * omega, damping, 0}};
  number(k.system, true);
  k.start.y.setZero(k.system.n_y());
  k.start.y[2] = 1;
  k.start.y[5] = 0.7 * omega;
  return k;
}

// One step of the scheme as its authors write it is linear in (θ, hθ̇, h²a); the code's follows it to rounding.
TEST(Alpha, UndampedOscillatorFollowsTheSchemeOnPaper) {
  constexpr int n = 50;
  for (const double rho : {0.0, 0.5, 0.8, 1.0})
    for (const double z : {0.1, 1.0, 10.0, 1e3}) {  // hω
      const Case k = oscillator(z / 0.01);
      const Step first = march(k, rho, 0.01, 1), last = march(k, rho, 0.01 * n, n);
      const double am = (2 * rho - 1) / (rho + 1), af = rho / (rho + 1), g = 0.5 - am + af, b = 0.25 * (1 - am + af) * (1 - am + af);
      // unknown (θ₁, hθ̇₁, h²a₁); of the equation of motion (1 − αm)a₁ + αm a₀ = −ω²((1 − αf)θ₁ + αf θ₀)
      Eigen::Matrix3d L, R;
      L << 1, 0, -b, 0, 1, -g, z * z * (1 - af), 0, 1 - am;
      R << 1, 1, 0.5 - b, 0, 1, 1 - g, -z * z * af, 0, -am;
      const Eigen::Matrix3d A = L.partialPivLu().solve(R);
      Eigen::Vector3d x(first.to.state.y[2], 0.01 * first.to.state.y[5], 1e-4 * first.to.memory.a[2]);
      double largest = 0;
      for (int i = 1; i < n; ++i) x = A * x, largest = std::max(largest, x.lpNorm<Eigen::Infinity>());
      // Rounding of each step, as large as the greatest of the three that were.
      const double rounding = n * 1e-14 * std::max({largest, z * z, 1.0});
      EXPECT_NEAR(last.to.state.y[2], x[0], rounding) << rho << " " << z;
      EXPECT_NEAR(0.01 * last.to.state.y[5], x[1], rounding) << rho << " " << z;
    }
}

// Of a linear system without dampers, what the scheme loses is all that is lost, at any step.
TEST(Alpha, LedgerOfALinearSystemClosesToRoundingAtAnyStep) {
  for (const double rho : {0.0, 0.8, 1.0})
    for (const double z : {0.01, 0.1, 1.0, 10.0, 1e3}) {
      const Case k = oscillator(z / 0.01);
      Equations eq(k.system);
      Alpha alpha(k.system, eq, rho, 0);
      alpha.validate_by(k.system.length, 0.7 * z / 0.01);
      Step step;
      step.to.state = k.start;
      step.to.dy.setZero(k.system.n_y());
      step.from = step.to;
      ASSERT_TRUE(alpha.project(k.system, step.to, eq));
      const double start = energies(k.system, step.to.state, eq).balance();
      double lost = 0;
      for (int i = 0; i < 40; ++i) {
        std::swap(step.from, step.to);
        ASSERT_TRUE(alpha.attempt(k.system, 0.01, step, eq)) << alpha.trouble();
        const Energies e = energies(k.system, step.to.state, eq);
        // What is summed, F·u, is hω times the energy.
        EXPECT_NEAR(e.balance(), start, 1e-12 * std::max(1.0, z) * start) << rho << " " << z << " " << i;
        lost = e.lost;
      }
      if (rho < 1 && z >= 1) {
        EXPECT_GT(lost, 0.01 * start) << rho << " " << z;
      } else if (rho == 1) {
        EXPECT_NEAR(lost, 0, 1e-11 * std::max(1.0, z) * start) << z;  // the trapezoid's rule
      }
    }
}

// The local error is the tolerance, so the step goes with its third root and the error of a run with h².
TEST(Alpha, ErrorFallsWithTheToleranceToTwoThirds) {
  const Case k = crank::make();
  const std::vector<double> tolerances{1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  std::vector<double> error;
  for (const double tolerance : tolerances) {
    Integrator run = integrator(k, tolerance);
    double sum = 0;
    for (int i = 1; i <= 10; ++i) {
      while (run.state().t < 0.06 * i) ASSERT_TRUE(run.advance(0.06 * i)) << run.failure();
      sum += std::pow(run.state().y[2] - k.truth(0.06 * i)[0], 2) / 10;
    }
    error.push_back(std::sqrt(sum));
    EXPECT_LT(error.back(), 10 * std::pow(tolerance, 2.0 / 3));
  }
  EXPECT_NEAR(slope(tolerances, error), 2.0 / 3, 0.1) << error.front() << " to " << error.back();
}

// ---- starts --------------------------------------------------------------------------------------

struct Start {
  const char* name;
  Case k;
  double rate;   ///< of its fastest motion, which is not stiff for these tolerances [rad/s]
  double until;  ///< [s]
};

// A mass let go on a spring that is a third too long.
Start slack_spring() {
  Case k{};
  k.system.gravity = {0, -9.81};
  k.system.bodies = {{"mass", 1.0, 0.01}};
  k.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  k.system.forces = {Spring{0, 1, 1e3, 0, 1}};
  number(k.system, true);
  k.start.y.setZero(k.system.n_y());
  k.start.y[0] = 1.3;
  return {"slack spring", k, std::sqrt(1e3), 0.5};
}
Start ring(const char* name, double angle, double speed, double until) {
  Case k = oscillator(1000);
  k.start.y[2] = angle, k.start.y[5] = speed;
  return {name, k, 1000, until};
}
// Two wheels on a shaft, the first turned by a torque.
Start shaft(const char* name, TimeLaw torque) {
  constexpr double J = 0.01, stiffness = 100;
  Case k{};
  k.system.bodies = {{"first", 1.0, J}, {"second", 1.0, J}};
  k.system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}, {1, {0, 0}, 0}};
  k.system.joints = {Revolute{0, 1}, Revolute{0, 2}};
  k.system.forces = {TorsionSpring{1, 2, stiffness, 0, 0}, Torque{0, 1, std::move(torque)}};
  number(k.system, true);
  k.start.y.setZero(k.system.n_y());
  return {name, k, std::sqrt(2 * stiffness / J), 0.2};
}

// Errors at the end, of q over the length that they are judged by and of s over the fastest speed.
double error_at_end(const Start& start, double tolerance) {
  const auto end = [&](double tight, const char* tableau) {
    Integrator run = integrator(start.k, tight, tableau);
    double fastest = 0;
    while (run.state().t < start.until && run.advance(start.until)) {
      const auto& y = run.state().y;
      fastest = std::max(fastest, y.segment(start.k.system.n(), start.k.system.n()).lpNorm<Eigen::Infinity>());
    }
    EXPECT_EQ(run.state().t, start.until) << start.name << run.failure();
    return std::pair(run.state().y, fastest);
  };
  const auto [exact, fastest] = end(1e-11, "dopri5");
  const VectorXd y = end(tolerance, nullptr).first;
  const Eigen::Index n = start.k.system.n();
  return std::max((y - exact).head(n).lpNorm<Eigen::Infinity>() / start.k.system.length,
                  (y - exact).segment(n, n).lpNorm<Eigen::Infinity>() / fastest);
}

// A step errs by the tolerance and there are some ωT/tolerance^⅓ of them: the run errs by ωT tolerance^⅔, whatever its first step
// starts from. A first step that is not controlled errs by the whole motion, at any tolerance.
TEST(Alpha, ErrorOfARunFallsWithTheToleranceFromAnyStart) {
  const auto grows = [](double t) { return Jet{30 * t * t, 60 * t, 60}; };
  const auto jumps = [](double t) { return Jet{t < 0.0437 ? 0.0 : 1.0, 0, 0}; };
  for (const Start& start :
       {slack_spring(), ring("bent at rest", 0.01, 0, 0.1), ring("straight at speed", 0, 10, 0.1),
        ring("straight at speed, long", 0, 10, 5), shaft("spun up from rest", grows), shaft("load switched on", jumps)}) {
    const std::vector<double> tolerances =
        start.rate * start.until > 1000 ? std::vector<double>{1e-6} : std::vector<double>{1e-4, 1e-5, 1e-6, 1e-7};
    std::vector<double> error;
    for (const double tolerance : tolerances) {
      error.push_back(error_at_end(start, tolerance));
      EXPECT_LT(error.back(), 2 * start.rate * start.until * std::pow(tolerance, 2.0 / 3)) << start.name << " " << tolerance;
    }
    if (error.size() > 1) {
      EXPECT_GT(slope(tolerances, error), 0.5) << start.name << " " << error.front() << " to " << error.back();
    }
  }
}

// Unbalanced springs far too stiff for the step, their displacement far below the tolerance: the first step must neither follow
// them nor leave them with more energy than they had.
TEST(Alpha, AStartOutOfBalanceGivesTheSchemeNoEnergy) {
  for (const double stiffness : {1e9, 1e12}) {
    Start start = shaft("stiff", [](double) { return Jet{1, 0, 0}; });
    std::get<TorsionSpring>(start.k.system.forces[0]).k = stiffness;
    start.k.start.y[2] = 1 / stiffness;  // the torque's own twist would be half of that
    Integrator run = integrator(start.k, 1e-6);
    const double stored = 0.5 / stiffness;
    ASSERT_TRUE(run.advance(0.2)) << run.failure();
    const double apart = run.state().y[start.k.system.n() + 5] - run.state().y[start.k.system.n() + 2];
    EXPECT_LE(0.5 * 0.005 * apart * apart, stored) << stiffness;
  }
}

TEST(Alpha, NumbersThatAreNotMakeAStepFail) {
  Case k = oscillator(10);
  k.system.forces.emplace_back(Torque{0, 1, [](double t) { return Jet{t > 0.1 ? std::numeric_limits<double>::quiet_NaN() : 0.0, 0, 0}; }});
  number(k.system, true);
  k.start.y.setZero(k.system.n_y());
  Integrator run = integrator(k, 1e-4);
  while (run.state().t < 1 && run.advance(1)) ASSERT_TRUE(run.state().y.allFinite());
  EXPECT_FALSE(run.failure().empty());
  EXPECT_LE(run.state().t, 0.1);
}

// A disc on the coupler's end, held to it by a coil.
Case with_stiff_disc(double stiffness, double damping) {
  Case k = crank::make();
  System& s = k.system;
  const VectorXd before = k.start.y;
  s.bodies.push_back({"disc", 0.05, 1e-5});
  s.markers.push_back({3, {0, 0}, 0});
  s.joints.emplace_back(Revolute{4, 6});
  s.forces = {TorsionSpring{4, 6, stiffness, damping, 0}};
  number(s, true);
  k.start.y.setZero(s.n_y());
  k.start.y.head<9>() = before.head<9>();
  k.start.y.segment<3>(9) << before[6], 0, before[5];
  k.start.y.segment<9>(12) = before.segment<9>(9);
  k.start.y.segment<3>(21) << before[15], 0, before[14];
  return k;
}
long steps_of(Integrator run, double until) {
  while (run.state().t < until && run.advance(until)) continue;
  EXPECT_EQ(run.state().t, until) << run.failure();
  return run.counts().steps;
}
TEST(Alpha, StiffSpringsAndDampersDoNotHoldTheStep) {
  constexpr double tolerance = 1e-6, until = 0.3;
  const long rigid = steps_of(integrator(crank::make(), tolerance), until);
  // Started without deflection the disc rings by J α/k, 5e-12 rad and less: below the tolerance.
  for (const double stiffness : {1e9, 1e12, 1e15})
    EXPECT_LT(steps_of(integrator(with_stiff_disc(stiffness, 0), tolerance), until), 1.5 * static_cast<double>(rigid)) << stiffness;
  for (const double damping : {1e2, 1e6})
    EXPECT_LT(steps_of(integrator(with_stiff_disc(0, damping), tolerance), until), 1.5 * static_cast<double>(rigid)) << damping;
}

TEST(Alpha, AnExplicitRunThatStabilityHoldsGoesOnImplicitly) {
  const Case k = with_stiff_disc(0, 10);  // 10/1e-5 = a million a second
  Scheme scheme;
  scheme.tableau = find_tableau("dopri5"), scheme.tolerance = 1e-6, scheme.switch_below = 1e-4;
  Integrator run(k.system, scheme, k.start);
  while (run.state().t < 0.3) ASSERT_TRUE(run.advance(0.3)) << run.failure();
  EXPECT_TRUE(run.implicit());
  EXPECT_NE(run.switched().find("stability"), std::string::npos) << run.switched();
  EXPECT_LT(run.counts().steps, 2000);  // explicit: above 60 000
  Integrator whole = integrator(k, 1e-8);
  while (whole.state().t < 0.3) ASSERT_TRUE(whole.advance(0.3)) << whole.failure();
  EXPECT_NEAR(run.state().y[2], whole.state().y[2], 10 * std::pow(1e-6, 2.0 / 3));  // as in the test of the tolerance
}

TEST(Alpha, FirstImpactsComeToThoseOfTheExplicitSchemeAsTheToleranceFalls) {
  const Case k = loose_crank();
  constexpr double until = 0.02;
  constexpr std::size_t impacts = 4;
  Integrator exact = integrator(k, 1e-12, "dopri5");
  while (exact.state().t < until) ASSERT_TRUE(exact.advance(until)) << exact.failure();
  ASSERT_GE(exact.impacts().size(), impacts);
  std::vector<double> worst;
  for (const double tolerance : {1e-6, 1e-8}) {
    Integrator run = integrator(k, tolerance);
    while (run.state().t < until) ASSERT_TRUE(run.advance(until)) << run.failure();
    ASSERT_GE(run.impacts().size(), impacts);
    worst.push_back(0);
    for (std::size_t i = 0; i < impacts; ++i) {
      const Impact &a = run.impacts()[i], &b = exact.impacts()[i];
      worst.back() = std::max(worst.back(), std::abs(a.begin - b.begin) / until);
      EXPECT_NEAR(a.peak_force, b.peak_force, 2e-3 * b.peak_force) << tolerance << " " << i;
    }
  }
  // Each impact magnifies what came before by about ten: the fourth has seen three. Errors fall by 100^⅔ = 21.
  EXPECT_LT(worst[0], 1e3 * std::pow(1e-6, 2.0 / 3) * 1e-1);
  EXPECT_LT(worst[1], 0.2 * worst[0]);
}

}  // namespace
}  // namespace pintle::alpha_test
