// examples/dc_motor.yaml against the two exponentials of its circuit and its rotor, and what electrical units tell apart.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::motor_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::run, pintle_scenes::Whole;

constexpr double U = 12, R = 0.5, L = 2e-3, k = 0.05, b = 2e-5, J = 1e-4;

Scene motor(const Overrides& changed = {}) { return read_scene(PINTLE_SOURCE_DIR "/examples/dc_motor.yaml", changed); }

class Motor : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Each, Motor,
                         testing::Values(Method{"dopri5", "dopri5", 1e-9, 1e-7}, Method{"verner87", "verner87", 1e-9, 1e-7},
                                         Method{"alpha", "generalized-alpha", 1e-8, 1e-4}),
                         pintle_scenes::name_of);

// Poles s² + (R/L + b/J) s + (R b + k²)/(L J) = 0; from rest without current ω = ω₀ (1 − (s₂ e^(s₁t) − s₁ e^(s₂t))/(s₂ − s₁)).
TEST_P(Motor, RunsUpByTheTwoRatesOfItsCircuitAndItsRotor) {
  const double half = (R / L + b / J) / 2, root = std::sqrt(half * half - (R * b + k * k) / (L * J)), s1 = root - half, s2 = -root - half;
  const double settled = k * U / (R * b + k * k);
  const Whole w = run(motor(), GetParam());
  expect_sound(w);
  const auto t = w.column("t [s]"), speed = w.column("rotor.speed [rad/s]"), current = w.column("current [A]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double e1 = std::exp(s1 * t[i]), e2 = std::exp(s2 * t[i]);
    const double omega = settled * (1 - (s2 * e1 - s1 * e2) / (s2 - s1)), rate = settled * s1 * s2 * (e2 - e1) / (s2 - s1);
    EXPECT_NEAR(speed[i], omega, GetParam().near * settled) << t[i];
    EXPECT_NEAR(current[i], (J * rate + b * omega) / k, GetParam().near * U / R) << t[i];
  }
  EXPECT_NEAR(speed.back(), 226.9993415, 1e-7 * 227 + GetParam().near * settled);
}

// What the battery gives is in the rotor, in the coil, or has become heat; the ledger knows the rotor's share.
TEST_P(Motor, DrawsWhatItDoesAndHeats) {
  const Whole w = run(motor({{"states.heated", "{rate: R*current^2, start: 0 J}"}}), GetParam());
  expect_sound(w);
  const double drawn = w.last("drawn [N m]");
  EXPECT_NEAR(w.last("heated [N m]") + w.last("stored [N m]") + w.ledger("motor.work in [J]"), drawn, 10 * GetParam().near * drawn);
}

TEST(MotorUnits, OneConstantIsInVoltSecondsAndInNewtonMetresAnAmpere) {
  const double by_volts = run(motor({{"k", "0.05 V s"}})).last("rotor.speed [rad/s]");
  EXPECT_EQ(run(motor({{"k", "50 mV*s/rad"}})).last("rotor.speed [rad/s]"), by_volts);
  EXPECT_EQ(run(motor({{"k", "0.05 N m/A"}})).last("rotor.speed [rad/s]"), by_volts);
  EXPECT_EQ(run(motor({{"R", "500 mΩ"}, {"L", "2000 uH"}})).last("rotor.speed [rad/s]"), by_volts);
}

TEST(MotorUnits, OthersAreRefused) {
  using pintle_test::expect_refused;
  expect_refused([] { motor({{"parameters.R", "0.5 V"}}); }, {"rate", "mixes", "[V]"});
  expect_refused([] { motor({{"parameters.L", "2 mF"}}); }, {"states.current.rate", "A/s"});
  expect_refused([] { motor({{"forces.motor.torque", "current"}}); }, {"forces.motor.torque", "a current [A]", "a torque"});
  expect_refused([] { motor({{"parameters.R", "0.5 ohm"}}); }, {"ohm", "Ohm"});
}

}  // namespace
}  // namespace pintle::motor_test
