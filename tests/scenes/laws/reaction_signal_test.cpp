// Columns that the accelerations decide, in conditions of events and in outputs; laws without a value, wherever they stand.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/mechanism/result_tables.h"
#include "framework/scene/units/expression.h"
#include "framework/scene/units/signal_words.h"
#include "framework/study/measures/measure.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::reaction_signal_test {
namespace {

using pintle_scenes::Whole;
using pintle_test::expect_says;

Scene scene(const std::string& text) { return read_scene_text(text, "scene.yaml"); }

// A bar of 2 kg whose centre swings 1 m below its pin, from the horizontal; φ from there.
const std::string swing = R"yaml(
gravity: [0, -9.81 m/s^2]
bodies: {bob: {rigid: {mass: 2 kg, inertia: 0.02 kg m^2}, points: {O: [-1 m, 0]}}}
joints: {pin: {revolute: [ground, bob.O]}}
outputs: {pull: "sqrt(pin.fx^2 + pin.fy^2)"}
)yaml";

class Breaks : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

// Along the bar the pin bears m g sin φ + m ω² with ω² = 2 m g sin φ/J, across it m g cos φ (1 − m/J), J = 2.02 kg m² about the pin.
TEST_P(Breaks, APinAtItsStrength) {
  const auto [method, condition] = GetParam();
  Scene s =
      scene(swing + "events: {breaks: {when: \"" + condition + "\", once: true, do: {release: pin, row: true}}}\nrun: {until: 1 s}\n");
  s.run.method = method;
  s.run.tolerance = 1e-9;
  const Whole w = pintle_scenes::run(s);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_EQ(w.run.happenings.size(), 1u);
  const double m = 2, J = 2.02, g = 9.81;
  const auto bears = [&](double phi) { return std::hypot(m * g * std::sin(phi) * (1 + 2 * m / J), m * g * std::cos(phi) * (1 - m / J)); };
  double low = 0, high = std::acos(-1.0) / 2;
  for (int i = 0; i < 60; ++i) (bears((low + high) / 2) < 40 ? low : high) = (low + high) / 2;
  const auto t = w.column("t [s]"), angle = w.column("bob.angle [rad]");
  const auto row = static_cast<std::size_t>(std::ranges::find(t, w.run.happenings[0].t) - t.begin());
  ASSERT_LT(row, t.size());
  EXPECT_NEAR(-angle[row], low, 1e-6);
  EXPECT_EQ(w.column("pull [N]").back(), 0);
}
INSTANTIATE_TEST_SUITE_P(Each, Breaks,
                         testing::Combine(testing::Values("dopri5", "verner87", "generalized-alpha"),
                                          testing::Values("pull > 40 N", "sqrt(pin.fx^2 + pin.fy^2) > 40 N")),
                         [](const auto& p) {
                           const std::string method = std::get<0>(p.param);
                           return (method[0] == 'g' ? "GeneralizedAlpha" : method) +
                                  (std::get<1>(p.param)[0] == 'p' ? "ByOutput" : "ByColumn");
                         });

// Two shafts of 1 and 3 kg m², the first driven: three quarters of its torque pass the clutch, which slips at 3 N m.
TEST(Reactions, AnOverloadClutchLetsGo) {
  const std::string text = R"yaml(
bodies:
  first: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0]}}
  second: {rigid: {mass: 1 kg, inertia: 3 kg m^2}, points: {O: [0, 0]}}
joints:
  left: {revolute: [ground, first.O]}
  right: {revolute: [ground, second.O]}
  clutch: {differential: [first, second], ratio: -1}
forces: {motor: {torque: 1 N m/s*t, on: first}}
events: {slip: {when: "abs(clutch.torque) > 3 N m", once: true, do: {release: clutch}}}
run: {until: 6 s, method: dopri5}
)yaml";
  const Whole w = pintle_scenes::run(text);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_EQ(w.run.happenings.size(), 1u);
  EXPECT_NEAR(w.run.happenings[0].t, 4, 1e-9);
}

// What trajectory.csv calls a column an output may name, of the column's dimension.
Dimension dimension_of(const std::string& unit) {
  return unit.empty() || unit == "-" || unit == "1" ? Dimension{} : read_quantity(unit).dimension;
}

// Units of the columns of a table, by their names without time and bodies.
std::map<std::string, std::string> units_of(const Table& table) {
  std::map<std::string, std::string> out;
  for (const std::string& column : table.header) {
    const std::size_t bracket = column.rfind(" ["), on = column.rfind(" on ");
    out[column.substr(0, on == std::string::npos ? bracket : on)] = column.substr(bracket + 2, column.size() - bracket - 3);
  }
  out.erase("t");
  return out;
}

// Cylinders whose pressure is known, with bristles that age.
const std::string bush = R"yaml(
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.01 kg m^2}, points: {A: [0, 0]}}}
joints:
  pin:
    revolute: [ground, rod.A]
    clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: ground,
                normal: {johnson: {length: 15 mm, young: 207 GPa, poisson: 0.3, hysteresis: flores, restitution: 0.8}},
                friction: {gonthier: {coefficient: 0.3, bristle stiffness: 1e5 1/m, dwell time: 1 s}}}
run: {until: 1 s}
)yaml";

TEST(Reactions, EveryColumnIsAWordOfItsUnit) {
  std::set<std::string> offered, written;
  const auto kind = [](const std::string& name) {
    const std::string out = name.substr(std::min(name.rfind('.'), name.size()));
    return out.starts_with(".mode ") ? ".mode" : out;
  };
  for (const std::string name :
       {"belt_drive", "planetary_gearbox", "slider_crank_clearance", "drum_brake", "jamming_drawer", "stage_microslip", "cam_roller",
        "excavator", "pid_arm", "release_hook", "gearbox", "gear_backlash", "breaker", "flexible_slider_crank", "four_bar_flexible", ""}) {
    SCOPED_TRACE(name);
    const Scene s = name.empty() ? scene(bush) : read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/" + name + ".yaml");
    const Model model = build(s);
    const auto words = signal_words(s);
    auto units = units_of(trajectory_table(model));
    for (const auto& [column, unit] : units) {
      const auto found = words.find(column);
      ASSERT_NE(found, words.end()) << column;
      EXPECT_TRUE(same(found->second.dimension, dimension_of(unit))) << column;
      written.insert(kind(column));
    }
    for (const auto& [word, what] : words)
      if (what.what == SignalWord::column && word.find(" on ") == std::string::npos) offered.insert(kind(word));
    for (const SceneJoint& j : s.joints) {
      if (j.clearance || j.play) continue;
      EXPECT_EQ(words.contains(j.name + ".force"), units.contains(j.name + ".force")) << j.name;
      if (j.coupling && !j.coupling->terms.empty()) continue;
      EXPECT_EQ(words.contains(j.name + ".torque"), units.contains(j.name + ".torque")) << j.name;
    }
    units.merge(units_of(ledger_table(model.system)));
    for (const auto& [column, unit] : units) {
      std::string measured;
      EXPECT_NO_THROW(measured = measured_unit({"", "peak " + column}, s)) << column;
      EXPECT_TRUE(same(dimension_of(measured), dimension_of(unit))) << column << " [" << measured << "]";
    }
  }
  for (const std::string& word : offered) EXPECT_TRUE(written.contains(word)) << word;
}

TEST(Reactions, ForcesAndStatesStillMayNotNameThem) {
  const std::string refused =
      pintle_test::refusal_by([] { build(scene(swing + "states: {n: {rate: pin.fx/(1 N s)}}\nrun: {until: 1 s}\n")); });
  expect_says(refused, {"pin.fx", "algebraic feedback"});
}

// Kinematics tells no forces: outputs of them are left out, the others stay themselves.
TEST(Reactions, KinematicsKeepsOutputsOfTheMotion) {
  const Scene s = scene(R"yaml(
bodies: {crank: {rigid: {mass: 1 kg, inertia: 1 kg m^2}, points: {O: [0, 0], A: [1 m, 0]}}}
joints: {pin: {revolute: [ground, crank.O]}}
drivers: {motor: {angle: [ground, crank], law: 2 rad/s*t}}
outputs: {load: 2*pin.fx, twice: 2*crank.alpha + 1 rad/s^2, height: crank.A.y, again: load + 1 N}
run: {until: 1 s}
)yaml");
  const Model model = build(s);
  const pintle::Run found = kinematics(s, model, assemble(s, model));
  EXPECT_EQ(std::ranges::count(found.trajectory.header, "load [N]") + std::ranges::count(found.trajectory.header, "again [N]"), 0);
  EXPECT_NEAR(found.trajectory.column("twice [1/s^2]").back(), 1, 1e-9);
  EXPECT_NEAR(found.trajectory.column("height [m]").back(), std::sin(2.0), 1e-9);
}

// ---- laws without a value ----

std::string cart(const std::string& force, const std::string& more, const std::string& x = "-0.1 m") {
  return R"yaml(
bodies: {cart: {rigid: {mass: 1 kg, inertia: 0.1}, points: {P: [0, 0]}}}
joints: {rail: {prismatic: [ground, cart]}}
)yaml" + ("forces: {push: {force: [\"" + force + "\", 0], at: cart.P}}\n" + more + "\nstart: {cart: {x: " + x +
          "}}\nrun: {until: 1 s, method: dopri5}\n");
}
const std::string root = "-1 N*sqrt(cart.x/(1 m))";

TEST(LawsWithoutAValue, AreNamedByStatics) {
  const Scene s = scene(cart(root, ""));
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model));
  EXPECT_FALSE(rest.found);
  expect_says(rest.reason, {"\"push\"", "scene.yaml:4", "not a finite number at t = 0 s", "cart.x = -0.1"});
}

TEST(LawsWithoutAValue, AreNamedByLinearize) {
  for (const char* x : {"-0.1 m", "0 m"}) {  // at 0 the force is 0, but its slope has no bound
    const Scene s = scene(cart(root, "", x));
    const Model model = build(s);
    expect_says(pintle_test::refusal_by<AssemblyError>([&] { linearize(s, model, assemble(s, model).start); }), {"\"push\"", "cart.x"});
  }
}

TEST(LawsWithoutAValue, AreNamedByInverse) {
  const Scene s = scene(cart("1 N*log(cart.x/(1 m) - 0.5)", "drivers: {motor: {distance: [ground, cart.P], law: 1 m - 0.9 m/s*t}}", "1 m"));
  const Model model = build(s);
  const Inverse found = inverse(s, model, assemble(s, model));
  EXPECT_EQ(found.run.status, Status::failed);
  expect_says(found.run.reason, {"\"push\"", "cart.x"});
}

TEST(LawsWithoutAValue, OfOutputsAreWarnedOfOnce) {
  const Whole w = pintle_scenes::run(cart("1 N", "outputs: {ratio: 1 N/(push.fx - 1 N)}", "0 m"));
  ASSERT_EQ(w.run.status, Status::finished);
  EXPECT_EQ(
      std::ranges::count_if(w.run.warnings, [](const std::string& warning) { return warning.find("\"ratio\"") != std::string::npos; }), 1);
  for (const std::string& warning : w.run.warnings)
    if (warning.find("\"ratio\"") != std::string::npos)
      expect_says(warning, {"scene.yaml:5", "not a finite number at t = 0 s", "push.fx = 1"});
}

TEST(LawsWithoutAValue, OfConditionsEndTheRun) {
  const Whole w = pintle_scenes::run(cart("-1 N", "events: {gone: {when: \"sqrt(cart.x/(1 m)) > 10\", do: {row: true}}}", "0.02 m"));
  EXPECT_EQ(w.run.status, Status::failed);
  expect_says(w.run.reason, {"the event \"gone\"", "not a finite number at t = 0.2 s", "scene.yaml:5", "cart.x = -"});
}

// From 3 m on to 5 m, which one step of a body that flies freely passes.
TEST(LawsWithoutAValue, OfConditionsInsideAStepEndTheRunToo) {
  for (const std::string method : {"dopri5", "verner87", "generalized-alpha"})
    for (const std::string x : {"cart.x", "out"}) {
      std::string text =
          "outputs: {out: cart.x}" +
          cart("0 N", "events: {gone: {when: \"sqrt((" + x + " - 3 m)*(" + x + " - 5 m)) > 50 m\", do: {row: true}}}", "0 m, vx: 10 m/s");
      text.replace(text.find("dopri5"), 6, method);
      const Whole w = pintle_scenes::run(text);
      EXPECT_EQ(w.run.status, Status::failed) << method;
      expect_says(w.run.reason, {"the event \"gone\"", "not a finite number at t = 0.3", "scene.yaml:5", x + " = 3"});
    }
}

TEST(UnknownNames, AreNotAnsweredWithUnits) {
  const std::string said = pintle_test::refusal_by([] { build(scene(cart("1 N*zzyzxqw", "states: {integral: {rate: 1}}"))); });
  expect_says(said, {"\"zzyzxqw\" is neither", "integral"});
  EXPECT_EQ(said.find("GPa"), std::string::npos) << said;
}

}  // namespace
}  // namespace pintle::reaction_signal_test
