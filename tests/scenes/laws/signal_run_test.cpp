// Laws of signals and states of the scene's own, by every kind of method, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/scenes/text_runs.h"

namespace pintle::signal_run_test {
namespace {

using pintle_scenes::Method;
using pintle_scenes::Whole;

// At one tolerance explicit pairs err by a hundred times that, the implicit one by its power two thirds.
const Method methods[] = {
    {"Dopri5", "dopri5", 1e-10, 1e-8}, {"Verner87", "verner87", 1e-10, 1e-8}, {"GeneralizedAlpha", "generalized-alpha", 1e-9, 1e-5}};
class SignalRun : public testing::TestWithParam<Method> {
 protected:
  Whole run(const std::string& text) const { return pintle_scenes::run(text, GetParam()); }
  double near() const { return GetParam().near; }
};
INSTANTIATE_TEST_SUITE_P(Each, SignalRun, testing::ValuesIn(methods), pintle_scenes::name_of);

const std::string wheel = R"yaml(
bodies: {wheel: {rigid: {mass: 2 kg, inertia: 0.5 kg m^2}, points: {O: [0, 0]}}}
joints: {axle: {revolute: [ground, wheel.O]}}
)yaml";

// J ω' = T(1 − ω/ω₀)
TEST_P(SignalRun, AMotorRunsUpItsCurve) {
  const Whole w = run(wheel + R"yaml(
forces: {motor: {torque: "12 N m*(1 - wheel.speed/(300 rad/s))", on: wheel}}
outputs: {power: motor.torque*wheel.speed}
run: {until: 20 s}
output: {every: 1 s}
)yaml");
  pintle_scenes::expect_sound(w);
  const auto t = w.column("t [s]"), speed = w.column("wheel.speed [rad/s]"), power = w.column("power [W]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double exact = 300 * (1 - std::exp(-12 * t[i] / (0.5 * 300)));
    EXPECT_NEAR(speed[i], exact, 300 * near());
    EXPECT_NEAR(power[i], 12 * (1 - exact / 300) * exact, 12 * 300 * near());
  }
  EXPECT_NEAR(w.ledger("motor.work in [J]"), 0.25 * speed.back() * speed.back(), 22500 * near());
}

// m v²/2 = ∫ p₀ A (x₀/x)^1.3 dx
TEST_P(SignalRun, AGasSpringGivesTheWorkOfItsExpansion) {
  const Whole w = run(R"yaml(
bodies: {piston: {rigid: {mass: 0.4 kg, inertia: 1e-3}, points: {P: [0, 0]}}}
joints: {guide: {prismatic: [ground, piston]}}
forces: {gas: {force: ["200 N*(50 mm/piston.P.x)^1.3", 0], at: piston.P}}
start: {piston: {x: 50 mm}}
run: {until: 10 ms}
)yaml");
  pintle_scenes::expect_sound(w);
  const double x = w.column("piston.x [m]").back(), v = w.column("piston.vx [m/s]").back();
  const double work = 200 * 0.05 / 0.3 * (1 - std::pow(0.05 / x, 0.3));
  EXPECT_GT(x, 0.06);
  EXPECT_NEAR(0.2 * v * v, work, work * near());
}

// Half a swing with the damper, half a swing without: its law is continuous, with a kink where the speed is 0.
TEST_P(SignalRun, AOneSidedDamperActsOneWay) {
  constexpr double m = 0.5, k = 200, c = 4;
  const double omega = std::sqrt(k / m), ratio = c / (2 * m * omega), slow = omega * std::sqrt(1 - ratio * ratio), pi = std::acos(-1.0);
  const double until = pi / omega + pi / slow;
  const Whole w = run(R"yaml(
bodies: {block: {rigid: {mass: 0.5 kg, inertia: 1e-3}, points: {P: [0, 0]}}}
joints: {guide: {prismatic: [ground, block]}}
forces: {strut: {spring: [ground, block.P], law: "200 N/m*(strut.length - 1 m) + if(strut.rate > 0, 4, 0)*1 N s/m*strut.rate"}}
start: {block: {x: 1.2 m}}
run: {until: )yaml" + pintle_scenes::number(until) +
                      "}\n");
  pintle_scenes::expect_sound(w);
  EXPECT_NEAR(w.column("block.x [m]").back(), 1 + 0.2 * std::exp(-ratio * omega * pi / slow), 10 * near());
}

// A rotor of inertia 1, its angle led to 0.5 rad by gains that place the poles at −1, −2, −3.
TEST_P(SignalRun, APidLoopIsItsExponentials) {
  const Whole w = run(R"yaml(
parameters: {target: 0.5 rad}
bodies: {arm: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states: {integral: {rate: target - arm.angle, start: 0 rad s}}
forces: {servo: {torque: "11 N m*(target - arm.angle) + 6 N m/s*integral - 6 N m s*arm.speed", on: arm}}
run: {until: 5 s}
output: {every: 0.25 s}
)yaml");
  pintle_scenes::expect_sound(w);
  const auto t = w.column("t [s]"), angle = w.column("arm.angle [rad]"), integral = w.column("integral [s]");
  // Θ/R = (11 s + 6)/((s + 1)(s + 2)(s + 3)), a step in R from t = 0
  const auto exact = [](double at) {
    return 0.5 * (1 + (-11 + 6.0) / (-1 * 1 * 2.0) * std::exp(-at) + (-22 + 6.0) / (-2 * -1 * 1.0) * std::exp(-2 * at) +
                  (-33 + 6.0) / (-3 * -2 * -1.0) * std::exp(-3 * at));
  };
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(angle[i], exact(t[i]), near()) << t[i];
  EXPECT_NEAR(integral.front(), 0, 1e-15);
  EXPECT_NEAR(integral.back(), 0, 0.1);  // 6 I = torque at rest = 0
}

// The table of a sine over the wheel's angle, against the formula, through 160 turns.
TEST_P(SignalRun, APeriodicTableIsReadAtAnySpeed) {
  const auto folder = std::filesystem::temp_directory_path() / ("pintle_periodic_" + std::string(GetParam().name));
  std::filesystem::create_directories(folder);
  const double pi = std::acos(-1.0);
  {
    std::ofstream file(folder / "sine.csv");
    file.precision(17);
    for (int i = 0; i <= 360; ++i) file << i << "," << (i % 360 == 0 ? 0 : 0.3 * std::sin(2 * pi * i / 360)) << "\n";
  }
  const auto scene = [&](const std::string& torque) {
    Scene s = read_scene_text(wheel + "forces: {load: {torque: " + torque +
                                  ", on: wheel}}\nstart: {wheel: {speed: 1000 rad/s}}\nrun: {until: 1 s}\noutput: {every: 0.1 s}\n",
                              "scene.yaml", {}, folder);
    return pintle_scenes::run(std::move(s), GetParam());
  };
  const Whole table = scene("{table: sine.csv, over: wheel.angle, over unit: deg, periodic: true}"),
              formula = scene("\"0.3 N m*sin(wheel.angle)\"");
  std::filesystem::remove_all(folder);
  pintle_scenes::expect_sound(table);
  pintle_scenes::expect_sound(formula);
  EXPECT_NEAR(table.column("wheel.angle [rad]").back(), formula.column("wheel.angle [rad]").back(), 1000 * near());
  EXPECT_NEAR(table.column("wheel.speed [rad/s]").back(), formula.column("wheel.speed [rad/s]").back(), 10 * near());
}

}  // namespace
}  // namespace pintle::signal_run_test
