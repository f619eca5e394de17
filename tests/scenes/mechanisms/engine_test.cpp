// examples/engine_single, gearbox and pid_arm against closed forms and integrations by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/hand_models.h"
#include "tests/scenes/text_runs.h"

namespace pintle::engine_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

constexpr double pi = 3.141592653589793;

// ---- a four-stroke engine from 800 to 9000 rpm ----

constexpr double r = 0.04, l = 0.14, rpm = pi / 30;

// The slopes m of the periodic cubic spline, m₋ + 4 m + m₊ = 3 (y₊ − y₋)/h: by sweeps, each of which halves what is left at the least.
struct Wave {
  double h;
  std::vector<double> y, slope;
  explicit Wave(const pintle_hand::Lines& table) : h(table.x[1] - table.x[0]), y(table.y.begin(), table.y.end() - 1), slope(y.size()) {
    const std::size_t n = y.size();
    for (int sweep = 0; sweep < 60; ++sweep)
      for (std::size_t i = 0; i < n; ++i)
        slope[i] = (3 * (y[(i + 1) % n] - y[(i + n - 1) % n]) / h - slope[(i + 1) % n] - slope[(i + n - 1) % n]) / 4;
  }
  double at(double x) const {
    const auto n = static_cast<double>(y.size());
    double place = x / h - std::floor(x / h / n) * n;
    if (place >= n) place = 0;
    const auto i = static_cast<std::size_t>(place), j = (i + 1) % y.size();
    const double s = place - static_cast<double>(i), rest = 1 - s;
    return y[i] * rest * rest * (1 + 2 * s) + y[j] * s * s * (3 - 2 * s) + h * s * rest * (slope[i] * rest - slope[j] * s);
  }
};

// Crank at an angle from top dead centre: the piston's way out for each rad/s, and the inertia that the crank feels.
double piston_slope(double angle) {
  const double across = std::sqrt(l * l - r * r * std::sin(angle) * std::sin(angle));
  return -r * std::sin(angle) * (1 + r * std::cos(angle) / across);
}
double inertia(double angle) {
  const double s = std::sin(angle), c = std::cos(angle), tilt = std::asin(r * s / l), swing = r * c / (l * std::cos(tilt));
  // The rod's centre a third from its big end, which is at r (cos, sin); the rod points out, down by its tilt.
  const double vx = -r * s - l / 3 * std::sin(tilt) * swing, vy = r * c - l / 3 * std::cos(tilt) * swing, piston = piston_slope(angle);
  return 8e-3 + 0.5 * (vx * vx + vy * vy) + 1.6e-3 * swing * swing + 0.4 * piston * piston;
}
double inertia_slope(double angle) {
  constexpr double h = 1e-3;
  return (8 * (inertia(angle + h) - inertia(angle - h)) - (inertia(angle + 2 * h) - inertia(angle - 2 * h))) / (12 * h);
}

TEST(EngineSingle, RunsUpThroughTwentyCycles) {
  const Whole w = run(read_scene(PINTLE_SOURCE_DIR "/examples/engine_single.yaml"));
  expect_sound(w);
  const Wave pressure(pintle_hand::read_lines(PINTLE_SOURCE_DIR "/examples/gas_pressure.csv"));
  const double area = pi / 4 * 0.08 * 0.08;
  const auto gas = [&](double angle) { return 1e3 * area * pressure.at(angle * 180 / pi); };

  const auto t = w.column("t [s]"), angle = w.column("crank.angle [rad]"), torque = w.column("brake.torque on crank [N m]");
  const double until = 20 * 8 * pi / (800 * rpm + 9000 * rpm), gain = (9000 - 800) * rpm / until;
  EXPECT_NEAR(t.back(), until, 1e-12);
  double most = 0;
  for (const double m : torque) most = std::max(most, std::abs(m));
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double turned = 800 * rpm * t[i] + gain * t[i] * t[i] / 2, speed = 800 * rpm + gain * t[i];
    ASSERT_NEAR(angle[i], pi + turned, 1e-9);
    // The motion is given, so that the torque is that of the equations to rounding, and to the 9th digit of the area in the scene.
    const double expected = inertia(turned) * gain + inertia_slope(turned) * speed * speed / 2 + gas(turned) * piston_slope(turned);
    ASSERT_NEAR(torque[i], expected, 1e-7 * most) << t[i];
  }
  // Work of a cycle, by the trapezoid's rule of the periodic integrand.
  double cycle = 0;
  constexpr int parts = 72000;
  for (int i = 0; i < parts; ++i) cycle -= gas(4 * pi * i / parts) * piston_slope(4 * pi * i / parts) * 4 * pi / parts;
  EXPECT_NEAR(cycle, 190.43, 0.01);
  EXPECT_NEAR(w.ledger("gas.work in [J]"), 20 * cycle, 1e-6 * 20 * cycle);
  const double stored = inertia(0) * (81e6 - 0.64e6) * rpm * rpm / 2;
  EXPECT_NEAR(w.ledger("brake.work in [J]"), stored - 20 * cycle, 1e-6 * stored);
}

// ---- an automatic gearbox ----

TEST(Gearbox, ShiftsUpAndDown) {
  const Whole w = run(read_scene(PINTLE_SOURCE_DIR "/examples/gearbox.yaml"));
  expect_sound(w);
  // Inertia that the carrier feels in first, of the three as one in second.
  const double in_first = 0.02 * 2.5 * 2.5 + 0.4, in_second = 0.47;
  const double up = 100 * in_first / (50 * 2.5), after_up = (0.02 * 250 + 0.4 * 100) / in_second;
  const double on_the_hill = after_up + 50 / in_second * (1 - up), down = 1 + (on_the_hill - 60) / (60 / in_second);
  const double after_down = (0.02 * 2.5 + 0.4) * 60 / in_first, stop = down + (90 - after_down) / (15 / in_first);
  ASSERT_EQ(w.run.happenings.size(), 3u);
  EXPECT_NEAR(w.run.happenings[0].t, up, 1e-7);
  EXPECT_NEAR(w.run.happenings[1].t, down, 1e-7);
  EXPECT_NEAR(w.run.t_end, stop, 1e-7);
  EXPECT_NEAR(w.ledger("lock.lost to engaging [J]"), (0.02 * 250 * 250 + 0.4 * 1e4 - in_second * after_up * after_up) / 2, 1e-6);
  EXPECT_NEAR(w.ledger("brake.lost to engaging [J]"), (in_second * 3600 - in_first * after_down * after_down) / 2, 1e-6);
  EXPECT_NEAR(w.last("sun.speed [rad/s]"), 2.5 * 90, 1e-6);
  const auto t = w.column("t [s]"), carrier = w.column("carrier.speed [rad/s]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < up) {
      EXPECT_NEAR(carrier[i], 125 / in_first * t[i], 1e-5) << t[i];
    } else if (t[i] > down) {
      EXPECT_NEAR(carrier[i], after_down + 15 / in_first * (t[i] - down), 1e-5) << t[i];
    } else if (t[i] > up && t[i] < 1) {
      EXPECT_NEAR(carrier[i], after_up + 50 / in_second * (t[i] - up), 1e-5) << t[i];
    }
  }
}

// ---- an arm led by a servo with saturation ----

TEST(PidArm, IsLiftedAndHeld) {
  const Whole w = run(read_scene(PINTLE_SOURCE_DIR "/examples/pid_arm.yaml"));
  expect_sound(w);
  const auto t = w.column("t [s]"), angle = w.column("arm.angle [rad]"), integral = w.column("integral [s]"),
             torque = w.column("servo.torque on arm [N m]");
  using State = std::array<double, 3>;  // angle, speed, integral
  const auto servo = [](const State& s) { return std::clamp(-40 * s[0] + 15 * s[2] - 6 * s[1], -9.0, 9.0); };
  const auto rate = [&](double, const State& s) {
    return State{s[1], (servo(s) - 2 * 9.81 * 0.3 * std::cos(s[0])) / (0.06 + 2 * 0.3 * 0.3), -s[0]};
  };
  State x{-pi / 2, 0, 0};
  const double near = 1e-5;  // the loop's slowest root lets errors of some hundred tolerances gather for seconds
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_NEAR(angle[i], x[0], near) << t[i];
    ASSERT_NEAR(integral[i], x[2], near) << t[i];
    for (int k = 0; k < 40; ++k) x = pintle_hand::runge_kutta(x, 0, 5e-4, rate);
  }
  EXPECT_NEAR(*std::max_element(torque.begin(), torque.end()), 9, 1e-12) << "it saturates";
  EXPECT_NEAR(angle.back(), 0, 1e-4);
  EXPECT_NEAR(integral.back(), 2 * 9.81 * 0.3 / 15, 1e-4);
}

}  // namespace
}  // namespace pintle::engine_test
