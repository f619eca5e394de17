// Backlash of gears and racks, against impacts, statics and motions written by hand: docs/theory/gears.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/configuration/equilibrium.h"
#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::backlash_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::Method, pintle_scenes::number, pintle_scenes::run, pintle_scenes::struck_by,
    pintle_scenes::Whole;
using pintle_test::expect_refused;

constexpr double play = 0.6e-3, slant = 0.35, push = 1000;
const std::string rest = "run: {until: 0.02}\noutput: {frames: 0, every: 1 ms}\n";

/// Two parts that teeth join, at the speeds s of which the pitch circles slip by c_a s_a + c_b s_b.
struct Pair {
  const char* name;
  std::string bodies, coupling;
  double c_a, c_b, J_a, J_b;  ///< [m or 1], [kg m² or kg]
  const char* of_a;           ///< column of its speed
  double across, apart;       ///< force on a's axle along y and x, over that along the pitch circles and its part along the line of centres
};
void PrintTo(const Pair& p, std::ostream* out) { *out << p.name; }

std::string wheels(double apart) {
  return "ground: {points: {B: [" + number(apart) + ", 0]}}\nbodies:\n  a: {rigid: {mass: 1, inertia: 2e-3}}\n  b: {pose: {at: [" +
         number(apart) +
         ", 0]}, rigid: {mass: 2, inertia: 5e-3}}\njoints:\n  at A: {revolute: [ground, a]}\n  at B: {revolute: [ground.B, b]}\n";
}
const std::string rail =
    "ground: {points: {B: [0.05, 0.1]}}\nbodies:\n  a: {rigid: {mass: 0.5, inertia: 1e-3}}\n"
    "  b: {pose: {at: [0.05, 0.1]}, rigid: {mass: 2, inertia: 5e-3}}\n"
    "joints:\n  at A: {prismatic: [ground, a]}\n  at B: {revolute: [ground.B, b]}\n";
const std::vector<Pair> pairs{
    {"Gear", wheels(0.3), "gear: [a, b], radii: [0.1, 0.2]", 0.1, 0.2, 2e-3, 5e-3, "a.speed [rad/s]", -1, 1},
    {"Teeth", wheels(0.3), "gear: [a, b], teeth: [20, 40]", 0.1, 0.2, 2e-3, 5e-3, "a.speed [rad/s]", -1, 1},
    {"Ring", wheels(0.1), "gear: [a, b], radii: [0.1, 0.2], inside: true", 0.1, -0.2, 2e-3, 5e-3, "a.speed [rad/s]", 1, -1},
    {"RingFirst", wheels(0.1), "gear: [a, b], radii: [0.2, 0.1], inside: true", 0.2, -0.1, 2e-3, 5e-3, "a.speed [rad/s]", -1, -1},
    {"Rack", rail, "rack: [a, b], radius: 0.1", -1, 0.1, 0.5, 5e-3, "a.vx [m/s]", 0, 0},
};

std::string scene(const Pair& p, const std::string& clearance, double angle, double backlash = play) {
  return p.bodies + "  teeth: {" + p.coupling + ", clearance: {backlash: " + number(backlash) +
         (angle > 0 ? ", pressure angle: " + number(angle) : "") + ", " + clearance + "}}\n";
}
/// On the pitch circles [kg].
double mass(const Pair& p) { return 1 / (p.c_a * p.c_a / p.J_a + p.c_b * p.c_b / p.J_b); }

class Backlash : public testing::TestWithParam<Pair> {
 protected:
  const Pair pair_ = GetParam();
  /// a is thrown at b, which rests.
  std::string thrown(double speed) const {
    return std::string("start: {a: {") + (pair_.of_a[2] == 'v' ? "vx: " : "speed: ") + number(speed) + "}, b: {speed: 0}}\n";
  }
};
INSTANTIATE_TEST_SUITE_P(Each, Backlash, testing::ValuesIn(pairs), [](const auto& p) { return p.param.name; });

// ---- impacts ----

// Between flanks nothing turns the wheels, an impact reverses the slip by Newton's law and leaves J_a s_a/c_a − J_b s_b/c_b as it is.
TEST_P(Backlash, FliesFromFlankToFlankByNewtonsLaw) {
  constexpr double e = 0.6;
  const double slip = 0.3, m = mass(pair_), s_a = slip / pair_.c_a;
  std::vector<Method> methods = struck_by;
  methods.push_back({"Moreau", "moreau", 1e-6, 1e-2});
  for (const double angle : {0.0, slant})
    for (const Method& method : methods) {
      SCOPED_TRACE(std::string(method.name) + number(angle));
      Scene s = read_scene_text(scene(pair_, "model: impact, restitution: 0.6", angle) + thrown(s_a) + rest, "s.yaml");
      if (method.words == "moreau") s.run.step = 1e-5;
      const Whole w = run(s, method);
      ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
      double begin = play / 2 / slip, now = slip;
      std::size_t k = 0;
      for (; begin < 0.02; ++k) {
        ASSERT_GT(w.run.impacts.size(), k);
        const Impact& impact = w.run.impacts[k];
        EXPECT_NEAR(impact.begin, begin, std::max(method.near * begin, method.near > 1e-3 ? 2e-4 : 0));
        EXPECT_NEAR(impact.approach, std::abs(now) * std::cos(angle), 1e-8);
        EXPECT_NEAR(impact.impulse, m * (1 + e) * std::abs(now) / std::cos(angle), 1e-8);
        now *= -e;
        begin += play / std::abs(now);
      }
      EXPECT_EQ(w.run.impacts.size(), k);
      EXPECT_NEAR(w.last(pair_.of_a), s_a + pair_.c_a * m * (now - slip) / pair_.J_a, 1e-8);
      EXPECT_NEAR(w.last("b.speed [rad/s]"), pair_.c_b * m * (now - slip) / pair_.J_b, 1e-8);
      for (const double x : w.column("teeth.travel [m]")) EXPECT_LE(std::abs(x), play / 2 + (method.near > 1e-3 ? 1e-5 : 1e-9));
    }
}

// On a linear stiffness along the line of action, of the mass m/cos² there, an impact is half a swing.
TEST_P(Backlash, SwingsOnALinearStiffness) {
  constexpr double k = 1e7;
  for (const double angle : {0.0, slant})
    for (const Method& method : {Method{"dopri5", "dopri5", 1e-10, 1e-7}, Method{"alpha", "generalized-alpha", 1e-8, 2e-3}}) {
      SCOPED_TRACE(std::string(method.name) + number(angle));
      const double slip = -0.3, m = mass(pair_) / std::pow(std::cos(angle), 2), v = 0.3 * std::cos(angle);
      const Whole w =
          run(scene(pair_, "normal: {spring-damper: {stiffness: 1e7, damping: 0}}", angle) + thrown(slip / pair_.c_a) + rest, method);
      expect_sound(w);
      ASSERT_GE(w.run.impacts.size(), 3u);
      const double held = M_PI * std::sqrt(m / k);
      for (std::size_t i = 0; i < 3; ++i) {
        const Impact& impact = w.run.impacts[i];
        EXPECT_NEAR(impact.begin, play / 2 / 0.3 + static_cast<double>(i) * (held + play / 0.3), method.near * 0.01);
        EXPECT_NEAR(impact.end - impact.begin, held, 3 * method.near * held);
        EXPECT_NEAR(impact.separation, v, method.near * v);
        EXPECT_NEAR(impact.deepest, v * std::sqrt(m / k), method.near * v * std::sqrt(m / k));
        EXPECT_NEAR(impact.peak_force, v * std::sqrt(m * k), method.near * v * std::sqrt(m * k));
      }
    }
}

// ---- at rest and along with the ideal gear ----

double effort(const Pair& p) { return p.c_a * push; }
std::string pushed(const Pair& p, double sign) {
  const std::string size = number(sign * effort(p));
  return p.of_a[2] == 'v' ? "forces: {f: {force: [" + size + ", 0], at: a}}\n" : "forces: {f: {torque: " + size + ", on: a}}\n";
}

// b held, a pressed, by a linear flank of 1e8 N/m.
Equilibrium pressed(const Pair& p, double angle, double sign) {
  const Scene s = ready_for_statics(read_scene_text(scene(p, "normal: {spring-damper: {stiffness: 1e8, damping: 100}}", angle) +
                                                        pushed(p, sign) + "drivers: {brake: {angle: [ground, b], law: 0}}\n" + rest,
                                                    "s.yaml"));
  const Model model = build(s);
  return find_equilibrium(s, model, assemble(s, model));
}

// Off the ideal gear by half the backlash and what the flank gives; bearings carry the force of slanted teeth.
TEST_P(Backlash, AtRestIsOffByHalfAndWhatAFlankGives) {
  constexpr double k = 1e8;
  for (const double angle : {0.0, slant})
    for (const double sign : {1.0, -1.0}) {
      const Equilibrium at_rest = pressed(pair_, angle, sign);
      ASSERT_TRUE(at_rest.found) << at_rest.reason;
      const auto value = [&](const std::string& column) { return at_rest.table.column(column).at(0); };
      const double normal = push / std::cos(angle), gives = normal / k / std::cos(angle);
      EXPECT_NEAR(value("teeth.travel [m]"), sign * (play / 2 + gives), 1e-12);
      EXPECT_NEAR(value("teeth.depth [m]"), normal / k, 1e-12);
      EXPECT_NEAR(value("teeth.normal [N]"), normal, 1e-6);
      EXPECT_NEAR(value("teeth.force [N]"), -sign * push, 1e-6);
      EXPECT_NEAR(value("brake.torque on b [N m]"), sign * pair_.c_b * push, 1e-6);
      if (pair_.apart == 0) continue;
      EXPECT_NEAR(value("at A.fy on a [N]"), -sign * pair_.across * push, 1e-5);
      EXPECT_NEAR(value("at A.fx on a [N]"), pair_.apart * push * std::tan(angle), 1e-5);
      EXPECT_NEAR(value("at B.fx on b [N]"), -pair_.apart * push * std::tan(angle), 1e-5);
    }
}

// Axles that are farther apart have more backlash, of slanted teeth.
TEST(BacklashOfAxles, GrowsAsTheyPart) {
  constexpr double more = 8e-5, k = 1e8;
  double travel[2];
  for (const double sign : {1.0, -1.0}) {
    Pair p = pairs[0];
    p.bodies = wheels(0.3 + more);
    const Equilibrium at_rest = pressed(p, slant, sign);
    ASSERT_TRUE(at_rest.found) << at_rest.reason;
    travel[sign > 0] = at_rest.table.column("teeth.travel [m]").at(0);
  }
  const double gives = push / k / std::pow(std::cos(slant), 2);
  EXPECT_NEAR(travel[1] - travel[0], play + 2 * more * std::tan(slant) + 2 * gives, 1e-11);
}

// Driven back and forth under a load that keeps one flank closed, b is off the ideal gear by half the backlash and F/k.
TEST(BacklashLimit, IsTheIdealGearAtTheRateOfPlayAndCompliance) {
  constexpr double load = 2, r_a = 0.1, r_b = 0.2, J_b = 5e-3;
  for (const double backlash : {1e-3, 1e-4, 1e-5})
    for (const double k : {1e7, 1e8}) {
      SCOPED_TRACE(number(backlash) + " " + number(k));
      const Whole w =
          run(scene(pairs[0], "normal: {spring-damper: {stiffness: " + number(k) + ", damping: " + number(1e-4 * k) + "}}", 0, backlash) +
              "forces: {load: {torque: 2, on: b}}\ndrivers: {motor: {angle: [ground, a], law: 0.5 rad*sin(6 rad/s*t)}}\n"
              "run: {until: 1, tolerance: 1e-9}\noutput: {frames: 0, every: 20 ms}\n");
      expect_sound(w);
      const std::vector<double> t = w.column("t [s]"), a = w.column("a.angle [rad]"), b = w.column("b.angle [rad]"),
                                force = w.column("teeth.force [N]");
      for (std::size_t i = 0; i < t.size(); ++i) {
        if (t[i] < 0.5) continue;
        const double F = (-r_a / r_b * 0.5 * -36 * std::sin(6 * t[i]) * J_b - load) / r_b;  // on the rim of b
        EXPECT_NEAR(force[i], F, 1e-3 * std::abs(F)) << t[i];
        EXPECT_NEAR(r_a * a[i] + r_b * b[i], backlash / 2 - F / k, 1e-3 * std::abs(F) / k + 1e-11) << t[i];
      }
    }
}

// On an arm that goes round several times.
TEST(BacklashOnAnArm, StaysWithinItself) {
  const Whole w = run(R"yaml(
bodies:
  arm: {rigid: {mass: 1, inertia: 0.01}, points: {P: [0.3, 0]}}
  planet: {pose: {at: [0.3, 0]}, rigid: {mass: 1, inertia: 5e-3}}
joints:
  axle: {revolute: [ground, arm]}
  pin: {revolute: [arm.P, planet]}
  mesh: {gear: [ground, planet], radii: [0.2, 0.1], clearance: {backlash: 1 mm, pressure angle: 20 deg, normal: {flores: {restitution: 0.3, stiffness: 1e9}}}}
drivers: {motor: {angle: [ground, arm], law: 8 rad/s*t + 0.5 rad*sin(20 rad/s*t)}}
run: {until: 2, tolerance: 1e-8}
output: {frames: 0, every: 10 ms}
)yaml");
  expect_sound(w);
  EXPECT_GT(w.run.impacts.size(), 10u);
  double deepest = 0;
  for (const Impact& i : w.run.impacts) deepest = std::max(deepest, i.deepest);
  const std::vector<double> arm = w.column("arm.angle [rad]"), planet = w.column("planet.angle [rad]"),
                            travel = w.column("mesh.travel [m]");
  for (std::size_t i = 0; i < arm.size(); ++i) {
    EXPECT_NEAR(0.1 * planet[i] - 0.3 * arm[i], travel[i], 1e-9);
    EXPECT_LE(std::abs(travel[i]), 0.5e-3 + 1.1 * deepest);
  }
}

// A flank that is pressed is a stiffness to small motions.
TEST(BacklashLinearized, SwingsOnTheFlankThatIsClosed) {
  constexpr double k = 1e8;
  const Scene s = read_scene_text(scene(pairs[0], "normal: {spring-damper: {stiffness: 1e8, damping: 100}}", slant) + pushed(pairs[0], 1) +
                                      "drivers: {brake: {angle: [ground, b], law: 0}}\nstart: equilibrium\n" + rest,
                                  "s.yaml");
  const Model model = build(s);
  const Linearization about = linearize(s, model, assemble(s, model).start);
  double found = 0;
  for (const LinearMode& mode : about.modes) found = std::max(found, std::abs(mode.root));
  EXPECT_NEAR(found, 0.1 * std::cos(slant) * std::sqrt(k / 2e-3), 1e-6 * found);
}

// ---- rattle ----

/// Approach speeds of teeth that fly between flanks x = A sin ωt and A sin ωt + play, drawn back by g; the last two, by hand.
std::array<double, 2> rattle(double A, double omega, double gap, double g, double e, int periods) {
  double t = 0, x = gap / 2, v = A * omega;
  std::array<double, 2> last{};
  const double h = 2 * M_PI / omega / 2000;
  while (t < periods * 2 * M_PI / omega) {
    const auto below = [&](double s) { return x + v * s - g * s * s / 2 - A * std::sin(omega * (t + s)); };
    double step = h;
    const bool lower = below(h)<0, upper = below(h)> gap;
    for (double low = 0, bits = 0; (lower || upper) && bits < 50; ++bits) {
      const double middle = (low + step) / 2;
      ((lower ? below(middle) < 0 : below(middle) > gap) ? step : low) = middle;
    }
    x += v * step - g * step * step / 2, v -= g * step, t += step;
    const double flank = A * omega * std::cos(omega * t);
    if ((lower && v < flank) || (upper && v > flank)) last = {last[1], std::abs(v - flank)}, v = flank - e * (v - flank);
  }
  return last;
}

TEST(GearRattle, HasTheSpeedsOfTheExample) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/gear_backlash.yaml", {{"joints.mesh.clearance.model", "impact"}});
  const double omega = 2 * 800 * 2 * M_PI / 60, g = 0.02 * 0.06 / 2e-3, e = 0.5;
  for (const bool rigid : {true, false}) {
    if (!rigid) s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/gear_backlash.yaml");
    const Whole w = run(s);
    expect_sound(w);
    const std::array<double, 2> by_hand = rattle(5e-5, omega, 3e-4, g, e, 40);
    const std::vector<Impact>& all = w.run.impacts;
    ASSERT_GT(all.size(), 70u);
    const double near = rigid ? 2e-3 : 2e-2;  // what is left of the start; a contact takes half a hundredth of a period
    std::array<double, 2> last{all[all.size() - 2].approach, all.back().approach}, speeds = by_hand;
    std::ranges::sort(last), std::ranges::sort(speeds);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(last[i], speeds[i], near * speeds[i]) << rigid;
    EXPECT_NEAR(last[1] - last[0], g * 2 * M_PI / omega / (1 + e), near * speeds[1]) << rigid;
  }
}

// ---- events ----

// Wheels that are parted and still turn together mesh again; not those of which one has fallen behind.
TEST(BacklashEvents, TeethMeshAgainWhereTheyFit) {
  const auto parted = [](const std::string& load) {
    return run(scene(pairs[0], "normal: {flores: {restitution: 0.5, stiffness: 1e9}}", 0) +
               "drivers: {motor: {angle: [ground, a], law: 10 rad/s*t}}\nforces: {load: {torque: \"if(t > " + load +
               ", 1, 0)*1 N m\", on: b}}\nevents:\n  open: {when: t > 5 ms, do: {release: teeth}}\n"
               "  shut: {when: t > 20 ms, do: {engage: teeth}}\nrun: {until: 60 ms}\noutput: {frames: 0, every: 1 ms}\n");
  };
  const Whole meshed = parted("30 ms");
  expect_sound(meshed);
  EXPECT_GE(meshed.run.impacts.size(), 2u);
  EXPECT_NEAR(meshed.last("teeth.force [N]"), -5, 1e-3);  // 1 N m at 0.2 m
  EXPECT_NEAR(meshed.last("teeth.travel [m]"), play / 2, 1e-5);
  const Whole behind = parted("8 ms");
  EXPECT_NE(behind.run.status, Status::finished);
  EXPECT_NE(behind.run.reason.find("half the backlash of its teeth"), std::string::npos) << behind.run.reason;
}

// Parted wheels slip by many teeth, and mesh again in the gap where they are by then.
TEST(BacklashEvents, TeethMeshInTheNearestGapAfterALongSlip) {
  const double pitch = 2 * M_PI * 0.1 / 20;
  const std::string wheels_driven =
      "drivers: {motor: {angle: [ground, a], law: 10 rad/s*t}}\nforces: {drag: {torque: -0.5 N m s*b.speed, on: b}}\n";
  const std::string pinion_driven =
      "drivers: {motor: {angle: [ground, b], law: 10 rad/s*t}}\nforces: {drag: {force: [-12.5 N s/m*a.vx, 0], at: a}}\n";
  const auto slipped = [&](const Pair& pair, const std::string& when) {
    return run(scene(pair, "normal: {flores: {restitution: 0.5, stiffness: 1e9}}", 0) +
               (pair.of_a[2] == 'v' ? pinion_driven : wheels_driven) +
               "events:\n  open: {when: t > 5 ms, once: true, do: {release: teeth}}\n"
               "  shut: {when: \"" +
               when + "\", once: true, do: {engage: teeth}}\nrun: {until: 0.5}\noutput: {frames: 0, every: 1 ms}\n");
  };
  Pair ring = pairs[2];
  ring.coupling = "gear: [a, b], teeth: [20, 40], inside: true";
  Pair rack = pairs[4];
  rack.coupling += ", teeth: 20";
  for (const Pair& pair : {pairs[1], ring, rack}) {
    SCOPED_TRACE(pair.coupling);
    const Whole w = slipped(pair, "t > 0.2 s && abs(sin(pi*teeth.travel/(" + number(pitch) + " m))) < 0.01");
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_EQ(w.run.happenings.size(), 2u);
    const double slip = pair.c_a * w.last(pair.of_a[2] == 'v' ? "a.x [m]" : "a.angle [rad]") + pair.c_b * w.last("b.angle [rad]");
    EXPECT_GT(slip, 5 * pitch);
    EXPECT_NEAR(std::remainder(slip, pitch), w.last("teeth.travel [m]"), 1e-9);
    EXPECT_NEAR(w.last("teeth.travel [m]"), play / 2, 1e-5);
    EXPECT_NEAR(std::abs(w.last("teeth.force [N]")), 0.5 * 5 / 0.2, 1e-3);
  }
  const Whole unknown = slipped(pairs[0], "t > 0.2 s");
  EXPECT_EQ(unknown.run.status, Status::failed);
  pintle_test::expect_says(unknown.run.reason, {"\"teeth\" cannot be engaged", "gap of the start", "`teeth`"});
  const Whole against = slipped(pairs[1], "abs(teeth.travel) > 10 mm");
  EXPECT_EQ(against.run.status, Status::failed);
  pintle_test::expect_says(against.run.reason, {"\"teeth\" cannot be engaged", "nearest gap", "`travel`"});
}

// ---- input ----

TEST(BadBacklash, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    std::string joint, key, says;
  };
  const std::string law = "normal: {spring-damper: {stiffness: 1e8, damping: 0}}", gear = "gear: [a, b], radii: [0.1, 0.2], clearance: ";
  for (const Bad& bad : std::vector<Bad>{
           {gear + "{" + law + "}", "joints.j.clearance", "add for example backlash: 0.1 mm"},
           {gear + "{backlash: 0, " + law + "}", "clearance.backlash", "greater than 0"},
           {gear + "{backlash: -1 mm, " + law + "}", "clearance.backlash", "greater than 0"},
           {gear + "{backlash: 1 deg, " + law + "}", "clearance.backlash", "length"},
           {gear + "{backlash: 150 mm, " + law + "}", "clearance.backlash", "less than the radius 100 mm"},
           {"gear: [a, b], teeth: [20, 40], clearance: {backlash: 40 mm, " + law + "}", "joints.j.clearance", "31.42 mm"},
           {gear + "{backlash: 1 mm}", "joints.j.clearance", "add for example normal"},
           {gear + "{backlash: 1 mm, gap: 1 mm, " + law + "}", "clearance.gap", "does not belong"},
           {gear + "{backlash: 1 mm, pressure angle: 50 deg, " + law + "}", "pressure angle", "less than 45 deg"},
           {gear + "{backlash: 1 mm, pressure angle: 0, " + law + "}", "pressure angle", "greater than 0"},
           {gear + "{backlash: 1 mm, friction: {coulomb: {coefficient: 0.1}}, " + law + "}", "clearance.friction", "roll without slip"},
           {gear + "{backlash: 1 mm, normal: {hertz: {young: 200 GPa, poisson: 0.3}}}", "joints.j.clearance", "pressure angle: 20 deg"},
           {"gear: [a, b], teeth: [20, 40], clearance: {backlash: 1 mm, pressure angle: 20 deg, normal: {johnson: {length: 10 mm, young: "
            "200 "
            "GPa, poisson: 0.3}}}",
            "joints.j.clearance", "radii"},
           {"belt: [a, b], radii: [0.1, 0.1], clearance: {backlash: 1 mm, " + law + "}", "joints.j.clearance", "does not belong to belt"},
           {"rolling: [a, b], radii: [0.1, 0.2], clearance: {backlash: 1 mm, " + law + "}", "joints.j.clearance",
            "does not belong to rolling"},
           {"revolute: [ground.B, b], clearance: {radial: 1 mm, bearing radius: 5 mm, bearing: b, backlash: 1 mm, " + law + "}",
            "clearance.backlash", "does not belong"}}) {
    SCOPED_TRACE(bad.joint);
    expect_refused([&] { build(read_scene_text(wheels(0.3) + "  j: {" + bad.joint + "}\n" + rest, "scene.yaml")); }, {bad.key, bad.says});
  }
}

// Elastic laws know how round the flanks are by the pressure angle: of cylinders of r sin α.
TEST(BacklashLaws, KnowHowRoundFlanksAre) {
  const auto law = [](const std::string& angle) {
    const std::string text = scene(pairs[0], "pressure angle: " + angle + ", normal: {hertz: {young: 200 GPa, poisson: 0.3}}", 0) + rest;
    return std::get<ImpactLaw>(build(read_scene_text(text, "s.yaml")).system.contacts.at(0).normal).k;
  };
  EXPECT_NEAR(law("20 deg") / law("30 deg"), std::sqrt(std::sin(M_PI / 9) / std::sin(M_PI / 6)), 1e-12);
}

}  // namespace
}  // namespace pintle::backlash_test
