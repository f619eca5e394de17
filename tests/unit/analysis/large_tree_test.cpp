// Mechanisms of thousands of bodies without rough poses, put together at t = 0: every joint is closed, by geometry of its own.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/common/some_of.h"
#include "framework/configuration/assemble.h"
#include "framework/output/results.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/rods.h"
#include "tests/refusal.h"

namespace pintle::large_tree_test {
namespace {

using namespace rods;
using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double length = 0.1;  // of a rod, and of the mechanism
const PointRef origin{"ground", "", {}};

std::string name(int i) { return "rod " + std::to_string(i); }
PointRef start(int i) { return {name(i), "A", {}}; }
PointRef end(int i) { return {name(i), "B", {}}; }

/// Rods without a pose, each held by the one that `before` names, or by the ground.
template <class Before>
Scene tree(int n, JointKind odd, Before before) {
  Scene s;
  for (int i = 0; i < n; ++i) {
    SceneBody b = rod(name(i), length, {0, 0}, 0);
    b.points[1].angle = 0.3;  // where a guide points
    s.bodies.push_back(b);
    const int on = before(i);
    s.joints.push_back(joint("joint " + std::to_string(i), i % 2 == 1 ? odd : JointKind::revolute, on < 0 ? origin : end(on), start(i)));
    if (i % 2 == 1 && odd == JointKind::prismatic) s.joints.back().angle = 0.2;
  }
  return s;
}
Scene chain(int n, JointKind odd = JointKind::revolute) {
  return tree(n, odd, [](int i) { return i - 1; });
}

struct Bodies {
  VectorXd y;
  double angle(int i) const { return y[3 * i + 2]; }
  Vector2d end_at(int i, double sign) const { return y.segment<2>(3 * i) + Rotation2Dd(angle(i)) * Vector2d(sign * length / 2, 0); }
  Vector2d a(int i) const { return end_at(i, -1); }
  Vector2d b(int i) const { return i < 0 ? Vector2d(0, 0) : end_at(i, 1); }
  // Closed to 1e-11 of a rod, which a place so far from the origin must allow: 8 roundings of the largest coordinate.
  double allowed() const { return 1e-11 * length + 8 * 2.2e-16 * y.lpNorm<Eigen::Infinity>(); }
};
Bodies put(const Scene& s) {
  const Model model = build(s);
  return {assemble(s, model).start.y.head(model.system.n())};
}

class LargeTree : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sizes, LargeTree, testing::Values(10, 300, 3000));

TEST_P(LargeTree, AnOpenChainCloses) {
  const int n = GetParam();
  const Bodies at = put(chain(n));
  for (int i = 0; i < n; ++i) EXPECT_LT((at.a(i) - at.b(i - 1)).norm(), at.allowed()) << i;
}

TEST_P(LargeTree, AStarOfChainsCloses) {
  const int n = GetParam(), arms = 5;
  const auto before = [](int i) { return i < arms ? -1 : i - arms; };
  const Bodies at = put(tree(n, JointKind::revolute, before));
  for (int i = 0; i < n; ++i) EXPECT_LT((at.a(i) - at.b(before(i))).norm(), at.allowed()) << i;
}

// Every other joint guides the next rod along a line and turns it by 0.5 rad.
TEST_P(LargeTree, AChainWithGuidesCloses) {
  const int n = GetParam();
  const Bodies at = put(chain(n, JointKind::prismatic));
  for (int i = 0; i < n; ++i) {
    const Vector2d gap = at.a(i) - at.b(i - 1);
    if (i % 2 == 0) {
      EXPECT_LT(gap.norm(), at.allowed()) << i;
      continue;
    }
    const double guide = at.angle(i - 1) + 0.3;
    EXPECT_LT(std::abs(std::cos(guide) * gap.y() - std::sin(guide) * gap.x()), at.allowed()) << i;
    EXPECT_NEAR(at.angle(i) - guide, 0.2, 1e-11) << i;
  }
}

// The last rod ends on the ground, at half of what the chain spans and off its line.
TEST_P(LargeTree, AChainWithItsEndHeldCloses) {
  const int n = GetParam();
  const Vector2d held = 0.5 * n * length * Vector2d(std::cos(0.4), std::sin(0.4));
  Scene s = chain(n);
  s.ground = {{"end", {held.x(), held.y()}, 0, {}}};
  s.joints.push_back(joint("last", JointKind::revolute, {"ground", "end", {}}, end(n - 1)));
  const Bodies at = put(s);
  const double allowed = at.allowed() + 1e-11 * held.norm();  // which is the mechanism's length here
  for (int i = 0; i < n; ++i) EXPECT_LT((at.a(i) - at.b(i - 1)).norm(), allowed) << i;
  EXPECT_LT((at.b(n - 1) - held).norm(), allowed);
}

// One of the rods holds another: a loop of a hundred within the chain.
TEST_P(LargeTree, AChainWithALoopOfItsOwnCloses) {
  const int n = GetParam(), loop = std::min(n / 2, 100);
  Scene s = chain(n);
  s.bodies[0].points.push_back({"side", {length / 2, length}, 0, {}});
  s.joints.push_back(joint("last", JointKind::revolute, {name(0), "side", {}}, end(loop)));
  const Bodies at = put(s);
  for (int i = 0; i < n; ++i) EXPECT_LT((at.a(i) - at.b(i - 1)).norm(), at.allowed()) << i;
  EXPECT_LT((at.y.head<2>() + Rotation2Dd(at.angle(0)) * Vector2d(0, length) - at.b(loop)).norm(), at.allowed());
}

// What the scene draws stays where it is drawn, where the others can follow.
TEST(LargeTreePoses, ADrawnAngleIsKept) {
  Scene s = chain(300);
  for (const std::size_t i : {0U, 100U, 299U}) s.bodies[i].angle = 0.5, s.bodies[i].drawn_angle = true;
  const Bodies at = put(s);
  for (const int i : {0, 100, 299}) EXPECT_NEAR(at.angle(i), 0.5, 1e-3) << i;
  for (int i = 0; i < 300; ++i) EXPECT_LT((at.a(i) - at.b(i - 1)).norm(), at.allowed()) << i;
}

TEST(LargeTreePoses, WhatIsFixedAtTheStartStays) {
  Scene s = chain(300);
  StartBody fixed;
  fixed.body = name(150);
  fixed.angle = 0.7, fixed.x = 1.5, fixed.y = 12;
  s.start_bodies = {fixed};
  const Bodies at = put(s);
  EXPECT_EQ(at.angle(150), 0.7);
  EXPECT_LT((at.a(150) - Vector2d(1.5, 12)).norm(), at.allowed());
  for (int i = 0; i < 300; ++i) EXPECT_LT((at.a(i) - at.b(i - 1)).norm(), at.allowed()) << i;
}

// The messages of many names.

TEST(SomeOf, NamesAFewAndCountsTheOthers) {
  EXPECT_EQ(some_of({"a"}), "\"a\"");
  EXPECT_EQ(some_of({"a", "b", "c"}), "\"a\", \"b\" and \"c\"");
  EXPECT_EQ(some_of({"a", "b", "c", "d", "e", "f", "g", "h", "i"}, false), "a, b, c, d, e, f, g, h and i");
  std::vector<std::string> many;
  for (int i = 0; i < 998; ++i) many.push_back("j" + std::to_string(i));
  EXPECT_EQ(some_of(many), "\"j0\", \"j1\", \"j2\", \"j3\", \"j4\", \"j5\", \"j6\", \"j7\" and 990 others");
}

TEST(SomeOf, AChainThatIsTooShortNamesAFewOfItsJoints) {
  constexpr int n = 60;
  Scene s = chain(n);
  s.ground = {{"end", {1.2 * n * length, 0}, 0, {}}};
  s.joints.push_back(joint("last", JointKind::revolute, {"ground", "end", {}}, end(n - 1)));
  const std::string said = pintle_test::refusal_by<AssemblyError>([&] { put(s); });
  EXPECT_TRUE(pintle_test::says(said, "cannot close")) << said;
  EXPECT_TRUE(pintle_test::says(said, " others; ")) << said;
  EXPECT_LT(said.size(), 400U);
}

// run.json, where the text of the scene is put in without reading it.

std::string description(const Scene& scene) {
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  return run_json(scene, model, assembly, simulate(scene, model, assembly));
}

TEST(RunJson, EndsWithTheSceneAsItWasRead) {
  const Scene scene = read_scene_text(
      "title: 'a \"b\" {'\nbodies: {b: {rigid: {mass: 1, inertia: 1e-3}, points: {a: [0, 0]}}}\njoints: {j: {revolute: [ground, b.a]}}\n"
      "run: {until: 1 ms}\noutput: {frames: 0}",
      "scene.yaml");
  for (const std::string& text : {description(scene), begun_json(scene)}) {
    const auto json = nlohmann::ordered_json::parse(text);
    EXPECT_EQ(std::prev(json.end()).key(), "scene");
    EXPECT_EQ(json.at("scene"), nlohmann::ordered_json::parse(scene.filled_in));
    EXPECT_EQ(json.dump(2) + "\n", text) << "not in the form of the rest";
  }
}

TEST(RunJson, HasNoSceneWhereNoneWasRead) {
  Scene scene = chain(2);
  scene.has_run = true;
  scene.run.until = 1e-3;
  EXPECT_TRUE(nlohmann::ordered_json::parse(description(scene)).at("scene").is_null());
}

}  // namespace
}  // namespace pintle::large_tree_test
