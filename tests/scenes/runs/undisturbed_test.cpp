// Steps are the same to the last bit whether or not anything is written out between them, and from each of them a saved state
// goes on as the run did.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/integration/integrator.h"
#include "framework/scene/yaml/reader.h"
#include "tests/scenes/flexible/flexible_scenes.h"

namespace pintle_scenes::undisturbed_test {
namespace {

using namespace pintle;

struct Case {
  std::string name;
  std::function<Scene()> scene;
  int steps = 80;
  std::function<void(Scheme&)> scheme = [](Scheme&) {};
  enum class Must { nothing, strike, switch_over, fall_back } must = Must::nothing;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

Scene loose(const std::string& method, const std::string& constraints = "projection") {
  return scene({.clearance = 1e-4, .friction = 0.05, .until = 0.05, .tolerance = 1e-7, .method = method, .constraints = constraints});
}

Scene linked(const std::string& method) {
  Scene s = loose(method);
  s.joints[2].clearance->model = ClearanceModel::massless_link;
  s.joints[2].clearance->friction.reset();
  s.start_journals = {{"gudgeon pin", {1e-4, 0}, {0, 0}, {}}};
  return s;
}

/// A crank whose pin meets its bearing as a rigid body, and slides and sticks there.
Scene struck(const std::string& method, const std::string& constraints = "projection") {
  Scene s = loose(method, constraints);
  SceneClearance& pin = *s.joints[2].clearance;
  pin.model = ClearanceModel::impact;
  pin.impact.restitution = 0.5;
  pin.friction->law = "coulomb";
  return s;
}

/// A bar on n equal cranks, of which all but two are redundant.
Scene cranks(int n, const std::string& method) {
  const double angle = 0.5;
  Scene s;
  SceneBody bar = body("bar", 1, n * n / 12.0, {});
  bar.at = {(n - 1) / 2.0 + std::cos(angle), std::sin(angle)};
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i);
    s.ground.push_back(point("G" + k, i));
    bar.points.push_back(point("P" + k, i - (n - 1) / 2.0));
    SceneBody crank = body("crank" + k, 1, 1.0 / 12, {point("A", -0.5), point("B", 0.5)});
    crank.at = {i + 0.5 * std::cos(angle), 0.5 * std::sin(angle)}, crank.angle = angle;
    s.bodies.push_back(crank);
    s.joints.push_back(joint("base" + k, JointKind::revolute, "ground.G" + k, "crank" + k + ".A"));
    s.joints.push_back(joint("top" + k, JointKind::revolute, "crank" + k + ".B", "bar.P" + k));
    s.start_bodies.push_back(start_angle("crank" + k, angle, -1));
  }
  s.bodies.push_back(bar);
  s.gravity = {0, -9.81};
  s.run.until = 3, s.run.tolerance = 1e-8, s.run.method = method;
  return s;
}

/// Its strut soon rests, and stability alone holds explicit steps.
Scene stiff_chain() {
  Scene s = floating_chain(2e4);
  s.run.tolerance = 1e-4, s.run.method = "dopri5";
  return s;
}

Scene flexible(const std::string& method, const std::string& stiffening, double clearance) {
  FlexibleCrank o;
  o.coupler = text(FlexibleBeam{.modes = "{frame: chord, count: 4}",
                                .more = "damping: {ratios: 0.02}\n" + (stiffening.empty() ? "" : "stiffening: " + stiffening + "\n")});
  o.clearance = clearance, o.tolerance = 1e-6, o.angle = 0.3;
  Scene s = scene_of(text(o));
  s.run.method = method;
  return s;
}

/// One of examples/, by its own method if none is named.
Scene of_example(const std::string& file, const std::string& method = "") {
  Scene s = with_pieces(read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/" + file + ".yaml"));
  if (!method.empty()) s.run.method = method, s.run.tolerance = 1e-6;
  return s;
}

/// A weight with a smooth outline strikes a roller at the end of a leaf, and rubs there.
Scene leaf_under_a_weight(const std::string& method) {
  Scene s = scene_of(R"(
bodies:
  leaf:
    beam: {from: A, to: B, section: {rectangle: [20 mm, 2 mm]}, young: 207 GPa, poisson: 0.3, density: 7850, elements: 2}
    points: {A: [0, 0], B: [200 mm, 0]}
    modes: {craig-bampton: {count: 0}, frame: {tangent: A}}
    profiles: {roller: {disc: B, radius: 5 mm}}
  weight:
    rigid: {mass: 0.5 kg, inertia: 1e-4 kg m^2}
    profiles: {rim: {polar: [[0, 20 mm], [90 deg, 19 mm], [180 deg, 20 mm], [270 deg, 19 mm]]}}
joints: {clamp: {weld: [ground, leaf.A]}}
contacts:
  blow:
    between: [weight.rim, leaf.roller]
    normal: {hunt-crossley: {restitution: 0.6, stiffness: 1e8 N/m^1.5}}
    friction: {gonthier: {coefficient: 0.2, bristle stiffness: 1e4 1/m, dwell time: 10 ms}}
start: {weight: {at: [203 mm, 24.5 mm], velocity: [0, -0.5]}}
run: {until: 60 ms, tolerance: 1e-6}
)");
  s.run.method = method;
  return s;
}

std::vector<Case> cases() {
  using enum Case::Must;
  std::vector<Case> all;
  for (const char* method : {"rkf45", "dopri5", "verner87", "generalized-alpha"}) {
    const std::string m = method;
    const std::string word = m == "generalized-alpha" ? "alpha" : m;
    all.push_back({word + "_contact_with_friction", [m] { return loose(m); }, 200, {}, strike});
    if (word != "alpha") all.push_back({word + "_impacts", [m] { return struck(m); }, 200, {}, strike});
    all.push_back({word + "_massless_link", [m] { return linked(m); }});
    all.push_back({word + "_redundant", [m] { return cranks(4, m); }});
    all.push_back({word + "_flexible", [m] { return flexible(m, "", 0); }});
    all.push_back({word + "_flexible_contact", [m] { return flexible(m, "", 1e-4); }, 400, {}, strike});
    all.push_back({word + "_stiffened_by_rotation", [m] { return flexible(m, "rotation", 1e-4); }, 400, {}, strike});
    all.push_back({word + "_stiffened_by_all", [m] { return flexible(m, "axial", 0); }});
  }
  for (const char* method : {"dopri5", "generalized-alpha"}) {
    const std::string m = method;
    all.push_back({(m == "dopri5" ? m : "alpha") + "_leaf_under_a_weight", [m] { return leaf_under_a_weight(m); }, 400, {}, strike});
    for (const char* file :
         {"drum_brake", "stick_slip", "stage_microslip", "rubber_mount", "planetary_gear", "release_hook", "guide_with_play"})
      all.push_back({(m == "dopri5" ? m : "alpha") + "_" + file, [m, file] { return of_example(file, m); }});
  }
  for (const char* method : {"dopri5", "verner87"}) {
    const std::string m = method;
    all.push_back({m + "_partitioned_impacts", [m] { return struck(m, "partitioning"); }, 200, {}, strike});
    all.push_back({m + "_partitioned_contact", [m] { return loose(m, "partitioning"); }, 200, {}, strike});
    all.push_back({m + "_partitioned_redundant", [m] {
                     Scene s = cranks(4, m);
                     s.run.constraints = "partitioning";
                     return s;
                   }});
  }
  for (const char* file : {"geneva", "ratchet", "walker", "woodpecker", "latch"})
    all.push_back({file, [file] { return of_example(file); }});
  all.push_back({"alpha_sparse_redundant", [] { return cranks(20, "generalized-alpha"); }, 40});
  all.push_back(
      {"auto_switches", stiff_chain, 150, [](Scheme& s) { s.tableau = find_tableau("dopri5"), s.switch_below = 1; }, switch_over});
  all.push_back(
      {"auto_falls_back", [] { return cranks(2, "verner87"); }, 60, [](Scheme& s) { s.fallback = find_tableau("dopri5"); }, fall_back});
  return all;
}

class Undisturbed : public testing::TestWithParam<Case> {
 protected:
  Undisturbed() : scene_(GetParam().scene()), model_(build(scene_)) {
    if (GetParam().scheme) GetParam().scheme(model_.scheme);
    start_ = assemble(scene_, model_).start;
  }
  Integrator integrator() const { return Integrator(model_.system, model_.scheme, start_); }
  bool advance(Integrator& run) const { return run.state().t < scene_.run.until && run.advance(scene_.run.until); }

  void validate_exam(const Integrator& run) const {
    using enum Case::Must;
    const Case::Must must = GetParam().must;
    if (must == strike) {
      EXPECT_GT(run.impacts().size(), 0u) << "no impact, no exam";
    }
    if (must == switch_over) {
      EXPECT_TRUE(run.implicit()) << "no switch, no exam";
    }
    if (must == fall_back) {
      EXPECT_NE(run.switched().find("dopri5"), std::string::npos) << "no fallback, no exam";
    }
  }

  Scene scene_;
  Model model_;
  State start_;
};

std::string bytes(const State& state, const Equations& eq) {
  std::string out;
  for (const Eigen::VectorXd* v : {&state.y, &eq.a, &eq.lambda, &eq.C, &eq.f})
    out.append(reinterpret_cast<const char*>(v->data()), sizeof(double) * static_cast<std::size_t>(v->size()));
  for (const ContactEffect& c : eq.contact)
    for (const double* x : {&c.gap.depth, &c.gap.rate, &c.normal.force, &c.friction})
      out.append(reinterpret_cast<const char*>(x), sizeof *x);
  return out;
}

/// Empty if it cannot be made.
std::string reading(Integrator& run, double part) {
  State at;
  const Step& last = run.last();
  return run.sample(last.from.state.t + part * last.h, at) ? bytes(at, run.sampled()) : "";
}

TEST_P(Undisturbed, StepsAreTheSameWithAndWithoutReadings) {
  Integrator alone = integrator(), read = integrator();
  State at;
  for (int k = 0; k < GetParam().steps && alone.state().t < scene_.run.until; ++k) {
    for (int i = 0; i < 1 + k % 3; ++i)
      for (const double part : {0.61803, 1e-5, 0.03, 1.0, 0.5, 0.999})
        if (k % 5 != 4) reading(read, part);
    ASSERT_EQ(advance(alone), advance(read)) << k;
    ASSERT_TRUE(alone.failure().empty()) << alone.failure();
    ASSERT_EQ(alone.save(), read.save()) << "step " << k << ", t = " << alone.state().t;
  }
  validate_exam(alone);
}

TEST_P(Undisturbed, AReadingDoesNotDependOnThoseBefore) {
  Integrator often = integrator(), once = integrator();
  for (int k = 0; k < GetParam().steps && advance(often) && advance(once); ++k) {
    for (const double part : {1e-5, 0.2, 0.9}) reading(often, part);
    if (k % 4 != 0) continue;
    const double part = k % 8 == 0 ? 0.4 : 1;
    ASSERT_EQ(reading(often, part), reading(once, part)) << "step " << k;
  }
}

TEST_P(Undisturbed, EveryStepIsARestartPoint) {
  constexpr int ahead = 3;
  Integrator run = integrator();
  std::vector<std::string> saved{run.save()}, middle{""};
  for (int k = 0; k < GetParam().steps && advance(run); ++k) {
    middle.push_back(reading(run, 0.4));
    saved.push_back(run.save());
  }
  ASSERT_GT(saved.size(), 20u);
  validate_exam(run);
  for (std::size_t k = 0; k + 1 < saved.size(); ++k) {
    Integrator next = integrator();
    next.load(saved[k]);
    ASSERT_EQ(next.save(), saved[k]) << "step " << k;
    for (std::size_t i = k + 1; i < saved.size() && i <= k + ahead; ++i) {
      ASSERT_TRUE(advance(next)) << next.failure();
      ASSERT_EQ(reading(next, 0.4), middle[i]) << "from step " << k << " at " << i;
      ASSERT_EQ(next.save(), saved[i]) << "from step " << k << " at " << i;
    }
  }
}

// Through `simulate`, with all that a scene may write.
TEST_P(Undisturbed, RunsEndTheSameWhateverIsWritten) {
  Integrator paced = integrator();
  for (int k = 0; k < GetParam().steps / 2 && advance(paced); ++k) continue;
  scene_.run.until = paced.state().t;
  std::vector<std::string> ends;
  std::vector<std::vector<double>> rows;
  for (const bool written : {false, true}) {
    scene_.output.every = written ? scene_.run.until / 37.3 : scene_.run.until;
    scene_.output.frames = written ? 23 : 0;
    scene_.output.states = written ? scene_.run.until / 11.7 : 0;
    Listeners listeners;
    std::string end;
    listeners.state = [&](const SavedState& s) { end = s.memory; };
    if (written) listeners.frame = [](const State&, const Equations&) {};
    Assembly assembly = assemble(scene_, model_);
    const pintle::Run run = simulate(scene_, model_, assembly, listeners);
    EXPECT_NE(run.status, Status::failed) << run.reason;
    ends.push_back(end);
    const std::size_t width = run.trajectory.columns();
    rows.emplace_back(run.trajectory.data.end() - static_cast<std::ptrdiff_t>(width), run.trajectory.data.end());
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(rows[0], rows[1]);

  Scene with_points = GetParam().scene();  // the duration takes part in the choice of the method
  for (const SceneBody& b : with_points.bodies) with_points.output.points.push_back({b.name, "", {}});
  Model recording = build(with_points);
  if (GetParam().scheme) GetParam().scheme(recording.scheme);
  Listeners listeners;
  listeners.state = [&](const SavedState& s) { ends.push_back(s.memory); };
  with_points.run.until = scene_.run.until;
  Assembly assembly = assemble(with_points, recording);
  simulate(with_points, recording, assembly, listeners);
  EXPECT_EQ(ends.back(), ends[0]) << "with points";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Undisturbed, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& c) { return c.param.name; });

}  // namespace
}  // namespace pintle_scenes::undisturbed_test
