// Facts about cost that do not depend on the machine: counts, no times. An executable of its own,
// because it counts every allocation of the process.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/integration/integrator.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/heap.h"
#include "tests/unit/rods.h"

namespace pintle::budget_test {
namespace {

using namespace rods;
using Eigen::Vector2d;
using Eigen::VectorXd;

TEST(AllocationCounter, SeesNewMallocAndEigen) {
  const std::size_t size = 1000 + static_cast<std::size_t>(std::rand() % 2);
  std::unique_ptr<std::vector<double>> made;
  void* (*volatile take)(std::size_t) = std::malloc;  // plain malloc may be moved by the compiler
  void* block = nullptr;
  VectorXd x;
  EXPECT_EQ(allocated([] {}), 0);
  EXPECT_GE(allocated([&] { made = std::make_unique<std::vector<double>>(size); }), 2);
  EXPECT_GE(allocated([&] { block = take(size); }), 1);
  const long before = heap_in_use();
  EXPECT_GE(allocated([&] { x.setZero(static_cast<Eigen::Index>(size)); }), 1);
  if (before >= 0) {
    const auto bytes = static_cast<long>(size * sizeof(double));
    EXPECT_LE(std::abs(heap_in_use() - before - bytes), 64) << "what is taken";
    x.resize(0);
    EXPECT_EQ(heap_in_use(), before) << "and what is given back";
  }
  std::free(block);
}

// ---- the slider-crank, as a scene ---------------------------------------------------------------

Scene slider_crank() {
  Scene s;
  s.gravity = {0, -9.81};
  SceneBody slider;
  slider.name = "slider";
  slider.mass = 0.14;
  slider.inertia = 1e-4;
  slider.at = {0.17, 0};
  s.bodies = {rod("crank", 0.05, {0, 0}, 0.3), rod("coupler", 0.12, {0.05, 0.01}, 0), slider};
  s.joints = {joint("bearing", JointKind::revolute, {"ground", "", {}}, {"crank", "A", {}}),
              joint("crank pin", JointKind::revolute, {"crank", "B", {}}, {"coupler", "A", {}}),
              joint("gudgeon pin", JointKind::revolute, {"coupler", "B", {}}, {"slider", "", {}}),
              joint("guide", JointKind::prismatic, {"ground", "", {}}, {"slider", "", {}})};
  StartBody crank;
  crank.body = "crank";
  crank.angle = 0.3;
  crank.speed = 50;
  s.start_bodies = {crank};
  return s;
}
void add_driver(Scene& s) {
  SceneDriver d;
  d.name = "motor";
  d.a = {"ground", "", {}};
  d.b = {"crank", "", {}};
  d.law = {[](double t) { return Jet{0.3 + 50 * t, 50, 0}; }, "", false};
  s.drivers = {d};
}
void add_springs(Scene& s) {
  const auto law = [](double t) { return Jet{std::sin(30 * t), 0, 0}; };
  const PointRef wall{"ground", "", {}}, slider{"slider", "", {}}, crank{"crank", "", {}};
  s.loads = {{"spring", SceneSpring{wall, slider, 200, 2, 0.1}, {}},
             {"coil", SceneTorsionSpring{wall, crank, 0.1, 1e-3, 0}, {}},
             {"push", SceneForce{slider, {law, "", false}, {law, "", false}, true}, {}},
             {"twist", SceneTorque{wall, crank, {law, "", false}}, {}}};
}
void add_clearance(Scene& s) {
  SceneClearance c;
  c.radial = 1e-4;
  c.bearing_radius = 0.01;
  c.bearing = "slider";
  c.normal.stiffness = 1e10;
  c.normal.restitution = 0.9;
  c.friction.emplace().coefficient = 0.05;
  s.joints[2].clearance = c;
}

// A coupler of two shapes, its axes and points as of the rigid one.
void bend_coupler(Scene& s, const char* stiffening) {
  const SceneBody rigid = s.bodies[1];
  s.bodies[1] = read_scene_text(
                    "bodies:\n  coupler:\n"
                    "    beam: {from: A, to: B, section: {circle: 10 mm}, elements: 10,\n"
                    "           young: 20 GPa, poisson: 0.3, mass: 0.24 kg}\n"
                    "    points: {A: [0, 0], B: [0.12, 0]}\n"
                    "    modes: {frame: chord, count: 2}\n    damping: {ratios: 0.02}\n"
                    "    stiffening: " +
                        std::string(stiffening) + "\n",
                    "coupler.yaml")
                    .bodies[0];
  s.bodies[1].at = rigid.at;
  s.bodies[1].angle = rigid.angle;
}

TEST(Budget, RigidSliderCrankHasNineCoordinatesAndEightRows) {
  Scene s = slider_crank();
  const System ideal = build(s).system;
  EXPECT_EQ(ideal.n(), 9);
  EXPECT_EQ(ideal.n_rows(), 8);
  EXPECT_EQ(ideal.n_z(), 0);
  EXPECT_EQ(ideal.n_y(), 18);
  add_clearance(s);
  const System loose = build(s).system;
  EXPECT_EQ(loose.n(), 9);
  EXPECT_EQ(loose.n_rows(), 6);
  EXPECT_EQ(loose.n_z(), 3);  // hysteresis, friction, and what the scheme takes should it turn implicit
}

TEST(Budget, RigidMechanismHasNothingFlexible) {
  Scene s = slider_crank();  // the slider on a rocker of its own: a four-bar
  s.bodies[2] = rod("rocker", 0.08, {0.17, 0.08}, -1.6);
  s.joints[2].b = {"rocker", "B", {}};
  s.ground = {{"hub", {0.17, 0.08}, 0, {}}};
  s.joints[3] = joint("hub", JointKind::revolute, {"ground", "hub", {}}, {"rocker", "A", {}});
  const Model model = build(s);
  const System& system = model.system;
  EXPECT_EQ(system.n(), 9);
  EXPECT_EQ(system.n(), system.n_rigid());
  for (const Body& b : system.bodies) EXPECT_FALSE(b.flex);
  for (const Marker& m : system.markers) EXPECT_EQ(m.shape.size() + m.slope.size() + m.second[0].size() + m.second[1].size(), 0);
  const Equations eq(system);
  EXPECT_TRUE(eq.flexible.empty());
  for (const auto& B : eq.B_eta) EXPECT_EQ(B.size(), 0);
  for (const auto& B : eq.B_eta_hat) EXPECT_EQ(B.size(), 0);
  for (const MarkerMotion& m : eq.motion) EXPECT_EQ(m.flex.size(), 0);
  EXPECT_TRUE(model.drawings.empty() && model.stresses.empty());
}

// ---- allocation --------------------------------------------------------------------------------

struct Setting {
  const char* name;
  void (*add)(Scene&);
};
const Setting settings[] = {
    {"ideal", [](Scene&) {}},
    {"driven", add_driver},
    {"springs", add_springs},
    {"clearance", add_clearance},
    {"everything",
     [](Scene& s) {
       add_driver(s);
       add_springs(s);
       add_clearance(s);
     }},
    {"flexible", [](Scene& s) { bend_coupler(s, "none"); }},
    {"stiffening", [](Scene& s) { bend_coupler(s, "axial"); }},
    {"flexible with everything",
     [](Scene& s) {
       bend_coupler(s, "axial");
       add_driver(s);
       add_springs(s);
       add_clearance(s);
     }},
};

struct Method {
  const char *name, *constraints;
};
const Method schemes[] = {{"rkf45", "projection"},    {"rkf45", "partitioning"},  {"dopri5", "projection"},
                          {"dopri5", "partitioning"}, {"verner87", "projection"}, {"generalized-alpha", "projection"}};

// Only two things may allocate after the first steps: the list of impacts as it doubles, and
// partitioning at the rare steps that choose a new set of coordinates.
TEST(Budget, AdvanceDoesNotAllocateAfterTheFirstSteps) {
  for (const Setting& setting : settings)
    for (const auto& [method, constraints] : schemes) {
      SCOPED_TRACE(std::string(setting.name) + " " + method + " " + constraints);
      Scene scene = slider_crank();
      setting.add(scene);
      scene.run.method = method;
      scene.run.constraints = constraints;
      const Model model = build(scene);
      Integrator run(model.system, model.scheme, assemble(scene, model).start);
      for (int i = 0; i < 5; ++i) ASSERT_TRUE(run.advance(100));
      long in_steps = 0, at_impacts = 0;
      std::size_t begun = 0;
      for (int i = 0; i < 3000; ++i) {
        const std::size_t impacts = run.impacts().size();
        const long choices = run.counts().partitions;
        bool going = false;
        const long count = allocated([&] { going = run.advance(100); });
        ASSERT_TRUE(going) << run.failure();
        if (run.counts().partitions > choices) continue;
        if (run.impacts().size() > impacts) {
          ++begun;
          at_impacts += count;
        } else {
          in_steps += count;
        }
      }
      EXPECT_EQ(in_steps, 0);
      if (model.system.contacts.empty() || !model.scheme.tableau) continue;  // implicit steps do not come to three impacts here
      EXPECT_GT(begun, 3u) << "no impact, no exam";
      EXPECT_LE(at_impacts, 2 + std::log2(static_cast<double>(run.impacts().size())));
    }
}

TEST(Budget, SamplingDoesNotAllocate) {
  Scene scene = slider_crank();
  bend_coupler(scene, "rotation");
  add_springs(scene);
  add_clearance(scene);
  const Model model = build(scene);
  Integrator run(model.system, model.scheme, assemble(scene, model).start);
  State out;
  const auto sample = [&] {
    const Step& last = run.last();
    return run.sample(last.from.state.t + 0.5 * last.h, out);
  };
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(run.advance(10) && sample());
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(run.advance(10));
    bool settled = false;
    EXPECT_EQ(allocated([&] { settled = sample(); }), 0);
    EXPECT_TRUE(settled);
  }
}

// Both pairs need six new evaluations a step; a seventh is taken over from the step before.
TEST(Budget, AStepTakesSixEvaluations) {
  for (const char* method : {"rkf45", "dopri5"}) {
    Scene scene = slider_crank();
    scene.run.method = method;
    const Model model = build(scene);
    Integrator run(model.system, model.scheme, assemble(scene, model).start);
    const Counts before = run.counts();
    for (int i = 0; i < 500; ++i) ASSERT_TRUE(run.advance(10));
    const Counts after = run.counts();
    EXPECT_EQ(after.evaluations - before.evaluations, 6 * (after.steps + after.rejected - before.steps - before.rejected));
    // A factorization an evaluation, and up to three more where the end is projected.
    EXPECT_LE(after.factorizations - before.factorizations, 1.5 * static_cast<double>(after.evaluations - before.evaluations));
  }
}

// What is written is evaluated once, and projected onto the joints; inside the long steps of verner87 a step to the middle and twelve
// evaluations come before the first row.
TEST(Budget, ARowTakesOneEvaluation) {
  constexpr int rows = 20, corrections = 3;
  struct Pair {
    const char* method;
    long first;
  };
  for (const Pair& pair : {Pair{"rkf45", 0}, Pair{"dopri5", 0}, Pair{"verner87", 13 + 12}}) {
    Scene scene = slider_crank();
    scene.run.method = pair.method;
    const Model model = build(scene);
    Integrator run(model.system, model.scheme, assemble(scene, model).start);
    State out;
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(run.advance(10));
      const Step& last = run.last();
      ASSERT_TRUE(run.sample(last.to.state.t, out));
      const long evaluated = run.sampled().evaluations, factored = run.sampled().factorizations;
      for (int row = 1; row <= rows; ++row) ASSERT_TRUE(run.sample(last.from.state.t + row * last.h / (rows + 1), out));
      EXPECT_EQ(run.sampled().evaluations - evaluated, rows + pair.first) << pair.method;
      EXPECT_LE(run.sampled().factorizations - factored, corrections * (rows + pair.first)) << pair.method;
    }
  }
}
}  // namespace
}  // namespace pintle::budget_test
