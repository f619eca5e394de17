// What `method: auto` makes of scenes whose own states alone move, and the warning of runs that something stiff holds.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"

namespace pintle::method_of_states_test {
namespace {

struct Whole {
  Model model;
  Run run;
};

Whole run_of(const std::string& text) {
  const Scene scene = read_scene_text(text, "scene.yaml");
  Whole out{build(scene), {}};
  out.run = simulate(scene, out.model, assemble(scene, out.model));
  EXPECT_EQ(out.run.status, Status::finished) << out.run.reason;
  return out;
}

/// Own states beside a plate that stands still.
std::string states_alone(const std::string& states, const std::string& until, const std::string& tolerance) {
  return "bodies: {plate: {rigid: {mass: 1, inertia: 1}}}\njoints: {held: {weld: [ground, plate]}}\nstates: {" + states +
         "}\nrun: {until: " + until + ", tolerance: " + tolerance + "}\noutput: {frames: 0, every: " + until + "}\n";
}

// Lorenz' equations turn and fold at rates that their Jacobian at the start does not have; whatever the unit of their time.
TEST(Auto, FollowsOwnStatesThatAreNotStiffByAnExplicitPair) {
  for (const std::string fast : {"1", "100"})
    for (const std::string tolerance : {"1e-5", "1e-6", "1e-9"}) {
      const Whole w = run_of(states_alone("X: {rate: \"F*10*(Y - X)\", start: 1}, Y: {rate: \"F*(X*(28 - Z) - Y)\", start: 1}, "
                                          "Z: {rate: \"F*(X*Y - 8/3*Z)\", start: 20}",
                                          "20/F", tolerance) +
                             "parameters: {F: " + fast + "}\n");
      EXPECT_NE(w.model.scheme.tableau, nullptr) << w.model.scheme.reason;
      EXPECT_NE(w.model.scheme.reason.find("states of the scene"), std::string::npos) << w.model.scheme.reason;
      EXPECT_EQ(w.run.switched, "") << fast << " " << tolerance;
    }
}

// Robertson's reaction (1966): rates from 0.04 to 1e4 and more, of which stability asks for some 35 000 steps of a pair. The sum is kept.
TEST(Auto, FollowsStiffOwnStatesByAnImplicitMethodOnceStepsTell) {
  const Whole w = run_of(states_alone(
      "a: {rate: \"-0.04*a + 1e4*b*c\", start: 1}, b: {rate: \"0.04*a - 1e4*b*c - 3e7*b^2\"}, c: {rate: 3e7*b^2}", "40", "1e-6"));
  EXPECT_NE(w.run.switched.find("generalized-alpha"), std::string::npos);
  EXPECT_LT(w.run.counts.steps, 3500);
  const auto last = [&](const char* name) { return w.run.trajectory.column(std::string(name) + " [1]").back(); };
  EXPECT_NEAR(last("a"), 0.7158, 1e-3);  // Hairer and Wanner, Solving Ordinary Differential Equations II
  EXPECT_NEAR(last("a") + last("b") + last("c"), 1, 1e-6);
}

}  // namespace
}  // namespace pintle::method_of_states_test
