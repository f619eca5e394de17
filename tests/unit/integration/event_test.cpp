// Events that a user registers from outside of the integrator, in every method.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "framework/integration/integrator.h"
#include "tests/contracts/scheme_cases.h"

namespace pintle::event_test {
namespace {

using namespace scheme_cases;
using Change = EventOutcome::Change;

constexpr double height = 2, g = 10, restitution = 0.5;  // of a body that falls and bounces

System free_body() {
  System s;
  s.gravity = {0, -g};
  s.bodies = {{"body", 3, 0.5}};
  s.length = height;
  number(s, true);
  return s;
}

State falling(const System& s, double spin = 0) {
  State out;
  out.y.setZero(s.n_y());
  out.y[1] = height, out.y[5] = spin;
  return out;
}

Scheme scheme_of(const std::string& method, double tolerance = 1e-9) {
  Scheme s;
  s.tableau = find_tableau(method);
  s.tolerance = tolerance;
  return s;
}

void add(Scheme& scheme, const Event& event) {
  scheme.events.push_back([event](const System&) { return single_event(event); });
}

Guard height_of(const State& x) { return {x.y[1], x.y[4]}; }
Guard angle_past(const State& x, double angle) { return {x.y[2] - angle, x.y[5]}; }

class EveryMethod : public testing::TestWithParam<const char*> {};

// With and without a rate. What is left of a quadratic or linear guard after the last correction is rounding.
TEST_P(EveryMethod, AStopConditionEndsTheRunWhereItsGuardIsZero) {
  const System system = free_body();
  constexpr double spin = 3, turns = 10;
  for (const bool rate_known : {true, false}) {
    Scheme scheme = scheme_of(GetParam());
    const auto guard = [=](const State& x) {
      Guard out = angle_past(x, turns);
      return rate_known ? out : Guard{out.value};
    };
    add(scheme, {"turns", guard, Direction::rising, [](State&) { return EventOutcome{.change = Change::nothing, .end = "ten radians"}; }});
    Integrator run(system, scheme, falling(system, spin));
    while (run.advance(100)) continue;
    EXPECT_TRUE(run.failure().empty()) << run.failure();
    EXPECT_EQ(run.ended(), "ten radians");
    EXPECT_NEAR(run.state().t, turns / spin, 1e-12 * turns / spin + 1e-12 / spin) << rate_known;
    EXPECT_EQ(run.counts().events, 1);
  }
}

// A fall from rest takes √(2H/g) and each bounce 2 e v/g: what an action does to the state goes on from there.
TEST_P(EveryMethod, AnActionMayChangeTheState) {
  const System system = free_body();
  Scheme scheme = scheme_of(GetParam());
  std::vector<double> bounces;
  add(scheme, {"floor", height_of, Direction::falling, [&](State& x) {
                 bounces.push_back(x.t);
                 x.y[4] *= -restitution;
                 return EventOutcome{Change::jump};
               }});
  Integrator run(system, scheme, falling(system));
  double t = std::sqrt(2 * height / g), v = g * t;
  std::vector<double> expected;
  for (int i = 0; i < 4; ++i) {
    expected.push_back(t);
    v *= restitution;
    t += 2 * v / g;
  }
  const double until = t - v / g;
  while (run.state().t < until) ASSERT_TRUE(run.advance(until)) << run.failure();
  ASSERT_EQ(bounces.size(), expected.size());
  // Explicit pairs follow parabolas to rounding; the implicit one to about tolerance^(2/3) of the time in each flight.
  const double each = run.implicit() ? std::pow(1e-9, 2.0 / 3) : 1e-11;
  for (std::size_t i = 0; i < bounces.size(); ++i) EXPECT_NEAR(bounces[i], expected[i], 4 * each * until) << i;
}

// The link swings to and fro through its lowest point: each way once in a period, and more often by nobody's count.
TEST_P(EveryMethod, OnePassageIsOneEvent) {
  Case k = link::make();
  k.system.forces.clear();
  number(k.system, true);
  k.start.y.conservativeResize(k.system.n_y());
  k.start.y.tail(k.system.n_z()).setZero();
  k.start.y.segment(k.system.n(), k.system.n()).setZero();  // let go at rest
  Scheme scheme = scheme_of(GetParam(), 1e-8);
  const double lowest = -std::acos(-1.0) / 2;
  std::vector<std::pair<int, double>> seen;
  const auto note = [&](int way) {
    return [&seen, way](State& x) {
      seen.emplace_back(way, x.t);
      return EventOutcome{Change::nothing};
    };
  };
  add(scheme, {"down", [=](const State& x) { return angle_past(x, lowest); }, Direction::falling, note(-1)});
  add(scheme, {"up", [=](const State& x) { return angle_past(x, lowest); }, Direction::rising, note(1)});
  Integrator run(k.system, scheme, k.start);
  while (run.state().t < 10) ASSERT_TRUE(run.advance(10)) << run.failure();
  ASSERT_GT(seen.size(), 8u);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].first, -seen[i - 1].first) << "the ways take turns";
    const double half = seen[1].second - seen[0].second;
    EXPECT_NEAR(seen[i].second - seen[i - 1].second, half, 1e-3 * half) << "half a period, without damping, i = " << i;
  }
}

TEST_P(EveryMethod, AtOneInstantLowerOrdersComeFirst) {
  const System system = free_body();
  Scheme scheme = scheme_of(GetParam());
  std::vector<std::pair<int, double>> seen;
  for (const int order : {3, 1, 2}) {
    add(scheme, {.name = "floor",
                 .guard = height_of,
                 .direction = Direction::falling,
                 .act =
                     [&seen, order](State& x) {
                       seen.emplace_back(order, x.t);
                       return EventOutcome{order == 2 ? Change::forces : Change::nothing};
                     },
                 .order = order});
  }
  Integrator run(system, scheme, falling(system));
  while (run.state().t < 1) ASSERT_TRUE(run.advance(1)) << run.failure();
  ASSERT_EQ(seen.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(seen[static_cast<std::size_t>(i)].first, i + 1);
    EXPECT_NEAR(seen[static_cast<std::size_t>(i)].second, seen[0].second, 1e-11);
  }
}

TEST_P(EveryMethod, AStartBeyondZeroIsNoPassage) {
  const System system = free_body();
  Scheme scheme = scheme_of(GetParam());
  int seen = 0;
  const auto count = [&](State&) {
    ++seen;
    return EventOutcome{Change::nothing};
  };
  add(scheme, {"above", [](const State& x) { return Guard{x.y[1] + 1e3, x.y[4]}; }, Direction::rising, count});
  Integrator run(system, scheme, falling(system));
  while (run.state().t < 1) ASSERT_TRUE(run.advance(1)) << run.failure();
  EXPECT_EQ(seen, 0);
}

// In the midst of bounces, from every step.
TEST_P(EveryMethod, ASavedRunGoesOnToTheBit) {
  const System system = free_body();
  Scheme scheme = scheme_of(GetParam());
  add(scheme, {"floor", height_of, Direction::falling, [](State& x) {
                 x.y[4] *= -restitution;
                 return EventOutcome{Change::jump};
               }});
  Integrator run(system, scheme, falling(system));
  std::vector<std::string> saved{run.save()};
  while (run.state().t < 1.5 && saved.size() < 200) {
    ASSERT_TRUE(run.advance(1.5));
    saved.push_back(run.save());
  }
  EXPECT_GE(run.counts().events, run.implicit() ? 1 : 2) << "no event, no exam";
  for (std::size_t i = 0; i + 1 < saved.size(); ++i) {
    Integrator next(system, scheme, falling(system));
    next.load(saved[i]);
    ASSERT_TRUE(next.advance(1.5));
    ASSERT_EQ(next.save(), saved[i + 1]) << i;
  }
}

TEST_P(EveryMethod, StateSavedWithOtherEventsIsRefused) {
  const System system = free_body();
  Scheme with = scheme_of(GetParam()), without = with;
  add(with, {"floor", height_of, Direction::falling, [](State&) { return EventOutcome{}; }});
  Integrator run(system, with, falling(system)), other(system, without, falling(system));
  EXPECT_THROW(other.load(run.save()), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Events, EveryMethod, testing::Values("rkf45", "dopri5", "verner87", "generalized-alpha"), [](const auto& each) {
  const std::string method = each.param;
  return method == "generalized-alpha" ? std::string("alpha") : method;
});

// The rates at the two ends of a step rise both: in between the guard has passed its summit and its valley.
TEST(Events, AreFoundBeforeTheGuardTurnsTwiceInAStep) {
  System system = free_body();
  system.gravity.setZero();  // at rest: one step
  Scheme scheme = scheme_of("verner87", 1e-6);
  std::vector<double> seen;
  add(scheme, {"summit",
               [](const State& x) {
                 const double t = x.t;
                 return Guard{t * t * t - 1.425 * t * t + 0.45 * t - 0.03, 3 * t * t - 2.85 * t + 0.45};
               },
               Direction::rising,
               [&](State& x) {
                 seen.push_back(x.t);
                 return EventOutcome{Change::nothing};
               }});
  State start;
  start.y.setZero(system.n_y());
  Integrator run(system, scheme, start);
  while (run.state().t < 1 && run.advance(1)) {
  }
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_LT(seen[0], 0.2);
}

// A contact whose onset is cut rather than located leaves the events of others where they are.
TEST(Events, AreLocatedBesideAnOnsetThatIsCut) {
  System system = free_body();
  system.markers = {{ground, {0, 0}, 0}, {0, {0, 0}, 0}};
  ContactPair pair;
  pair.a = 1, pair.b = 0;
  pair.gap = JournalBearing{0.5, 0.5 + height + 1e-3};
  pair.normal = ImpactLaw{1e6, 1.5, 0.3};
  system.contacts = {pair};
  system.contact_names = {"rim"};
  number(system);
  Scheme scheme = scheme_of("dopri5", 1e-6);
  scheme.onset_cut = 1e-6;
  std::vector<double> seen;
  add(scheme, {"half way",
               [](const State& x) {
                 return Guard{x.y[1] - height / 2, x.y[4]};
               },
               Direction::falling,
               [&](State& x) {
                 seen.push_back(x.t);
                 return EventOutcome{Change::nothing};
               }});
  State start = falling(system);
  Integrator run(system, scheme, start);
  while (run.impacts().empty()) ASSERT_TRUE(run.advance(10)) << run.failure();
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0], std::sqrt(height / g), 1e-11);
  const double depth = gap_of(system, 0, run.state()).value;
  EXPECT_GT(depth, 0);
  EXPECT_LE(depth, 1e-6);
}

// Models of one mechanism may differ in the integrals behind their coordinates; taken as its own, a shorter one was read past its end.
TEST(Integrator, TakesNoStartOfAnotherSystem) {
  const System system = free_body();
  for (const int more : {-1, 1}) {
    State start = falling(system);
    start.y.conservativeResizeLike(Eigen::VectorXd::Zero(system.n_y() + more));
    for (const char* method : {"dopri5", "verner87", "generalized-alpha"})
      EXPECT_THROW(Integrator(system, scheme_of(method), start), std::invalid_argument);
  }
}

}  // namespace
}  // namespace pintle::event_test
