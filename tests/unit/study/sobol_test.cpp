// Sampling and differences of the sensitivity study, against closed forms.
#include "framework/study/sensitivity/sobol.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/study/sensitivity/derivative.h"
#include "framework/study/sweep/sampling.h"

namespace pintle::sobol_test {
namespace {

constexpr double pi = std::numbers::pi;
using Inputs = std::vector<double>;
using Function = std::function<double(const Inputs&)>;

/// f at A, B and A with columns of B, inputs in [0, 1).
SobolValues sampled(const Function& f, std::size_t inputs, std::size_t n) {
  std::vector<std::vector<double>> a, b;
  for (std::size_t i = 0; i < inputs; ++i)
    a.push_back(Stream(1, "a" + std::to_string(i)).strata(n)), b.push_back(Stream(1, "b" + std::to_string(i)).strata(n));
  SobolValues out{{}, {}, std::vector<std::vector<double>>(inputs)};
  for (std::size_t k = 0; k < n; ++k) {
    Inputs at_a, at_b;
    for (std::size_t i = 0; i < inputs; ++i) at_a.push_back(a[i][k]), at_b.push_back(b[i][k]);
    out.a.push_back(f(at_a)), out.b.push_back(f(at_b));
    for (std::size_t i = 0; i < inputs; ++i) {
      Inputs mixed = at_a;
      mixed[i] = at_b[i];
      out.mixed[i].push_back(f(mixed));
    }
  }
  return out;
}

/// Ishigami and Homma (1990): sin x₁ + a sin² x₂ + b x₃⁴ sin x₁, each x even in [−π, π].
double ishigami(const Inputs& u) {
  const auto x = [&](std::size_t i) { return pi * (2 * u[i] - 1); };
  return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

// With a = 7, b = 0.1: V = a²/8 + bπ⁴/5 + b²π⁸/18 + 1/2, V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = 8b²π⁸/225.
TEST(Sobol, FindsTheSharesOfIshigamisFunctionWithinTheirIntervals) {
  const double b = 0.1, p4 = std::pow(pi, 4), V = 49.0 / 8 + b * p4 / 5 + b * b * p4 * p4 / 18 + 0.5;
  const double V1 = std::pow(1 + b * p4 / 5, 2) / 2, V2 = 49.0 / 8, V13 = 8 * b * b * p4 * p4 / 225;
  const double first[] = {V1 / V, V2 / V, 0}, total[] = {(V1 + V13) / V, V2 / V, V13 / V};
  const std::vector<SobolIndex> found = sobol_indices(sampled(ishigami, 3, 2048), 1);
  for (std::size_t i = 0; i < 3; ++i) {
    // The interval is two standard errors wide on each side; four of them are missed by one of ten thousand.
    const auto near = [&](const Share& s, double exact) {
      EXPECT_LT(std::abs(s.value - exact), (s.high - s.low) + 1e-9) << i;
      EXPECT_LE(s.low, s.value) << i;
      EXPECT_GE(s.high, s.value) << i;
      EXPECT_LT(s.high - s.low, 0.2) << i;
    };
    near(found[i].first, first[i]);
    near(found[i].total, total[i]);
  }
}

TEST(Sobol, OfASumOfInputsFirstAndTotalAreTheSharesOfTheSquares) {
  const std::vector<SobolIndex> found = sobol_indices(sampled([](const Inputs& u) { return 3 * u[0] + 4 * u[1]; }, 2, 1024), 1);
  for (std::size_t i = 0; i < 2; ++i) {
    const double exact = i == 0 ? 9.0 / 25 : 16.0 / 25;
    EXPECT_NEAR(found[i].first.value, exact, found[i].first.high - found[i].first.low);
    EXPECT_NEAR(found[i].total.value, exact, found[i].total.high - found[i].total.low);
  }
}

TEST(Sobol, LeavesOutPointsThatCouldNotBeMeasured) {
  SobolValues all = sampled(ishigami, 3, 256), less = all;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  less.a.push_back(nothing), less.b.push_back(1);
  for (auto& m : less.mixed) m.push_back(1);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(sobol_indices(all, 1)[i].total.value, sobol_indices(less, 1)[i].total.value);
  all.a.assign(256, 2), all.b.assign(256, 2);
  EXPECT_TRUE(std::isnan(sobol_indices(all, 1)[0].first.value)) << "nothing varies";
}

TEST(Sobol, TheNormalQuantileUndoesTheNormalDistribution) {
  for (const double x : {-4.0, -1.5, 0.0, 0.3, 2.7}) EXPECT_NEAR(normal_quantile(0.5 * std::erfc(-x / std::numbers::sqrt2)), x, 1e-9) << x;
  EXPECT_EQ(normal_quantile(0), -9);
}

/// Differences of f about x by the study's steps.
Derivative differences(const std::function<double(double)>& f, double x, double step, std::size_t levels) {
  std::vector<double> plus, minus;
  for (std::size_t k = 0; k < levels; ++k) {
    const double h = std::ldexp(step, -static_cast<int>(k));
    plus.push_back(f(x + h)), minus.push_back(f(x - h));
  }
  return derivative(step, plus, minus);
}

TEST(Derivative, ComesWithAnErrorThatHolds) {
  for (const double step : {0.5, 0.1, 1e-3, 1e-7}) {
    const Derivative d = differences([](double x) { return std::exp(std::sin(3 * x)); }, 0.4, step, 4);
    const double exact = 3 * std::cos(1.2) * std::exp(std::sin(1.2));
    EXPECT_LE(std::abs(d.value - exact), d.error + 1e-15) << step;
  }
  EXPECT_LT(differences([](double x) { return std::exp(x); }, 0, 0.1, 4).error, 1e-9);
}

TEST(Derivative, SeesNoiseInTheValues) {
  int k = 0;
  const auto noisy = [&](double x) { return x * x + (++k % 2 == 0 ? 1e-6 : -1e-6); };
  const Derivative d = differences(noisy, 1, 0.1, 4);
  EXPECT_LE(std::abs(d.value - 2), d.error);
  EXPECT_GT(d.error, 1e-6);
}

TEST(Derivative, IsNothingWithoutValues) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(derivative(0.1, {nothing}, {1}).value));
  const Derivative one = derivative(0.1, {1.2, nothing}, {1.0, 1.0});
  EXPECT_NEAR(one.value, 1, 1e-12);
  EXPECT_TRUE(std::isnan(one.error)) << "one difference knows nothing of its error";
}

}  // namespace
}  // namespace pintle::sobol_test
