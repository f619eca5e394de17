// examples/valve_spring_surge.yaml against the waves of a rod that is held at one end and moved by the cam at the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "tests/scenes/hand_models.h"
#include "tests/scenes/text_runs.h"

namespace pintle::spring_surge_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;

constexpr double k = 40e3, m = 0.08, valve = 0.1, fitted = 20e-3, beta = 16e-6, pi = 3.141592653589793;
const double first = pi * std::sqrt(k / m);  // ω₁ between held ends
constexpr int waves = 4;                     // as many as the scene keeps

// The lift 8 mm sin⁴ and its derivatives by the angle.
struct Lift {
  double y, slope, bend;
};
Lift lift(double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  if (s < 0) return {0, 0, 0};
  return {8e-3 * std::pow(s, 4), 32e-3 * s * s * s * c, 8e-3 * (12 * s * s * c * c - 4 * std::pow(s, 4))};
}

// u = (fitted + h) x/L + Σ q_n sin(nπx/L):  q̈ + β ω² q̇ + ω² q = −2 (−1)ⁿ⁺¹/(nπ) ḧ
struct Rod {
  double speed, t = 0;
  std::array<double, 2 * waves> x{};
  static double reach(int n) { return (n % 2 == 1 ? 1 : -1) / (n * pi); }
  double bend(double time) const { return speed * speed * lift(speed * time).bend; }
  std::array<double, 2 * waves> rate(double time, const std::array<double, 2 * waves>& s) const {
    std::array<double, 2 * waves> out{};
    for (int n = 1; n <= waves; ++n) {
      const auto i = static_cast<std::size_t>(n - 1);
      const double w = n * first;
      out[i] = s[i + waves];
      out[i + waves] = -w * w * (s[i] + beta * s[i + waves]) - 2 * reach(n) * bend(time);
    }
    return out;
  }
  void advance(double until, double step) {
    const auto steps = static_cast<int>(std::ceil((until - t) / step - 1e-9));
    for (int i = 0; i < steps; ++i)
      x = pintle_hand::runge_kutta(x, t + i * (until - t) / steps, (until - t) / steps,
                                   [this](double at, const auto& s) { return rate(at, s); });
    t = until;
  }
  double middle() const { return x[0] - x[2]; }
  double force_on_cam() const {
    const Lift h = lift(speed * t);
    double out = (valve + m / 3) * bend(t) + k * (fitted + h.y + beta * speed * h.slope);
    for (int n = 1; n <= waves; ++n) out += m * reach(n) * rate(t, x)[static_cast<std::size_t>(n - 1 + waves)];
    return out;
  }
};

Scene at_speed(double rpm) { return read_scene(PINTLE_SOURCE_DIR "/examples/valve_spring_surge.yaml", {{"speed", number(rpm) + " rpm"}}); }

TEST(ValveSpring, SurgesWhereAHarmonicOfTheCamMeetsIt) {
  double peak[2];
  for (const int case_of : {0, 1}) {
    const double harmonic = case_of == 0 ? 5 : 5.5, speed = first / harmonic;
    const Whole w = run(at_speed(speed * 30 / pi));
    expect_sound(w);
    ASSERT_EQ(w.run.warnings.size(), 1u);
    EXPECT_NE(w.run.warnings[0].find("\"spring\" is stretched or compressed by 40 % of its size"), std::string::npos) << w.run.warnings[0];
    const auto t = w.column("t [s]"), surge = w.column("surge [m]"), force = w.column("lobe.force [N]");
    Rod rod{speed};
    // 200 elements raise a wave's frequency by (nπ/200)²/24, 1e-5 of the first. Over the damping ratio βω/2 = 0.018 that changes a
    // resonance by 6e-4; of the others, below a tenth of it, by no more.
    const double near = 1e-3;
    double most = 0, push = 0;
    for (std::size_t i = 0; i < t.size(); ++i) most = std::max(most, std::abs(surge[i])), push = std::max(push, std::abs(force[i]));
    for (std::size_t i = 1; i < t.size(); ++i) {
      rod.advance(t[i], 1e-5);
      ASSERT_NEAR(surge[i], rod.middle(), near * most) << t[i];
      ASSERT_NEAR(force[i], rod.force_on_cam(), near * push) << t[i];
    }
    peak[case_of] = most;
    if (case_of == 0) {
      EXPECT_NEAR(1e3 * most, 3.2, 0.05);
      EXPECT_NEAR(*std::min_element(force.begin(), force.end()), 126, 2);
    }
  }
  EXPECT_GT(peak[0], 2 * peak[1]);
}

// The rest of the spring's natural frequencies have the valve and the cam at rest: n √(k/m)/2.
TEST(ValveSpring, HasItsFrequenciesBetweenHeldEnds) {
  const Scene s = at_speed(0.001);
  const Model model = build(s);
  const State start = assemble(s, model).start;
  std::vector<double> found;
  for (const LinearMode& mode : linearize(s, model, start).modes) found.push_back(std::abs(mode.root));
  for (int n = 1; n <= waves; ++n) {
    const double w = n * first;
    double nearest = 0;
    for (const double f : found)
      if (std::abs(f - w) < std::abs(nearest - w)) nearest = f;
    EXPECT_NEAR(nearest, w, 1.1 * std::pow(n * pi / 200, 2) / 24 * w) << n;
  }
}

}  // namespace
}  // namespace pintle::spring_surge_test
