#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/study/nonlinear/nonlinear.h"
#include "tests/scenes/studies/sweep_folder.h"

/// Studies of nonlinear motion, and the ball on a table in closed form.
namespace pintle {

inline constexpr double pi = std::numbers::pi;

/// Sets a study up in a folder and follows it.
struct Followed {
  Nonlinear study;
  std::vector<Row> rows;
  std::vector<FollowedValue> values;
};

inline Followed follow_study(const SweepFolder& folder, const std::string& scene, const std::string& study, int threads = 1) {
  folder.write("scene.yaml", scene);
  folder.write("study.yaml", "scene: scene.yaml\n" + study);
  Followed out;
  out.study = read_nonlinear(folder / "study.yaml");
  SweepSettings settings;
  settings.threads = threads;
  out.rows = run_nonlinear(out.study, folder / "out", settings).rows;
  out.values = followed(out.study, out.rows);
  for (const FollowedValue& value : out.values) EXPECT_EQ(value.status, "finished") << value.reason;
  return out;
}

/// A damped oscillator of 1 kg and 1 N/m, driven by 1 N cos(omega t), that hits a stop at its rest with restitution 0.6.
inline constexpr const char* impact_oscillator =
    "parameters: {omega: 2 rad/s}\n"
    "ground: {points: {G: [0, 0]}, profiles: {stop: {path: [[0.1 m, -1 m], [0.1 m, 1 m]], material: right}}}\n"
    "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}, profiles: {rim: {disc: [0, 0], radius: 0.1 m}}}}\n"
    "joints: {guide: {prismatic: [ground.G, block]}}\n"
    "forces: {pull: {force: [\"1 N*cos(omega*t) - 1 N/m*block.x - 0.1 N s/m*block.vx\", 0], at: block}}\n"
    "contacts: {hit: {between: [block.rim, ground.stop], model: impact, restitution: 0.6}}\n"
    "start: {block: {x: -0.5 m, vx: 0}}\n"
    "run: {until: 100 s, tolerance: 1e-10, method: dopri5}\n";

/// A ball on a heavy table that goes as A sin(omega t), driven by gamma = A omega^2/g: the exact map, once a period. The orbit that
/// hits once a period has, at its impacts, gamma cos(phi) = pi (1 - e)/(1 + e), and the multipliers of its return have the sum
/// 1 + e^2 - (1 + e)^2 gamma sin(phi) and the product e^2. So it is born at gamma = pi (1 - e)/(1 + e) and doubles where
/// gamma sin(phi) = 2 (1 + e^2)/(1 + e)^2.
struct VibratingTable {
  double e = 0.5, omega = 100, g = 9.81;
  double birth() const { return pi * (1 - e) / (1 + e); }
  double doubling() const { return std::hypot(birth(), 2 * (1 + e * e) / ((1 + e) * (1 + e))); }
  double phase(double gamma) const { return std::acos(birth() / gamma); }
  double sum(double gamma) const { return 1 + e * e - (1 + e) * (1 + e) * gamma * std::sin(phase(gamma)); }
  /// Half a flight after an impact, at the apex, `off` times as high above the table's height at impacts as on the orbit.
  std::string scene(double gamma, double off) const {
    const double period = 2 * pi / omega, amplitude = gamma * g / (omega * omega), launch = g * period / 2;
    const double apex = 0.01 + amplitude * std::sin(phase(gamma)) + off * launch * launch / (2 * g);
    return "parameters: {omega: 100 rad/s, gamma: " + std::to_string(gamma) +
           ", A: gamma*9.81 m/s^2/omega^2, phase: " + std::to_string(phase(gamma)) +
           "}\ngravity: [0, -9.81]\n"
           "ground: {points: {below: {at: [0, -1 m], angle: 90 deg}}}\n"
           "bodies:\n"
           "  table: {rigid: {mass: 100 kg, inertia: 1}, profiles: {top: {path: [[-1, 0], [1, 0]], material: right}}}\n"
           "  ball: {rigid: {mass: 0.01 kg, inertia: 1e-6}, profiles: {rim: {disc: [0, 0], radius: 10 mm}}}\n"
           "joints:\n"
           "  guide: {prismatic: [ground.below, table], angle: -90 deg}\n"
           "  tube: {prismatic: [ground.below, ball], angle: -90 deg}\n"
           "drivers: {shaker: {distance: [ground.below, table], law: \"1 m + A*sin(omega*t + phase + pi)\"}}\n"
           "contacts: {hit: {between: [ball.rim, table.top], model: impact, restitution: 0.5}}\n"
           "start: {ball: {y: " +
           std::to_string(apex) +
           " m, vy: 0}}\n"
           "run: {until: 10 s, tolerance: 1e-10, method: dopri5}\n";
  }
};

// E. N. Lorenz (1963), by states of the scene's own.
inline const char* const lorenz =
    "parameters: {sigma: 10, rho: 28, beta: 8/3}\n"
    "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
    "joints: {held: {weld: [ground, plate]}}\n"
    "states:\n"
    "  X: {rate: \"sigma*(Y - X)/(1 s)\", start: 1}\n"
    "  Y: {rate: \"(X*(rho - Z) - Y)/(1 s)\", start: 1}\n"
    "  Z: {rate: \"(X*Y - beta*Z)/(1 s)\", start: 20}\n"
    "run: {until: 1000 s, tolerance: 1e-9, method: verner87}\n";

inline std::string once_a_period(int transient, int returns) {
  return "section: {every: 2*pi/omega, record: {height: ball.y, speed: ball.vy}, transient: " + std::to_string(transient) +
         ", returns: " + std::to_string(returns) + ", tolerance: 1e-3}\n";
}

}  // namespace pintle
