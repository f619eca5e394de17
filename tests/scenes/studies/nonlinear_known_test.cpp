// The scenes of examples/nonlinear/ against what the literature has of them.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/study/nonlinear/nonlinear.h"
#include "tests/scenes/studies/nonlinear_study.h"

namespace pintle {
namespace {

std::string known_scene(const std::string& name) { return contents(fs::path(PINTLE_SOURCE_DIR) / "examples/nonlinear" / name); }

// Sprott (2003), A.4.6: 0.1572 and -0.4072. Their sum is that of the drag whatever the time; differences of 1e-6 over 2 s err by 1e-5.
TEST(KnownMotion, DuffingHasItsExponents) {
  const SweepFolder folder;
  const Followed done =
      follow_study(folder, known_scene("duffing.yaml"),
                   "set: {gamma: 0.4, b: 0.25, omega: 1 rad/s}\nlyapunov: {exponents: 2, every: 2 s, over: 1600 s, transient: 100 s}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].value + found[1].value, -0.25, 1e-4);
  EXPECT_LT(found[0].error, 0.03);
  EXPECT_NEAR(found[0].value, 0.1572, 4 * found[0].error);
}

// Jordan and Smith (2007): one period of the driving at gamma = 0.20, two at 0.28, four at 0.29, five at 0.37, two about both
// wells at 0.65.
TEST(KnownMotion, DuffingDoublesItsPeriod) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, known_scene("duffing.yaml"),
                                     "section: {every: 2*pi/omega, record: [block.x, block.vx], transient: 200, returns: 16}\n"
                                     "over: {gamma: [0.2, 0.28, 0.29, 0.37, 0.65]}\ndirection: from start\n");
  std::vector<std::size_t> periods;
  for (const FollowedValue& value : done.values) periods.push_back(value.period);
  EXPECT_EQ(periods, (std::vector<std::size_t>{1, 2, 4, 5, 2}));
}

// By Hamilton's equations volumes stay, and exponents come in pairs; two are of the motion itself and its energy, and go to 0 as ln t/t.
TEST(KnownMotion, HenonAndHeilesHavePairsOfOppositeExponents) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, known_scene("henon_heiles.yaml"), "lyapunov: {exponents: 4, every: 4 s, over: 600 s}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 4u);
  const double time = 600, left = std::log(time) / time;
  EXPECT_NEAR(found[0].value + found[1].value + found[2].value + found[3].value, 0, 1e-5);
  EXPECT_NEAR(found[0].value + found[3].value, 0, left);
  EXPECT_NEAR(found[1].value, 0, left);
  EXPECT_NEAR(found[2].value, 0, left);
  EXPECT_GT(found[0].value, 2 * left);
}

/// The valve of examples/nonlinear/relief_valve.yaml by the classical method of Runge and Kutta, its impacts and greatest lifts by bisection.
struct Valve {
  using Vector = std::array<double, 3>;  // lift, speed, pressure
  double q;
  Vector y{1, 0, 10};
  int impacts = 0;

  Vector rate(const Vector& at) const { return {at[1], at[2] - 10 - at[0] - 1.25 * at[1], 20 * (q - at[0] * std::sqrt(at[2]))}; }
  Vector after(double h) const {
    const auto along = [&](const Vector& k, double by) { return Vector{y[0] + by * k[0], y[1] + by * k[1], y[2] + by * k[2]}; };
    const Vector a = rate(y), b = rate(along(a, h / 2)), c = rate(along(b, h / 2)), d = rate(along(c, h));
    Vector out = y;
    for (std::size_t i = 0; i < 3; ++i) out[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    return out;
  }
  /// The time at which `of` becomes negative, within a step that ends with it negative.
  template <class F>
  double crossing(double h, const F& of) const {
    double low = 0;
    for (int i = 0; i < 60; ++i) (of(after((low + h) / 2)) < 0 ? h : low) = (low + h) / 2;
    return h;
  }
  /// To the next greatest lift.
  void go_to_return() {
    const double step = 2e-4;
    while (true) {
      const Vector next = after(step);
      if (next[0] < 0) {
        y = after(crossing(step, [](const Vector& at) { return at[0]; }));
        y[0] = 0, y[1] *= -0.8, ++impacts;
      } else if (y[1] > 0 && next[1] < 0) {
        y = after(crossing(step, [](const Vector& at) { return at[1]; }));
        y[1] = -1e-300;
        return;
      } else {
        y = next;
      }
    }
  }
};

// Oscillations begin where a pair of eigenvalues of the linear system crosses the imaginary axis: with a = beta x/(2 sqrt(p)) and
// b = beta sqrt(p), (kappa + a)(1 + kappa a) = a + b, at q = 8.4911. The classical method errs by 1e-13 a step here; in chaos, at q = 0.5
// and q = 7, distances grow less than tenfold a return.
TEST(KnownMotion, AReliefValveGoesAsItsEquationsByHand) {
  const SweepFolder folder;
  for (const double q : {8.3, 7.0, 5.0, 2.0, 0.5}) {
    SCOPED_TRACE(q);
    const Followed done = follow_study(
        folder, known_scene("relief_valve.yaml"),
        "set: {q: " + std::to_string(q) + "}\nsection: {when: valve.vx < 0, record: [valve.x, p], transient: 0, returns: 8}\n");
    fs::remove_all(folder / "out");
    const Orbit& orbit = done.values.at(0).orbit;
    Valve valve{q};
    ASSERT_EQ(orbit.signals.size(), 8u);
    double near = 1e-8;
    for (const std::vector<double>& one : orbit.signals) {
      valve.go_to_return();
      EXPECT_NEAR(one[0], valve.y[0], near);
      EXPECT_NEAR(one[1], valve.y[2], 10 * near);
      near *= 3;
    }
    EXPECT_EQ(orbit.impacts.count, valve.impacts);
  }
}

}  // namespace
}  // namespace pintle
