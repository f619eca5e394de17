// Where nothing but gravity acts, a step may be as long as the run. No contact may be lost in it, at any tolerance.
#include <gtest/gtest.h>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::long_step_test {
namespace {

using pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number, pintle_scenes::run, pintle_scenes::struck_by,
    pintle_scenes::Whole;

constexpr double g = 9.81, edge = 0.1;

class LongSteps : public testing::TestWithParam<Method> {};
std::vector<Method> methods() {
  std::vector<Method> out = struck_by;
  out.push_back({"generalized_alpha", "generalized-alpha", 0, 0});
  return out;
}
INSTANTIATE_TEST_SUITE_P(All, LongSteps, testing::ValuesIn(methods()), name_of);

// At the end of a long step the ball is far below the table, beside it.
TEST_P(LongSteps, ABallHopsOnATableUntilItsEdge) {
  std::vector<std::string> laws{"normal: {hunt-crossley: {restitution: 0.9, stiffness: 1e9}}"};
  if (GetParam().words != "generalized-alpha") laws.push_back("model: impact, restitution: 0.9");
  for (const std::string& law : laws)
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8})
      for (const double speed : {0.2, 0.5}) {
        SCOPED_TRACE(law + ", tolerance " + number(tolerance) + ", " + number(speed) + " m/s");
        const Whole w =
            run("gravity: [0, -9.81]\nground: {profiles: {table: {path: [[-1, 0], [0.1, 0]], material: right}}}\n"
                "bodies: {ball: {rigid: {mass: 1, inertia: 4e-5}, profiles: {rim: {disc: [0, 0], radius: 10 mm}}}}\n"
                "contacts: {hop: {between: [ball.rim, ground.table], " +
                    std::string(law) + "}}\nstart: {ball: {at: [0, 10.5 mm], velocity: [" + number(speed) +
                    ", -0.2]}}\nrun: {until: 2}\noutput: {every: 0.5, frames: 0}\n",
                {GetParam().name, GetParam().words, tolerance, 0});
        ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
        const std::vector<Impact>& all = w.run.impacts;
        ASSERT_GE(all.size(), 4u);
        for (std::size_t i = 1; i < all.size(); ++i) {
          constexpr double slow = 1e-4, rounding = 1e-14;  // [m/s], of its height [m]
          const double flight = 2 * all[i - 1].separation / g;
          if (all[i - 1].separation < slow || speed * all[i].begin > edge) continue;
          EXPECT_NEAR(all[i].begin - all[i - 1].end, flight, tolerance * flight + rounding / slow) << i;
        }
        EXPECT_GT(speed * (all.back().end + 2 * all.back().separation / g), edge) << "it fell through the table";
      }
}

// It turns four times in the first long step, with 5 mm of rounding at each corner.
TEST(LongStep, ASpinningBoxTouchesTheFloorWithItsNextCorner) {
  const std::string text =
      "gravity: [0, -9.81]\nbodies:\n  box:\n    rigid: {mass: 1 kg, inertia: 1.7e-3 kg m^2}\n"
      "    profiles: {outline: {path: [[-6 cm, -4 cm], [6 cm, -4 cm], [6 cm, 4 cm], [-6 cm, 4 cm]], closed: true, round: 5 mm}}\n"
      "ground:\n  profiles:\n    table: {path: [[-1 m, -1 m], [0, -1 m], [0, 0], [-1 m, 0]], closed: true}\n"
      "    floor: {path: [[0, -0.6 m], [3 m, -0.6 m]], material: right}\ncontacts:\n"
      "  on table: {between: [box.outline, ground.table], normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e8 N/m^1.5}}, friction: "
      "{coulomb: {coefficient: 0.2}}}\n"
      "  on floor: {between: [box.outline, ground.floor], normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e8 N/m^1.5}}, friction: "
      "{coulomb: {coefficient: 0.2}}}\n"
      "start: {box: {at: [-0.3 m, 4 cm], vx: 1.2 m/s, vy: 0, angle: 0, speed: 0}}\nrun: {until: 0.8 s}\noutput: {frames: 0}\n";
  const auto hits = [&](double tolerance) {
    const Whole w = run(text, {"dopri5", "dopri5", tolerance, 0});
    pintle_scenes::expect_sound(w);
    std::vector<double> out;
    for (const Impact& i : pintle_scenes::impacts(w, "on floor")) out.push_back(i.begin);
    return out;
  };
  const std::vector<double> fine = hits(1e-9), coarse = hits(1e-6);
  ASSERT_GE(fine.size(), 2u);
  ASSERT_GE(coarse.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(coarse[i], fine[i], 1e-4);
}

// The corner that has just parted comes again within the same step, and is far outside at its end.
TEST_P(LongSteps, ABoxTumblesInAHole) {
  constexpr double hole = 0.25;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    SCOPED_TRACE(tolerance);
    const Whole w =
        run("gravity: [0, -9.81]\nground: {profiles: {hole: {hole: [0, 0], radius: 0.25}}}\n"
            "bodies: {box: {rigid: {mass: 0.6, inertia: 1.4e-4}, profiles: {sides: {path: [[-0.03, -0.02], [0.03, -0.02], [0.03, 0.02], "
            "[-0.03, 0.02]], closed: true}}}}\n"
            "contacts: {hit: {between: [box.sides, ground.hole], normal: {hunt-crossley: {restitution: 0.9, stiffness: 1e9}}}}\n"
            "start: {box: {at: [0.017, 0.04], angle: 4.092, vx: 1.716, vy: 1.426, speed: 19.64}}\n"
            "run: {until: 0.6}\noutput: {every: 0.01, frames: 0}\n",
            {GetParam().name, GetParam().words, tolerance, 0});
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_GE(w.run.impacts.size(), 4u);
    const std::vector<double> x = w.column("box.x [m]"), y = w.column("box.y [m]");
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(std::hypot(x[i], y[i]), hole) << i;
  }
}

// Nothing else moves it, so that its first step is as long as the run: ten powers of ten longer than the time to the impact.
TEST_P(LongSteps, ABallStrikesAWallRightAfterTheStart) {
  std::vector<std::string> laws{"normal: {hunt-crossley: {restitution: 0.9, stiffness: 1e9}}"};
  if (GetParam().words != "generalized-alpha") laws.push_back("model: impact, restitution: 1");
  for (const std::string& law : laws)
    for (const double speed : {1.0, 100.0, 1e4})
      for (const double gap : {1e-10, 1e-8, 1e-6, 1e-4}) {
        SCOPED_TRACE(law + ", " + number(speed) + " m/s, " + number(gap) + " m");
        const Whole w =
            run("ground: {profiles: {wall: {path: [[0.05, -1], [0.05, 1]], material: right}}}\n"
                "bodies: {ball: {rigid: {mass: 1, inertia: 1e-3}, profiles: {rim: {disc: [0, 0], radius: 0.05}}}}\n"
                "contacts: {hit: {between: [ball.rim, ground.wall], " +
                    law + "}}\nstart: {ball: {x: " + number(-gap) + ", vx: " + number(speed) +
                    "}}\nrun: {until: 1}\noutput: {every: 1, frames: 0}\n",
                {GetParam().name, GetParam().words, 1e-6, 0});
        ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
        ASSERT_EQ(w.run.impacts.size(), 1u);
        EXPECT_NEAR(w.last("ball.vx [m/s]"), -speed * (law.starts_with("model") ? 1 : 0.9), 0.02 * speed);
        EXPECT_NEAR(w.last("ball.x [m]"), w.last("ball.vx [m/s]"), 0.02 * speed);
      }
}

// A block with these rounded corners on a table that ends at x = 0, its centre 30 cm before the end.
std::string block_on_table(const std::string& rounding, const std::string& law, double speed) {
  return "gravity: [0, -9.81]\nbodies:\n  box:\n    rigid: {mass: 1 kg, inertia: 1.7e-3 kg m^2}\n"
         "    profiles: {outline: {path: [[-6 cm, -4 cm], [6 cm, -4 cm], [6 cm, 4 cm], [-6 cm, 4 cm]], closed: true" +
         rounding + "}}\nground: {profiles: {table: {path: [[-1, -1], [0, -1], [0, 0], [-1, 0]], closed: true}}}\n" +
         "contacts: {c: {between: [box.outline, ground.table], " + law + ", friction: {coulomb: {coefficient: 0.2}}}}\n" +
         "start: {box: {at: [-0.3, 4 cm], vx: " + number(speed) + ", vy: 0, angle: 0, speed: 0}}\n";
}

// Its corners pass the end one after another in the middle of long steps. Until its centre of pressure passes, which friction moves ahead of
// its centre of mass, friction alone acts, and every method integrates the motion exactly.
TEST_P(LongSteps, RowsFollowABlockThatSlidesOverTheEndOfATable) {
  if (GetParam().words == "generalized-alpha") GTEST_SKIP() << "it takes no rigid contacts";
  for (const std::string rounding : {"", ", round: 2 mm", ", round: 5 mm"})
    for (const double tolerance : {1e-4, 1e-6, 1e-8})
      for (const double speed : {1.2, 2.0}) {
        SCOPED_TRACE(rounding + ", tolerance " + number(tolerance) + ", " + number(speed) + " m/s");
        const Whole w = run(
            block_on_table(rounding, "model: impact, restitution: 0.3", speed) + "run: {until: 0.3}\noutput: {every: 2 ms, frames: 0}\n",
            {GetParam().name, GetParam().words, tolerance, 0});
        pintle_scenes::expect_sound(w);
        const std::vector<double> t = w.column("t [s]"), x = w.column("box.x [m]"), v = w.column("box.vx [m/s]");
        std::size_t before = 0;
        for (std::size_t i = 0; i < t.size() && x[i] < -0.2 * 0.04; ++i, ++before) {
          EXPECT_NEAR(x[i], -0.3 + speed * t[i] - 0.1 * g * t[i] * t[i], 1e-9) << t[i];
          EXPECT_NEAR(v[i], speed - 0.2 * g * t[i], 1e-9) << t[i];
        }
        EXPECT_GT(before, 50u);
      }
}

// Its lower corners are also behind the end face of the table, far deeper than under the upper one.
TEST(LongStep, RowsNameTheFacesThatTouch) {
  constexpr double mass = 1, stiffness = 1e8, length = 0.12;
  const double sinks = std::pow(mass * g / 2 / stiffness, 2.0 / 3);  // on two corners
  for (const std::string rounding : {"", ", round: 5 mm"})
    for (const std::string law :
         {"model: impact, restitution: 0.3", "normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e8 N/m^1.5}}"}) {
      SCOPED_TRACE(law + rounding);
      const Whole w =
          run(block_on_table(rounding, law, 0) + "run: {until: 0.2}\noutput: {every: 1 ms, frames: 0}\n", {"dopri5", "dopri5", 1e-8, 0});
      ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
      const std::vector<double> x = w.column("c.x [m]"), y = w.column("c.y [m]"), depth = w.column("c.depth [m]");
      for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_LE(std::abs(depth[i]), 2 * sinks) << i;  // at most twice as deep as where it comes to rest: it was let go at the surface
        EXPECT_LE(std::abs(y[i]), 2 * sinks) << i;
        EXPECT_LE(std::abs(x[i] + 0.3), length / 2 + 1e-9) << i;
      }
    }
}

}  // namespace
}  // namespace pintle::long_step_test
