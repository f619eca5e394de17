// Gears, racks and discs that roll, against statics and motions written by hand: docs/theory/gears.md.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/configuration/equilibrium.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::gear_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number, pintle_scenes::run,
    pintle_scenes::Whole;
using pintle_test::expect_refused, pintle_test::refusal_by;

constexpr double g = 9.81;
const std::vector<Method> methods{{"dopri5", "dopri5", 1e-10, 1e-8}, {"alpha", "generalized-alpha", 1e-9, 1e-5}};

// ---- wheels on fixed axles ----

/// Wheels of 0.1 and 0.2 m, the second at (0.3, 0) or where the first runs in it.
std::string two_wheels(const std::string& coupling, double apart = 0.3) {
  return "ground: {points: {B: [" + number(apart) + ", 0]}}\nbodies:\n  a: {rigid: {mass: 1, inertia: 2e-3}}\n  b: {pose: {at: [" +
         number(apart) +
         ", 0]}, rigid: {mass: 2, inertia: 5e-3}}\njoints:\n  at A: {revolute: [ground, a]}\n  at B: {revolute: [ground.B, b]}\n  pair: " +
         coupling + "\n";
}
const std::string rest = "run: {until: 0.1}\noutput: {frames: 0, every: 0.02}\n";

struct Pair {
  const char* name;
  std::string coupling;
  double apart, turns;  // of b for one of a
  double across;        // force on a across the line of centres, over its torque and radius
};
void PrintTo(const Pair& p, std::ostream* out) { *out << p.name; }
const std::vector<Pair> pairs{
    {"Gear", "{gear: [a, b], radii: [0.1, 0.2]}", 0.3, -0.5, -1},
    {"Teeth", "{gear: [a, b], teeth: [17, 34]}", 0.3, -0.5, -1},
    {"Ring", "{gear: [a, b], radii: [0.1, 0.2], inside: true}", 0.1, 0.5, 1},
    {"RingFirst", "{gear: [a, b], radii: [0.2, 0.1], inside: true}", 0.1, 2, -1},
    {"OpenBelt", "{belt: [a, b], radii: [0.1, 0.2]}", 0.5, 0.5, 0.2},
    {"CrossedBelt", "{belt: [a, b], radii: [0.1, 0.2], crossed: true}", 0.5, -0.5, -0.6},
};

class OnFixedAxles : public testing::TestWithParam<Pair> {};

TEST_P(OnFixedAxles, TurnByTheirRatioAndSpeedUpAsOneInertia) {
  const Pair p = GetParam();
  for (const Method& method : methods) {
    const Whole w = run(two_wheels(p.coupling, p.apart) + "forces: {motor: {torque: 0.3, on: a}}\n" + rest, method);
    expect_sound(w);
    const double acceleration = 0.3 / (2e-3 + p.turns * p.turns * 5e-3), t = 0.1;
    EXPECT_NEAR(w.last("a.speed [rad/s]"), acceleration * t, acceleration * t * method.near);
    EXPECT_NEAR(w.last("b.angle [rad]"), p.turns * w.last("a.angle [rad]"), 1e-10);
  }
}

// A torque on a, b held: the teeth push where the circles touch, the spans of a belt pull along their lines, so that bearings carry what the
// couples alone would not show. Of an open belt the spans' slope is (r_b − r_a)/L.
TEST_P(OnFixedAxles, BearTheForceBetweenThem) {
  const Pair p = GetParam();
  const Scene s = ready_for_statics(pintle::read_scene_text(
      two_wheels(p.coupling, p.apart) + "forces: {motor: {torque: 5, on: a}}\ndrivers: {brake: {angle: [ground, b], law: 0}}\n" + rest,
      "s.yaml"));
  const Model model = build(s);
  const Equilibrium at_rest = find_equilibrium(s, model, assemble(s, model));
  ASSERT_TRUE(at_rest.found) << at_rest.reason;
  const auto value = [&](const std::string& column) { return at_rest.table.column(column).at(0); };
  const double radius = p.coupling.find("[0.2") != std::string::npos ? 0.2 : 0.1, rim = -5 / radius;
  EXPECT_NEAR(value("pair.force [N]"), rim, 1e-9);
  EXPECT_NEAR(value("at A.fy on a [N]"), p.across * rim, 1e-9);
  EXPECT_NEAR(value("at B.fy on b [N]"), -p.across * rim, 1e-9);
  EXPECT_NEAR(value("at A.fx on a [N]"), 0, 1e-9);
  EXPECT_NEAR(value("brake.torque on b [N m]"), -5 / p.turns, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Each, OnFixedAxles, testing::ValuesIn(pairs), [](const auto& p) { return p.param.name; });

// Three wheels, each on the other two, cannot turn; one more than its neighbours' ratio allows neither.
TEST(GearTrain, ThatClosesOnItselfIsLocked) {
  const std::string three =
      "ground: {points: {B: [0.2, 0], C: [0.1, \"0.1*sqrt(3)\"]}}\nbodies:\n  a: {rigid: {mass: 1, inertia: 2e-3}}\n"
      "  b: {pose: {at: [0.2, 0]}, rigid: {mass: 1, inertia: 2e-3}}\n  c: {pose: {at: [0.1, \"0.1*sqrt(3)\"]}, rigid: {mass: 1, inertia: "
      "2e-3}}\n"
      "joints:\n  A: {revolute: [ground, a]}\n  B: {revolute: [ground.B, b]}\n  C: {revolute: [ground.C, c]}\n"
      "  ab: {gear: [a, b], teeth: [20, 20]}\n  bc: {gear: [b, c], teeth: [20, 20]}\n  ca: {gear: [c, a], teeth: [20, 20]}\n";
  const Whole w = run(three + "forces: {motor: {torque: 0.3, on: a}}\n" + rest);
  expect_sound(w, 1e-12);
  EXPECT_NEAR(w.last("a.angle [rad]"), 0, 1e-12);
  EXPECT_NEAR(w.last("ab.force [N]"), -0.15 / 0.1, 1e-9);  // half the torque goes to each neighbour
  const std::string driven = three + "drivers: {motor: {angle: [ground, a], law: 2*t}}\n" + rest;
  expect_refused<AssemblyError>([&] { run(driven); }, {"motor", "ab", "bc", "ca"});
}

// ---- wheels on a carrier ----

// Round a fixed wheel of radius A a wheel of radius B on an arm: its angle is ψ (1 + A/B), in a ring ψ (1 − A/B), on an open belt likewise;
// over more than a turn of the line of centres.
TEST(Carried, WheelsTurnWithTheLineOfCentres) {
  struct Case {
    std::string coupling;
    double arm, turns;
  };
  for (const Case& c : std::vector<Case>{{"{gear: [ground, planet], radii: [0.1, 0.05]}", 0.15, 3},
                                         {"{gear: [ground, planet], radii: [0.3, 0.05], inside: true}", 0.25, -5},
                                         {"{belt: [ground, planet], radii: [0.1, 0.1]}", 0.3, 0},
                                         {"{belt: [ground, planet], radii: [0.1, 0.05]}", 0.3, -1}}) {
    const std::string text =
        "bodies:\n  arm: {rigid: {mass: 1, inertia: 1e-2}, points: {P: [" + number(c.arm) + ", 0]}}\n  planet: {pose: {at: [" +
        number(c.arm) +
        ", 0]}, rigid: {mass: 1, inertia: 1e-3}}\njoints:\n  hub: {revolute: [ground, arm]}\n  pin: {revolute: [arm.P, planet]}\n"
        "  pair: " +
        c.coupling + "\ndrivers: {motor: {angle: [ground, arm], law: 15*t}}\nrun: {until: 1}\noutput: {frames: 0, every: 0.05}\n";
    const Scene s = pintle::read_scene_text(text, "s.yaml");
    const Model model = build(s);
    const pintle::Run moved = kinematics(s, model, assemble(s, model));
    ASSERT_EQ(moved.status, Status::finished) << moved.reason;
    const auto arm = moved.trajectory.column("arm.angle [rad]"), planet = moved.trajectory.column("planet.angle [rad]");
    for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_NEAR(planet[i], c.turns * arm[i], 1e-9) << c.coupling;
    EXPECT_NEAR(arm.back(), 15, 1e-9);
  }
}

// examples/planetary_gearbox.yaml: Willis's ratios, and each planet's teeth and pin by hand; the redundant planets share alike.
TEST(PlanetaryGearbox, CarriesWhatStaticsAndInertiaAsk) {
  const Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/planetary_gearbox.yaml");
  for (const Method& method : methods) {
    const Whole w = run(s, method);
    expect_sound(w);
    const double near = method.near;
    EXPECT_NEAR(w.last("sun.speed [rad/s]"), 200, 200 * near);
    EXPECT_NEAR(w.last("arm.speed [rad/s]"), w.last("sun.speed [rad/s]") / 4, 1e-7);
    EXPECT_NEAR(w.last("planet 2.speed [rad/s]"), -w.last("sun.speed [rad/s]") / 2, 1e-7);
    for (const std::string i : {"1", "2", "3"}) EXPECT_NEAR(w.last("sun " + i + ".force [N]"), -5, 5e3 * near) << i;
    const double ring = (-5 * 0.02 + 8e-4 / 3 * 100) / 0.02;  // the planet's own spin
    EXPECT_NEAR(w.last("ring 1.force [N]"), ring, 5e3 * near);
    const double angle = w.last("arm.angle [rad]"), fx = w.last("pin 1.fx on planet 1 [N]"), fy = w.last("pin 1.fy on planet 1 [N]");
    EXPECT_NEAR(-std::sin(angle) * fx + std::cos(angle) * fy, 1 * 0.04 * 50 - 5 + ring, 1e4 * near);
    EXPECT_NEAR(std::cos(angle) * fx + std::sin(angle) * fy, -0.04 * 50 * 50, 1e4 * near);
  }
}

// ---- racks and what rolls ----

// A pinion under its rack, turned by a torque: (m + J/r²) a = T/r, to the left where a pinion above would drive it to the right.
TEST(RackAndPinion, SpeedUpAsOneMass) {
  for (const double side : {-1.0, 1.0})
    for (const Method& method : methods) {
      const std::string at = "[0.1, " + number(0.05 * side) + "]";
      const Whole w =
          run("ground: {points: {P: " + at + "}}\nbodies:\n  bar: {rigid: {mass: 2, inertia: 1e-2}}\n  pinion: {pose: {at: " + at +
                  "}, rigid: {mass: 1, inertia: 1e-3}}\njoints:\n  guide: {prismatic: [ground, bar]}\n  bearing: {revolute: [ground.P, "
                  "pinion]}\n"
                  "  teeth: {rack: [bar, pinion], radius: 0.05}\nforces: {motor: {torque: 0.6, on: pinion}}\n" +
                  rest,
              method);
      expect_sound(w);
      const double a = side * 0.6 / 0.05 / (2 + 1e-3 / (0.05 * 0.05)), t = 0.1;
      EXPECT_NEAR(w.last("bar.x [m]"), a * t * t / 2, std::abs(a) * t * t * method.near);
      EXPECT_NEAR(w.last("pinion.angle [rad]"), side * w.last("bar.x [m]") / 0.05, 1e-10);
      EXPECT_NEAR(w.last("teeth.force [N]"), -2 * a, 1e-6 + 1e3 * method.near);
      EXPECT_NEAR(w.ledger("motor.work in [J]"), 0.6 * w.last("pinion.angle [rad]"), 1e-8 + method.near);
    }
}

// A disc of k = J/(m r²) on a slope: a = g sin β/(1 + k), friction m a − m g sin β, normal m g cos β.
TEST(Rolling, DownASlope) {
  constexpr double slope = 0.3, r = 0.1, m = 2, J = 0.012, k = J / (m * r * r);
  for (const Method& method : methods) {
    const Whole w = run("gravity: [0, -9.81]\nground: {points: {L: {at: [1, 2], angle: " + number(-slope) +
                            "}}}\nbodies:\n  disc: {pose: {at: [" + number(1 + r * std::sin(slope)) + ", " +
                            number(2 + r * std::cos(slope)) + "], angle: 1}, rigid: {mass: 2, inertia: 0.012}}\n" +
                            "joints: {contact: {rolling: [ground.L, disc], radius: 0.1}}\n" + rest,
                        method);
    expect_sound(w);
    const double a = g * std::sin(slope) / (1 + k), t = 0.1, way = a * t * t / 2;
    EXPECT_NEAR(w.last("disc.x [m]"), 1 + r * std::sin(slope) + way * std::cos(slope), way * 10 * method.near);
    EXPECT_NEAR(w.last("disc.angle [rad]"), 1 - way / r, way / r * 10 * method.near);
    EXPECT_NEAR(w.last("contact.normal [N]"), m * g * std::cos(slope), 1e-6 + 1e3 * method.near);
    EXPECT_NEAR(w.last("contact.force [N]"), m * (a - g * std::sin(slope)), 1e-6 + 1e3 * method.near);
    EXPECT_NEAR(w.run.unexplained, 0, 1e-6);
  }
}

// In a bowl of radius R: ω² = g/((R − r)(1 + k)); on the top of a drum it falls with the same, ω² < 0; and a full swing keeps its energy.
TEST(Rolling, InABowlAndOnADrum) {
  constexpr double R = 1, r = 0.2, k = 0.4;
  const auto scene = [&](bool inside) {
    const double y = inside ? -(R - r) : R + r;
    return pintle::read_scene_text("gravity: [0, -9.81]\nbodies:\n  disc: {pose: {at: [0, " + number(y) +
                                       "]}, rigid: {mass: 1.5, inertia: " + number(1.5 * k * r * r) +
                                       "}}\njoints: {contact: {rolling: [ground, disc], radii: [1, 0.2]" +
                                       (inside ? ", inside: true" : "") + "}}\nstart: {disc: {vx: " + (inside ? "2.5" : "0") + "}}\n" +
                                       "run: {until: 2, tolerance: 1e-10}\noutput: {frames: 0, every: 0.1}\n",
                                   "s.yaml");
  };
  for (const bool inside : {true, false}) {
    const Scene s = scene(inside);
    const Model model = build(s);
    State start = assemble(s, model).start;
    start.y.segment(model.system.n(), model.system.n()).setZero();
    const Linearization about = linearize(s, model, start);
    const double rate = std::sqrt(g / ((inside ? R - r : R + r) * (1 + k)));
    double found = 0;
    for (const LinearMode& mode : about.modes) found = std::max(found, inside ? mode.root.imag() : mode.root.real());
    EXPECT_NEAR(found, rate, 1e-7 * rate);
  }
  const Whole w = run(scene(true));
  expect_sound(w);
  const auto x = w.column("disc.x [m]"), y = w.column("disc.y [m]"), angle = w.column("disc.angle [rad]");
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(std::hypot(x[i], y[i]), R - r, 1e-9);
    EXPECT_NEAR(angle[i], -std::atan2(x[i], -y[i]) * (R - r) / r, 1e-8);
  }
}

// ---- bad input ----

TEST(GearInput, IsRefusedWithTheRemedy) {
  const auto refused = [](const std::string& coupling, double apart, const std::vector<std::string>& parts) {
    expect_refused([&] { build(pintle::read_scene_text(two_wheels(coupling, apart) + rest, "s.yaml")); }, parts);
  };
  refused("{gear: [a, b], radii: [0.1, 0.2]}", 0.32, {"s.yaml:8", "joints.pair", "320 mm", "100 mm", "200 mm", "300 mm"});
  refused("{gear: [a, b], radii: [0.1, 0.2]}", 0.1, {"100 mm apart", "inside: true"});
  refused("{gear: [a, b], radii: [0.1, 0.2], inside: true}", 0.3, {"leave out inside"});
  refused("{gear: [a, b], radii: [0.1, 0]}", 0.3, {"joints.pair.radii", "must be greater than 0"});
  refused("{gear: [a, b], teeth: [30.5, 61]}", 0.3, {"s.yaml:8", "joints.pair.teeth", "30.5", "whole", "radii"});
  refused("{gear: [a, b], teeth: [20, -40]}", 0.3, {"joints.pair.teeth", "must be greater than 0"});
  refused("{belt: [a, b], radii: [0.1, 0.25]}", 0.3, {"joints.pair", "300 mm apart", "350 mm"});
  refused("{belt: [a, b], radii: [-0.1, 0.1], crossed: true}", 0.3, {"joints.pair.radii", "must be greater than 0"});
  refused("{rack: [a, b], radius: -0.2}", 0.3, {"joints.pair.radius"});
  refused("{rolling: [a, b], radius: 0}", 0.3, {"joints.pair.radius"});
  refused("{differential: [{angle: [ground, a]}, {angle: [a, ground], ratio: 2}]}", 0.3, {"joints.pair.differential", "ratios"});
  refused("{gear: [a, b]}", 0.3, {"lacks a required key", "radii", "teeth"});
  refused("{gear: [a, b], radii: [0.1, 0.2], teeth: [1, 2]}", 0.3, {"teeth", "keep one of them"});
  refused("{gear: [a, b], radii: [0.1, 0.2], clearance: {gap: 1}}", 0.3, {"clearance", "does not belong to the clearance of a gear"});
  refused("{gear: [a, b], radii: [0.1, 0.2], friction: {}}", 0.3, {"friction", "does not belong to gear"});
  refused("{belt: [a, b], radii: [0.1, 0.2], crossed: true}", 0.25, {"250 mm", "300 mm"});
  refused("{rack: [a, b], radius: 0.2}", 0.3, {"joints.pair", "0 mm off the line", "200 mm"});
  refused("{rolling: [a, b], radius: 0.2, inside: true}", 0.3, {"inside", "radii"});
  refused("{gear: [a, a], radii: [0.1, 0.2]}", 0.3, {"both ends are on \"a\""});
}

// Trains that ask two ratios of one pair of wheels, or an odd ring of wheels, stand under a torque, and are named; others are not.
TEST(GearTrain, ThatHoldsItselfIsNamed) {
  const std::string torque = "forces: {push: {torque: 1, on: a}}\n" + rest;
  const auto warned = [](const std::string& scene) {
    std::string all;
    for (const std::string& warning : run(scene).run.warnings) all += warning + "\n";
    return all;
  };
  const std::string pair = two_wheels("{gear: [a, b], radii: [0.1, 0.2]}");
  pintle_test::expect_says(warned(pair + "  second: {gear: [a, b], radii: [0.14, 0.16]}\n" + torque),
                           {"the couplings \"pair\" and \"second\" hold each other still", "contradict"});
  EXPECT_EQ(warned(pair + "  second: {gear: [a, b], radii: [0.1, 0.2]}\n" + torque).find("still"), std::string::npos);
  EXPECT_EQ(warned(pair + torque).find("still"), std::string::npos);
  EXPECT_EQ(warned(pair + "  hold: {weld: [ground.B, b]}\n" + torque).find("still"), std::string::npos) << "held by a joint";

  const std::string ring = R"(
ground: {points: {B: [0.3, 0], C: [0.15, 0.25980762113533157]}}
bodies:
  a: {rigid: {mass: 1, inertia: 2e-3}}
  b: {pose: {at: [0.3, 0]}, rigid: {mass: 1, inertia: 2e-3}}
  c: {pose: {at: [0.15, 0.25980762113533157]}, rigid: {mass: 1, inertia: 2e-3}}
joints:
  ja: {revolute: [ground, a]}
  jb: {revolute: [ground.B, b]}
  jc: {revolute: [ground.C, c]}
  ab: {gear: [a, b], radii: [0.15, 0.15]}
  bc: {gear: [b, c], radii: [0.15, 0.15]}
)";
  pintle_test::expect_says(warned(ring + "  ca: {gear: [c, a], radii: [0.15, 0.15]}\n" + torque),
                           {"the couplings \"ab\", \"bc\" and \"ca\" hold each other still"});
  EXPECT_EQ(warned(ring + torque).find("still"), std::string::npos);
}

// Trains that ask two ratios of one pair of wheels, and are driven: what contradicts what is named, at speeds and at accelerations.
TEST(GearInput, NamesTheCouplingsOfATrainThatContradictsItself) {
  const std::string triangle =
      "ground: {points: {B: [0.2, 0], C: [0.1, 0.17320508075688773]}}\nbodies:\n  a: {rigid: {mass: 1, inertia: 1e-3}}\n"
      "  b: {rigid: {mass: 1, inertia: 1e-3}, pose: {at: [0.2, 0]}}\n"
      "  c: {rigid: {mass: 1, inertia: 1e-3}, pose: {at: [0.1, 0.17320508075688773]}}\njoints:\n"
      "  A: {revolute: [ground, a]}\n  B: {revolute: [ground.B, b]}\n  C: {revolute: [ground.C, c]}\n"
      "  ab: {gear: [a, b], radii: [0.1, 0.1]}\n  bc: {gear: [b, c], radii: [0.1, 0.1]}\n  ca: {gear: [c, a], radii: [0.1, 0.1]}\n";
  const std::string twice = two_wheels("{gear: [a, b], radii: [0.1, 0.2]}") + "  loop: {belt: [a, b], radii: [0.1, 0.1]}\n";
  const auto said = [](const std::string& text) {
    try {
      return run(text).run.reason;
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
  };
  for (const char* law : {"2*t", "2*t^2"}) {
    const std::string motor = "drivers: {motor: {angle: [ground, a], law: " + std::string(law) + "}}\n" + rest;
    pintle_test::expect_says(said(triangle + motor), {"ab", "bc", "ca", "motor", "remove"});
    pintle_test::expect_says(said(twice + motor), {"pair", "loop", "motor", "remove"});
  }
}

}  // namespace
}  // namespace pintle::gear_test
