// Only what a scene requires is run: proved by the machine instructions of an evaluation, counted and looked at one by
// one (stepping.h). The mechanism: a crank, a coupler that may bend, and a slider whose pin may be worn.

#include <gtest/gtest.h>

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/integration/integrator.h"
#include "framework/mechanism/drawing.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/stepping.h"
#include "tests/unit/worn_slider_crank.h"

namespace pintle::requires_test {
namespace {

// Everything that a mechanism can have, each once; the journal starts in the wall, so the contact is closed.
const std::string everything = std::string(R"(
gravity: [0, -9.81]
ground: {points: {far: [0.4, 0.1]}}
bodies:
  crank: {rigid: {mass: 0.3 kg, inertia: 1e-4}, points: {O: [-25 mm, 0], A: [25 mm, 0]}, pose: {at: [20 mm, 15 mm], angle: 35 deg}}
  coupler:
    beam: {from: A, to: B, section: {circle: 10 mm}, elements: 6, young: 207 GPa, poisson: 0.3, mass: 0.2 kg}
    points: {A: [0, 0], B: [120 mm, 0]}
    modes: {frame: chord, count: 2}
    damping: {ratios: 0.02}
    stiffening: axial
    pose: {at: [40 mm, 28 mm], angle: -14 deg}
  slider: {rigid: {mass: 0.14 kg, inertia: 1e-4}, points: {P: [0, 0]}, pose: {at: [157 mm, 0]}}
)") + worn_joints("1e10") + R"(drivers: {motor: {angle: [ground, crank], law: 35 deg + 150*t}}
forces:
  push: {force: [1 N, 0], at: slider.P}
  twist: {torque: 0.1 N m, on: crank}
  coil: {torsion spring: [ground, crank], stiffness: 0.1, damping: 1e-3}
  spring: {spring: [ground.far, slider.P], stiffness: 200 N/m, damping: 2, free length: 0.1}
  mount: {maxwell: [ground.far, slider.P], stiffness: 100 N/m, damping: 3}
start:
  gudgeon pin: {eccentricity: [0.11 mm, 0]}
run: {until: 1 ms, method: rkf45}
output: {every: 1 ms, frames: 3}
)";

Scene full() { return read_scene_text(everything, "everything.yaml"); }

SceneElastic& coupler(Scene& s) { return *s.bodies[1].elastic; }
void drop_load(Scene& s, const char* name) {
  std::erase_if(s.loads, [&](const SceneLoad& l) { return l.name == name; });
}

/// What can be taken away without touching the rest.
struct Feature {
  const char* name;
  void (*remove)(Scene&);
};
void PrintTo(const Feature& f, std::ostream* out) { *out << f.name; }
const Feature features[] = {
    {"gravity",
     [](Scene& s) {
       s.gravity = {0, 0};
     }},
    {"friction", [](Scene& s) { s.joints[2].clearance->friction.reset(); }},
    {"driver", [](Scene& s) { s.drivers.clear(); }},
    {"force", [](Scene& s) { drop_load(s, "push"); }},
    {"torque", [](Scene& s) { drop_load(s, "twist"); }},
    {"torsion spring", [](Scene& s) { drop_load(s, "coil"); }},
    {"spring", [](Scene& s) { drop_load(s, "spring"); }},
    {"internal state", [](Scene& s) { drop_load(s, "mount"); }},
    {"contact", [](Scene& s) { s.joints.erase(s.joints.begin() + 2), s.start_journals.clear(); }},
    {"stiffening", [](Scene& s) { coupler(s).stiffening = Stiffening::none; }},
    {"second shape", [](Scene& s) { coupler(s).modes->keep.count = 1; }},
    {"shapes",
     [](Scene& s) {
       coupler(s).modes.reset();
       coupler(s).damping.reset();
       coupler(s).stiffening = Stiffening::none;
     }},
};
/// A model at its start, ready to be evaluated.
struct Posed {
  explicit Posed(const Scene& scene) : model(build(scene)), eq(model.system) {
    state = assemble(scene, model).start;
    state.impact_rate.assign(model.system.contacts.size(), 1.0);  // closed
    dy.setZero(model.system.n_y());
    evaluate();
  }
  void evaluate() { regular = pintle::evaluate(model.system, state, eq, dy); }
  Model model;
  Equations eq;
  State state;
  Eigen::VectorXd dy;
  bool regular = false;
};
std::optional<long> instructions(const Scene& scene) {
  Posed at(scene);
  EXPECT_TRUE(at.regular);
  const std::optional<Stepped> run = stepped([&] { at.evaluate(); });
  return run ? std::optional(run->instructions) : std::nullopt;
}
constexpr const char* cannot = "this machine does not let a program step through itself";

struct Removing : testing::TestWithParam<Feature> {};

// With unit/dynamics/budget_test.cpp, where a step is six evaluations whatever the scene has, and with what follows, that an
// integrator looks for contacts only where there are some: no step becomes more expensive.
TEST_P(Removing, MakesAnEvaluationCheaper) {
  Scene scene = full();
  const std::optional<long> with = instructions(scene);
  GetParam().remove(scene);
  const std::optional<long> without = instructions(scene);
  if (!with || !without) GTEST_SKIP() << cannot;
  EXPECT_LT(*without, *with);
}
INSTANTIATE_TEST_SUITE_P(Each, Removing, testing::ValuesIn(features), [](const auto& feature) {
  std::string name = feature.param.name;
  std::erase(name, ' ');
  return name;
});

// ---- what is not there is not entered -----------------------------------------------------------

/// Functions that one kind of term needs and nothing else does.
using Term = std::pair<const char*, const void*>;
const std::vector<Term> terms{
    {"contact", entry_of(static_cast<ContactEffect (*)(const ContactPair&, const MarkerMotion&, const MarkerMotion&, double,
                                                       const DryFriction&, const double*)>(evaluate))},
    {"impact law", entry_of(static_cast<NormalForce (*)(const ImpactLaw&, const Approach&)>(evaluate))},
    {"friction law", entry_of(static_cast<FrictionForce (*)(const FrictionLaw&, double, double)>(evaluate))},
    {"force or spring",
     entry_of(static_cast<ForceEffect (*)(const Force&, const MarkerMotion&, const MarkerMotion&, double, const double*, const double*)>(
         evaluate))},
    {"inertia of shapes", entry_of(evaluate_inertia)},
    {"forces on shapes", entry_of(add_forces)},
    {"rows on shapes", entry_of(to_metric)},
    {"marker on shapes", entry_of(pose_on_flexible)},
    {"speed of a marker on shapes", entry_of(move_on_flexible)}};
/// What the integrator looks for contacts with, and what draws frames.
const std::vector<Term> between_evaluations{
    {"search for contacts", entry_of(static_cast<MovingPoint (*)(const System&, int, const Eigen::VectorXd&)>(moving_point))},
    {"frame", entry_of(draw)}};

std::vector<const void*> entries(const std::vector<Term>& of) {
  std::vector<const void*> out;
  for (const Term& t : of) out.push_back(t.second);
  return out;
}
void expect_entered(const std::vector<Term>& of, const Stepped& run, bool there) {
  for (std::size_t i = 0; i < of.size(); ++i) EXPECT_EQ(run.entered[i] > 0, there) << of[i].first;
}

constexpr const char* four_bar = R"(
ground: {points: {C: [0.3, 0]}}
bodies:
  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [-50 mm, 0], A: [50 mm, 0]}, pose: {at: [0.05, 0]}}
  coupler: {rigid: {mass: 0.5, inertia: 1e-2}, points: {A: [-150 mm, 0], B: [150 mm, 0]}, pose: {at: [0.25, 0.05], angle: 40 deg}}
  rocker: {rigid: {mass: 0.4, inertia: 5e-3}, points: {B: [0, 0.1], C: [0, -0.1]}, pose: {at: [0.3, 0.1]}}
joints:
  main bearing: {revolute: [ground, crank.O]}
  crank pin: {revolute: [crank.A, coupler.A]}
  rocker pin: {revolute: [coupler.B, rocker.B]}
  rocker bearing: {revolute: [ground.C, rocker.C]}
start: {crank: {angle: 10 deg, speed: 10 rad/s}}
run: {until: 1 ms}
)";

TEST(Required, ARigidFourBarHasNineCoordinatesNoModalStorageAndNoContactLoop) {
  Posed at(read_scene_text(four_bar, "four_bar.yaml"));
  const System& s = at.model.system;
  EXPECT_EQ(s.n(), 9);
  EXPECT_EQ(s.n_rows(), 8);
  EXPECT_EQ(s.n_y(), 18) << "no integral of the ledger";
  EXPECT_EQ(s.contacts.size() + s.forces.size() + at.eq.contact.size() + at.eq.force.size() + at.state.impact_rate.size(), 0u);
  Eigen::Index modal = 0;
  for (const Marker& m : s.markers) modal += m.shape.size() + m.slope.size() + m.second[0].size() + m.second[1].size();
  for (const MarkerMotion& m : at.eq.motion) modal += m.flex.size();
  for (const RowBlock& B : at.eq.B_eta) modal += B.size();
  for (const RowBlock& B : at.eq.B_eta_hat) modal += B.size();
  EXPECT_EQ(modal + static_cast<Eigen::Index>(at.eq.flexible.size() + at.eq.B_hat.size()), 0);
  const std::optional<Stepped> run = stepped([&] { at.evaluate(); }, entries(terms));
  if (!run) GTEST_SKIP() << cannot;
  expect_entered(terms, *run, false);
}

TEST(Required, TheFunctionsWatchedAreThoseThatTheirTermsRun) {
  Posed at(full());
  const std::optional<Stepped> run = stepped([&] { at.evaluate(); }, entries(terms));
  if (!run) GTEST_SKIP() << cannot;
  expect_entered(terms, *run, true);
}

constexpr const char* pendulum = R"(
bodies: {rod: {rigid: {mass: 0.5 kg, inertia: 0.01}, points: {O: [-20 cm, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0, speed: 3}}
run: {until: 1 s, method: rkf45}
)";
// An explicit step knows the gap at its end from its last evaluation; an implicit one looks for it.
constexpr const char* worn = R"(
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 0.5 kg, inertia: 0.01}, points: {O: [-20 cm, 0]}}}
joints:
  hinge: {revolute: [ground, rod.O], clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: ground,
          normal: {lankarani-nikravesh: {restitution: 0.8, stiffness: 1e9}}}}
start: {rod: {angle: 0, speed: 0}}
run: {until: 1 s, method: generalized-alpha}
)";

/// The instructions of one step that is accepted, the second of the run.
std::optional<Stepped> second_step(const char* text) {
  const Scene scene = read_scene_text(text, "step.yaml");
  const Model model = build(scene);
  Integrator run(model.system, model.scheme, assemble(scene, model).start);
  EXPECT_TRUE(run.advance(1));
  EXPECT_LT(run.state().t, 1);
  std::vector<Term> all = terms;
  all.insert(all.end(), between_evaluations.begin(), between_evaluations.end());
  return stepped([&] { run.advance(1); }, entries(all));
}

TEST(Required, AStepOfAPendulumEntersNoTermThatItLacks) {
  const std::optional<Stepped> run = second_step(pendulum);
  if (!run) GTEST_SKIP() << cannot;
  EXPECT_GT(run->instructions, 1000);
  for (const long entered : run->entered) EXPECT_EQ(entered, 0);
}

TEST(Required, AStepLooksForContactsWhereAPinIsWorn) {
  const std::optional<Stepped> run = second_step(worn);
  if (!run) GTEST_SKIP() << cannot;
  EXPECT_GT(run->entered[terms.size()], 0) << "search for contacts";
}

// A law of time asks once for itself each time it is called.
TEST(Required, LawsOfDriversAndLoadsAreAskedWhereTheyAreAlone) {
  long asked = 0;
  const Law law{[&](double t) { return ++asked, Jet{3 * t, 3, 0}; }, "", false};
  Scene scene = read_scene_text(pendulum, "pendulum.yaml");
  const auto asked_in_ten_steps = [&] {
    const Model model = build(scene);
    Integrator run(model.system, model.scheme, assemble(scene, model).start);
    asked = 0;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(run.advance(1));
    return asked;
  };
  EXPECT_EQ(asked_in_ten_steps(), 0);
  scene.drivers = {{"motor", DriverKind::angle, {"ground", "", {}}, {"rod", "", {}}, law, {}}};
  EXPECT_GT(asked_in_ten_steps(), 60) << "position and speed of six evaluations a step";
}

// A row has each output once. Looks at a condition are at eighths of a step, at its end for the guard and for sizes, and at its start.
TEST(Required, AConditionIsReadOnceAtEachLook) {
  constexpr int steps = 10;
  long read = 0;
  Scene scene = read_scene_text(std::string(pendulum) + R"(
events: {pulled: {when: "max(hinge.fx^2 + hinge.fy^2, 1 N^2) > 1e6 N^2 && hinge.fx^2 + hinge.fy^2 > 1e7 N^2", do: {row: true}}}
)",
                                "step.yaml");
  scene.outputs.push_back({"counter", {[&](double) { return ++read, Jet{}; }, "", false}, "", {}});
  const Model model = build(scene);
  Integrator run(model.system, model.scheme, assemble(scene, model).start);
  read = 0;
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(run.advance(1));
  EXPECT_GE(read, 2 * steps);
  EXPECT_LE(read, 2 * (steps * (8 + 1 + 2 + 1) + 1)) << "of two comparisons, and where the first step starts";
}

TEST(Required, FramesAreDrawnWhereTheSceneAsksForThemAlone) {
  for (const int frames : {0, 3}) {
    Scene scene = full();
    scene.output.frames = frames;
    scene.run.until = 1e-5;
    const Model model = build(scene);
    EXPECT_EQ(model.drawings.size(), frames > 0 ? 1u : 0u) << "shapes at all drawn points";
    int drawn = 0;
    Listeners listeners;
    listeners.frame = [&](const State&, const Equations&) { ++drawn; };
    EXPECT_EQ(simulate(scene, model, assemble(scene, model), listeners).status, Status::finished);
    EXPECT_EQ(drawn, frames);
  }
}

}  // namespace
}  // namespace pintle::requires_test
