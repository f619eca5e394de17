// Siconos as a judge of rigid contacts, with models of its own and its own time-stepping by Moreau and Jean: as its step becomes shorter, what
// it finds tends to our events, which locate each impact, by the first order of its step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "framework/scene/yaml/reader.h"
#include "tests/scenes/contact/rigid_scenes.h"
#include "tests/siconos/siconos_systems.h"

namespace pintle::siconos_test {
namespace {

using pintle_scenes::disc, pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::number, pintle_scenes::run,
    pintle_scenes::run_for, pintle_scenes::struck, pintle_scenes::Whole;
using siconos_judge::Sample;

/// The largest difference between a number of Siconos and a column of ours, less `zero`, at our outputs after the start.
template <class Value>
double apart(const std::vector<Sample>& theirs, const Value& value, const Whole& ours, const std::string& column, double zero = 0) {
  const double step = theirs.front().t;
  const std::vector<double> t = ours.column("t [s]"), x = ours.column(column);
  double out = 0;
  for (std::size_t i = 1; i < t.size(); ++i)
    out = std::max(out, std::abs(value(theirs.at(static_cast<std::size_t>(std::lround(t[i] / step)) - 1)) - (x[i] - zero)));
  return out;
}

/// A tenth of the step leaves about a tenth of the difference: a fifth is allowed, as an impact falls anywhere in its step.
/// @param per_step  what may be left of it for a step of 1 s
template <class Off>
void expect_first_order(double step, const Off& off, double per_step) {
  const double coarse = off(step), fine = off(step / 10);
  std::cout << "  apart by " << coarse << " with a step of " << step << " s, by " << fine << " with a tenth of it\n";
  EXPECT_LT(fine, coarse / 5);
  EXPECT_LT(fine, per_step * step / 10);
}

// From 1 m, four bounces. Each comes up to a step late: (1 + e) v apart for a step of 1 s, the four together 23.5 m/s. That is an estimate: how
// later bounces carry the difference on is left out.
TEST(Siconos, ADiscThatBounces) {
  const Whole ours =
      run(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n" + struck("foot", "ball.rim", "ground.floor", "restitution: 0.8") +
          "start: {ball: {at: [0, 1.1]}}\n" + run_for(2.5, 0.02));
  expect_sound(ours);
  expect_first_order(
      1e-3,
      [&](double step) {
        return apart(
            siconos_judge::bouncing_disc(1, 0.8, step, 2.5), [](const Sample& at) { return at.q[0]; }, ours, "ball.y [m]", 0.1);
      },
      23.5);
}

// Up a slope of 20 degrees and back, for a friction that does not hold it; up and no farther, for one that does. In the step in which it
// turns, friction is off by 2 µ g cos 20° at most, and the place after it by that, the step and the time that is left.
TEST(Siconos, ABlockOnASlope) {
  const double angle = 20 * M_PI / 180;
  for (const double mu : {0.2, 0.5}) {
    SCOPED_TRACE(mu);
    const Whole ours =
        run(floor_under(angle) +
            "bodies: {block: {rigid: {mass: 1, inertia: 1}, profiles: {sides: {path: [[-0.1, -0.05], [0.1, -0.05], [0.1, "
            "0.05], [-0.1, 0.05]], closed: true}}}}\ncontacts:\n" +
            struck("foot", "block.sides", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: " + number(mu) + "}}") +
            "start: {block: {at: [0, 0.05], velocity: [-2, 0]}}\n" + run_for(1, 0.05));
    expect_sound(ours);
    expect_first_order(
        1e-3,
        [&](double step) {
          return apart(
              siconos_judge::block_on_slope(-angle, mu, -2, step, 1), [](const Sample& at) { return at.q[0]; }, ours, "block.x [m]");
        },
        2 * mu * 9.81 * std::cos(angle));
  }
}

// Through the impacts of both corners at once, their accumulation, sliding along the guide and lift-off. What is a step late is off by what
// the crank's speed changes in a step: 2e4 rad/s², the greatest mean over a millisecond of the published rows.
TEST(Siconos, ASliderCrankWithPlayInItsGuide) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/guide_with_play.yaml");
  ScenePlay& play = *s.joints.back().play;
  play.impact = SceneImpact{.restitution = 0.4};
  play.friction = SceneFriction{};
  play.friction->law = "coulomb", play.friction->coefficient = 0.01;
  s.run.method = "dopri5", s.run.tolerance = 1e-10, s.run.until = 20e-3;
  s.output.every = 1e-3, s.output.frames = 0;
  const Whole ours = run(s);
  expect_sound(ours);
  expect_first_order(
      1e-4,
      [&](double step) {
        return apart(
            siconos_judge::slider_crank(step, 20e-3), [](const Sample& at) { return at.v[0]; }, ours, "crank.speed [rad/s]");
      },
      2e4);
}

}  // namespace
}  // namespace pintle::siconos_test
