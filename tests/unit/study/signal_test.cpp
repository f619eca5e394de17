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

// Switched forces, energies at blows: wherever the jump lies between rows, no value beyond those of the signal is reported.
TEST(Signal, NoPeakIsInventedWhereASignalJumps) {
  using Function = double (*)(double t, double jump);
  const Function values[] = {[](double t, double jump) { return t < jump ? 0.0 : 10.0; },
                             [](double t, double jump) { return t < jump ? -10.0 : 10.0; },
                             [](double t, double jump) { return t < jump ? 10 * t * t / (jump * jump) : 4.0; },
                             [](double t, double jump) { return t < jump ? 0.0 : 10 * std::exp(jump - t); },
                             [](double t, double jump) { return 10 - std::abs(t - jump); },
                             [](double t, double jump) { return std::min(10.0, 10.5 - 20 * std::abs(t - jump)); }};
  for (const Function value : values)
    for (int k = 0; k < 40; ++k) {
      const double jump = 0.4 + 0.0067 * k;
      Signal s;
      for (int row = 0; row <= 50; ++row) s.t.push_back(0.02 * row), s.y.push_back(value(s.t.back(), jump));
      EXPECT_LE(greatest(s).value, 10 + 1e-12) << jump;
      for (double& y : s.y) y = -y;
      EXPECT_GE(least(s).value, -10 - 1e-12) << jump;
    }
}

// A body is accelerated, and the force ends: its speed, whose rate jumps, does not exceed what is reached.
TEST(Signal, NoPeakIsInventedWhereARateJumps) {
  for (const double after : {0.0, -2.0, 1.0})
    for (int k = 0; k < 40; ++k) {
      const double jump = 0.4 + 0.0067 * k;
      Signal s;
      for (int row = 0; row <= 50; ++row) {
        const double t = 0.02 * row;
        s.t.push_back(t), s.rate.push_back(t < jump ? 5 : after);
        s.y.push_back(5 * std::min(t, jump) + after * std::max(0.0, t - jump));
      }
      const double most = after > 0 ? s.y.back() : 5 * jump;
      EXPECT_LE(greatest(s).value, most + 1e-12) << after << " from " << jump;
      EXPECT_GE(greatest(s).value, most - 0.1) << after << " from " << jump;  // what happens between two rows
    }
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
