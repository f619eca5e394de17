// Clearance joints in whole runs: where they start, how onset is found, how they bounce, several at
// once.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "framework/build/clearance.h"
#include "framework/integration/integrator.h"
#include "tests/oracles/hertz_bounce.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::contact_run_test {
namespace {

namespace po = pintle_oracle;
using pintle::JointKind;
using pintle::Status;

// --- starts ---

/// The run's end against the independent model's.
void expect_as_oracle(SliderCrank o, double tolerance) {
  o.tolerance = 1e-12;
  const Whole w = run(scene(o));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  po::State s = po::start(oracle(o));
  const po::Stats stats = po::simulate(oracle(o), po::Options{.tolerance = 1e-12}, o.until, s);
  const char* names[6] = {"crank.angle [rad]",   "coupler.angle [rad]",   "slider.x [m]",
                          "crank.speed [rad/s]", "coupler.speed [rad/s]", "slider.vx [m/s]"};
  for (std::size_t i = 0; i < 6; ++i) {
    double size = 0;
    for (const double x : w.column(names[i])) size = std::max(size, std::abs(x));
    EXPECT_NEAR(w.last(names[i]), s.y[i], tolerance * size) << names[i];
  }
  EXPECT_EQ(w.run.impacts.size(), static_cast<std::size_t>(stats.impacts));
}

constexpr double few_impacts = 1e-7;  // of the largest value, as for the paper's cases

TEST(JournalStart, AnywhereInTheGapIsAsInMinimalCoordinates) {
  for (const double radius : {0.1, 0.6, 0.99})
    for (const double turn : {0.3, 1.9, 3.5, 5.1}) {
      SCOPED_TRACE(std::to_string(radius) + " c at " + std::to_string(turn));
      const double e = radius * 5e-4;
      expect_as_oracle({.clearance = 5e-4, .friction = 0.02, .eccentricity = {e * std::cos(turn), e * std::sin(turn)}, .until = 4e-3},
                       few_impacts);
    }
}

TEST(JournalStart, NearlyAtTheWallIsAsInMinimalCoordinates) {
  // The paper's second start, 1e-8 m from the wall.
  for (const double side : {-1.0, 1.0})
    expect_as_oracle(
        {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.01, .eccentricity = {side * (2e-3 - 1e-8), 0}, .until = 2e-3},
        few_impacts);
}

TEST(JournalStart, ExactlyAtTheWallBeginsOneContactOrNone) {
  for (const double side : {-1.0, 1.0}) {
    const Whole w = run(scene(SliderCrank{.clearance = 2e-3, .speed = 300, .eccentricity = {side * 2e-3, 0}, .until = 1e-3}));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    // The slider is being slowed: the coupler's journal is pressed to the −x wall of its bearing.
    EXPECT_EQ(w.run.impacts.size(), side < 0 ? 1u : 0u);
  }
}

TEST(JournalStart, DeepInTheWallIsAsInMinimalCoordinates) {
  // Without hysteresis: at rest in the wall there is no approach speed to scale it by.
  for (const double depth : {1e-8, 1e-6, 2e-5})
    expect_as_oracle({.clearance = 5e-4, .restitution = 1, .eccentricity = {0, 5e-4 + depth}, .until = 2e-3}, few_impacts);
}

TEST(JournalStart, DeepInTheWallLatchesTheSpeedThatReachesThere) {
  // At rest there, no approach speed is known; ½ m v² = k δ^2.5/2.5 with the reduced mass of coupler and
  // slider gives one, and the contact parts in a time like that of an impact.
  const double depth = 1e-6;
  const Whole w = run(scene(SliderCrank{.clearance = 5e-4, .eccentricity = {0, 5e-4 + depth}, .until = 1e-3, .tolerance = 1e-10}));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_FALSE(w.run.impacts.empty());
  EXPECT_EQ(w.run.impacts[0].begin, 0);
  const double k = 4 / (3 * 2 * (1 - 0.3 * 0.3) / 207e9) * std::sqrt(9.5e-3 * 10e-3 / 0.5e-3);
  const double speed = std::sqrt(2 * k * std::pow(depth, 2.5) / 2.5 * (1 / 0.21 + 1 / 0.14));
  EXPECT_NEAR(w.run.impacts[0].approach, speed, 1e-9 * speed);  // rounding of the start's depth
  EXPECT_LT(w.run.counts.evaluations, 100000);
  EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-8 * w.run.first.stored());
}

TEST(JournalStart, SpeedIntoTheWallIsWhatTheImpactLatches) {
  SliderCrank o{.clearance = 5e-4, .until = 1e-4};
  pintle::Scene s = scene(o);
  s.start_journals[0].eccentricity = {0, 5e-4 + 1e-6};
  s.start_journals[0].speed = {0.2, 0.7};
  const Whole w = run(s);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.column("gudgeon pin.rate [m/s]").front(), 0.7, 1e-9);
  ASSERT_FALSE(w.run.impacts.empty());
  EXPECT_NEAR(w.run.impacts[0].approach, 0.7, 1e-9);
}

// --- onset ---

TEST(OnsetCut, TendsToTheLocatedOnset) {
  SliderCrank o{.clearance = 5e-4, .until = 1.2e-3};
  const Whole located = run(scene(o));
  ASSERT_FALSE(located.run.impacts.empty());
  const pintle::Impact& first = located.run.impacts[0];
  for (const double cut : {1e-6, 1e-7, 1e-8, 1e-9}) {
    pintle::Scene s = scene(o);
    s.run.onset_cut = cut;
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_FALSE(w.run.impacts.empty());
    const pintle::Impact& i = w.run.impacts[0];
    // Found after the wall, by no more than the time in which the cut is crossed.
    EXPECT_GE(i.begin, first.begin - 1e-12) << cut;
    EXPECT_LE(i.begin, first.begin + 1.1 * cut / first.approach) << cut;
    // The journal is hardly accelerated in so short a time: 1e4 m/s² at most.
    EXPECT_NEAR(i.approach, first.approach, 1e4 * cut / first.approach) << cut;
  }
}

// --- bounces: a puck in a bearing on the ground, no gravity, struck head-on ---

pintle::Scene puck_in_bearing(double speed, double restitution, bool bearing_on_ground) {
  pintle::Scene s;
  s.bodies = {body("puck", 0.4, 1e-4, {})};
  s.joints = {joint("bush", JointKind::revolute, "ground", "puck")};
  s.joints[0].clearance = clearance(bearing_on_ground ? "ground" : "puck", 1e-3, restitution);
  s.start_bodies = {start_at("puck", 0, 0, 0, speed, 0, 0)};
  s.start_journals = {{"bush", {0, 0}, {bearing_on_ground ? speed : -speed, 0}, {}}};
  s.run.until = 1.5e-3 / speed, s.run.tolerance = 1e-12;
  return s;
}

class HeadOn : public testing::TestWithParam<bool> {};  // bearing on the ground, else on the puck

TEST_P(HeadOn, BounceIsThatOfTheClosedForm) {
  constexpr double quadrature = 1e-6;  // of peak and depth, read off between steps
  for (const double restitution : {0.3, 0.8, 1.0})
    for (const double speed : {0.01, 1.0}) {
      const pintle::Scene s = puck_in_bearing(speed, restitution, GetParam());
      const Whole w = run(s);
      ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
      ASSERT_EQ(w.run.impacts.size(), 1u);
      const pintle::Impact& i = w.run.impacts[0];
      const po::Bounce b{.mass = 0.4,
                         .speed = speed,
                         .stiffness = pintle::contact_stiffness(*s.joints[0].clearance),
                         .chi = po::lankarani_nikravesh(restitution)};
      EXPECT_NEAR(i.begin, 1e-3 / speed, 1e-12 / speed);
      EXPECT_NEAR(i.approach, speed, 1e-12 * speed);
      const double e = b.chi > 0 ? po::restitution(b.chi) : 1;
      EXPECT_NEAR(i.separation, e * speed, 1e-9 * speed);
      EXPECT_NEAR(i.end - i.begin, po::duration(b), 1e-8 * po::duration(b));
      EXPECT_NEAR(i.deepest, po::deepest(b), quadrature * po::deepest(b));
      EXPECT_NEAR(i.peak_force, po::peak_force(b), 1e-4 * po::peak_force(b));
      EXPECT_NEAR(i.lost, po::loss(b), 1e-9 * 0.2 * speed * speed);
    }
}

INSTANTIATE_TEST_SUITE_P(Bearing, HeadOn, testing::Bool(), [](const auto& i) { return i.param ? "OnTheGround" : "OnThePuck"; });

// The last digit of the clock is then longer than the time in which the wall is told from the gap.
TEST(LateClock, HasTheImpactsOfAnEarlyOne) {
  pintle::Scene s = puck_in_bearing(1, 1, true);
  s.run.method = "verner87", s.run.tolerance = 1e-10;
  const pintle::Model model = build(s);
  const auto impacts = [&](double begin) {
    pintle::State start = assemble(s, model).start;
    start.t = begin;
    pintle::Integrator motion(model.system, model.scheme, start);
    while (motion.state().t < begin + 0.5 && motion.advance(begin + 0.5)) {
    }
    EXPECT_EQ(motion.failure(), "");
    for (const pintle::Impact& i : motion.impacts()) EXPECT_NEAR(i.approach, 1, 1e-6);
    return motion.impacts().size();
  };
  const std::size_t early = impacts(0);
  EXPECT_GT(early, 200u);
  for (const double begin : {4096.0, 16384.0, 1e5, 1e6}) EXPECT_EQ(impacts(begin), early) << begin;
}

TEST(Restitution, OfOneKeepsTheEnergyThroughEveryImpact) {
  const Whole w = run(scene(SliderCrank{.clearance = 5e-4, .restitution = 1, .until = 0.02, .tolerance = 1e-11}));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_GE(w.run.impacts.size(), 10u);
  EXPECT_EQ(w.run.last.lost, 0);
  for (const double e : w.run.ledger.column("stored [J]")) EXPECT_NEAR(e, w.run.first.stored(), 1e-8 * w.run.first.stored());
}

TEST(Restitution, OfZeroLosesTheMostAndBalances) {
  double before = 1e300;
  for (const double e : {0.0, 0.4, 0.8, 0.95}) {
    const Whole w = run(scene(SliderCrank{.clearance = 5e-4, .restitution = e, .until = 1.2e-3, .tolerance = 1e-10}));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_FALSE(w.run.impacts.empty());
    EXPECT_LT(w.run.impacts[0].separation, w.run.impacts[0].approach);
    // Lost in the first impact, which all begin alike.
    EXPECT_LT(w.run.impacts[0].lost, before) << e;
    EXPECT_GT(w.run.impacts[0].lost, 0) << e;
    EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-8 * w.run.first.stored());
    before = w.run.impacts[0].lost;
  }
}

// --- several at once ---

pintle::Scene worn_everywhere(double c, double friction) {
  pintle::Scene s = scene(SliderCrank{.clearance = c, .until = 0.01, .tolerance = 1e-10});
  s.joints[0].clearance = clearance("ground", c, 0.8);
  s.joints[1].clearance = clearance("coupler", c, 0.8);
  for (std::size_t i = 0; i < 3 && friction > 0; ++i) s.joints[i].clearance->friction = pintle::SceneFriction{.coefficient = friction};
  return s;
}

TEST(ThreeClearances, AllStrikeAndTheBooksClose) {
  for (const double friction : {0.0, 0.1})
    for (const char* constraints : {"projection", "partitioning"}) {
      pintle::Scene s = worn_everywhere(2e-4, friction);
      s.run.constraints = constraints;
      const Whole w = run(s);
      ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
      int strikes[3] = {0, 0, 0};
      double last = 0;
      for (const pintle::Impact& i : w.run.impacts) {
        ++strikes[i.contact];
        EXPECT_GE(i.begin, last);  // in order of beginning
        last = i.begin;
      }
      for (const int n : strikes) EXPECT_GT(n, 0);
      EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-8 * w.run.first.stored());
    }
}

TEST(ThreeClearances, TendToIdealPinsAsTheyShrink) {
  const Whole ideal = run(scene(SliderCrank{.clearance = 0, .until = 0.01, .tolerance = 1e-10}));
  for (const double c : {1e-4, 1e-5}) {
    const Whole w = run(worn_everywhere(c, 0));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    const auto x = w.column("slider.x [m]"), x0 = ideal.column("slider.x [m]");
    // Three gaps in a row, and the crank's lag, which goes as the gap too.
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(std::abs(x[i] - x0[i]), 15 * c);
  }
}

// --- a contact that begins slowly and is then loaded ---

// A journal in a guide meets the wall at once, at `speed`; within 0.02 s a force along the guide rises to `load`.
pintle::Scene loaded_contact(double speed, double restitution, double load) {
  pintle::Scene s;
  s.ground = {point("O", 0)};
  s.bodies = {body("journal", 1, 0.01, {point("P", 0)})};
  const double radial = 1e-4;
  s.joints = {joint("bearing", JointKind::revolute, "ground.O", "journal.P"),
              joint("guide", JointKind::prismatic, "ground.O", "journal.P")};
  s.joints[0].clearance = clearance("ground", radial, restitution);
  s.start_journals = {{"bearing", {radial - 1e-7 * speed, 0}, {speed, 0}, {}}};
  const auto rise = [load](double t) {
    const double x = std::clamp(t / 0.02, 0.0, 1.0);
    return pintle::Jet{load * x * x * (3 - 2 * x), 0, 0};
  };
  s.loads = {force("load", "journal.P", {rise, "rise", false}, law(0))};
  s.run.until = 0.05, s.run.method = "dopri5", s.run.tolerance = 1e-7;
  return s;
}
std::size_t doubts_of_slow_contact(const Whole& w) {
  return static_cast<std::size_t>(std::ranges::count_if(w.run.warnings, [](const std::string& text) {
    return text.find("\"bearing\"") != std::string::npos && text.find("pressed in") != std::string::npos &&
           text.find("slowest impact") != std::string::npos;
  }));
}

TEST(SlowContact, PressedInFasterThanItBeganIsDoubted) { EXPECT_EQ(doubts_of_slow_contact(run(loaded_contact(4e-6, 0.8, 1000))), 1u); }

TEST(SlowContact, IsNotDoubtedWithoutHysteresisOrLoadOrAfterAnImpact) {
  EXPECT_EQ(doubts_of_slow_contact(run(loaded_contact(4e-6, 1, 1000))), 0u);
  EXPECT_EQ(doubts_of_slow_contact(run(loaded_contact(4e-6, 0.8, 0))), 0u);
  EXPECT_EQ(doubts_of_slow_contact(run(loaded_contact(0.005, 0.8, 0))), 0u);
}

}  // namespace
}  // namespace pintle_scenes::contact_run_test
