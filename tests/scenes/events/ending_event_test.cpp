// An event that ends a run: what `simulate` makes of it.

#include <gtest/gtest.h>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/integration/events/event.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::ending_event_test {
namespace {

using namespace pintle;

// The crank is first among the bodies, so its angle is the third coordinate.
TEST(EndingEvent, FinishesTheRunInOrderWithItsReasonAndALastRow) {
  for (const char* method : {"dopri5", "generalized-alpha"}) {
    const Scene s = scene({.clearance = 0, .driven = true, .until = 0.05, .tolerance = 1e-6, .method = method});
    Model model = build(s);
    model.scheme.events.push_back([](const System& system) {
      const Eigen::Index speed = system.n() + 2;
      return single_event(
          {"one radian",
           [speed](const State& x) {
             return Guard{x.y[2] - 1, x.y[speed]};
           },
           Direction::rising,
           [](State&) { return EventOutcome{.change = EventOutcome::Change::nothing, .end = "the crank has turned by a radian"}; }});
    });
    const pintle::Run run = simulate(s, model, assemble(s, model));
    EXPECT_EQ(run.status, Status::finished) << run.reason;
    EXPECT_EQ(run.reason, "the crank has turned by a radian");
    EXPECT_NEAR(run.t_end, 1.0 / 150, 1e-9 / 150) << "driven at 150 rad/s";
    const std::size_t width = run.trajectory.columns();
    ASSERT_GE(run.trajectory.data.size(), width);
    EXPECT_EQ(run.trajectory.data[run.trajectory.data.size() - width], run.t_end);
  }
}

}  // namespace
}  // namespace pintle_scenes::ending_event_test
