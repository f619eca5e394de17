// Differentials and the planetary trains made of them, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/configuration/equilibrium.h"
#include "framework/build/inertia_defaults.h"
#include "framework/scene/error.h"
#include "tests/scenes/mechanisms.h"

namespace pintle::differential_test {
namespace {

using pintle_scenes::angle_driver;
using pintle_scenes::body;
using pintle_scenes::joint;
using pintle_scenes::law;
using pintle_scenes::point;
using pintle_scenes::ref;
using pintle_scenes::torque;
using pintle_scenes::Whole;

SceneJoint differential(const std::string& name, const std::string& a, const std::string& b, const std::string& cage, double ratio) {
  SceneJoint j = joint(name, JointKind::differential, a, b);
  if (!cage.empty()) j.c = ref(cage);
  j.ratio = ratio;
  return j;
}

constexpr double arm_length = 0.04, J_sun = 1e-3, J_planet = 8e-4, J_arm = 11.2e-3, m_planet = 1;
constexpr double in = 0.5, load = -0.4;  // [N m]

// Sun of 20 teeth, planet of 20, ring of 60, which is the ground.
Scene planetary() {
  Scene s;
  s.gravity = {0, 0};
  s.bodies = {body("sun", 0.5, J_sun, {}), body("planet", m_planet, J_planet, {}), body("arm", 1, J_arm, {point("P", arm_length)})};
  s.bodies[1].at = {arm_length, 0};
  s.joints = {joint("sun bearing", JointKind::revolute, "ground", "sun"), joint("arm bearing", JointKind::revolute, "ground", "arm"),
              joint("planet pin", JointKind::revolute, "arm.P", "planet"), differential("sun and planet", "sun", "planet", "arm", 1),
              differential("planet and ring", "planet", "ground", "arm", -3)};
  s.loads = {torque("motor", "sun", law(in)), torque("load", "arm", law(load))};
  s.run.until = 0.5;
  s.run.tolerance = 1e-10;
  s.output.every = 0.05;
  return s;
}

class Planetary : public testing::TestWithParam<const char*> {};

TEST_P(Planetary, TurnsByWillisAndSpeedsUpAsOneInertia) {
  Scene s = planetary();
  s.run.method = GetParam();
  const bool implicit = s.run.method == "generalized-alpha";
  if (implicit) s.run.tolerance = 1e-8;
  const Whole w = pintle_scenes::run(s);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const double J = J_sun + (J_arm + m_planet * arm_length * arm_length) / 16 + J_planet / 4, acceleration = (in + load / 4) / J;
  const auto t = w.column("t [s]"), sun = w.column("sun.angle [rad]"), arm = w.column("arm.angle [rad]"),
             planet = w.column("planet.angle [rad]");
  const double exact = 1e-9, near = implicit ? 1e-5 : exact;  // of 100 rad
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_NEAR(sun[i], acceleration * t[i] * t[i] / 2, 100 * near);
    EXPECT_NEAR(arm[i], sun[i] / 4, 100 * exact);
    EXPECT_NEAR(planet[i], -sun[i] / 2, 100 * exact);
  }
}
INSTANTIATE_TEST_SUITE_P(Each, Planetary, testing::Values("dopri5", "verner87", "generalized-alpha"),
                         [](const auto& p) { return std::string(p.param).substr(0, p.param[0] == 'g' ? 11 : std::string::npos); });

// A motor that holds the sun meets the load by a quarter, the ring by the rest: on the planet's side of its gear a couple of −ratio λ.
TEST(Differential, SharesCouplesByVirtualWork) {
  Scene s = planetary();
  s.loads = {torque("load", "arm", law(load))};
  s.drivers = {angle_driver("brake", "ground", "sun", law(0))};
  const Scene ready = ready_for_statics(s);
  const Model model = build(ready);
  const Equilibrium rest = find_equilibrium(ready, model, assemble(ready, model));
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.table.column("brake.torque on sun [N m]").at(0), -load / 4, 1e-12);
  // On the arm: the load and what both differentials leave to it, on the planet nothing in all.
  EXPECT_NEAR(
      rest.table.column("sun and planet.torque on planet [N m]").at(0) + rest.table.column("planet and ring.torque on planet [N m]").at(0),
      0, 1e-12);
}

TEST(Differential, WithoutACageTurnsAgainstTheGround) {
  Scene s;
  s.gravity = {0, 0};
  s.bodies = {body("left", 1, 2e-3, {}), body("right", 1, 5e-3, {})};
  s.joints = {joint("one", JointKind::revolute, "ground", "left"), joint("two", JointKind::revolute, "ground", "right"),
              differential("gears", "left", "right", "", 2.5)};
  s.loads = {torque("motor", "left", law(0.1))};
  s.run.until = 0.3;
  s.output.every = 0.1;
  const Whole w = pintle_scenes::run(s);
  const double acceleration = 0.1 / (2e-3 + 5e-3 / (2.5 * 2.5));
  EXPECT_NEAR(w.column("left.speed [rad/s]").back(), 0.3 * acceleration, 1e-7);
  EXPECT_NEAR(w.column("right.speed [rad/s]").back(), -0.3 * acceleration / 2.5, 1e-7);
}

TEST(Differential, NeedsThreeBodiesAndARatio) {
  Scene s = planetary();
  s.joints[3] = differential("sun and planet", "sun", "planet", "planet", 1);
  EXPECT_THROW(build(s), SceneError);
  s.joints[3] = differential("sun and planet", "sun", "planet", "arm", 0);
  EXPECT_THROW(build(s), SceneError);
  s.joints[3] = differential("sun and planet", "sun", "ground", "", 1);
  EXPECT_THROW(build(s), SceneError);
}

}  // namespace
}  // namespace pintle::differential_test
