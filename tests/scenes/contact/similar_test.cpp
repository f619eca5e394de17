// Lengths and times of a scene multiplied by one power of two: speeds stay, and every number of the run is the same but for that factor,
// to the bit. What differs is a bound in metres or seconds where one relative to the scene is due.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::similar_test {
namespace {

using pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number, pintle_scenes::run, pintle_scenes::struck_by,
    pintle_scenes::Whole;

class Similar : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(All, Similar, testing::ValuesIn(struck_by), name_of);

// It falls onto a corner, rocks from corner to corner, slides and comes to rest.
std::string rocking_block(double s) {
  const auto at = [&](double x, double y) { return "[" + number(x * s) + ", " + number(y * s) + "]"; };
  return "gravity: [0, " + number(-9.81 / s) + "]\nbodies: {block: {rigid: {mass: 1, inertia: " + number(0.1 * s * s) +
         "}, profiles: {rim: {path: [" + at(-0.2, -0.5) + ", " + at(0.2, -0.5) + ", " + at(0.2, 0.5) + ", " + at(-0.2, 0.5) +
         "], closed: true}}}}\nground: {profiles: {floor: {path: [" + at(-5, 0) + ", " + at(5, 0) +
         "], material: right}}}\ncontacts: {foot: {between: [block.rim, ground.floor], model: impact, restitution: 0.5, friction: "
         "{coulomb: {coefficient: 0.5}}}}\nstart: {block: {at: " +
         at(0, 0.5625) + ", angle: 0.2}}\nrun: {until: " + number(3 * s) + "}\noutput: {every: " + number(s) + ", frames: 0}\n";
}

TEST_P(Similar, ARockingBlockComesToRestAtEveryScale) {
  const auto run_at = [](double s) { return run(rocking_block(s), {GetParam().name, GetParam().words, 1e-6, 0}); };
  const Whole one = run_at(1);
  ASSERT_EQ(one.run.status, Status::finished) << one.run.reason;
  ASSERT_GT(one.run.impacts.size(), 100u);
  for (const int power : {-40, -20, 20, 40}) {
    SCOPED_TRACE(power);
    const double s = std::ldexp(1, power);
    const Whole w = run_at(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_EQ(w.run.impacts.size(), one.run.impacts.size());
    for (std::size_t i = 0; i < one.run.impacts.size(); ++i) {
      EXPECT_EQ(w.run.impacts[i].begin / s, one.run.impacts[i].begin) << i;
      EXPECT_EQ(w.run.impacts[i].approach, one.run.impacts[i].approach) << i;
    }
    EXPECT_EQ(w.last("block.x [m]") / s, one.last("block.x [m]"));
    EXPECT_EQ(w.last("block.angle [rad]"), one.last("block.angle [rad]"));
  }
}

}  // namespace
}  // namespace pintle::similar_test
