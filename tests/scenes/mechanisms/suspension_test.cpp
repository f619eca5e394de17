// examples/rear_suspension.yaml against an integration of its two dofs, the road's arcs and lines by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/scenes/hand_models.h"
#include "tests/scenes/text_runs.h"

namespace pintle::suspension_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81, M = 280, m = 38, I = 1.5, centre = 0.37, length = 0.45, wheel = 0.32, speed = 7;

// How deep the wheel, its middle at a place of the road, is in it, and the direction in which that pushes it.
struct Ground {
  double depth, nx, ny;
};
Ground road(double x, double y) {
  const double along = x + 0.56;  // from the middle of the hump, which is 80 mm high: arcs of 1 m about these
  const double round = std::hypot(along, y + 0.92);
  // The arcs meet 16.26° = asin 0.28 from the vertical; beyond ±0.56 m it is level.
  if (std::abs(along) < 0.28 * round) return {1 + wheel - round, along / round, (y + 0.92) / round};
  if (std::abs(along) >= 0.56) return {wheel - y, 0, 1};
  const double aside = std::abs(along) - 0.56, hollow = std::hypot(aside, 1 - y);
  return {wheel - 1 + hollow, (along < 0 ? -1 : 1) * -aside / hollow, (1 - y) / hollow};
}

struct Suspension {
  using State = std::array<double, 4>;  // the body's height, the arm's angle, and their rates
  pintle_hand::Lines damper = pintle_hand::read_lines(PINTLE_SOURCE_DIR "/examples/damper.csv"),
                     stop = pintle_hand::read_lines(PINTLE_SOURCE_DIR "/examples/bump_stop.csv");
  double t = 0, hardest = 0;  // hardest: greatest force of the tyre
  State x{};

  struct Strut {
    double length, slope;  // by the arm's angle
  };
  static Strut strut(double angle) {
    const double c = std::cos(angle), s = std::sin(angle), px = 0.3 * c - 0.04 * s, py = 0.3 * s + 0.04 * c;
    const double dx = px - 0.26, dy = py - 0.45, l = std::hypot(dx, dy);
    return {l, (dx * -py + dy * px) / l};
  }
  struct Tyre {
    double depth, raw, nx, ny;  // raw: k δ + c δ̇, also where that pulls
  };
  static Tyre tyre(double time, const State& s) {
    const double c = std::cos(s[1]), sn = std::sin(s[1]);
    const Ground at = road(length * c - speed * time, s[0] + length * sn);
    const double vx = -length * sn * s[3] - speed, vy = s[2] + length * c * s[3];
    return {at.depth, 260e3 * at.depth - 150 * (vx * at.nx + vy * at.ny), at.nx, at.ny};
  }
  static double push(double time, const State& s) {
    const Tyre at = tyre(time, s);
    return at.depth > 0 ? std::max(0.0, at.raw) : 0;
  }
  State rate(double time, const State& s) const {
    const double c = std::cos(s[1]), sn = std::sin(s[1]);
    const Tyre at = tyre(time, s);
    const double force = push(time, s);
    const Strut l = strut(s[1]);
    const double pull = 45e3 * (l.length - 0.49) + damper.at(l.slope * s[3]) + stop.at(1e3 * l.length);
    // Lagrange's equations of the height and the angle: [a b; b d] accelerations = forces
    const double a = M + m, b = m * centre * c, d = I + m * centre * centre;
    const double up = force * at.ny - (M + m) * g + m * centre * sn * s[3] * s[3];
    const double turning = force * length * (at.ny * c - at.nx * sn) - m * g * centre * c - pull * l.slope;
    const double det = a * d - b * b;
    return {s[2], s[3], (d * up - b * turning) / det, (a * turning - b * up) / det};
  }
  State after(double h) const {
    return pintle_hand::runge_kutta(x, t, h, [this](double time, const State& s) { return rate(time, s); });
  }
  /// Where a step touches the road or leaves it the force jumps: there it is cut small.
  void advance(double until, double step) {
    while (t < until - 1e-15) {
      const double h = std::min(step, until - t);
      const State next = after(h);
      const bool changes = (tyre(t, x).depth > 0) != (tyre(t + h, next).depth > 0);
      if (changes && step > 1e-8) {
        advance(t + h, h / 50);
      } else {
        x = next;
        t += h;
        hardest = std::max(hardest, push(t, x));
      }
    }
  }
  /// At rest on the level road, by Newton's method with differences.
  void rest() {
    x = {0.28, -0.1, 0, 0};
    for (int k = 0; k < 50; ++k) {
      const auto out = [&](double height, double angle) { return rate(0, {height, angle, 0, 0}); };
      const double h = 1e-7;
      const State f = out(x[0], x[1]), fy = out(x[0] + h, x[1]), fa = out(x[0], x[1] + h);
      const double yy = (fy[2] - f[2]) / h, ya = (fa[2] - f[2]) / h, ay = (fy[3] - f[3]) / h, aa = (fa[3] - f[3]) / h,
                   det = yy * aa - ya * ay;
      x[0] -= (aa * f[2] - ya * f[3]) / det;
      x[1] -= (yy * f[3] - ay * f[2]) / det;
    }
  }
};

TEST(RearSuspension, GoesOverItsHump) {
  Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/rear_suspension.yaml");
  s.output.frames = 0;
  const Whole w = run(s);
  expect_sound(w);
  const auto t = w.column("t [s]"), height = w.column("body.y [m]"), angle = w.column("arm.angle [rad]"), strut = w.column("strut [m]"),
             strut_speed = w.column("strut speed [m/s]"), push = w.column("tyre.normal [N]");
  Suspension hand;
  hand.rest();
  // Statics by hand as well: the tyre bears all, and the moment about the pivot is the strut's.
  EXPECT_NEAR(push.front(), (M + m) * g, 1e-6 * M * g);
  const double near = 1e-6;  // a hundred times the tolerance, of metres and radians that change by some tenths
  for (std::size_t i = 0; i < t.size(); ++i) {
    hand.advance(t[i], 2e-5);
    const auto l = Suspension::strut(hand.x[1]);
    ASSERT_NEAR(height[i], hand.x[0], near) << t[i];
    ASSERT_NEAR(angle[i], hand.x[1], near) << t[i];
    ASSERT_NEAR(strut[i], l.length, near) << t[i];
    ASSERT_NEAR(strut_speed[i], l.slope * hand.x[3], 100 * near) << t[i];
  }
  EXPECT_NEAR(*std::min_element(strut.begin(), strut.end()), 0.3425, 1e-4) << "against the bump stop, which begins at 0.375";
  EXPECT_EQ(*std::min_element(push.begin(), push.end()), 0) << "the wheel leaves the road";
  double hardest = 0;
  for (const Impact& i : w.run.impacts) hardest = std::max(hardest, i.peak_force);
  EXPECT_NEAR(hardest, hand.hardest, 1e-4 * hand.hardest);  // it is parabolic about the ends of the steps that were looked at
  EXPECT_NEAR(hardest, 8133, 1);
}

// It begins at rest on a flat road, where a step may be as long as the whole hump.
TEST(RearSuspension, GoesOverItsHumpByEveryMethodAndTolerance) {
  Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/rear_suspension.yaml");
  s.output.frames = 0;
  Suspension hand;
  hand.rest();
  std::vector<std::array<double, 2>> by_hand;  // height, angle
  for (const char* method : {"dopri5", "rkf45", "verner87"})
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      SCOPED_TRACE(std::string(method) + " " + std::to_string(tolerance));
      s.run.method = method, s.run.tolerance = tolerance;
      const Whole w = run(s);
      expect_sound(w);
      const auto t = w.column("t [s]"), height = w.column("body.y [m]"), angle = w.column("arm.angle [rad]");
      const double near = std::max(1000 * tolerance, 1e-6);
      for (std::size_t i = 0; i < t.size(); ++i) {
        if (by_hand.size() == i) {
          hand.advance(t[i], 2e-5);
          by_hand.push_back({hand.x[0], hand.x[1]});
        }
        ASSERT_NEAR(height[i], by_hand[i][0], near) << t[i];
        ASSERT_NEAR(angle[i], by_hand[i][1], near) << t[i];
      }
    }
}

}  // namespace
}  // namespace pintle::suspension_test
