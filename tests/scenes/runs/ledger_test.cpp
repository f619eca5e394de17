// Where the energy goes: the books of whole runs, and what is kept of runs that end early.
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::ledger_test {
namespace {

namespace po = pintle_oracle;
using pintle::Status;

// --- the paper's cases ---

// Asked for: at a tolerance of 1e-10, over the whole span and at every output.
constexpr double books = 1e-8;  // of the initial energy

struct Case {
  const char* name;
  SliderCrank options;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Case cases[] = {
    {"Table2At50", {.speed = 50}},
    {"Table2At100", {.speed = 100}},
    {"Table2At150", {.speed = 150}},
    {"Table2At200", {.speed = 200}},
    {"TenthMillimetre", {.clearance = 1e-4}},
    {"HalfMillimetre", {.clearance = 5e-4}},
    {"HalfMillimetreForASecond", {.clearance = 5e-4, .until = 1}},
    {"FrictionNone", {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .until = 0.1}},
    {"FrictionOneHundredth", {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.01, .until = 0.1}},
    {"FrictionOneTenth", {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.1, .until = 0.1}},
    {"FrictionThreeTenths", {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.3, .until = 0.1}},
    {"DrivenAt5000rpm",
     {.clearance = 5e-4, .speed = 5000 * M_PI / 30, .restitution = 0.9, .friction = 0.1, .driven = true, .until = 0.012}},
};

class PaperLedger : public testing::TestWithParam<std::tuple<Case, const char*>> {};

TEST_P(PaperLedger, LeavesNothingUnexplained) {
  auto [c, method] = GetParam();
  c.options.tolerance = 1e-10, c.options.method = method;
  const Whole w = run(scene(c.options));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_LT(std::abs(w.run.worst_unexplained), books * w.run.first.stored());
  EXPECT_LT(w.run.worst_position, 1e-10);
  EXPECT_LT(w.run.worst_velocity, 1e-10);
  RecordProperty("unexplained", std::to_string(std::log10(std::abs(w.run.worst_unexplained) / w.run.first.stored())));
}

INSTANTIATE_TEST_SUITE_P(Cases, PaperLedger, testing::Combine(testing::ValuesIn(cases), testing::Values("dopri5", "rkf45")),
                         [](const auto& i) { return std::string(std::get<0>(i.param).name) + "_" + std::get<1>(i.param); });

TEST(PaperLedger, GeometricSlidingSpeedHidesTheWorkThatTheOracleFinds) {
  // Until 6 ms all impacts are reproducible; what the law's own speed shows, and does not, is too.
  const SliderCrank o{
      .clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.1, .geometric = true, .until = 6e-3, .tolerance = 1e-11};
  const Whole w = run(scene(o));
  po::State s = po::start(oracle(o));
  po::simulate(oracle(o), po::Options{.tolerance = 1e-12}, o.until, s);
  const double work = s.y[7], shown = s.y[8];
  ASSERT_GT(work, 10 * shown);
  EXPECT_NEAR(w.run.unexplained, shown - work, 1e-6 * work);
  EXPECT_NEAR(w.ledger("gudgeon pin.lost to friction [J]"), shown, 1e-6 * work);
  EXPECT_NEAR(w.ledger("gudgeon pin.lost to hysteresis [J]"), s.y[6], 1e-6 * s.y[6]);
}

TEST(PaperLedger, OverItsBoundHasItsOwnStatusAndKeepsEverything) {
  pintle::Scene s = scene(SliderCrank{.clearance = 2e-3, .speed = 300, .friction = 0.1, .geometric = true, .until = 6e-3});
  const Whole over = run(s);
  EXPECT_EQ(over.run.status, Status::ledger_over_bound);
  EXPECT_NE(over.run.reason.find("unexplained"), std::string::npos) << over.run.reason;
  EXPECT_EQ(over.run.t_end, 6e-3);
  EXPECT_EQ(over.run.trajectory.rows(), 101u);
  EXPECT_EQ(over.run.ledger.rows(), 101u);
  s.run.ledger_bound = 1;
  const Whole within = run(s);
  EXPECT_EQ(within.run.status, Status::finished);
  EXPECT_EQ(within.run.trajectory.data, over.run.trajectory.data);
}

// --- closed forms ---

constexpr double closed_form = 1e-9;  // a thousand times the tolerance of these runs, relative

// m ẍ + c ẋ + k x = 0, x(0) = x₀, ẋ(0) = 0, under-damped.
struct Oscillator {
  double m, c, k, x0;
  double energy(double t) const {
    const double a = c / (2 * m), w = std::sqrt(k / m - a * a), d = std::exp(-a * t);
    const double x = x0 * d * (std::cos(w * t) + a / w * std::sin(w * t));
    const double v = -x0 * d * (a * a + w * w) / w * std::sin(w * t);
    return m * v * v / 2 + k * x * x / 2;
  }
};

TEST(Damper, LosesWhatTheClosedFormSays) {
  const Oscillator o{2, 3, 80, 0.3};
  pintle::Scene s;
  s.bodies = {body("cart", o.m, 0.1, {})};
  s.joints = {joint("rail", pintle::JointKind::prismatic, "ground", "cart")};
  s.loads = {spring("strut", "ground", "cart", o.k, o.c, 1)};
  s.start_bodies = {start_at("cart", 1 + o.x0, 0, 0, 0, 0, 0)};
  s.run.until = 2, s.run.tolerance = 1e-12;
  const Whole w = run(s);
  const double lost = o.energy(0) - o.energy(2);
  EXPECT_NEAR(w.ledger("strut.lost to damper [J]"), lost, closed_form * lost);
  EXPECT_NEAR(w.ledger("stored [J]"), o.energy(2), closed_form * lost);
}

TEST(TorsionDamper, LosesWhatTheClosedFormSays) {
  const Oscillator o{0.2, 0.3, 8, 0.7};
  pintle::Scene s;
  s.bodies = {body("disc", 1, o.m, {})};
  s.joints = {joint("axle", pintle::JointKind::revolute, "ground", "disc")};
  s.loads = {{"coil", pintle::SceneTorsionSpring{ref("ground"), ref("disc"), o.k, o.c, 0.2}, {}}};
  s.start_bodies = {start_angle("disc", 0.2 + o.x0, 0)};
  s.run.until = 2, s.run.tolerance = 1e-12;
  const Whole w = run(s);
  const double lost = o.energy(0) - o.energy(2);
  EXPECT_NEAR(w.ledger("coil.lost to damper [J]"), lost, closed_form * lost);
}

TEST(Driver, PutsInTheEnergyThatTheClosedFormGains) {
  const po::LinkMass links[3] = {{1.0, 0.01, 0.5}, {2.0, 0.1, 0.4}, {1.5, 0.05, 0.6}};
  const po::FourBar f{1.0, 0.3, 0.9, 0.7};
  pintle::Scene s = four_bar(f, links, 9.81, 0.4, 2, 6);
  s.run.until = 1.5, s.run.tolerance = 1e-11;
  const Whole w = run(s);
  const double t = 1.5,
               gained = po::energy(f, {0.4 + 2 * t + 3 * t * t, 2 + 6 * t, 6}, links, 9.81) - po::energy(f, {0.4, 2, 6}, links, 9.81);
  EXPECT_NEAR(w.ledger("motor.work in [J]"), gained, closed_form * std::abs(gained));
  EXPECT_NEAR(w.run.unexplained, 0, closed_form * std::abs(gained));
}

TEST(Load, WorkIsForceTimesPath) {
  pintle::Scene s;
  s.bodies = {body("puck", 2, 0.1, {point("P", 0.1, 0.05)})};
  s.loads = {force("pull", "puck.P", law(3), law(-2))};
  s.start_bodies = {start_at("puck", 0, 0, 0, 1, 0, 5)};
  s.run.until = 1, s.run.tolerance = 1e-12;
  const Whole w = run(s);
  const auto reach = [&](std::size_t row) {  // 3 x_P − 2 y_P
    const double a = w.column("puck.angle [rad]")[row];
    const double c = std::cos(a), d = std::sin(a);
    return 3 * (w.column("puck.x [m]")[row] + 0.1 * c - 0.05 * d) - 2 * (w.column("puck.y [m]")[row] + 0.1 * d + 0.05 * c);
  };
  const double work = reach(w.run.trajectory.rows() - 1) - reach(0);
  EXPECT_NEAR(w.ledger("pull.work in [J]"), work, closed_form * std::abs(work));
  EXPECT_NEAR(w.run.last.kinetic - w.run.first.kinetic, work, closed_form * std::abs(work));
}

TEST(Load, FollowingForceTurnsWithItsBody) {
  // Through the mass centre: spin w stays, v̇ = F (cos wt, sin wt)/m.
  pintle::Scene s;
  s.bodies = {body("puck", 2, 0.1, {})};
  s.loads = {force("jet", "puck", law(3), law(0), true)};
  s.start_bodies = {start_at("puck", 0, 0, 0, 0, 0, 4)};
  s.run.until = 1, s.run.tolerance = 1e-12;
  const Whole w = run(s);
  const double vx = 3 / (2 * 4.0) * std::sin(4.0), vy = 3 / (2 * 4.0) * (1 - std::cos(4.0));
  EXPECT_NEAR(w.last("puck.vx [m/s]"), vx, closed_form);
  EXPECT_NEAR(w.last("puck.vy [m/s]"), vy, closed_form);
  EXPECT_NEAR(w.ledger("jet.work in [J]"), vx * vx + vy * vy, closed_form);
}

TEST(Load, TorqueInTimeGivesItsIntegralAsSpin) {
  pintle::Scene s;
  s.bodies = {body("disc", 1, 0.5, {})};
  s.joints = {joint("axle", pintle::JointKind::revolute, "ground", "disc")};
  s.loads = {torque("motor", "disc", wave(0.2, 1.5, 7))};
  s.start_bodies = {start_angle("disc", 0, 0)};
  s.run.until = 2, s.run.tolerance = 1e-12;
  const Whole w = run(s);
  const double spin = (0.2 * 2 + 1.5 / 7 * (1 - std::cos(14.0))) / 0.5;
  EXPECT_NEAR(w.last("disc.speed [rad/s]"), spin, closed_form);
  EXPECT_NEAR(w.ledger("motor.work in [J]"), 0.25 * spin * spin, closed_form);
}

TEST(FloatingChain, KeepsItsMomentaAndLosesOnlyToItsDamper) {
  for (const double damping : {0.0, 5.0}) {
    pintle::Scene s = floating_chain(damping);
    s.run.tolerance = 1e-12;
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, Status::finished);
    const auto momenta = [&](std::size_t row) {
      std::array<double, 3> p{};
      for (const pintle::SceneBody& b : s.bodies) {
        const auto at = [&](const char* what) { return w.column(b.name + what)[row]; };
        const double vx = at(".vx [m/s]"), vy = at(".vy [m/s]");
        p[0] += b.mass * vx, p[1] += b.mass * vy;
        p[2] += b.mass * (at(".x [m]") * vy - at(".y [m]") * vx) + b.inertia * at(".speed [rad/s]");
      }
      return p;
    };
    const auto before = momenta(0), after = momenta(w.run.trajectory.rows() - 1);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(after[i], before[i], closed_form) << i;
    EXPECT_NEAR(w.ledger("stored [J]") + w.run.last.lost, w.run.first.stored(), closed_form);
    EXPECT_EQ(w.run.last.lost > 0, damping > 0);
  }
}

// --- runs that end early ---

TEST(FailedRun, KeepsWhatItComputed) {
  pintle::Scene s = scene(SliderCrank{.clearance = 5e-4, .until = 0.02});
  const Whole all = run(s);
  s.run.max_steps = all.run.counts.steps / 2;
  const Whole half = run(s);
  EXPECT_EQ(half.run.status, Status::failed);
  EXPECT_NE(half.run.reason.find("max steps"), std::string::npos) << half.run.reason;
  EXPECT_EQ(half.run.counts.steps, s.run.max_steps);
  EXPECT_GT(half.run.t_end, 0);
  EXPECT_LT(half.run.t_end, 0.02);
  // Every output up to the time reached, and the same as in the whole run, bit for bit.
  const auto rows = static_cast<std::size_t>(half.run.t_end / s.output.every) + 1;
  EXPECT_EQ(half.run.trajectory.rows(), rows + 1);
  EXPECT_EQ(half.run.ledger.rows(), rows + 1);
  const auto regular = static_cast<std::ptrdiff_t>(rows * half.run.trajectory.columns());
  ASSERT_LE(static_cast<std::size_t>(regular), all.run.trajectory.data.size());
  EXPECT_TRUE(std::equal(half.run.trajectory.data.begin(), half.run.trajectory.data.begin() + regular, all.run.trajectory.data.begin()));
  // And one where it ended, in which the books are those that the run reports.
  EXPECT_EQ(half.column("t [s]").back(), half.run.t_end);
  EXPECT_EQ(half.run.ledger.column("t [s]").back(), half.run.t_end);
  EXPECT_EQ(half.run.ledger.column("stored [J]").back(), half.run.last.stored());
  EXPECT_EQ(half.run.ledger.column("unexplained [J]").back(), half.run.unexplained);
  EXPECT_FALSE(half.run.impacts.empty());
}

TEST(FailedRun, StopsWhereTheLinksCanReachNoFarther) {
  // Crank end and the rocker's pivot part to coupler + rocker at 60°: from 30° at 1 rad/s, π/6 s.
  const po::LinkMass links[3] = {{1.0, 0.01}, {1.0, 0.1}, {1.0, 0.05}};
  for (const char* constraints : {"projection", "partitioning"}) {
    pintle::Scene s = four_bar({1, 1, 0.5, 0.5}, links, 0, M_PI / 6, 1, 0);
    s.run.until = 1, s.run.constraints = constraints;
    const Whole w = run(s);
    EXPECT_EQ(w.run.status, Status::failed) << constraints;
    EXPECT_FALSE(w.run.reason.empty());
    EXPECT_LE(w.run.t_end, M_PI / 6 + 1e-9) << constraints;
    EXPECT_GT(w.run.t_end, 0.99 * M_PI / 6) << constraints;
    EXPECT_GT(w.run.trajectory.rows(), 500u) << constraints;
  }
}

TEST(InterruptedRun, KeepsWhatItComputed) {
  const pintle::Scene s = scene(SliderCrank{});
  const pintle::Model model = pintle::build(s);
  pintle::Listeners listeners;
  listeners.progress = [](double t) { return t < 0.01; };
  const pintle::Run r = pintle::simulate(s, model, pintle::assemble(s, model), listeners);
  EXPECT_EQ(r.status, Status::interrupted);
  EXPECT_GE(r.t_end, 0.01);
  EXPECT_LT(r.t_end, 0.05);
  EXPECT_GE(r.trajectory.rows(), 20u);
}

}  // namespace
}  // namespace pintle_scenes::ledger_test
