// The motion inside the long steps of a pair of order 8.

#include "framework/integration/explicit/inner_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "framework/integration/explicit/stages.h"
#include "framework/integration/explicit/tableau.h"
#include "framework/integration/integrator.h"
#include "tests/contracts/first_step.h"
#include "tests/contracts/scheme_cases.h"

namespace pintle::inner_motion_test {
namespace {

using namespace scheme_cases;

// The error of a step of order 8 is h⁹; at these steps the next term is seen too.
constexpr double nearer_to_nine = 8.5;

TEST(InnerMotion, ErrsAsAStepOfOrderEight) {
  for (const Case& k : {link::make(), series::make()}) {
    const std::vector<double> h{0.12, 0.08, 0.054};
    std::vector<double> error;
    for (const double span : h) {
      Equations eq(k.system);
      Stages stages(k.system, *find_tableau("verner87"), Constraints::projection);
      Step step;
      ASSERT_TRUE(first_step(k, span, stages, step, eq));
      InnerMotion inner;
      ASSERT_TRUE(inner.prepare(k.system, step, stages, eq));
      error.push_back(0);
      Instant dense{k.start, VectorXd::Zero(k.system.n_y())};
      for (int tenth = 1; tenth < 10; ++tenth) {
        inner.interpolate(step, tenth * span / 10, dense.state);
        ASSERT_TRUE(stages.project(k.system, dense, eq));
        error.back() = std::max(error.back(), (k.seen(dense.state.y, eq) - k.truth(tenth * span / 10)).lpNorm<Eigen::Infinity>());
      }
    }
    EXPECT_GT(slope(h, error), nearer_to_nine) << "from " << error.front() << " to " << error.back();
  }
}

// What a step shows must not depend on which steps were looked into before, nor how often.
TEST(InnerMotion, IsPreparedAnewForEachStepAndOnlyOnce) {
  const Case k = link::make();
  Integrator run(k.system, {.tableau = find_tableau("verner87"), .tolerance = 1e-8}, k.start);
  Integrator other(k.system, {.tableau = find_tableau("verner87"), .tolerance = 1e-8}, k.start);
  State one, two;
  for (int i = 0; i < 6; ++i) {
    ASSERT_TRUE(run.advance(10) && other.advance(10));
    const double begin = run.last().from.state.t, h = run.last().h;
    for (const double x : {0.2, 0.7, 0.9}) ASSERT_TRUE(run.sample(begin + x * h, one));
    const long before = run.sampled().evaluations;
    ASSERT_TRUE(run.sample(begin + 0.7 * h, one));
    EXPECT_EQ(run.sampled().evaluations - before, 1);
    if (i % 2 == 0) continue;  // the other looks into every second step alone
    ASSERT_TRUE(other.sample(begin + 0.7 * h, two));
    EXPECT_EQ(one.y, two.y);
  }
}

}  // namespace
}  // namespace pintle::inner_motion_test
