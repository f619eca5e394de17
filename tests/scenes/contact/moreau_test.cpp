// Steps of one length through impacts: to what they tend as the step falls, at what order, and what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::moreau_test {
namespace {

using pintle_scenes::at, pintle_scenes::disc, pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::number,
    pintle_scenes::run, pintle_scenes::struck, pintle_scenes::Whole;

std::string run_by(const std::string& method, double until, double every) {
  return "run: {until: " + number(until) + ", method: " + method + "}\noutput: {every: " + number(every) + ", frames: 0}\n";
}
std::string moreau(double step) { return "{moreau: {step: " + number(step) + "}}"; }

// The slider-crank of Flores, Leine and Glocker; the crank's speed before its first impact and after two, by two coordinates and 45 digits.
double crank_after(double ms, double step) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/guide_with_play.yaml");
  s.joints.back().play->impact = SceneImpact{.restitution = 0.4};
  s.run.method = "moreau", s.run.step = step, s.run.until = ms * 1e-3;
  s.output.every = 1e-3, s.output.frames = 0;
  const Whole w = run(s);
  expect_sound(w);
  return w.last("crank.speed [rad/s]");
}

TEST(Moreau, TendsToFreeMotionByTheSecondPower) {
  const double truth = 120.463881713558296;
  const double coarse = std::abs(crank_after(2, 1e-4) - truth), fine = std::abs(crank_after(2, 1e-5) - truth);
  EXPECT_NEAR(std::log10(coarse / fine), 2, 0.1);
}

// Where in its step an impact falls is chance: the error of one step is up to the jump of the acceleration times it.
TEST(Moreau, TendsToTheImpactsByTheFirstPower) {
  const double truth = 79.4224451929059035, jump = 5e3;
  for (const double step : {1e-4, 1e-5, 1e-6}) EXPECT_LT(std::abs(crank_after(6, step) - truth), jump * step) << step;
}

TEST(Moreau, BringsABallToRest) {
  const double step = 1e-3, g = 9.81;
  const Whole w =
      run(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n" + struck("foot", "ball.rim", "ground.floor", "restitution: 0.8") +
          "start: {ball: {at: [0, 1.1]}}\n" + run_by(moreau(step), 6, 0.1));
  expect_sound(w);
  EXPECT_NEAR(w.last("ball.y [m]"), 0.1, g * step * step);
  EXPECT_NEAR(w.last("ball.vy [m/s]"), 0, g * step);
  EXPECT_NEAR(at(w, "ball.y [m]", 0.4), 1.1 - g * 0.08, 1e-9);  // falls are exact
  double pushed = 0, lost = 0;
  for (const Impact& i : w.run.impacts) pushed += i.impulse, lost += i.lost;
  EXPECT_NEAR(pushed, g * 6, 2 * g * step);  // what stops the weight of 1 kg
  EXPECT_NEAR(lost, w.ledger("foot.lost to hysteresis [J]"), 1e-12 * g);
  EXPECT_NEAR(w.ledger("foot.lost to hysteresis [J]"), g, 1e-4 * g);
}

// At √(2H/g) (1 + e)/(1 − e). Each of some n impacts, until v < g h, comes a step late at the most, with a speed that is (1 + e) g h off: the
// flights after it keep that for 2 (1 + e) h/(1 − e) in all.
TEST(Moreau, EndsAllBouncesWhereTheirSeriesDoes) {
  constexpr double g = 9.81, H = 1;
  for (const double e : {0.5, 0.8})
    for (const double step : {1e-3, 1e-4}) {
      SCOPED_TRACE("restitution " + number(e) + ", step " + number(step));
      const double end = std::sqrt(2 * H / g) * (1 + e) / (1 - e), n = std::ceil(std::log(step * std::sqrt(g / (2 * H))) / std::log(e));
      const Whole w = run(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n" +
                          struck("foot", "ball.rim", "ground.floor", "restitution: " + number(e)) + "start: {ball: {at: [0, " +
                          number(0.1 + H) + "]}}\n" + run_by(moreau(step), 1.1 * end, 0.1));
      expect_sound(w);
      ASSERT_FALSE(w.run.impacts.empty());
      EXPECT_NEAR(w.run.impacts.back().begin, end, (n + 1) * step * (1 + 2 * (1 + e) / (1 - e)));
      EXPECT_TRUE(std::isnan(w.run.impacts.back().end));
    }
}

TEST(Moreau, SlidesAndRolls) {
  const double step = 1e-4;
  const Whole w = run(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n" +
                      struck("foot", "ball.rim", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: 0.2}}") +
                      "start: {ball: {at: [0, 0.1], velocity: [5, 0]}}\n" + run_by(moreau(step), 2, 0.1));
  expect_sound(w);
  EXPECT_NEAR(w.last("ball.vx [m/s]"), 5 * 2. / 3, 10 * step);
  EXPECT_NEAR(w.last("ball.speed [rad/s]"), -50 * 2. / 3, 100 * step);
  EXPECT_NEAR(w.ledger("foot.lost to friction [J]"), 25 / 6., 100 * step);
  ASSERT_EQ(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].lost, w.ledger("foot.lost to friction [J]") + w.ledger("foot.lost to hysteresis [J]"), 1e-12 * 25);
}

TEST(Moreau, IsRefusedWhereItDoesNotFit) {
  const auto scene = [](const std::string& laws, const std::string& method) {
    return floor_under() + "bodies:\n" + disc("ball") + "contacts:\n  foot: {between: [ball.rim, ground.floor], " + laws + "}\n" +
           run_by(method, 1, 0.1);
  };
  const std::string rigid = "model: impact, restitution: 0.5";
  const auto refused = [&](const std::string& text, const std::string& says) {
    pintle_test::expect_one_line(pintle_test::refusal_by<std::exception>([&] { build(read_scene_text(text, "scene.yaml")); }),
                                 "scene.yaml:", {says});
  };
  refused(scene(rigid, "moreau"), "write {moreau: {step: 0.1 ms}}");
  refused(scene(rigid, moreau(2)), "no longer than the run");
  refused(scene(rigid + ", restitution law: poisson", moreau(1e-3)), "give it to \"foot\", or use auto");
  refused(scene("normal: {hertz: {stiffness: 1e9}}", moreau(1e-3)), "give \"foot\" model: impact, or use auto");
  const auto beam = [](const std::string& law) {
    return "bodies:\n  bm:\n    beam: {from: A, to: B, section: {rectangle: [10 mm, 10 mm]}, young: 200 GPa, poisson: 0.3, density: 8000 "
           "kg/m^3}\n"
           "    points: {A: [0, 0], B: [1 m, 0]}\n    modes: {frame: {tangent: A}, craig-bampton: {count: 2}}\n"
           "joints: {held: {weld: [ground, bm.A]}}\nforces: {push: {force: [0, " +
           law + "], at: bm.B}}\n" + run_by(moreau(1e-3), 1, 0.1);
  };
  for (const char* law : {"-20 N", "-20 N*sin(t/(1 s))", "-20 N s/m*bm.B.vy"}) refused(beam(law), "rigid bodies only");
}

}  // namespace
}  // namespace pintle::moreau_test
