// Mechanisms moved by hand, against their closed forms.
#include "framework/configuration/moved_by_hand.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"

namespace pintle {
namespace {

using Eigen::Vector2d;

/// A crank of 1, a rod of 3, a slider on y = 0.
constexpr const char* slider_crank = R"(
ground: {points: {O: [0, 0]}}
bodies:
  crank: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0], A: [1, 0]}, pose: {angle: 0.6}}
  rod: {rigid: {mass: 1, inertia: 1}, points: {A: [0, 0], B: [3, 0]}, pose: {at: [0.8, 0.6], angle: -0.2}}
  slider: {rigid: {mass: 1, inertia: 1}, points: {P: [0, 0]}, pose: {at: [3.8, 0]}}
joints:
  main: {revolute: [ground.O, crank.O]}
  pin: {revolute: [crank.A, rod.A]}
  gudgeon: {revolute: [rod.B, slider.P]}
  guide: {prismatic: [ground.O, slider.P]}
run: {until: 1}
)";

struct Hand {
  Model model;
  MovedByHand hand;
  explicit Hand(const std::string& text) : Hand(read_scene_text(text, "scene.yaml", {}, ".")) {}
  explicit Hand(const Scene& scene) : model(build(scene)), hand(model.system, assemble(scene, model).start.y) {}
};

double place_of_slider(double crank) { return std::cos(crank) + std::sqrt(9 - std::sin(crank) * std::sin(crank)); }

TEST(MovedByHand, TheSliderFollowsTheCrankRoundAndRound) {
  Hand h(slider_crank);
  EXPECT_EQ(h.hand.mobility(), 1);
  for (double angle = 0.7; angle < 9; angle += 0.4) {  // through both dead centres of the slider
    ASSERT_TRUE(h.hand.pull(0, {1, 0}, {std::cos(angle), std::sin(angle)}));
    const Eigen::VectorXd& q = h.hand.coordinates();
    EXPECT_NEAR(q[6], place_of_slider(angle), 1e-7);
    EXPECT_NEAR(q[7], 0, 1e-7);
    EXPECT_NEAR(std::remainder(q[2] - angle, 2 * M_PI), 0, 1e-7);
  }
}

TEST(MovedByHand, WhatIsPulledOutOfReachStaysAtTheEndOfItsWay) {
  Hand h(slider_crank);
  ASSERT_TRUE(h.hand.pull(2, {0, 0}, {9, 5}));  // of the slider's line 4 is the farthest
  // The distance from 4 is quadratic in the crank's angle, so half the digits of the angle are left.
  EXPECT_NEAR(h.hand.coordinates()[6], 4, 1e-4);
  EXPECT_NEAR(h.hand.coordinates()[7], 0, 1e-7);
}

TEST(MovedByHand, ACrankPulledFromAfarPointsAtIt) {
  Hand h(slider_crank);
  ASSERT_TRUE(h.hand.pull(0, {1, 0}, {-3, 4}));  // the nearest point of the circle lies on the ray
  EXPECT_NEAR(std::atan2(std::sin(h.hand.coordinates()[2]), std::cos(h.hand.coordinates()[2])), std::atan2(4, -3), 1e-3);
}

TEST(MovedByHand, JointsWithPlayAreClosed) {
  std::string text = slider_crank;
  const std::string pin = "{revolute: [rod.B, slider.P]}";
  text.replace(text.find(pin), pin.size(),
               "{revolute: [rod.B, slider.P], clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: slider,\n"
               "            normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}}");
  Hand h(text);
  EXPECT_EQ(h.hand.mobility(), 1);
  ASSERT_TRUE(h.hand.pull(0, {1, 0}, {0, 1}));
  EXPECT_NEAR(h.hand.coordinates()[6], std::sqrt(8), 1e-7);
}

TEST(MovedByHand, DriversLetGo) {
  Hand h(std::string(slider_crank) + "drivers: {motor: {angle: [ground, crank], law: present + 1 rad/s*t}}\n");
  EXPECT_EQ(h.hand.mobility(), 1);
  ASSERT_TRUE(h.hand.pull(0, {1, 0}, {0, 1}));
  EXPECT_NEAR(h.hand.coordinates()[6], std::sqrt(8), 1e-7);
}

TEST(MovedByHand, DegreesOfFreedomAreMotionsThatKeepTheJointsClosed) {
  Hand h(slider_crank);
  const Eigen::MatrixXd motions = h.hand.dofs(5);
  ASSERT_EQ(motions.cols(), 1);
  const Eigen::VectorXd& q = h.hand.coordinates();
  const double angle = q[2], rate = motions(2, 0), s = std::sin(angle), c = std::cos(angle);
  ASSERT_GT(std::abs(rate), 0.1);
  EXPECT_NEAR(motions(6, 0) / rate, -s - s * c / std::sqrt(9 - s * s), 1e-9);  // dx/dφ of the slider
  EXPECT_NEAR(motions(7, 0), 0, 1e-9);
}

TEST(MovedByHand, AFreeBodyHasThreeDegreesOfFreedomAndGoesWhereItIsPulled) {
  Hand h("bodies: {stone: {rigid: {mass: 1, inertia: 1}}}\nrun: {until: 1}\n");
  EXPECT_EQ(h.hand.mobility(), 3);
  EXPECT_EQ(h.hand.dofs(5).cols(), 3);
  ASSERT_TRUE(h.hand.pull(0, {0.5, 0}, {2, 3}));
  const Eigen::VectorXd& q = h.hand.coordinates();
  EXPECT_NEAR((Vector2d(q.head<2>()) + Eigen::Rotation2Dd(q[2]) * Vector2d(0.5, 0) - Vector2d(2, 3)).norm(), 0, 1e-8);
}

}  // namespace
}  // namespace pintle
