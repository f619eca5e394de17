// examples/knuckle_press.yaml against an integration of its one dof.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/hand_models.h"
#include "tests/scenes/text_runs.h"

namespace pintle::press_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81, pi = 3.141592653589793, r = 0.06, c = 0.5, a = 0.4, e = 0.015;
constexpr double flywheel = 300, idle = 90 * pi / 30;
const double height = std::sqrt(a * a - e * e);

struct Vector {
  double x, y;
};
Vector operator-(Vector p, Vector q) { return {p.x - q.x, p.y - q.y}; }
Vector mean(Vector p, Vector q) { return {(p.x + q.x) / 2, (p.y + q.y) / 2}; }
double dot(Vector p, Vector q) { return p.x * q.x + p.y * q.y; }
double cross(Vector p, Vector q) { return p.x * q.y - p.y * q.x; }

// Crank at an angle: the slide's height, and what moves for each rad/s of the crank.
struct Pose {
  double slide, slide_rate, inertia, weight;  // weight: rise of potential energy for each radian [J/rad]
};
Pose at(double angle) {
  const Vector O{-e - c - r, height}, T{0, 2 * height}, A{O.x + r * std::cos(angle), O.y + r * std::sin(angle)};
  const Vector across = T - A;
  const double far = std::sqrt(dot(across, across)), along = (c * c - a * a + far * far) / (2 * far),
               aside = std::sqrt(c * c - along * along);
  const Vector u{across.x / far, across.y / far}, K{A.x + along * u.x + aside * u.y, A.y + along * u.y - aside * u.x};
  const double slide = K.y - std::sqrt(a * a - K.x * K.x);
  const Vector S{0, slide}, hung = K - T, rod = K - A, strut = K - S, moved_A{-r * std::sin(angle), r * std::cos(angle)};
  const double swing = dot(moved_A, rod) / cross(hung, rod);  // of the upper link: K moves across it, and not along the rod against A
  const Vector moved_K{-swing * hung.y, swing * hung.x}, turned = moved_K - moved_A;
  const double rod_rate = cross(rod, turned) / (c * c), slide_rate = dot(moved_K, strut) / strut.y;
  const Vector moved_S{0, slide_rate};
  const double strut_rate = cross(strut, moved_K - moved_S) / (a * a);
  const auto link = [](double mass, double inertia, Vector one, Vector other, double rate) {
    const Vector v = mean(one, other);
    return mass * dot(v, v) + inertia * rate * rate;
  };
  return {slide, slide_rate,
          6 + link(60, 1.4, moved_A, moved_K, rod_rate) + link(50, 0.8, moved_K, {0, 0}, swing) +
              link(50, 0.8, moved_K, moved_S, strut_rate) + 300 * slide_rate * slide_rate,
          g * (60 * mean(moved_A, moved_K).y + 50 * moved_K.y / 2 + 50 * mean(moved_K, moved_S).y + 300 * slide_rate)};
}
double inertia_slope(double angle) {
  constexpr double h = 1e-3;
  return (8 * (at(angle + h).inertia - at(angle - h).inertia) - (at(angle + 2 * h).inertia - at(angle - 2 * h).inertia)) / (12 * h);
}

struct Press {
  pintle_hand::Lines motor = pintle_hand::read_lines(PINTLE_SOURCE_DIR "/examples/press_motor.csv"),
                     load = pintle_hand::read_lines(PINTLE_SOURCE_DIR "/examples/press_load.csv");
  double drive(double speed) const { return motor.at(speed * 30 / pi); }
  /// Angle and speed of crank and flywheel together.
  std::array<double, 2> rate(const std::array<double, 2>& x) const {
    const Pose p = at(x[0]);
    const double press = p.slide_rate * x[1] < 0 ? 1e3 * load.at(1e3 * p.slide) * p.slide_rate : 0;
    const double torque = drive(x[1]) + press - p.weight - inertia_slope(x[0]) * x[1] * x[1] / 2;
    return {x[1], torque / (flywheel + p.inertia)};
  }
};

TEST(KnucklePress, MakesItsStroke) {
  const Whole w = run(read_scene(PINTLE_SOURCE_DIR "/examples/knuckle_press.yaml"));
  expect_sound(w);
  const Press press;
  const double work = 2750;                                       // area under the lines of the table: 100 + 600 + 1100 + 950 J
  EXPECT_NEAR(w.ledger("work.work in [J]"), -work, 1e-5 * work);  // the corners of the table fall within steps

  // The clutch: two lumps of clay. At 90 rpm the motor gives nothing, so the flywheel has kept its speed.
  const double crank = at(pi).inertia, together = flywheel * idle / (flywheel + crank);
  EXPECT_NEAR(w.ledger("clutch.lost to engaging [J]"), flywheel * crank / (flywheel + crank) * idle * idle / 2, 1e-6 * work);

  // Row by row; the integration's steps divide the output's.
  const auto t = w.column("t [s]"), slide = w.column("slide.y [m]"), speed = w.column("flywheel.speed [rad/s]");
  const double near = 1e-6;  // a hundred times the tolerance: tests/scenes/laws/signal_run_test.cpp
  std::array<double, 2> x{pi, together};
  const double h = 2e-5;
  const auto step = [&](double by) { return pintle_hand::runge_kutta(x, 0, by, [&](double, const auto& s) { return press.rate(s); }); };
  std::size_t row = 0;
  while (t[row] < 0.1 + 1e-9) ++row;
  double slowest = idle, now = 0.1;
  for (long k = 0; x[0] < 3 * pi; ++k) {
    if (k % 100 == 0 && k > 0) {
      ASSERT_NEAR(t[row], now, 1e-9);
      EXPECT_NEAR(slide[row], at(x[0]).slide, 0.05 * near) << now;
      EXPECT_NEAR(speed[row], x[1], 10 * near) << now;
      slowest = std::min(slowest, x[1]);
      ++row;
    }
    const double whole = step(h)[0] - 3 * pi,
                 left = whole > 0 ? pintle_hand::crossing(h, [&](double by) { return step(by)[0] - 3 * pi; }) : h;
    x = step(left);
    now += left;
    if (whole > 0) break;
  }
  EXPECT_NEAR(slowest * 30 / pi, 81.9, 0.05);
  // Held by its brake the slide moves by rounding, beside a flywheel that turns: that is no way down.
  std::vector<std::string> names;
  for (const Happening& happened : w.run.happenings) names.push_back(happened.event);
  ASSERT_EQ(names, (std::vector<std::string>{"stroke", "down", "down", "top", "ready"}));
  EXPECT_NEAR(w.run.happenings[3].t, now, near);
  EXPECT_NEAR(w.ledger("brake.lost to engaging [J]"), at(3 * pi).inertia * x[1] * x[1] / 2, near * work);

  // The flywheel alone comes back to 88 rpm.
  const double ready = 88 * pi / 30;
  std::array<double, 1> alone{x[1]};
  const auto faster = [&](double by) {
    return pintle_hand::runge_kutta(alone, 0, by, [&](double, const auto& s) { return std::array{press.drive(s[0]) / flywheel}; });
  };
  for (; faster(h)[0] < ready; now += h) alone = faster(h);
  now += pintle_hand::crossing(h, [&](double by) { return faster(by)[0] - ready; });
  EXPECT_NEAR(w.run.t_end, now, 10 * near);
}

}  // namespace
}  // namespace pintle::press_test
