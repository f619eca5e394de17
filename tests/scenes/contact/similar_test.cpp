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

// Where coordinates are rounded to more than 1e-13 of the ball's size.
TEST_P(Similar, ABallComesToRestOnAFloorFarFromTheOrigin) {
  constexpr double r = 0.1, e = 0.8, fall = 0.4472135954999579;  // the time in which it falls 1 m at 10 m/s^2 [s]
  for (const double height : {0.0, 300.0, -1e4, 5.4e6}) {
    SCOPED_TRACE(height);
    const std::string floor = number(height);
    const Whole w =
        run("gravity: [0, -10]\nbodies: {ball: {rigid: {mass: 1, inertia: 0.004}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}}\n"
            "ground: {profiles: {floor: {path: [[-3, " +
                floor + "], [6, " + floor +
                "]], material: right}}}\n"
                "contacts: {floor: {between: [ball.rim, ground.floor], model: impact, restitution: 0.8}}\nstart: {ball: {at: [0, " +
                number(height + r + 1) + "]}}\nrun: {until: 5}\noutput: {every: 1, frames: 0}\n",
            {GetParam().name, GetParam().words, 1e-6, 0});
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_GT(w.run.impacts.size(), 10u);
    const double known = 1e-13 + 1e-15 * std::abs(height);  // [m]
    double begin = fall, speed = 10 * fall;
    for (std::size_t i = 0; i < 10; ++i, speed *= e) {
      EXPECT_NEAR(w.run.impacts[i].begin, begin, 10 * (static_cast<double>(i) + 1) * known / speed) << i;
      begin += 2 * e * speed / 10;
    }
    EXPECT_NEAR(w.last("ball.y [m]"), height + r, 10 * known);
  }
}

// It tumbles and rocks; its smallest bounces are shorter than a part of the step in which they are looked for.
TEST_P(Similar, ABlockTumblesToRestFarFromTheOrigin) {
  constexpr double right_angle = 1.5707963267948966;
  const auto end = [](double height) {
    const std::string floor = number(height);
    const Whole w = run(
        "gravity: [0, -10]\nbodies: {block: {rigid: {mass: 1, inertia: 0.0066666666666666667}, profiles: {outline: {path: [[-0.1, -0.1], "
        "[0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]], closed: true}}}}\nground: {profiles: {floor: {path: [[-3, " +
            floor + "], [6, " + floor +
            "]], material: right}}}\ncontacts: {floor: {between: [block.outline, ground.floor], model: impact, restitution: 0.4, "
            "friction: {coulomb: {coefficient: 0.4}}}}\nstart: {block: {angle: 20 deg, at: [0, " +
            number(height + 0.6) + "], velocity: [1, 0], speed: 5}}\nrun: {until: 4}\noutput: {every: 1, frames: 0}\n",
        {GetParam().name, GetParam().words, 1e-6, 0});
    EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_NEAR(w.last("block.y [m]"), height + 0.1, 1e-12 + 1e-14 * std::abs(height));
    EXPECT_NEAR(std::remainder(w.last("block.angle [rad]"), right_angle), 0, 1e-6);
    return w.last("block.x [m]");
  };
  const double here = end(0);
  for (const double height : {300.0, -1e4, 3e4, 5.4e6}) {
    SCOPED_TRACE(height);
    EXPECT_NEAR(end(height), here, 1e-4);
  }
}

}  // namespace
}  // namespace pintle::similar_test
