// Putting a mechanism together at t = 0, judged by closed forms and by a dense solve of its own.

#include "framework/configuration/assemble.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "framework/build/build.h"
#include "framework/dynamics/equations/jacobian.h"
#include "tests/oracles/four_bar.h"
#include "tests/unit/rods.h"
#include "tests/refusal.h"

namespace pintle::assemble_test {
namespace {

using pintle_test::says;

using namespace rods;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Joints are closed to 1e-12 of the mechanism's size; a pose follows within its conditioning, 10.
constexpr double closed = 1e-11;
// Speeds by two solutions of one linear system, condition number up to 1e4.
constexpr double solved = 1e-9;

Law constant(double value) {
  return {[value](double) { return Jet{value, 0, 0}; }, "", true};
}
Law steady(double start, double rate) {
  return {[=](double t) { return Jet{start + rate * t, rate, 0}; }, "", false};
}

SceneJoint pin(const std::string& name, PointRef a, PointRef b) { return joint(name, JointKind::revolute, std::move(a), std::move(b)); }
StartBody start_angle(const std::string& body, double angle) {
  StartBody s;
  s.body = body;
  s.angle = angle;
  return s;
}
StartBody start_speed(const std::string& body, double speed) {
  StartBody s;
  s.body = body;
  s.speed = speed;
  return s;
}
SceneDriver drive(const std::string& name, const std::string& body, Law law) {
  SceneDriver d;
  d.name = name;
  d.a = {"ground", "", {}};
  d.b = {body, "", {}};
  d.law = std::move(law);
  return d;
}

Scene slider_crank(double crank, double coupler, double angle) {
  Scene s;
  s.bodies = {rod("crank", crank, {0.02, -0.01}, angle + 0.2), rod("coupler", coupler, {0, 0.1}, 0)};
  SceneBody slider;
  slider.name = "slider";
  slider.mass = 0.5;
  slider.inertia = 1e-3;
  slider.at = {crank + coupler, 0.03};
  s.bodies.push_back(slider);
  s.joints = {pin("bearing", {"ground", "", {}}, {"crank", "A", {}}), pin("crank pin", {"crank", "B", {}}, {"coupler", "A", {}}),
              pin("gudgeon pin", {"coupler", "B", {}}, {"slider", "", {}}),
              joint("guide", JointKind::prismatic, {"ground", "", {}}, {"slider", "", {}})};
  s.start_bodies = {start_angle("crank", angle)};
  return s;
}
// Crank, coupler, rocker between ground points 0 and (ground, 0).
Scene four_bar(double ground, double crank, double coupler, double rocker) {
  Scene s;
  s.ground = {{"C", {ground, 0}, 0, {}}};
  s.bodies = {rod("crank", crank, {0, 0}, 1.0), rod("coupler", coupler, {0, 0.1}, 0.2), rod("rocker", rocker, {ground, 0}, 1.5)};
  s.joints = {pin("p1", {"ground", "", {}}, {"crank", "A", {}}), pin("p2", {"crank", "B", {}}, {"coupler", "A", {}}),
              pin("p3", {"coupler", "B", {}}, {"rocker", "B", {}}), pin("p4", {"ground", "C", {}}, {"rocker", "A", {}})};
  return s;
}
struct Put {
  Model model;
  Assembly assembly;
  double angle(int body) const { return assembly.start.y[3 * body + 2]; }
  double speed(int body) const { return assembly.start.y[model.system.n() + 3 * body + 2]; }
};
Put put(const Scene& scene) {
  Put p{build(scene), {}};
  p.assembly = assemble(scene, p.model);
  return p;
}
std::string complaint(const Scene& scene) {
  return pintle_test::refusal_by<AssemblyError>([&] { put(scene); });
}

// ---- poses ------------------------------------------------------------------------------------

TEST(Assemble, ClosesASliderCrankFromARoughPose) {
  const pintle_oracle::SliderCrank lengths{0.1, 0.3};
  for (double angle : {-3.0, -1.2, 0.0, 0.8, 2.4}) {
    const auto truth = evaluate(lengths, pintle_oracle::Turn{angle, 0, 0});
    const Put p = put(slider_crank(0.1, 0.3, angle));
    EXPECT_EQ(p.angle(0), angle);
    EXPECT_NEAR(p.angle(1), truth.coupler.angle, closed) << angle;
    EXPECT_NEAR(p.assembly.start.y[6], truth.x, closed) << angle;
    EXPECT_NEAR(p.assembly.start.y[7], 0, closed) << angle;
    EXPECT_EQ(p.assembly.rank, 8);
    EXPECT_TRUE(p.assembly.redundant.empty());
  }
}

TEST(Assemble, RoughPoseChoosesTheBranchOfAFourBar) {
  for (const bool open : {true, false}) {
    Scene s = four_bar(0.4, 0.1, 0.35, 0.3);
    s.start_bodies = {start_angle("crank", 1.0)};
    const auto truth = evaluate(pintle_oracle::FourBar{0.4, 0.1, 0.35, 0.3, open}, pintle_oracle::Turn{1.0, 0, 0});
    ASSERT_TRUE(truth.closes);
    s.bodies[1].angle = truth.coupler.angle + 0.3;
    s.bodies[2].angle = truth.rocker.angle - 0.3;
    const Put p = put(s);
    EXPECT_LT(std::abs(std::remainder(p.angle(1) - truth.coupler.angle, 2 * M_PI)), closed);
    EXPECT_LT(std::abs(std::remainder(p.angle(2) - truth.rocker.angle, 2 * M_PI)), closed);
  }
}

// Forty rods of 0.1 m thrown about, between pivots 3 m apart.
TEST(Assemble, ClosesAChainOfFortyLinksFromAPoorPose) {
  std::mt19937 random(3);
  const auto within = [&](double r) { return r * (static_cast<double>(random()) / 2147483648.0 - 1); };
  Scene s;
  s.ground = {{"end", {3, 0}, 0, {}}};
  PointRef last{"ground", "", {}};
  for (int i = 0; i < 40; ++i) {
    const std::string name = "link " + std::to_string(i);
    s.bodies.push_back(rod(name, 0.1, {0.075 * i + within(0.2), within(0.3)}, within(1.5)));
    s.joints.push_back(pin("pin " + std::to_string(i), last, {name, "A", {}}));
    last = {name, "B", {}};
  }
  s.joints.push_back(pin("last pin", last, {"ground", "end", {}}));
  const Put p = put(s);
  Vector2d end(0, 0);
  for (int i = 0; i < 40; ++i) {
    const Vector2d u(std::cos(p.angle(i)), std::sin(p.angle(i)));
    EXPECT_LT((p.assembly.start.y.segment<2>(3 * i) - end - 0.05 * u).norm(), 40 * closed) << i;
    end += 0.1 * u;
  }
  EXPECT_LT((end - Vector2d(3, 0)).norm(), 40 * closed);
}

TEST(Assemble, KeepsWhatIsPinnedToTheLastBit) {
  Scene s = slider_crank(0.1, 0.3, 0.3);
  s.start_bodies.clear();
  StartBody slider;
  slider.body = "slider";
  slider.x = 0.3721;
  slider.vx = -0.77;
  s.start_bodies.push_back(slider);
  const Put p = put(s);
  EXPECT_EQ(p.assembly.start.y[6], 0.3721);
  EXPECT_EQ(p.assembly.start.y[9 + 6], -0.77);
}

TEST(Assemble, PutsAJournalAtItsEccentricityAndSpeed) {
  Scene s = slider_crank(0.1, 0.3, 0.8);
  SceneClearance c;
  c.radial = 1e-4;
  c.bearing_radius = 0.01;
  c.bearing = "slider";
  c.normal.stiffness = 1e9;
  s.joints[2].clearance = c;
  StartJournal journal;
  journal.joint = "gudgeon pin";
  journal.eccentricity = {3e-5, -6e-5};
  journal.speed = {0.02, 0.01};
  s.start_journals = {journal};
  s.start_bodies[0].speed = 20;
  const Put p = put(s);
  const VectorXd& y = p.assembly.start.y;
  const Vector2d u(std::cos(y[5]), std::sin(y[5]));
  const Vector2d e = y.segment<2>(3) + 0.15 * u - y.segment<2>(6);
  const Vector2d e_rate = y.segment<2>(9 + 3) + 0.15 * y[9 + 5] * perp(u) - y.segment<2>(9 + 6);
  EXPECT_LT((e - Vector2d(3e-5, -6e-5)).norm(), closed);
  EXPECT_LT((e_rate - Vector2d(0.02, 0.01)).norm(), solved);
  EXPECT_EQ(y[9 + 2], 20);
}

// ---- speeds -----------------------------------------------------------------------------------

// min ½ sᵀMs subject to Ċ = 0 and s_i = given, by its dense KKT system.
VectorXd slowest(const Put& p, int pinned, double value) {
  const System& system = p.model.system;
  Equations eq(system);
  VectorXd y = p.assembly.start.y;
  pose(system, 0, y, eq);
  y.segment(system.n(), system.n()).setZero();
  speed(system, 0, y, eq);
  const int n = system.n(), m = system.n_rows();
  MatrixXd K = MatrixXd::Zero(n + m + 1, n + m + 1);
  for (int i = 0; i < n; ++i) {
    const Body& b = system.bodies[static_cast<std::size_t>(i / 3)];
    K(i, i) = i % 3 == 2 ? b.J : b.m;
  }
  K.block(n, 0, m, n) = dense_jacobian(system, eq);
  K(n + m, pinned) = 1;
  K.topRightCorner(n, m + 1) = K.bottomLeftCorner(m + 1, n).transpose();
  VectorXd r = VectorXd::Zero(n + m + 1);
  r.segment(n, m) = -eq.Cdot;
  r[n + m] = value;
  return K.fullPivLu().solve(r).head(n);
}

// Rods hung in a row; centres are not at the origins of their axes.
Scene hanging_chain(int links) {
  Scene s;
  PointRef last{"ground", "", {}};
  for (int i = 0; i < links; ++i) {
    const std::string name = "link " + std::to_string(i);
    s.bodies.push_back(rod(name, 0.2 + 0.1 * i, {0.1 * i, -0.2 * i}, -1.3 + 0.4 * i));
    s.joints.push_back(pin("pin " + std::to_string(i), last, {name, "A", {}}));
    last = {name, "B", {}};
  }
  return s;
}

TEST(Assemble, SpeedsAreThoseOfLeastKineticEnergy) {
  for (int pinned : {0, 1, 2}) {
    Scene s = hanging_chain(3);
    s.start_bodies = {start_speed("link " + std::to_string(pinned), 2.5)};
    const Put p = put(s);
    const VectorXd expected = slowest(p, 3 * pinned + 2, 2.5);
    const VectorXd found = p.assembly.start.y.segment(9, 9);
    EXPECT_EQ(p.speed(pinned), 2.5);
    EXPECT_LT((found - expected).lpNorm<Eigen::Infinity>(), solved) << "spin of link " << pinned;
  }
}

TEST(Assemble, SpeedsFollowADriver) {
  Scene s = four_bar(0.4, 0.1, 0.35, 0.3);
  s.drivers = {drive("motor", "crank", steady(1.0, 7.0))};
  const Put p = put(s);
  const pintle_oracle::FourBar lengths{0.4, 0.1, 0.35, 0.3};
  const auto truth = evaluate(lengths, pintle_oracle::Turn{1.0, 7.0, 0});
  EXPECT_NEAR(p.speed(0), 7.0, solved);
  EXPECT_NEAR(p.speed(1), truth.coupler.rate, solved);
  EXPECT_NEAR(p.speed(2), truth.rocker.rate, solved);
}

// ---- what cannot be -----------------------------------------------------------------------------

TEST(Assemble, NamesAJointThatCannotClose) {
  const std::string message = complaint(four_bar(1.0, 0.1, 0.2, 0.3));
  EXPECT_TRUE(says(message, "\"p1\"") || says(message, "\"p2\"") || says(message, "\"p3\"") || says(message, "\"p4\"")) << message;
  EXPECT_TRUE(says(message, "cannot close")) << message;
  EXPECT_TRUE(says(message, " m remains")) << message;
}

TEST(Assemble, NamesBothOfTwoDriversThatContradict) {
  Scene s = four_bar(0.4, 0.1, 0.35, 0.3);
  s.drivers = {drive("motor", "crank", constant(1.0)), drive("other motor", "crank", constant(1.2))};
  const std::string message = complaint(s);
  EXPECT_TRUE(says(message, "\"motor\"")) << message;
  EXPECT_TRUE(says(message, "\"other motor\"")) << message;
}

TEST(Assemble, NamesBothDriversWhenOnlyTheirSpeedsContradict) {
  Scene s = four_bar(0.4, 0.1, 0.35, 0.3);
  s.drivers = {drive("motor", "crank", steady(1.0, 5)), drive("other motor", "crank", steady(1.0, 6))};
  const std::string message = complaint(s);
  EXPECT_TRUE(says(message, "\"motor\"")) << message;
  EXPECT_TRUE(says(message, "\"other motor\"")) << message;
}

// A third rod of the crank's length, parallel to crank and rocker: it moves, though one row is
// idle.
TEST(Assemble, NamesTheIdleRowOfAParallelogramWithAThirdLink) {
  Scene s = four_bar(0.4, 0.2, 0.4, 0.2);
  s.start_bodies = {start_angle("crank", 1.0)};
  s.bodies[1] = rod("coupler", 0.4, {0.1, 0.17}, 0);
  s.bodies[1].points.push_back({"M", {0.2, 0}, 0, {}});
  s.bodies[2] = rod("rocker", 0.2, {0.4, 0}, 1.0);
  s.bodies.push_back(rod("third", 0.2, {0.2, 0}, 1.0));
  s.ground.push_back({"middle", {0.2, 0}, 0, {}});
  s.joints.push_back(pin("p5", {"ground", "middle", {}}, {"third", "A", {}}));
  s.joints.push_back(pin("p6", {"third", "B", {}}, {"coupler", "M", {}}));
  const Put p = put(s);
  ASSERT_EQ(p.model.system.n_rows(), 12);
  EXPECT_EQ(p.assembly.rank, 11);
  ASSERT_EQ(p.assembly.redundant.size(), 1u);
  const Redundancy& r = p.assembly.redundant[0];
  EXPECT_EQ(p.model.system.joint_names[static_cast<std::size_t>(r.joint)], "p6");
  for (int other : {0, 1, 2, 3, 4})  // every other pin has a part in it
    EXPECT_EQ(std::count(r.implied_by.begin(), r.implied_by.end(), other), 1) << other;
  EXPECT_TRUE(says(row_text(p.model.system, r.joint, r.row), "\"p6\""));
}

TEST(Assemble, TwoDriversThatAgreeAreRedundantNotWrong) {
  Scene s = four_bar(0.4, 0.1, 0.35, 0.3);
  s.drivers = {drive("motor", "crank", steady(1.0, 5)), drive("other motor", "crank", steady(1.0, 5))};
  const Put p = put(s);
  EXPECT_EQ(p.assembly.rank, 9);
  ASSERT_EQ(p.assembly.redundant.size(), 1u);
  EXPECT_EQ(p.assembly.redundant[0].joint, 5);
  EXPECT_EQ(p.assembly.redundant[0].implied_by, std::vector<int>{4});
}

}  // namespace
}  // namespace pintle::assemble_test
