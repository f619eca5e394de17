#pragma once

#include <cmath>
#include <string>

#include "tests/scenes/mechanisms.h"

/// Parallelograms, and one bar on many cranks, which is redundant in every pose; both have flat poses.
namespace pintle_scenes {

using namespace pintle;

inline constexpr double g = 9.81, rod_inertia = 1.0 / 12;  // every link: 1 m, 1 kg, uniform

/// θ of  inertia θ̈ = −weight cos θ  at time t, by many small classical steps: error below 1e-10.
inline double angle_at(double t, double inertia, double weight, double angle, double speed) {
  constexpr int steps = 40000;
  const double h = t / steps;
  const auto accel = [&](double x) { return -weight / inertia * std::cos(x); };
  for (int i = 0; i < steps; ++i) {
    const double k1 = accel(angle), k2 = accel(angle + h / 2 * speed), k3 = accel(angle + h / 2 * speed + h * h / 4 * k1),
                 k4 = accel(angle + h * speed + h * h / 2 * k2);
    angle += h * speed + h * h / 6 * (k1 + k2 + k3);
    speed += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return angle;
}

inline SceneBody link(const std::string& name, double x, double y, double angle) {
  SceneBody b = body(name, 1, rod_inertia, {point("A", -0.5), point("B", 0.5)});
  b.at = {x + 0.5 * std::cos(angle), y + 0.5 * std::sin(angle)}, b.angle = angle;
  return b;
}
inline std::string numbered(const char* name, int i) { return name + std::to_string(i); }
inline void finish(Scene& s, double until) {
  s.gravity = {0, -g};
  s.run.until = until, s.run.method = "dopri5", s.run.tolerance = 1e-9;
  s.output.every = until / 20;
}

/// n parallelograms in a row on n + 1 cranks, the IFToMM library's N four-bar mechanism: all cranks turn alike. As they
/// lie flat, each parallelogram could fold.
inline Scene parallelograms(int n, double angle, double speed, double until) {
  Scene s;
  for (int i = 0; i <= n; ++i) {
    s.ground.push_back(point(numbered("G", i), i));
    s.bodies.push_back(link(numbered("crank", i), i, 0, angle));
    s.joints.push_back(joint(numbered("base", i), JointKind::revolute, numbered("ground.G", i), numbered("crank", i) + ".A"));
    s.start_bodies.push_back(start_angle(numbered("crank", i), angle, speed));
  }
  for (int i = 0; i < n; ++i) {
    s.bodies.push_back(link(numbered("bar", i), i + std::cos(angle), std::sin(angle), 0));
    s.joints.push_back(joint(numbered("left", i), JointKind::revolute, numbered("crank", i) + ".B", numbered("bar", i) + ".A"));
    s.joints.push_back(joint(numbered("right", i), JointKind::revolute, numbered("crank", i + 1) + ".B", numbered("bar", i) + ".B"));
  }
  finish(s, until);
  return s;
}
inline double expected_parallelograms(int n, double t, double angle, double speed) {
  return angle_at(t, (n + 1) / 3.0 + n, g * ((n + 1) / 2.0 + n), angle, speed);
}

/// One bar, of 1 kg, on n ≥ 3 equal cranks 1 m apart: it moves, though all but two cranks are redundant.
inline Scene parallel_cranks(int n, double angle, double speed, double until) {
  Scene s;
  SceneBody bar = body("bar", 1, rod_inertia * n * n, {});
  bar.at = {(n - 1) / 2.0 + std::cos(angle), std::sin(angle)};
  for (int i = 0; i < n; ++i) {
    s.ground.push_back(point(numbered("G", i), i));
    bar.points.push_back(point(numbered("P", i), i - (n - 1) / 2.0));
    s.bodies.push_back(link(numbered("crank", i), i, 0, angle));
    s.joints.push_back(joint(numbered("base", i), JointKind::revolute, numbered("ground.G", i), numbered("crank", i) + ".A"));
    s.joints.push_back(joint(numbered("top", i), JointKind::revolute, numbered("crank", i) + ".B", numbered("bar.P", i)));
    s.start_bodies.push_back(start_angle(numbered("crank", i), angle, speed));
  }
  s.bodies.push_back(bar);
  finish(s, until);
  return s;
}

}  // namespace pintle_scenes
