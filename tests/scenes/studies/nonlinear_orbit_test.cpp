// Periodic orbits by shooting and their Floquet multipliers against closed forms and variational equations integrated here.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/study/nonlinear/nonlinear.h"
#include "tests/scenes/studies/nonlinear_study.h"

namespace pintle {
namespace {

using Pair = std::array<std::complex<double>, 2>;

/// Roots of x^2 - sum x + product, the greatest modulus first, then the greatest argument.
Pair roots(double sum, double product) {
  const std::complex<double> root = std::sqrt(std::complex<double>(sum * sum / 4 - product));
  Pair out{sum / 2 + root, sum / 2 - root};
  if (std::abs(out[1]) > std::abs(out[0]) || out[1].imag() > out[0].imag()) std::swap(out[0], out[1]);
  return out;
}

void expect_multipliers(const Cycle& cycle, const Pair& expected, double bound) {
  ASSERT_EQ(cycle.re.size(), 2u);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(cycle.re[j], expected[j].real(), bound) << j;
    EXPECT_NEAR(cycle.im[j], expected[j].imag(), bound) << j;
  }
}

// Neighbours are 1e-6 m and 16 um/s apart, 1e-3 of the table's motion: central differences err by some 1e-6.
TEST(PeriodicOrbits, OfABouncingBallHaveTheMultipliersOfTheClosedFormBeyondTheDoubling) {
  const VibratingTable table;
  const SweepFolder folder;
  const Followed done =
      follow_study(folder, table.scene(1.2, 1.0), once_a_period(20, 3) + "over: {gamma: {from: 1.2, to: 1.8, count: 13}}\norbit: {}\n");
  ASSERT_EQ(done.values.size(), 13u);
  for (const FollowedValue& value : done.values) {
    SCOPED_TRACE(value.parameters.at(0));
    const Cycle& cycle = value.orbit.cycle;
    expect_multipliers(cycle, roots(table.sum(value.at.at(0)), table.e * table.e), 1e-4);
    EXPECT_EQ(stability(cycle), value.at.at(0) < table.doubling() ? OrbitStability::stable : OrbitStability::unstable);
    EXPECT_EQ(cycle.continued, value.at.at(0) > 1.2);
    EXPECT_NEAR(cycle.period, 2 * pi / table.omega, 1e-12);
    // Half a flight after the impact the ball is at rest, by g/8 of the period squared above the table at impacts.
    const double amplitude = value.at.at(0) * table.g / (table.omega * table.omega), flight = 2 * pi / table.omega;
    const double apex = 0.01 + amplitude * std::sin(table.phase(value.at.at(0))) + table.g * flight * flight / 8;
    // The phase of the table in the scene is that of gamma = 1.2: the section is by so much off the apex.
    const double off = (table.phase(1.2) - table.phase(value.at.at(0))) / table.omega;
    ASSERT_EQ(cycle.signals.size(), 1u);
    EXPECT_NEAR(cycle.signals[0][1], -table.g * off, 1e-6);
    EXPECT_NEAR(cycle.signals[0][0], apex - table.g * off * off / 2, 1e-7);
  }
  // The chord of the multiplier over an interval of 0.05 errs by 0.05^2/8 times a curvature over a slope of some 2.
  const std::vector<LossOfStability> losses = losses_of_stability(done.values);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].through, Crossing::minus_one);
  EXPECT_NEAR(losses[0].x, table.doubling(), 2e-3);
}

TEST(PeriodicOrbits, OfABouncingBallHaveTheMultiplierMinusOneAtTheDoubling) {
  const VibratingTable table;
  const SweepFolder folder;
  const Followed done = follow_study(folder, table.scene(table.doubling(), 1.0), once_a_period(0, 2) + "orbit: {}\n");
  const Cycle& cycle = done.values.at(0).orbit.cycle;
  expect_multipliers(cycle, roots(table.sum(table.doubling()), table.e * table.e), 1e-4);
  EXPECT_NEAR(cycle.re[0], -1, 1e-4);
}

// Of a period of two returns the orbit of one is a fixed point too: it is told.
TEST(PeriodicOrbits, AreToldWhereTheyCloseBefore) {
  const VibratingTable table;
  for (const double gamma : {1.3, 1.6}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, table.scene(gamma, 1.01), once_a_period(200, 3) + "orbit: {period: 2}\n");
    const Cycle& cycle = done.values.at(0).orbit.cycle;
    ASSERT_EQ(cycle.signals.size(), 2u);
    EXPECT_EQ(cycle.least, gamma < table.doubling() ? 1 : 2);
    EXPECT_EQ(stability(cycle), OrbitStability::stable);
    // Each impact and flight takes areas by e^2.
    EXPECT_NEAR(cycle.modulus(0) * cycle.modulus(1), std::pow(table.e, 4), 1e-4);
    if (gamma < table.doubling()) {
      const Pair once = roots(table.sum(gamma), table.e * table.e);
      const std::complex<double> sum = once[0] * once[0] + once[1] * once[1];
      expect_multipliers(cycle, roots(sum.real(), std::pow(table.e, 4)), 1e-4);
    }
  }
}

/// x'' + c x' + k x = cos(omega t) with a stop at x = 0 for x < 0, restitution e, one impact a period T: with the free flow Phi(T), in
/// deviations from the particular solution p, (-p, -v/e - q) = Phi (-p, v - q) for the speed v after an impact and q = p'.
/// So p = -alpha v and q = beta v there, and p^2 + q^2/omega^2 is the amplitude squared. Through an impact deviations go by
/// [-e 0; (a+ + e a-)/v- -e], where a+ + e a- = (1 + e) f at x = 0, f being what the force is there, p'' + c q + k p.
struct Stopped {
  double c = 0.1, k = 1, e = 0.6, omega = 2;
  Pair multipliers() const {
    const double T = 2 * pi / omega, decay = std::exp(-c * T / 2), w = std::sqrt(k - c * c / 4), cs = std::cos(w * T), sn = std::sin(w * T);
    const double p11 = decay * (cs + c / 2 / w * sn), p12 = decay * sn / w, p21 = -decay * k * sn / w, p22 = decay * (cs - c / 2 / w * sn);
    const double ratio = p12 / (1 - p11), kappa = 1 - p22 - p21 * ratio;
    const double alpha = ratio * (1 + e) / (e * kappa), beta = 1 - (1 + e) / (e * kappa);
    const double amplitude = 1 / std::hypot(k - omega * omega, c * omega);
    const double v = -amplitude / std::hypot(alpha, beta / omega);  // away from the stop
    const double p = -alpha * v, q = beta * v, force = (k - omega * omega) * p + c * q;
    const double before = -v / e, s21 = (1 + e) * force / before;
    return roots(-e * (p11 + p22) + s21 * p12, e * e * (p11 * p22 - p12 * p21));
  }
};

// Scales are 1 m and some 1 m/s: differences of 1e-6 err by 1e-12 times a third derivative, and by what steps of 1e-10 err differently.
TEST(PeriodicOrbits, OfAnImpactOscillatorHaveTheMultipliersOfItsSaltationMatrix) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, impact_oscillator,
                                     "section: {every: 2*pi/omega, record: [block.x, block.vx], transient: 30, returns: 3}\n"
                                     "over: {omega: [2, 2.1]}\norbit: {}\n");
  for (const FollowedValue& value : done.values) {
    SCOPED_TRACE(value.parameters.at(0));
    EXPECT_EQ(value.orbit.impacts.count, 3);
    expect_multipliers(value.orbit.cycle, Stopped{.omega = value.at.at(0)}.multipliers(), 1e-4);
    const double T = 2 * pi / value.at.at(0);
    EXPECT_NEAR(value.orbit.cycle.modulus(0) * value.orbit.cycle.modulus(1), 0.36 * std::exp(-0.1 * T), 1e-4);
  }
}

std::string duffing(const std::string& more = "") {
  return "parameters: {gamma: 0.2, omega: 1.2 rad/s}\n"
         "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}}}\n"
         "joints: {guide: {prismatic: [ground, block]}}\n"
         "forces: {pull: {force: [\"gamma*1 N*cos(omega*t) + 1 N/m*block.x - 1 N/m^3*block.x^3 - 0.3 N s/m*block.vx\", 0], at: block}}\n"
         "start: {block: {x: 1 m, vx: 0}}\n"
         "run: {until: 100 s, tolerance: 1e-11, method: verner87" +
         more + "}\n";
}

/// Duffing's equation and its variational equations over a period from phase 0, by the classical method of Runge and Kutta.
struct DuffingPeriod {
  using Vector = std::array<double, 6>;  // x, v, and the columns of the monodromy matrix
  Vector end{};
  DuffingPeriod(double gamma, double x, double v) {
    constexpr int steps = 2000;
    const double h = 2 * pi / 1.2 / steps;
    const auto rate = [gamma](double t, const Vector& y) {
      const double slope = 1 - 3 * y[0] * y[0];
      return Vector{y[1], gamma * std::cos(1.2 * t) + y[0] - y[0] * y[0] * y[0] - 0.3 * y[1],
                    y[3], slope * y[2] - 0.3 * y[3],
                    y[5], slope * y[4] - 0.3 * y[5]};
    };
    const auto along = [](const Vector& y, const Vector& k, double by) {
      Vector out = y;
      for (std::size_t i = 0; i < 6; ++i) out[i] += by * k[i];
      return out;
    };
    end = {x, v, 1, 0, 0, 1};
    for (int n = 0; n < steps; ++n) {
      const double t = n * h;
      const Vector a = rate(t, end), b = rate(t + h / 2, along(end, a, h / 2)), c = rate(t + h / 2, along(end, b, h / 2)),
                   d = rate(t + h, along(end, c, h));
      for (std::size_t i = 0; i < 6; ++i) end[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
  }
};

// By Liouville the product of the multipliers is exp(-0.3 T). The integration here errs by less than 1e-8; the program's is ten times
// finer, so that what bounds the multipliers is its differences.
TEST(PeriodicOrbits, OfDuffingCloseAndHaveTheMultipliersOfTheirVariationalEquations) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, duffing(),
                                     "section: {every: 2*pi/omega, record: [block.x, block.vx], transient: 50, returns: 3}\n"
                                     "over: {gamma: {from: 0.2, to: 0.3, count: 6}}\norbit: {}\n");
  const double T = 2 * pi / 1.2;
  for (const FollowedValue& value : done.values) {
    SCOPED_TRACE(value.parameters.at(0));
    const Cycle& cycle = value.orbit.cycle;
    ASSERT_EQ(cycle.signals.size(), 1u);
    const double x = cycle.signals[0][0], v = cycle.signals[0][1];
    const DuffingPeriod by_hand(value.at.at(0), x, v);
    EXPECT_NEAR(by_hand.end[0], x, 1e-6);
    EXPECT_NEAR(by_hand.end[1], v, 1e-6);
    expect_multipliers(cycle, roots(by_hand.end[2] + by_hand.end[5], std::exp(-0.3 * T)), 1e-4);
  }
}

// r' = mu r - r^3 turns by w: the circle r^2 = mu, left by exp(-2 mu T). Its own direction is no multiplier.
TEST(PeriodicOrbits, OfALimitCycleAreFixedPointsOfASectionByACondition) {
  const SweepFolder folder;
  const Followed done =
      follow_study(folder,
                   "parameters: {mu: 0.1}\n"
                   "bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\n"
                   "joints: {held: {weld: [ground, plate]}}\n"
                   "states:\n"
                   "  X: {rate: \"(mu*X - 2*Y - X*(X^2 + Y^2))/(1 s)\", start: 0}\n"
                   "  Y: {rate: \"(mu*Y + 2*X - Y*(X^2 + Y^2))/(1 s)\", start: -0.4}\n"
                   "run: {until: 100 s, tolerance: 1e-11, method: verner87}\n",
                   "section: {when: Y > 0, record: X, transient: 2, returns: 3}\nover: {mu: [0.1, 0.15, 0.2]}\norbit: {}\n");
  for (const FollowedValue& value : done.values) {
    const Cycle& cycle = value.orbit.cycle;
    EXPECT_NEAR(cycle.period, pi, 1e-7);
    EXPECT_NEAR(cycle.signals.at(0).at(0), std::sqrt(value.at.at(0)), 1e-7);
    ASSERT_EQ(cycle.re.size(), 1u);
    EXPECT_NEAR(cycle.re[0], std::exp(-2 * value.at.at(0) * pi), 1e-4);
    EXPECT_EQ(cycle.im[0], 0);
  }
}

struct Linear {
  const char* scene;
  Crossing through;
};

// Linear, so that the multipliers are exp(lambda T): a pair for c about 0, one of +1 for a about 0.
// A pair becomes real, and one of the two crosses. Between the values trace and determinant of the map are linear.
TEST(PeriodicOrbits, LoseTheirStabilityByRealMultipliersThatWereAPair) {
  const auto at = [](double x, std::vector<double> re, std::vector<double> im) {
    FollowedValue value;
    value.at = {x};
    value.orbit.cycle.point = {0}, value.orbit.cycle.re = std::move(re), value.orbit.cycle.im = std::move(im);
    value.orbit.cycle.continued = 1;
    return value;
  };
  for (const double sign : {-1.0, 1.0}) {
    const std::vector<LossOfStability> losses =
        losses_of_stability({at(2, {0.2 * sign, 0.2 * sign}, {0.5, -0.5}), at(3, {1.2 * sign, 0.3 * sign}, {0, 0})});
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].through, sign < 0 ? Crossing::minus_one : Crossing::plus_one);
    const double before = 1 - 0.4 + 0.29, after = 1 - 1.5 + 0.36;  // 1 ∓ trace + determinant
    EXPECT_NEAR(losses[0].x, 2 + before / (before - after), 1e-14);
  }
}

// Two pairs, of which one crosses at 0 and the other has greater modulus on one side.
TEST(PeriodicOrbits, LoseTheirStabilityByOneOfTwoPairs) {
  const auto at = [](double x) {
    FollowedValue value;
    value.at = {x};
    Cycle& cycle = value.orbit.cycle;
    cycle.point = {0}, cycle.continued = 1;
    const double first = std::exp(-x), second = std::exp(-0.2 - 0.1 * x);
    for (const double sign : {-1.0, 1.0}) {
      cycle.re.push_back(first * std::cos(2.3)), cycle.im.push_back(sign * first * std::sin(2.3));
      cycle.re.push_back(second * std::cos(1.7)), cycle.im.push_back(sign * second * std::sin(1.7));
    }
    return value;
  };
  const std::vector<LossOfStability> losses = losses_of_stability({at(0.3), at(-0.1)});
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].through, Crossing::pair);
  EXPECT_NEAR(losses[0].x, 0, 0.1);
}

TEST(PeriodicOrbits, TellThroughWhatTheirMultipliersLeave) {
  const std::string head =
      "parameters: {a: -0.02}\nbodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}\njoints: {held: {weld: [ground, plate]}}\n";
  const std::string tail = "run: {until: 100 s, tolerance: 1e-11, method: verner87}\n";
  for (const Linear& one :
       {Linear{"states:\n  X: {rate: \"Y/(1 s)\", start: 0}\n  Y: {rate: \"(2*a*Y - X + cos(3 rad/s*t))/(1 s)\", start: 0}\n",
               Crossing::pair},
        Linear{"states:\n  X: {rate: \"(a*X + cos(3 rad/s*t))/(1 s)\", start: 0}\n", Crossing::plus_one}}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, head + one.scene + tail,
                                       "section: {every: 2*pi/(3 rad/s), record: X, transient: 2, returns: 2}\n"
                                       "over: {a: [-0.02, -0.01, 0.01, 0.02]}\norbit: {}\n");
    for (const FollowedValue& value : done.values)
      EXPECT_NEAR(value.orbit.cycle.modulus(0), std::exp(value.at.at(0) * 2 * pi / 3), 1e-5) << value.parameters.at(0);
    const std::vector<LossOfStability> losses = losses_of_stability(done.values);
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].through, one.through);
    EXPECT_EQ(losses[0].before, 1u);
    EXPECT_NEAR(losses[0].x, 0, 1e-3);
  }
}

// A pendulum on the pin of a crank that turns: the crank is where it was after a turn, and drivers leave the pendulum alone free.
// Its drag takes areas by exp(-c T/J).
TEST(PeriodicOrbits, CloseThoughACrankHasTurned) {
  const SweepFolder folder;
  const Followed done =
      follow_study(folder,
                   "gravity: [0, -9.81]\n"
                   "parameters: {omega: 3 rad/s}\n"
                   "bodies:\n"
                   "  crank: {rigid: {mass: 1 kg, inertia: 0.01}, points: {pin: [0.1 m, 0]}}\n"
                   "  bob: {rigid: {mass: 1 kg, inertia: 0.09 kg m^2}, points: {eye: [0, 0.4 m]}}\n"
                   "joints: {axle: {revolute: [ground, crank]}, hinge: {revolute: [crank.pin, bob.eye]}}\n"
                   "drivers: {motor: {angle: [ground, crank], law: omega*t}}\n"
                   "forces: {drag: {torque: -0.2 N m s*bob.speed, on: bob}}\n"
                   "start: {bob: {angle: 0, speed: 0}}\n"
                   "run: {until: 100 s, tolerance: 1e-10, method: verner87}\n",
                   "section: {every: 2*pi/omega, record: [bob.angle, bob.speed], transient: 20, returns: 3}\norbit: {}\n");
  const Cycle& cycle = done.values.at(0).orbit.cycle;
  ASSERT_EQ(cycle.re.size(), 2u);
  const double inertia = 0.09 + 0.4 * 0.4;
  EXPECT_NEAR(cycle.modulus(0) * cycle.modulus(1), std::exp(-0.2 / inertia * 2 * pi / 3), 1e-4);
  EXPECT_EQ(stability(cycle), OrbitStability::stable);
}

// Duffing's equation at a condition: time is of account, and the remedy is told.
TEST(PeriodicOrbits, OfDrivenMotionAreRefusedAtACondition) {
  const SweepFolder folder;
  folder.write("scene.yaml", duffing());
  folder.write("study.yaml", "scene: scene.yaml\nsection: {when: block.vx < 0, record: block.x, transient: 0, returns: 3}\norbit: {}\n");
  const Nonlinear study = read_nonlinear(folder / "study.yaml");
  const std::vector<FollowedValue> values = followed(study, run_nonlinear(study, folder / "out", {}).rows);
  EXPECT_EQ(values.at(0).status, "no periodic orbit");
  EXPECT_NE(values[0].reason.find("section.every"), std::string::npos) << values[0].reason;
  EXPECT_FALSE(values[0].orbit.cycle.found());
}

/// J a'' = amp cos 2t - c a' - m g l cos a: the product of the multipliers is exp(-c T/J) on any orbit (Liouville).
struct DrivenPendulum {
  double drag = 0.15, inertia = 0.02 + 0.25, period = pi;
  double product() const { return std::exp(-drag * period / inertia); }
  std::string scene() const {
    return "gravity: [0, -9.81]\n"
           "parameters: {omega: 2 rad/s, amp: 3.5 N m}\n"
           "bodies: {bob: {rigid: {mass: 1 kg, inertia: 0.02 kg m^2, center: [0.5 m, 0]}, points: {O: [0, 0]}}}\n"
           "joints: {pin: {revolute: [ground, bob.O]}}\n"
           "forces: {drive: {torque: amp*cos(omega*t), on: bob}, damp: {torque: -0.15 N m s*bob.speed, on: bob}}\n"
           "start: {bob: {angle: 0.1204311 rad, speed: 6.3478605850}}\n"
           "run: {until: 10 s, method: dopri5, tolerance: 1e-10}\n";
  }
};

constexpr const char* each_period = "section: {every: 2*pi/omega, record: bob.speed, transient: 20, returns: 3}\n";

// Neighbours take steps that err by several 1e-10 differently. At a distance of 1e-4 to 1e-3 that leaves some 1e-5, and the square of
// the distance 1e-6; at 1e-6 it left 1e-4. A late clock and an angle of hundreds of turns change nothing.
TEST(PeriodicOrbits, HaveMultipliersWithinTheErrorToldHoweverLateTheClock) {
  const DrivenPendulum pendulum;
  for (const char* transient : {"20", "400", "1600"}) {
    const SweepFolder folder;
    const Followed done =
        follow_study(folder, pendulum.scene(),
                     std::string("section: {every: 2*pi/omega, record: bob.speed, transient: ") + transient + ", returns: 3}\norbit: {}\n");
    const Cycle& cycle = done.values.at(0).orbit.cycle;
    ASSERT_EQ(cycle.error.size(), 2u) << done.values[0].reason;
    const double told = cycle.error[0] * cycle.modulus(1) + cycle.error[1] * cycle.modulus(0);
    EXPECT_NEAR(cycle.modulus(0) * cycle.modulus(1), pendulum.product(), told) << transient;
    EXPECT_LT(told, 1e-4) << transient;
  }
}

// One distance that is asked for is kept, and its error told: at 1e-6 steps err by 1e-4 of it.
TEST(PeriodicOrbits, TellTheErrorOfADistanceThatIsAskedFor) {
  const DrivenPendulum pendulum;
  for (const char* distance : {"1e-6", "0.1"}) {
    const SweepFolder folder;
    const Followed done = follow_study(folder, pendulum.scene(), each_period + std::string("orbit: {distance: ") + distance + "}\n");
    const Cycle& cycle = done.values.at(0).orbit.cycle;
    ASSERT_EQ(cycle.error.size(), 2u) << done.values[0].reason;
    const double told = cycle.error[0] * cycle.modulus(1) + cycle.error[1] * cycle.modulus(0);
    EXPECT_NEAR(cycle.modulus(0) * cycle.modulus(1), pendulum.product(), told) << distance;
  }
}

// Of the drive's period of pi s none of these is a multiple: a point that comes again after 1 s goes elsewhere in the next.
TEST(PeriodicOrbits, AreRefusedWhereTheDriveDoesNotRepeat) {
  const DrivenPendulum pendulum;
  for (const char* every : {"1 s", "pi/omega", "3.14 s"}) {
    const SweepFolder folder;
    folder.write("scene.yaml", pendulum.scene());
    folder.write("study.yaml", std::string("scene: scene.yaml\nsection: {every: ") + every +
                                   ", record: bob.speed, transient: 60, returns: 8}\norbit: {}\n");
    const Nonlinear study = read_nonlinear(folder / "study.yaml");
    const std::vector<FollowedValue> values = followed(study, run_nonlinear(study, folder / "out", {}).rows);
    EXPECT_EQ(values.at(0).status, "no periodic orbit") << every;
    EXPECT_FALSE(values[0].orbit.cycle.found()) << every;
    EXPECT_NE(values[0].reason.find("do not repeat"), std::string::npos) << values[0].reason;
    EXPECT_NE(values[0].reason.find("section.every"), std::string::npos) << values[0].reason;
  }
}

// Half the drive's period twice is the period: an orbit of two returns closes.
TEST(PeriodicOrbits, CloseAfterReturnsThatTogetherLastTheDrivesPeriod) {
  const DrivenPendulum pendulum;
  const SweepFolder folder;
  const Followed done = follow_study(folder, pendulum.scene(),
                                     "section: {every: pi/omega, record: bob.speed, transient: 40, returns: 3}\norbit: {period: 2}\n");
  EXPECT_EQ(done.values.at(0).status, "finished") << done.values[0].reason;
  EXPECT_NEAR(done.values[0].orbit.cycle.period, pi, 1e-9);
}

// Exponents go on for one interval and two, a period and a half, after the last return; the next value begins at that return all the same.
TEST(Nonlinear, TheNextValueBeginsAtAReturnWhateverExponentsTake) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, duffing(),
                                     "section: {every: 2*pi/omega, record: block.x, transient: 0, returns: 2}\n"
                                     "lyapunov: {every: pi/omega, over: 2*pi/omega}\nover: {gamma: [0.2, 0.21]}\n");
  const double T = 2 * pi / 1.2;
  EXPECT_NEAR(done.values.at(1).orbit.t.at(1), 4 * T, 1e-9);
}

}  // namespace
}  // namespace pintle
