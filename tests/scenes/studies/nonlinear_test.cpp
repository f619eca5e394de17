// Poincaré sections, periods and Lyapunov exponents against closed forms.
#include "framework/study/nonlinear/nonlinear.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scenes/studies/nonlinear_study.h"

namespace pintle {
namespace {

// The divergence of the flow is -(sigma + 1 + beta) everywhere; the flow's own direction neither grows nor shrinks.
TEST(Nonlinear, LorenzHasItsExponentsAndTheirSumIsTheDivergence) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, lorenz, "lyapunov: {exponents: 3, every: 0.2 s, over: 300 s, transient: 20 s}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].value + found[1].value + found[2].value, -(10 + 1 + 8.0 / 3), 1e-3);
  // 0.9056 (Sprott 2003); the time is finite: within four of its own standard errors, and these are small.
  EXPECT_LT(found[0].error, 0.05);
  EXPECT_NEAR(found[0].value, 0.9056, 4 * found[0].error);
  EXPECT_NEAR(found[1].value, 0, 4 * found[1].error + 0.01);
}

// On van der Pol's limit cycle the greatest exponent is 0. The logarithm of the distance along it rises and falls by that of the speed
// (X', Y'), which is between 0.6 and 4: where the time begins and ends in a period leaves ln 7/time at most. Batches, of one period and a
// half, scatter a hundred times less.
TEST(Nonlinear, ExponentsOfALimitCycleAreZeroWithinTheirErrors) {
  for (const double over : {100.0, 200.0, 400.0}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder,
                                       "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
                                       "joints: {held: {weld: [ground, plate]}}\n"
                                       "states:\n"
                                       "  X: {rate: Y/(1 s), start: 2}\n"
                                       "  Y: {rate: \"((1 - X^2)*Y - X)/(1 s)\", start: 0.1}\n"
                                       "run: {until: 700 s, tolerance: 1e-10, method: verner87}\n",
                                       "lyapunov: {exponents: 2, every: 0.5 s, over: " + std::to_string(over) + " s, transient: 67.3 s}\n");
    const Exponent& zero = done.values.at(0).orbit.exponents.at(0);
    EXPECT_NEAR(zero.value, 0, zero.error) << over;
    EXPECT_LT(zero.error, 2 * std::log(7) / over) << over;
  }
}

TEST(Nonlinear, ABouncingBallDoublesItsPeriodAtTheClosedForm) {
  const VibratingTable table;
  for (const double part : {0.98, 1.02}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, table.scene(part * table.doubling(), 1.001), once_a_period(300, 16));
    EXPECT_EQ(done.values.at(0).period, part < 1 ? 1u : 2u);
    EXPECT_EQ(done.values[0].orbit.impacts.count, 16);
    EXPECT_EQ(done.values[0].orbit.impacts.grazing, 0);
  }
}

// Deviations d of a return obey d'' - sum d' + product d = 0.
TEST(Nonlinear, ReturnsOfABouncingBallConvergeByTheMultipliersOfTheClosedForm) {
  const VibratingTable table;
  const double gamma = 1.2;
  const SweepFolder folder;
  const Followed done = follow_study(folder, table.scene(gamma, 1.0005), once_a_period(0, 40));
  const std::vector<std::vector<double>>& returns = done.values.at(0).orbit.signals;
  const auto d = [&](std::size_t k) { return returns[k][1] - returns.back()[1]; };
  const std::size_t k = 4;  // small by then, so that squares are some 1e-4 of it
  const double det = d(k) * d(k + 2) - d(k + 1) * d(k + 1);
  const double sum = (d(k) * d(k + 3) - d(k + 1) * d(k + 2)) / det;
  const double product = (d(k + 1) * d(k + 3) - d(k + 2) * d(k + 2)) / det;
  EXPECT_NEAR(sum, table.sum(gamma), 2e-3);
  EXPECT_NEAR(product, table.e * table.e, 2e-3);
}

// Both multipliers have the size e where they are complex, so both exponents are log(e) a period: neighbours pass impacts.
TEST(Nonlinear, ExponentsOfABouncingBallAreTheLogarithmsOfItsMultipliers) {
  const VibratingTable table;
  const double period = 2 * pi / table.omega;
  const SweepFolder folder;
  const Followed done = follow_study(folder, table.scene(1.2, 1.0),
                                     "lyapunov: {exponents: 2, every: 2*pi/omega, over: 200*2*pi/omega, transient: 50*2*pi/omega}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR((found[0].value + found[1].value) * period, 2 * std::log(table.e), 1e-3);
  EXPECT_NEAR(found[0].value * period, std::log(table.e), 0.02);  // the share of the last, unfinished turn of the pair
}

// x of the ball is 0 but for rounding, which does not repeat.
TEST(Nonlinear, ASignalThatIsRoundingHidesNoPeriod) {
  const VibratingTable table;
  const SweepFolder folder;
  const std::string study =
      "section: {every: 2*pi/omega, record: [ball.y, ball.x + 1e-17 m*sin(1e6 rad/s*t), ball.vx], transient: 300, returns: 16}\n";
  EXPECT_EQ(follow_study(folder, table.scene(0.98 * table.doubling(), 1.001), study).values.at(0).period, 1u);
}

// A damped block at rest at each return, but for noise that does not repeat.
TEST(Nonlinear, RestIsOfPeriodOne) {
  const char* const block =
      "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}}}\njoints: {guide: {prismatic: [ground, block]}}\n"
      "forces: {pull: {force: [\"-1 N/m*block.x - 1 N s/m*block.vx\", 0], at: block}}\n"
      "start: {block: {x: 0.1 m, vx: 0}}\nrun: {until: 10 s, method: dopri5}\n";
  for (const std::string noise : {"1e-7 m", "1e-14 m"}) {
    const SweepFolder folder;
    const bool moved = noise == "1e-7 m";  // otherwise all that is seen is the noise
    const std::string study = "section: {every: 1 s, record: [" + std::string(moved ? "block.x + " : "") + noise +
                              "*sin(1e6 rad/s*t)], transient: " + (moved ? "40" : "0") + ", returns: 8}\n";
    EXPECT_EQ(follow_study(folder, block, study).values.at(0).period, 1u) << noise;
  }
}

// Just below the birth of its orbit the ball comes to rest in each period, where all deviations vanish; far below it rests for good.
TEST(Nonlinear, ExponentsOfAMotionThatComesToRestAreDoubted) {
  const VibratingTable table;
  const std::string study = "lyapunov: {exponents: 1, every: 2*pi/omega, over: 20*2*pi/omega, transient: 5*2*pi/omega}\n";
  for (const double gamma : {0.5, 0.98 * table.birth(), 1.02 * table.birth()}) {  // 0.5: it stays on the table
    const SweepFolder folder;
    const Followed done =
        follow_study(folder, table.scene(1.02 * table.birth(), 1), "set: {gamma: " + std::to_string(gamma) + "}\n" + study);
    EXPECT_EQ(done.values.at(0).reason.find("stayed closed") != std::string::npos, gamma < table.birth()) << gamma;
  }
}

// A ball that stays on a table of a compliant contact, whose deviations fall by e^-60 in a period, and by e^-6 in a tenth of it.
TEST(Nonlinear, ExponentsOfNeighboursLostInRoundingAreDoubted) {
  const VibratingTable table;
  std::string scene = table.scene(1.02 * table.birth(), 1);
  const std::string rigid = "model: impact, restitution: 0.5";
  const std::size_t at = scene.find(rigid);
  ASSERT_NE(at, std::string::npos) << scene;
  scene.replace(at, rigid.size(), "normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e8 N/m^1.5}}");
  for (const char* every : {"2*pi/omega", "0.1*2*pi/omega"}) {
    const SweepFolder folder;
    const Followed done = follow_study(
        folder, scene,
        std::string("set: {gamma: 0.5}\nlyapunov: {exponents: 2, every: ") + every + ", over: 20*2*pi/omega, transient: 20*2*pi/omega}\n");
    EXPECT_EQ(done.values.at(0).reason.find("shorten lyapunov.every") != std::string::npos, every[0] == '2') << done.values[0].reason;
  }
}

// Near the doubling they are real and apart, and neighbours take the time that is not counted to turn to the slower one.
TEST(Nonlinear, ExponentsOfABouncingBallAreThoseOfItsRealMultipliers) {
  const VibratingTable table;
  const double period = 2 * pi / table.omega, gamma = 1.5, sum = table.sum(gamma), root = std::sqrt(sum * sum - 4 * table.e * table.e);
  const double slow = (sum - root) / 2, fast = (sum + root) / 2;  // both below 0
  const SweepFolder folder;
  const Followed done =
      follow_study(folder, table.scene(gamma, 1.0), "lyapunov: {exponents: 2, every: 2*pi/omega, over: 200*2*pi/omega}\n");
  const std::vector<Exponent>& found = done.values.at(0).orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].value * period, std::log(-slow), 1e-4);
  EXPECT_NEAR(found[1].value * period, std::log(-fast), 1e-3);
}

TEST(Nonlinear, ErrorsOfExponentsAreToldOfEnoughIntervals) {
  for (const int intervals : {19, 20}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, lorenz, "lyapunov: {every: 0.2 s, over: " + std::to_string(intervals) + "*0.2 s}\n");
    EXPECT_EQ(std::isnan(done.values.at(0).orbit.exponents.at(0).error), intervals < 20);
  }
}

// Free motion takes areas of the phase plane by exp(-c t/m), an impact by e^2: the product of the multipliers of an orbit that hits once
// a period, and the sum of its exponents.
TEST(Nonlinear, AnImpactOscillatorsMultipliersHaveTheProductOfTheClosedForm) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, impact_oscillator,
                                     "section: {every: 2*pi/omega, record: [block.x, block.vx], transient: 100, returns: 20}\n"
                                     "lyapunov: {exponents: 2, every: 2*pi/omega, over: 100*2*pi/omega}\n");
  EXPECT_EQ(done.values.at(0).period, 1u);
  EXPECT_EQ(done.values[0].orbit.impacts.count, 20);
  const std::vector<Exponent>& found = done.values[0].orbit.exponents;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR((found[0].value + found[1].value) * pi, 2 * std::log(0.6) - 0.1 * pi, 1e-4);
}

// By energy 1/12 a section of Hénon and Heiles' (1964) at x = 0, x' > 0 keeps H.
TEST(Nonlinear, ASectionOfHenonAndHeilesKeepsItsEnergy) {
  const SweepFolder folder;
  const Followed done = follow_study(folder,
                                     "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
                                     "joints: {held: {weld: [ground, plate]}}\n"
                                     "states:\n"
                                     "  x: {rate: u/(1 s), start: 0}\n"
                                     "  y: {rate: w/(1 s), start: 0.1}\n"
                                     "  u: {rate: \"(-x - 2*x*y)/(1 s)\", start: sqrt(1/6 - 0.01 + 0.002/3)}\n"
                                     "  w: {rate: \"(-y - x^2 + y^2)/(1 s)\", start: 0}\n"
                                     "run: {until: 500 s, tolerance: 1e-11, method: verner87}\n",
                                     "section: {when: x > 0, record: [x, y, u, w], transient: 0, returns: 40}\n");
  ASSERT_EQ(done.values.at(0).orbit.signals.size(), 40u);
  for (const std::vector<double>& r : done.values[0].orbit.signals) {
    const double x = r[0], y = r[1], u = r[2], w = r[3];
    EXPECT_NEAR(x, 0, 1e-10);
    EXPECT_GT(u, 0);
    EXPECT_NEAR((u * u + w * w + x * x + y * y) / 2 + x * x * y - y * y * y / 3, 1.0 / 12, 1e-8);
  }
}

}  // namespace
}  // namespace pintle
