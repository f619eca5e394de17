// Joint forces of redundant mechanisms, and the crossing of flat poses over all tolerances.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/build/build.h"
#include "framework/dynamics/equations/equations.h"
#include "tests/scenes/joints/parallel_links.h"

namespace pintle_scenes::flat_pose_test {
namespace {

std::vector<std::size_t> force_columns(const Whole& w) {
  std::vector<std::size_t> out;
  const auto& header = w.run.trajectory.header;
  for (std::size_t i = 0; i < header.size(); ++i)
    if (header[i].ends_with(" [N]")) out.push_back(i);
  return out;
}

// Shares that no motion settles are those of least norm in every step, so both methods give the same forces along a run through flat
// poses, to what the implicit one follows the motion to: its tolerance^⅔, some tens of times as speeds grow.
TEST(ParallelCranks, HaveTheSameForcesByGeneralisedAlphaAsByAnExplicitPair) {
  for (const int n : {3, 13})  // 13: more rows than are dense
    for (const double tolerance : {1e-5, 1e-6}) {
      SCOPED_TRACE(std::to_string(n) + " cranks at " + std::to_string(tolerance));
      Scene s = parallel_cranks(n, 0.4, 4, 3);
      s.output.every = 0.03;
      const Whole by_pair = run(s);
      s.run.method = "generalized-alpha", s.run.tolerance = tolerance;
      const Whole implicit = run(s);
      ASSERT_EQ(implicit.run.status, Status::finished) << implicit.run.reason;
      for (const std::string& warning : implicit.run.warnings)
        EXPECT_FALSE(warning.find("generalised-alpha") != std::string::npos) << warning;
      const auto &a = implicit.run.trajectory, &b = by_pair.run.trajectory;
      ASSERT_EQ(a.data.size(), b.data.size());
      double peak = 0, apart = 0;
      for (std::size_t row = 0; row < b.data.size(); row += b.columns())
        for (const std::size_t c : force_columns(by_pair)) {
          peak = std::max(peak, std::abs(b.data[row + c]));
          apart = std::max(apart, std::abs(a.data[row + c] - b.data[row + c]));
        }
      EXPECT_LT(apart, 100 * std::pow(tolerance, 2.0 / 3) * peak);
    }
}

// At rest the bar's weight is shared alike: the least norm of forces whose sum is g.
TEST(ParallelCranks, AtRestShareTheWeightAlikeByGeneralisedAlpha) {
  for (const int n : {3, 13}) {
    Scene s = parallel_cranks(n, -M_PI / 2, 0, 1);
    s.run.method = "generalized-alpha", s.run.tolerance = 1e-6;
    const Whole w = run(s);
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(w.last(numbered("top", i) + ".fy on bar [N]"), g / n, 1e-6 * g);
      EXPECT_NEAR(w.last(numbered("base", i) + ".fy on " + numbered("crank", i) + " [N]"), g / n + g, 1e-6 * g);
    }
  }
}

// The permanent redundancy is seen beside rows that are nearly dependent, at any distance from the flat pose: forces tend to those in it, for
// each radian by no more than all weights and inertia forces together.
TEST(ParallelCranks, HaveForcesThatTendToThoseOfTheFlatPose) {
  for (const double speed : {1.0, 5.0}) {
    Eigen::VectorXd flat;
    for (double u : {0.0, 0.05, 0.03, 0.02, 0.0112, 0.008, 0.005, 0.0037, 0.003, 0.002, 0.0015, 0.001}) {
      const Scene s = parallel_cranks(3, std::asin(u), speed, 1);
      const Model model = build(s);
      State at = assemble(s, model).start;
      Equations eq(model.system);
      ASSERT_TRUE(project(model.system, 0, at.y, eq)) << u;
      accelerate(model.system, at, eq);
      if (u == 0) flat = eq.lambda;
      EXPECT_EQ(eq.schur.lost(), u == 0 ? 2 : 1) << u;
      // ω² ε/u⁴ of a mass is what rounding of places leaves in forces.
      const double known = 1e-15 * speed * speed / std::pow(std::max(u, 1e-3), 4), load = 4 * (g + speed * speed);
      EXPECT_LT((eq.lambda - flat).lpNorm<Eigen::Infinity>(), load * u + known + 1e-9 * load) << u << " " << speed;
    }
  }
}

// Flat poses are crossed the better the tighter the tolerance, without a stall. What is left at the tightest: a stage at a distance u from
// the pose knows accelerations out of the branch to ω² ε/u³, of which a step brings hω into the motion; with u some hundredths of the step,
// hω = 0.02, that is 1e-8, and the motion's own sensitivity makes ten times that of it.
TEST(FlatPoses, AreCrossedTheBetterTheTighterTheTolerance) {
  struct Pair {
    const char* method;
    double tightest;
  };
  constexpr double floor = 1e-7, until = 3, angle = 0.4, speed = 4;
  for (const Pair& pair : {Pair{"dopri5", 1e-12}, Pair{"rkf45", 1e-12}, Pair{"verner87", 1e-12}})
    for (const bool cranks : {true, false})
      for (double tolerance = 1e-6; tolerance > 0.5 * pair.tightest; tolerance /= 10) {
        SCOPED_TRACE(std::string(pair.method) + (cranks ? ", cranks, " : ", parallelograms, ") + std::to_string(std::log10(tolerance)));
        Scene s = cranks ? parallel_cranks(3, angle, speed, until) : parallelograms(2, angle, speed, until);
        s.run.method = pair.method, s.run.tolerance = tolerance;
        const Whole w = run(s);
        ASSERT_NE(w.run.status, Status::failed) << w.run.reason;
        const double expected = cranks ? angle_at(until, 2, g * 2.5, angle, speed) : expected_parallelograms(2, until, angle, speed);
        EXPECT_NEAR(w.last("crank0.angle [rad]"), expected, 100 * tolerance + floor);
        EXPECT_LT(w.run.counts.steps, 3000 * std::pow(1e-12 / tolerance, 0.1));
      }
}

}  // namespace
}  // namespace pintle_scenes::flat_pose_test
