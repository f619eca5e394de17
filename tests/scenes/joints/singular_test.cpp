// Redundant joints and singular configurations: whole runs against motions of one coordinate, integrated here.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "tests/scenes/joints/parallel_links.h"
#include "tests/refusal.h"

namespace pintle_scenes::singular_test {
namespace {

using pintle_test::says;

using namespace pintle;

// Crank and rod of equal length: with the crank upright, the slider is at the pivot and could stay there.
Scene equal_slider_crank(double angle) {
  Scene s;
  s.ground = {point("O", 0)};
  s.bodies = {link("crank", 0, 0, angle), link("rod", std::cos(angle), std::sin(angle), -angle), body("slider", 1, 0.1, {point("P", 0)})};
  s.bodies[2].at = {2 * std::cos(angle), 0};
  s.joints = {joint("pivot", JointKind::revolute, "ground.O", "crank.A"), joint("knee", JointKind::revolute, "crank.B", "rod.A"),
              joint("gudgeon", JointKind::revolute, "rod.B", "slider.P"), joint("guide", JointKind::prismatic, "ground.O", "slider.P")};
  finish(s, 3);
  s.gravity = {0, 0};
  return s;
}

Scene two_drivers(Law left, Law right) {
  Scene s = parallelograms(1, 0.5, 0, 2);
  s.start_bodies.clear();
  s.drivers = {angle_driver("motor", "ground.G0", "crank0.A", std::move(left)),
               angle_driver("other motor", "ground.G1", "crank1.A", std::move(right))};
  return s;
}
Law late(double begin) {
  return {[=](double t) {
            const double d = t > begin ? t - begin : 0;
            return Jet{0.5 + t + d * d * d, 1 + 3 * d * d, 6 * d};
          },
          "late", false};
}

std::string complaint(const Scene& s) {
  return pintle_test::refusal_by<AssemblyError>([&] { run(s); });
}

// Tolerance 1e-9 a step, hundreds of steps, and errors that grow as speeds differ: 1e-5 rad of the tens travelled.
constexpr double followed = 1e-5;

void expect_angle(const Whole& w, const std::string& name, double expected, double within = followed, double booked = 1e-6) {
  EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.last(name + ".angle [rad]"), expected, within) << name;
  EXPECT_LT(std::abs(w.run.worst_unexplained), booked * w.run.energy_in_play);
}

TEST(ParallelogramChain, PassesItsFlatPosesAsOneCoordinateDoes) {
  for (const int n : {1, 2, 5, 40}) {
    const double until = n == 40 ? 3 : 8;  // 3 and 8 flat poses
    const Whole w = run(parallelograms(n, M_PI / 2, 1, until));
    const double expected = expected_parallelograms(n, until, M_PI / 2, 1);
    for (const int i : {0, n}) expect_angle(w, numbered("crank", i), expected, n == 40 ? 1e-4 : followed, n == 40 ? 1e-5 : 1e-6);
    EXPECT_NEAR(w.last("bar0.angle [rad]"), 0, 1e-9) << "a folded branch";
    EXPECT_GT(std::abs(expected - M_PI / 2), 3 * M_PI) << "too short a run to pass flat poses";
  }
}

TEST(ParallelogramChain, GoesOnFromAFlatStartAsItsSpeedsSay) {
  for (const int n : {1, 3}) {
    const Whole w = run(parallelograms(n, 0, 3, 2));
    expect_angle(w, "crank0", expected_parallelograms(n, 2, 0, 3));
    expect_angle(w, numbered("crank", n), expected_parallelograms(n, 2, 0, 3));
    EXPECT_EQ(static_cast<int>(w.assembly.redundant.size()), n);
    for (const Redundancy& r : w.assembly.redundant) EXPECT_FALSE(r.permanent);
  }
}

TEST(ParallelogramChain, DrivenThroughFlatPosesStaysAParallelogram) {
  Scene s = parallelograms(1, 0, 0, 1);  // flat at the start, at 0.5 s and at the end, all of them outputs
  s.start_bodies = {start_angle("crank1", 0, 2 * M_PI)};
  s.start_bodies[0].angle.reset();
  s.drivers = {angle_driver("motor", "ground.G0", "crank0.A", law(0, 2 * M_PI))};
  const Whole w = run(s);
  expect_angle(w, "crank1", 2 * M_PI);
  // The torque by hand: at steady speed it bears the weight, g (½ + ½ + 1) cos θ.
  const auto torque = w.column("motor.torque on crank0 [N m]");
  const auto angle = w.column("crank0.angle [rad]");
  // In the flat pose itself speeds off by 1e-9 leave forces a thousandth.
  for (std::size_t i = 0; i < angle.size(); ++i)
    EXPECT_NEAR(torque[i], 2 * g * std::cos(angle[i]), std::abs(std::sin(angle[i])) < 1e-6 ? 1e-3 * g : 1e-5) << angle[i];
}

TEST(SliderCrank, OfEqualLengthsPassesItsBranchingPoseByMomentum) {
  for (const double angle : {0.4, M_PI / 2}) {
    Scene s = equal_slider_crank(angle);
    s.start_bodies = {start_angle("crank", angle, 2)};
    if (angle == M_PI / 2) s.start_bodies.push_back(start_angle("rod", -angle, -2));
    const Whole w = run(s);
    EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
    const auto crank = w.column("crank.angle [rad]"), x = w.column("slider.x [m]");
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], 2 * std::cos(crank[i]), 1e-8);
    EXPECT_GT(crank.back(), 4) << "too short a run to pass the pose";
    EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-6 * w.run.energy_in_play);
  }
}

TEST(SliderCrank, OfEqualLengthsIsDrivenThroughItsBranchingPose) {
  for (const double angle : {0.5, M_PI / 2}) {
    Scene s = equal_slider_crank(angle);
    s.start_bodies = {start_angle("rod", -angle, -2)};
    s.drivers = {angle_driver("motor", "ground.O", "crank.A", law(angle, 2))};
    const Whole w = run(s);
    EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_NEAR(w.last("slider.x [m]"), 2 * std::cos(angle + 6), 1e-8);
  }
}

TEST(SliderCrank, PushedBeyondItsReachStopsAtTheDeadCentreAndNamesTheDriver) {
  Scene s = equal_slider_crank(0.5);
  SceneDriver ram = angle_driver("ram", "ground.O", "slider.P", law(1.8, 0.2));  // 2 m after 1 s
  ram.kind = DriverKind::distance;
  s.drivers = {ram};
  const Whole w = run(s);
  EXPECT_EQ(w.run.status, Status::failed);
  EXPECT_NEAR(w.run.t_end, 1, 1e-3);
  EXPECT_TRUE(says(w.run.reason, "dead centre") && says(w.run.reason, "\"ram\"")) << w.run.reason;
}

// Two hinges in one place: each bears half of m (a − g), the least norm.
TEST(DoublyHingedDoor, SwingsAsAPendulumAndSharesItsWeight) {
  Scene s;
  s.ground = {point("L", 0), point("H", 0)};
  s.bodies = {body("door", 2, 0.3, {point("L", -0.5), point("H", -0.5)})};
  s.bodies[0].at = {0.5, 0};
  s.joints = {joint("lower", JointKind::revolute, "ground.L", "door.L"), joint("upper", JointKind::revolute, "ground.H", "door.H")};
  s.start_bodies = {start_angle("door", 0, 1)};
  finish(s, 2);
  for (const char* constraints : {"projection", "partitioning"}) {
    s.run.constraints = constraints;
    const Whole w = run(s);
    expect_angle(w, "door", angle_at(2, 0.3 + 0.5, g, 0, 1));
    EXPECT_EQ(w.assembly.rank, 2);
    ASSERT_EQ(w.assembly.redundant.size(), 2u);
    for (const Redundancy& r : w.assembly.redundant) EXPECT_TRUE(r.permanent && r.joint == 1);
    for (const bool shared : w.assembly.shared) EXPECT_TRUE(shared);
    const auto lower = w.column("lower.fy on door [N]"), upper = w.column("upper.fy on door [N]");
    // At the start: θ̈ = −g/0.8, the centre's acceleration downwards 0.5 θ̈.
    EXPECT_NEAR(std::abs(lower[0] + upper[0]), 2 * (g - 0.5 * g / 0.8), 1e-8);
    // Shares are sought with rows shifted by 1e-10: rounding over that, squared, times forces up to 30 N; and what speeds off by
    // 1e-13 ask.
    for (std::size_t i = 0; i < lower.size(); ++i) EXPECT_NEAR(lower[i], upper[i], 1e-9);
  }
}

TEST(ParallelCranks, MoveThoughOverconstrainedAndPassTheirFlatPoses) {
  for (const int n : {3, 5})
    for (const double angle : {0.4, 0.0}) {
      const Whole w = run(parallel_cranks(n, angle, 4, 3));
      const double expected = angle_at(3, n / 3.0 + 1, g * (n / 2.0 + 1), angle, 4);
      for (int i = 0; i < n; ++i) expect_angle(w, numbered("crank", i), expected);
      int permanent = 0;
      for (const Redundancy& r : w.assembly.redundant) permanent += r.permanent ? 1 : 0;
      EXPECT_EQ(static_cast<int>(w.assembly.redundant.size()), angle == 0 ? n - 1 : n - 2);
      EXPECT_EQ(permanent, n - 2);
    }
}

// What is redundant in every pose is no singular configuration: the pair that was chosen runs to the end, in about the steps of the
// mechanism with two cranks, which swings alike; and however the world is turned.
TEST(ParallelCranks, KeepTheMethodThatWasChosenAndItsSteps) {
  const double angle = -M_PI / 2, until = 6;  // hanging, far from flat
  long of_two = 0;
  for (const int n : {2, 3, 4, 7})
    for (const double turn : {0.0, M_PI / 6, M_PI / 2}) {
      Scene s = moved(parallel_cranks(n, angle, 1, until), 0, 0, turn);
      s.run.method = "auto", s.run.tolerance = 1e-10;
      const Whole w = run(s);
      ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
      EXPECT_EQ(w.run.switched, "") << n << " cranks, turned by " << turn;
      EXPECT_NEAR(w.last("crank0.angle [rad]") - turn, angle_at(until, n / 3.0 + 1, g * (n / 2.0 + 1), angle, 1), 1e-7) << n;
      if (of_two == 0) of_two = w.run.counts.steps;
      EXPECT_LT(w.run.counts.steps, 2 * of_two) << n << " cranks, turned by " << turn;
    }
}

// Upright, or lying if the world is turned, cranks bear along y, or x, alone: no weight of a null vector is on the other rows there.
TEST(ParallelCranks, AreLastinglyRedundantInPosesAlongTheAxes) {
  for (const int n : {3, 4, 7})
    for (const double angle : {M_PI / 2, M_PI / 2 - 0.3})
      for (const double turn : {0.0, M_PI / 6, M_PI / 2}) {
        const Scene s = moved(parallel_cranks(n, angle, 1, 1), 0, 0, turn);
        const Model model = build(s);
        const Assembly a = assemble(s, model);
        ASSERT_EQ(static_cast<int>(a.redundant.size()), n - 2);
        for (const Redundancy& r : a.redundant)
          EXPECT_TRUE(r.permanent) << row_text(model.system, r.joint, r.row) << " " << angle << " " << turn;
        for (std::size_t row = 0; row < a.shared.size(); ++row) EXPECT_TRUE(a.shared[row]) << row << " " << angle << " " << turn;
        for (const std::string& warning : warnings_of(model, a)) EXPECT_FALSE(says(warning, "singular")) << warning;
      }
}

// What statics finds can be linearized: of one coordinate, inertia θ̈ = K (θ₀ − θ) − weight cos θ.
TEST(ParallelCranks, AreLinearizedWhereTheyRest) {
  const double stiffness = 100;
  for (const int n : {2, 3, 5})
    for (const double turn : {0.0, M_PI / 2}) {
      Scene s = parallel_cranks(n, 1, 0, 1);
      s.loads = {{"spring", SceneTorsionSpring{ref("ground"), ref("crank0"), stiffness, 0, 1.2}, {}}};
      s = moved(s, 0, 0, turn);
      std::get<SceneTorsionSpring>(s.loads[0].what).free_angle = 1.2 + turn;
      const Model model = build(s);
      const Equilibrium rest = find_equilibrium(s, model, assemble(s, model));
      ASSERT_TRUE(rest.found) << rest.reason;
      const Linearization lin = linearize(s, model, rest.state, Laws::hold);
      ASSERT_EQ(lin.modes.size(), 1u);
      const double angle = rest.state.y[2] - turn, weight = g * (n / 2.0 + 1);
      EXPECT_NEAR(stiffness * (1.2 - angle), weight * std::cos(angle), 1e-9);
      EXPECT_NEAR(lin.modes[0].root.imag(), std::sqrt((stiffness - weight * std::sin(angle)) / (n / 3.0 + 1)), 1e-8);
    }
}

// A crank too long by less than `check` shows, by more than a run can close.
TEST(ParallelCranks, ThatMissByLittleAreRefusedAtOnceWithJointAndMisfit) {
  const auto with_misfit = [](double misfit) {
    Scene s = parallel_cranks(3, 0.4, 1, 1);
    s.bodies[1].points[1].at[0] += misfit;
    return s;
  };
  for (const double misfit : {3e-9, 3e-10, 1e-10}) {
    const std::string message = complaint(with_misfit(misfit));
    EXPECT_TRUE(says(message, "\"top") || says(message, "\"base")) << misfit << message;
    EXPECT_TRUE(says(message, " m remains") && says(message, "more digits")) << message;
  }
  const Whole w = run(with_misfit(3e-13));
  EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
}

// A rod whose ends ride two lines at right angles; its middle rides a circle: the crank there is one row too many.
TEST(EllipticTrammel, MovesWithAnExtraLink) {
  Scene s;
  s.ground = {point("X", 0), point("Y", 0, 0, M_PI / 2)};
  const double angle = 0.3;
  SceneBody rod = body("rod", 1, 1.0 / 3, {point("A", -1), point("M", 0), point("B", 1)});
  rod.at = {std::cos(angle), std::sin(angle)}, rod.angle = -angle;
  s.bodies = {rod, link("crank", 0, 0, angle)};
  s.joints = {joint("along x", JointKind::slot, "ground.X", "rod.B"), joint("along y", JointKind::slot, "ground.Y", "rod.A"),
              joint("pivot", JointKind::revolute, "ground.X", "crank.A"), joint("middle", JointKind::revolute, "crank.B", "rod.M")};
  s.start_bodies = {start_angle("crank", angle, 1)};
  finish(s, 3);
  const Whole w = run(s);
  expect_angle(w, "crank", angle_at(3, 1.0 / 3 + 1 + 1.0 / 3, 1.5 * g, angle, 1));
  EXPECT_NEAR(w.last("rod.angle [rad]"), -w.last("crank.angle [rad]"), 1e-9);
  ASSERT_EQ(w.assembly.redundant.size(), 1u);
  EXPECT_TRUE(w.assembly.redundant[0].permanent);
}

TEST(TwoDrivers, ThatAgreeRunAndBearTheWeightTogether) {
  const Whole w = run(two_drivers(law(0.5, 1), law(0.5, 1)));
  EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
  const auto a = w.column("motor.torque on crank0 [N m]"), b = w.column("other motor.torque on crank1 [N m]"),
             angle = w.column("crank0.angle [rad]");
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i] + b[i], 2 * g * std::cos(angle[i]), 1e-6);
}

// Shares of forces that are settled by least norm are as smooth as the motion: nothing else would hold up the steps.
TEST(TwoDrivers, ThatAgreeTakeNoMoreStepsThanOneDoes) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    Scene two = two_drivers(law(0.5, 1), law(0.5, 1));
    two.run.tolerance = tolerance;
    two.run.max_step = 10;
    Scene one = two;
    one.drivers.pop_back();
    EXPECT_LT(run(two).run.counts.steps, 2 * run(one).run.counts.steps + 10) << tolerance;
  }
}

TEST(TwoDrivers, ThatFightAreRefusedWithBothNames) {
  for (const Law& other : {law(0.6, 1), law(0.5, 1.2), law(0.5, 1, 0.3), late(0.7)}) {
    const std::string message = complaint(two_drivers(law(0.5, 1), other));
    EXPECT_TRUE(says(message, "\"motor\"") && says(message, "\"other motor\"")) << message;
  }
}

// Where their ratio changes with the pose nothing can be told beforehand.
TEST(TwoDrivers, ThatComeToFightStopTheRunWithBothNames) {
  Scene s = two_drivers(law(0.5), late(10));
  s.bodies[1] = link("crank1", 1, 0, 0.7);
  s.bodies[1].points[1].at = {0.3, 0};  // no parallelogram: 0.8 m
  const auto slow = [](double scale) {
    return Law{[=](double t) { return Jet{0.5 + scale * t * t * t, 3 * scale * t * t, 6 * scale * t}; }, "slow", false};
  };
  Scene one = s;
  one.drivers.resize(1);
  const double rocker = run(one).column("crank1.angle [rad]").front();
  s.drivers[0].law = slow(0.1);
  s.drivers[1].law = {[=](double t) { return Jet{rocker + 0.05 * t * t * t, 0.15 * t * t, 0.3 * t}; }, "other", false};
  const Whole w = run(s);
  EXPECT_EQ(w.run.status, Status::failed);
  EXPECT_TRUE(says(w.run.reason, "\"motor\"") && says(w.run.reason, "\"other motor\"")) << w.run.reason;
}

// A crank of hardly any inertia is no singular configuration: the run goes on, or names the crank and what to do.
TEST(DrivenCrank, WithHardlyAnyInertiaRunsOrIsNamed) {
  const auto crank_of = [](double inertia, const char* method) {
    Scene s = equal_slider_crank(0.5);
    s.bodies[0].mass = inertia, s.bodies[0].inertia = inertia;
    s.drivers = {angle_driver("motor", "ground.O", "crank.A", law(0.5, 1))};
    s.run.until = 0.1;
    s.run.method = method;
    return s;
  };
  for (const double inertia : {1e-9, 1e-12, 1e-16, 1e-30})
    for (const char* method : {"auto", "generalized-alpha"}) {
      const Whole w = run(crank_of(inertia, method));
      if (w.run.status == Status::finished)
        EXPECT_NEAR(w.last("crank.angle [rad]"), 0.6, 1e-9);
      else
        EXPECT_TRUE(says(w.run.reason, "the inertia of \"crank\"") && says(w.run.reason, "give \"crank\" a mass")) << w.run.reason;
      EXPECT_TRUE(w.run.status == Status::finished || inertia < 1e-9) << inertia << " " << method;
    }
}

}  // namespace
}  // namespace pintle_scenes::singular_test
