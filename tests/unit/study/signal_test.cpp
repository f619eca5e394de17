// Peaks and frequencies of sampled signals, against closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/study/measures/signal.h"

namespace pintle::signal_test {
namespace {

constexpr double pi = std::numbers::pi;

Signal sampled(int n, double length, double (*f)(double), double (*rate)(double) = nullptr) {
  Signal s;
  for (int k = 0; k <= n; ++k) {
    s.t.push_back(length * k / n), s.y.push_back(f(s.t.back()));
    if (rate) s.rate.push_back(rate(s.t.back()));
  }
  return s;
}

TEST(Signal, PeaksBetweenRowsHaveFourthOrder) {
  const auto f = [](double t) { return std::sin(t + 0.3) + 0.2 * std::sin(2 * t); };
  const auto rate = [](double t) { return std::cos(t + 0.3) + 0.4 * std::cos(2 * t); };
  double top = 0;
  for (int k = 0; k < 4'000'000; ++k) top = std::max(top, f(7e-6 * k / 4));
  for (const bool with_rates : {false, true}) {
    // The distance to the nearest row differs from n to n; the worst of several counts.
    const auto worst = [&](int n) {
      double error = 0;
      for (int k = n; k < n + 12; ++k)
        error = std::max(error, std::abs(greatest(with_rates ? sampled(k, 7, f, rate) : sampled(k, 7, f)).value - top));
      return error;
    };
    EXPECT_GT(std::log2(worst(60) / worst(120)), with_rates ? 3.3 : 2.5) << with_rates;
    EXPECT_LT(worst(120), 1e-4);
  }
}

// A position at a stop, from which a body bounces: the cubic would turn before it.
TEST(Signal, PeaksWhereTheRateJumpsAreReached) {
  constexpr double hit = 0.537;
  Signal s = sampled(
      20, 1, [](double t) { return 3 - std::abs(t - hit); }, [](double t) { return t < hit ? 1.0 : -1.0; });
  EXPECT_LT(greatest(s).value, 2.995);
  s.jumps = {0.2, hit, 0.9};
  EXPECT_NEAR(greatest(s).value, 3, 1e-15);
  EXPECT_EQ(greatest(s).at, hit);
  for (double& y : s.y) y = -y;
  for (double& rate : s.rate) rate = -rate;
  EXPECT_NEAR(least(s).value, -3, 1e-15);
  EXPECT_NEAR(greatest(between(s, 0.5, 0.6)).value, -3 + 0.063, 1e-15);
}

TEST(Signal, FrequencyOfAToneIsFoundHoweverItIsCut) {
  for (const double periods : {2.0, 3.3, 7.77, 50.25, 400.1})
    for (const double phase : {0.0, 0.9, 2.2}) {
      Signal s;
      for (int k = 0; k <= 4000; ++k) {
        s.t.push_back(2.5 * k / 4000);
        s.y.push_back(5 + s.t.back() + 0.01 * std::sin(2 * pi * periods * k / 4000 + phase));
      }
      const double f = periods / 2.5;
      EXPECT_NEAR(dominant_frequency(s), f, 1e-6 * f) << periods << " periods, phase " << phase;
    }
}

TEST(Signal, StrongerOfTwoTonesIsTheFrequency) {
  Signal s = sampled(3000, 10, [](double t) { return std::sin(2 * pi * 3 * t) + 1.4 * std::cos(2 * pi * 11.5 * t) + 100; });
  EXPECT_NEAR(dominant_frequency(s), 11.5, 1e-4);
}

TEST(Signal, WithoutAPeriodHasNoFrequency) {
  EXPECT_TRUE(std::isnan(dominant_frequency(sampled(1000, 1, [](double) { return 3.0; }))));
  EXPECT_TRUE(std::isnan(dominant_frequency(sampled(1000, 1, [](double t) { return 2 * t - 1; }))));
  EXPECT_TRUE(std::isnan(dominant_frequency(sampled(1000, 1, [](double t) { return std::sin(2 * t); }))));
  EXPECT_TRUE(std::isnan(dominant_frequency(sampled(10, 1, [](double t) { return std::sin(20 * t); }))));
}

}  // namespace
}  // namespace pintle::signal_test
