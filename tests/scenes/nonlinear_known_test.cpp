// The scenes of examples/nonlinear/ against what the literature has of them.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/study/nonlinear/nonlinear.h"
#include "tests/scenes/nonlinear_study.h"

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

}  // namespace
}  // namespace pintle
