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
using Eigen::MatrixXd;
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

// ---- many rows ---------------------------------------------------------------------------------

// Rods of length 0.1 hung in a row, angles and spins at random but the same each time.
struct Chain {
  System system;
  State state;
};
Chain chain(int links) {
  constexpr double half = 0.05, m = 0.2, J = m * 0.01 / 12;
  Chain c;
  c.system.gravity = {0.3, -9.81};
  c.system.markers.push_back({});
  for (int i = 0; i < links; ++i) {
    c.system.bodies.push_back({"link", m, J});
    c.system.markers.push_back({i, {-half, 0}, 0});
    c.system.markers.push_back({i, {half, 0}, 0});
    c.system.joints.emplace_back(Revolute{2 * i, 2 * i + 1});
    c.system.joint_names.push_back("pin");
  }
  c.system.length = half;
  number(c.system);
  c.state.y.setZero(c.system.n_y());
  Vector2d end(0, 0), end_rate(0, 0);
  for (int i = 0; i < links; ++i) {
    const double angle = 1.5 * std::sin(3.0 * i), spin = 2 * std::cos(5.0 * i);
    const Vector2d u(std::cos(angle), std::sin(angle));
    c.state.y.segment<3>(3 * i) << end + half * u, angle;
    c.state.y.segment<3>(c.system.n() + 3 * i) << end_rate + half * spin * perp(u), spin;
    end += 2 * half * u;
    end_rate += 2 * half * spin * perp(u);
  }
  return c;
}

// [M Cqᵀ; Cq 0] [a; λ] = [f; γ], written down for this chain alone and solved densely.
VectorXd reference_accelerations(const Chain& c) {
  constexpr double half = 0.05;
  const int n = c.system.n(), rows = c.system.n_rows();
  MatrixXd K = MatrixXd::Zero(n + rows, n + rows);
  VectorXd r = VectorXd::Zero(n + rows);
  for (int i = 0; i < n / 3; ++i) {
    const Body& b = c.system.bodies[static_cast<std::size_t>(i)];
    K.diagonal().segment<3>(3 * i) << b.m, b.m, b.J;
    r.segment<2>(3 * i) = b.m * c.system.gravity;
    const double angle = c.state.y[3 * i + 2], spin = c.state.y[n + 3 * i + 2];
    const Vector2d u = half * Vector2d(std::cos(angle), std::sin(angle));
    // Pin i: r_i − u − (r_j + u_j) = 0; its second derivative holds +spin² u + spin_j² u_j.
    const int row = n + 2 * i;
    K.block<2, 2>(row, 3 * i).setIdentity();
    K.block<2, 1>(row, 3 * i + 2) = -perp(u);
    r.segment<2>(row) -= spin * spin * u;
    if (i + 1 < n / 3) {
      K.block<2, 2>(row + 2, 3 * i) = -MatrixXd::Identity(2, 2);
      K.block<2, 1>(row + 2, 3 * i + 2) = -perp(u);
      r.segment<2>(row + 2) -= spin * spin * u;
    }
  }
  K.topRightCorner(n, rows) = K.bottomLeftCorner(rows, n).transpose();
  return K.partialPivLu().solve(r).head(n);
}

TEST(Schur, IsSparseAboveFortyEightRowsAndGivesTheSameAccelerations) {
  for (int links : {1, 5, 24, 25, 60}) {
    const Chain c = chain(links);
    Equations eq(c.system);
    VectorXd dy(c.system.n_y());
    ASSERT_TRUE(evaluate(c.system, c.state, eq, dy));
    EXPECT_EQ(eq.schur.sparse(), 2 * links > 48);
    const VectorXd a = reference_accelerations(c);
    // Condition number of S grows with the square of the links, 1e4 for sixty.
    EXPECT_LT((dy.segment(c.system.n(), c.system.n()) - a).norm(), 1e-10 * a.norm()) << links;
  }
}

TEST(Schur, AnAccelerationOfAChainOfAThousandDoesNotAllocate) {
  Chain c = chain(1000);
  Equations eq(c.system);
  VectorXd dy(c.system.n_y());
  ASSERT_STREQ(eq.schur.solver(), "sparse (LDL)");
  bool regular = true;
  EXPECT_EQ(allocated([&] {
              for (int i = 0; i < 3; ++i) {
                c.state.y[2] += 1e-6;
                regular = regular && evaluate(c.system, c.state, eq, dy);
              }
            }),
            0);
  EXPECT_TRUE(regular);
}

// Entries of L, and bytes, a body: the same at 100 and at 10 000 links.
TEST(Schur, AChainsFactorAndMemoryGrowWithTheLinks) {
  const auto measure = [](int links) {
    const Chain c = chain(links);
    const long before = heap_in_use();
    const Equations eq(c.system);
    const long bytes = before < 0 ? 0 : heap_in_use() - before;
    return std::pair(eq.schur.nonzeros() / links, static_cast<double>(bytes) / links);
  };
  const auto [few_entries, few_bytes] = measure(100);
  const auto [many_entries, many_bytes] = measure(10'000);
  EXPECT_LT(many_entries, 1.05 * few_entries);
  EXPECT_LT(many_bytes, 1.2 * few_bytes);
}

TEST(Schur, DenseDependentRowsDoNotAllocate) {
  Chain c = chain(3);
  for (int k : {1, 2}) c.system.joints.push_back(c.system.joints[static_cast<std::size_t>(k)]);
  c.system.joint_names.resize(c.system.joints.size());
  number(c.system);
  Equations eq(c.system);
  pose(c.system, 0, c.state.y, eq);
  VectorXd mu = VectorXd::Ones(c.system.n_rows());
  factor(c.system, c.state.y, eq);
  EXPECT_EQ(allocated([&] {
              factor(c.system, c.state.y, eq);
              eq.schur.solve(mu);
            }),
            0);
  EXPECT_TRUE(eq.schur.dependent());
}
}  // namespace
}  // namespace pintle::budget_test
