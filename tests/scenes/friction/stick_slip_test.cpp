// Rabinowicz's mass on a belt: times of stick and of slip, the amplitude, and the belt's speed above which damping ends the sticking.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/scenes/friction/friction_scenes.h"

namespace pintle::stick_slip_test {
namespace {

using pintle_scenes::dopri5, pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::number, pintle_scenes::Oscillator,
    pintle_scenes::run, pintle_scenes::Whole;

constexpr double pi = std::numbers::pi;

const std::array methods{dopri5, Method{"Rkf45", "rkf45", 1e-9, 1e-6}, Method{"Verner87", "verner87", 1e-7, 2e-5},
                         Method{"GeneralizedAlpha", "generalized-alpha", 1e-8, 2e-4}};

class StickSlip : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(By, StickSlip, testing::ValuesIn(methods), pintle_scenes::name_of);

struct Cycle {
  double slips, sticks, amplitude;
};
/// From one row while it sticks, one while it slips and one while it sticks again: what uniform and harmonic motion say of the times at
/// which one becomes the other.
Cycle cycle_of(const Whole& w, const Oscillator& o, std::size_t cycle) {
  const double omega = std::sqrt(o.k), middle = o.slides * o.N / o.k, breaks = o.holds * o.N / o.k;
  const std::vector<double> t = w.column("t [s]"), x = w.column("slider.x [m]"), v = w.column("slider.vx [m/s]");
  const auto stuck = [&](std::size_t i) { return std::abs(v[i] - o.V) < 1e-9 * o.V; };
  std::vector<std::size_t> slip;  // first rows of slips
  for (std::size_t i = 1; i < t.size(); ++i)
    if (stuck(i - 1) && !stuck(i)) slip.push_back(i);
  if (slip.size() < cycle + 2) {
    ADD_FAILURE() << slip.size() << " slips";
    return {};
  }
  const auto begins = [&](std::size_t i) { return t[i - 1] + (breaks - x[i - 1]) / o.V; };
  const std::size_t within = slip[cycle] + 10;
  const double A = std::hypot(x[within] - middle, v[within] / omega), phase = std::atan2(-v[within] / omega, x[within] - middle);
  const double last = pi + std::asin(o.V / omega / A);  // from A cos to where A sin is −V/ω, behind the middle
  const double ends = t[within] + (last - phase) / omega;
  return {ends - begins(slip[cycle]), begins(slip[cycle + 1]) - ends, A};
}

TEST_P(StickSlip, HasItsTimesOfStickAndSlipAndItsAmplitude) {
  for (const double V : {0.02, 0.1, 0.3}) {
    const Oscillator o{.V = V, .until = 2 * (0.3 * 10 / 400 / V + 1)};
    const double omega = std::sqrt(o.k), D = (o.holds - o.slides) * o.N / o.k, reach = std::hypot(D, V / omega);
    const Whole w = run(o.text(), GetParam());
    expect_sound(w);
    for (const std::size_t cycle : {0u, 1u}) {
      SCOPED_TRACE(number(V) + " m/s, cycle " + std::to_string(cycle));
      const Cycle c = cycle_of(w, o, cycle);
      const double near = 30 * GetParam().near;
      EXPECT_NEAR(c.sticks, 2 * D / V, near * reach / V);
      EXPECT_NEAR(c.slips, (pi + 2 * std::atan(V / (omega * D))) / omega, near * reach / V);
      EXPECT_NEAR(c.amplitude, reach, near * reach);
    }
  }
}

// ---- with a damper ----------------------------------------------------------------------------

/// The greatest speed at which a mass that slips from a belt of speed V goes back, over V: m x″ + c x′ + k x = μ N, from
/// k x = μ_s N − c V and x′ = V.
double comes_back(const Oscillator& o, double c) {
  const double beta = c / 2, omega2 = o.k, omega = std::sqrt(omega2 - beta * beta), y = ((o.holds - o.slides) * o.N - c * o.V) / o.k;
  const double sine = (omega2 * y + beta * o.V) / omega, first = std::atan2(sine, o.V), peak = 2 * pi - std::atan(beta / omega);
  return std::hypot(o.V, sine) * std::exp(-beta * (peak - first) / omega) * std::cos(peak) / o.V;
}
double critical_speed(double c) {
  double sticks = 1e-3, slides = 1e3;
  for (int i = 0; i < 100; ++i) {
    const double V = std::sqrt(sticks * slides);
    (comes_back(Oscillator{.V = V}, c) > 1 ? sticks : slides) = V;
  }
  return sticks;
}
/// It has stuck again after its first slip.
bool sticks_again(double V, double c, const Method& method) {
  const Oscillator o{.V = V, .until = 0.3 * 10 / 400 / V + 1};
  std::string text = o.text();
  text.replace(text.find("free length: 1"), 14, "free length: 1, damping: " + number(c));
  const Whole w = run(text, method);
  expect_sound(w);
  const double slips = (o.holds * o.N - c * V) / o.k / V;
  const std::vector<double> t = w.column("t [s]"), v = w.column("slider.vx [m/s]");
  EXPECT_GT(slips, 0);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] > slips + 0.05 && std::abs(v[i] - V) < 1e-9 * V) return true;
  return false;
}

TEST_P(StickSlip, EndsAboveTheCriticalSpeedOfTheBelt) {
  for (const double damping : {0.4, 2.0}) {  // 1 % and 5 % of the critical one
    const double V = critical_speed(damping);
    EXPECT_NEAR(comes_back(Oscillator{.V = V}, damping), 1, 1e-12);
    for (const double beside : {1.0, 4.0, 16.0}) {  // the belt is met ever more shortly
      const double off = 30 * GetParam().near * beside;
      EXPECT_TRUE(sticks_again((1 - off) * V, damping, GetParam())) << V << ", " << off;
      EXPECT_FALSE(sticks_again((1 + off) * V, damping, GetParam())) << V << ", " << off;
    }
  }
}
// For little damping it is ω D/√(4πζ).
TEST(StickSlip, CriticalSpeedIsDerjaguins) {
  const double D = 0.1 * 10 / 400;
  for (const double zeta : {1e-4, 1e-6})
    EXPECT_NEAR(critical_speed(2 * zeta * 20) / (20 * D / std::sqrt(4 * pi * zeta)), 1, 3 * std::sqrt(zeta));
}

}  // namespace
}  // namespace pintle::stick_slip_test
