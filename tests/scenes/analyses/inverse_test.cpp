// Driving efforts: against virtual power, and by driving with what was found.
#include "framework/analysis/kinematics/inverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/build/build.h"
#include "framework/scene/units/table.h"
#include "tests/scenes/flexible/flexible_scenes.h"

namespace pintle_scenes::inverse_test {
namespace {

using namespace pintle;
using namespace pintle_oracle;

constexpr double closed_form = 1e-9;  ///< relative to the greatest torque

struct Answer {
  Model model;
  Inverse found;
  const std::vector<double>& effort() const { return found.drivers.at(0).value; }
  const std::vector<double>& times() const { return found.drivers.at(0).t; }
  double largest() const {
    double out = 0;
    for (double v : effort()) out = std::max(out, std::abs(v));
    return out;
  }
};
Answer answer_to(const Scene& scene) {
  Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  Inverse found = inverse(scene, model, assembly);
  return {std::move(model), std::move(found)};
}

constexpr FourBar bars{0.4, 0.1, 0.35, 0.25, true};
const LinkMass masses[3] = {{0.5, 1e-3, 0.5}, {1.2, 2e-2, 0.4}, {0.9, 8e-3, 0.55}};

TEST(Inverse, TheTorqueOnAFourBarIsThatOfVirtualPower) {
  Scene s = four_bar(bars, masses, 9.81, 0.3, 12, -5);
  s.run.until = 1.5;
  const Answer a = answer_to(s);
  ASSERT_EQ(a.found.run.status, Status::finished) << a.found.run.reason;
  EXPECT_TRUE(a.found.by_algebra);
  for (std::size_t k = 0; k < a.times().size(); k += 7) {
    const double t = a.times()[k];
    EXPECT_NEAR(a.effort()[k], crank_torque(bars, {0.3 + 12 * t - 2.5 * t * t, 12 - 5 * t, -5}, masses, 9.81), closed_form * a.largest())
        << t;
  }
}

// The run with the driver as a constraint comes to the same forces another way.
TEST(Inverse, JointForcesAreThoseOfARunWithTheSameDriver) {
  Scene s = four_bar(bars, masses, 9.81, 0.3, 12, -5);
  s.run.until = 0.5, s.output.every = 0.01, s.run.tolerance = 1e-11;
  const Answer a = answer_to(s);
  const Whole r = run(s);
  ASSERT_EQ(a.found.run.trajectory.header, r.run.trajectory.header);
  for (const std::string& column : r.run.trajectory.header) {
    const auto x = a.found.run.trajectory.column(column), y = r.column(column);
    double size = 1e-3, most = 0;  // a column may hold zeros
    for (std::size_t k = 0; k < y.size(); ++k) size = std::max(size, std::abs(y[k])), most = std::max(most, std::abs(x[k] - y[k]));
    EXPECT_LT(most, 1e-8 * size) << column;
  }
}

// Driven by the torque that was found, instead of by the driver.
Scene driven_by(Scene s, const Answer& a, const std::string& on, StartBody start) {
  const Spline spline(Samples{a.times(), a.effort()});
  s.drivers.clear();
  s.loads.push_back(torque("found", on, {[spline](double t) { return spline(t); }, "found", false}));
  s.start_bodies = {std::move(start)};
  s.run.tolerance = 1e-12;
  return s;
}

TEST(Inverse, AFourBarDrivenByTheTorqueFoundLandsOnItsMotion) {
  Scene s = four_bar(bars, masses, 9.81, 0.3, 6, 4);
  s.run.until = 1, s.output.every = 0.1;
  const Answer a = answer_to(s);
  const Whole r = run(driven_by(s, a, "crank", start_angle("crank", 0.3, 6)));
  ASSERT_EQ(r.run.status, Status::finished) << r.run.reason;
  EXPECT_NEAR(r.last("crank.angle [rad]"), 0.3 + 6 + 2, 1e-8);
  EXPECT_NEAR(r.last("crank.speed [rad/s]"), 10, 1e-7);
}

TEST(Inverse, ASliderCrankDrivenByTheTorqueFoundLandsOnItsMotion) {
  pintle_scenes::SliderCrank o;
  o.clearance = 0, o.driven = true, o.speed = 50, o.until = 0.2, o.outputs = 20;
  Scene s = scene(o);
  const Answer a = answer_to(s);
  const Whole r = run(driven_by(s, a, "crank", start_angle("crank", 0, 50)));
  ASSERT_EQ(r.run.status, Status::finished) << r.run.reason;
  EXPECT_NEAR(r.last("crank.angle [rad]"), 10, 1e-8);
}

// Distance drivers: the thrust of a jack under a beam, moments about the pivot by hand.
TEST(Inverse, TheThrustOfAJackBalancesMoments) {
  Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("O", 0), point("J", 0.5, -0.6)};
  s.bodies = {body("beam", 20, 1.5, {point("O", -0.5), point("end", 0.5)})};
  s.bodies[0].at = {0.5, 0};
  s.joints = {joint("pivot", JointKind::revolute, "ground.O", "beam.O")};
  const double start = std::hypot(0.5, 0.6);
  s.drivers = {{"jack", DriverKind::distance, ref("ground.J"), ref("beam.end"), law(start, 0.1, 0.2), {}}};
  s.run.until = 1, s.output.every = 0.05;
  const Answer a = answer_to(s);
  ASSERT_EQ(a.found.run.status, Status::finished) << a.found.run.reason;
  const double J = 1.5 + 20 * 0.25;
  for (std::size_t k = 0; k < a.times().size(); k += 5) {
    // length² = 1 + |J|² − 2 J·(cos θ, sin θ)
    const double t = a.times()[k], l = start + 0.1 * t + 0.1 * t * t, v = 0.1 + 0.2 * t, gx = 0.5, gy = -0.6, g2 = gx * gx + gy * gy;
    const double theta = std::acos((1 + g2 - l * l) / (2 * std::sqrt(g2))) + std::atan2(gy, gx);
    const double arm = gx * std::sin(theta) - gy * std::cos(theta);  // l dl/dθ
    const double w = l * v / arm, bend = gx * std::cos(theta) + gy * std::sin(theta);
    const double alpha = (v * v + l * 0.2 - bend * w * w) / arm;
    const double thrust = (J * alpha + 20 * 9.81 * 0.5 * std::cos(theta)) / (arm / l);
    EXPECT_NEAR(a.effort()[k], thrust, closed_form * a.largest()) << t;
  }
}

TEST(Inverse, ASceneWithoutDriversIsRefused) { EXPECT_THROW(answer_to(pendulum(Hanging::by_pin, 1)), SceneError); }

// --- bodies that bend ---

// A cranked arm that turns evenly about one end, without gravity: its spin bends it, and with the right start nothing
// rings.
std::string arm(const std::string& law, double until) {
  return R"(
ground: {points: {O: [0, 0]}}
bodies:
  arm:
    beam: {through: [A, C, B], section: {rectangle: [10 mm, 10 mm]}, young: 70 GPa, poisson: 0.3, density: 2700, elements: 4, theory: euler}
    points: {A: [0, 0], C: [0.4, 0], B: [0.4, 0.2]}
    modes: {frame: {tangent: A}, craig-bampton: {count: 2}}
joints: {hub: {revolute: [ground.O, arm.A]}}
drivers: {motor: {angle: [ground.O, arm.A], law: ")" +
         law + R"("}}
output: {points: [arm.B]}
run: {until: )" +
         std::to_string(until) + R"(, tolerance: 1e-10}
)";
}

TEST(Inverse, AnEvenlyTurningFlexibleArmKeepsItsShape) {
  const Answer a = answer_to(scene_of(arm("40*t", 0.05)));
  ASSERT_EQ(a.found.run.status, Status::finished) << a.found.run.reason;
  EXPECT_FALSE(a.found.by_algebra);
  const auto stretch = a.found.run.trajectory.column("arm.B.ux [m]"), across = a.found.run.trajectory.column("arm.B.uy [m]");
  const double size = std::hypot(stretch.front(), across.front());
  EXPECT_GT(size, 1e-9) << "its own spin bends it";
  for (std::size_t k = 0; k < stretch.size(); ++k) {
    EXPECT_NEAR(stretch[k], stretch.front(), 1e-5 * size);
    EXPECT_NEAR(across[k], across.front(), 1e-5 * size);
  }
}

// A smooth turn through 1 rad in 0.2 s, then driven by the torque found. The difference is that of the spline through
// a torque which rings at the arm's own frequencies, of some 4000 rows, and its growth in time.
TEST(Inverse, AFlexibleArmDrivenByTheTorqueFoundLandsOnItsMotion) {
  Scene s = scene_of(arm("step(t, 0, 0.2)", 0.2));
  const Answer a = answer_to(s);
  ASSERT_EQ(a.found.run.status, Status::finished) << a.found.run.reason;
  EXPECT_EQ(a.times().size(), 4097u);
  const Spline spline(Samples{a.times(), a.effort()});
  s.drivers.clear();
  s.loads = {torque("found", "arm.A", {[spline](double t) { return spline(t); }, "found", false})};
  s.start_bodies = {start_angle("arm", 0, 0)};
  const Whole r = run(s);
  EXPECT_NEAR(r.last("arm.angle [rad]"), 1, 1e-5);
}

}  // namespace
}  // namespace pintle_scenes::inverse_test
