// Contacts between profiles of bodies, in whole runs: against closed forms and against clearance joints.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::profile_contact_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81;

Scene scene(const std::string& text) { return read_scene_text(text, "scene.yaml"); }

// A ball above a floor, dropped.
std::string ball(const std::string& law, double height = 0.1, const std::string& more = "", double until = 0.4) {
  return "gravity: [0, -9.81]\n"
         "bodies: {ball: {rigid: {mass: 0.5, inertia: 1e-4}, profiles: {skin: {disc: [0, 0], radius: 20 mm}}}}\n"
         "ground: {profiles: {floor: {path: [[1, 0], [-1, 0]]}}}\n"
         "contacts: {bounce: {between: [ball.skin, ground.floor], normal: {" +
         law + "}" + more + "}}\nstart: {ball: {y: " + std::to_string(0.02 + height) +
         ", vx: 0.3}}\nrun: {until: " + std::to_string(until) + " s, tolerance: 1e-9}\noutput: {every: 1 ms}\n";
}

TEST(ProfileContact, ABallBouncesWithTheRestitutionAskedFor) {
  const Whole w = run(ball("exact: {restitution: 0.8, stiffness: 1e9}"));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 2u);
  const Impact& first = w.run.impacts[0];
  EXPECT_NEAR(first.begin, std::sqrt(2 * 0.1 / g), 1e-8);
  EXPECT_NEAR(first.approach, std::sqrt(2 * g * 0.1), 1e-8);
  EXPECT_NEAR(first.separation / first.approach, 0.8, 2 * g * first.deepest / std::pow(first.approach, 2));  // gravity goes on
  EXPECT_NEAR(w.run.impacts[1].begin - first.end, 2 * first.separation / g, 1e-8);
  EXPECT_NEAR(w.last("ball.x [m]"), 0.3 * 0.4, 1e-9);  // no friction
}

// Hertz: the peak force of an impact at v is k (5 m v²/4k)^0.6.
TEST(ProfileContact, PeakForceIsHertzs) {
  const Whole w = run(ball("hertz: {stiffness: 1e10}"));
  expect_sound(w);
  const double v = w.run.impacts[0].approach, k = 1e10, m = 0.5;
  EXPECT_NEAR(w.run.impacts[0].peak_force / (k * std::pow(5 * m * v * v / (4 * k), 0.6)), 1, 1e-3);
  EXPECT_NEAR(w.run.impacts[0].separation, v, 1e-5 * v);
}

TEST(ProfileContact, EveryMethodSeesTheSameImpacts) {
  const Whole reference = run(ball("flores: {restitution: 0.6, stiffness: 1e9}"));
  for (const std::string method : {"rkf45", "dopri5", "verner87", "{generalized-alpha: {rho: 0.8}}"}) {
    Scene s = scene(ball("flores: {restitution: 0.6, stiffness: 1e9}") + "parameters: {x: 1}\n");
    const bool implicit = method.starts_with("{");
    s.run.method = implicit ? "generalized-alpha" : method;
    s.run.tolerance = implicit ? 1e-7 : 1e-9;
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_EQ(w.run.impacts.size(), reference.run.impacts.size()) << method;
    for (std::size_t i = 0; i < w.run.impacts.size(); ++i) {
      const double near = implicit ? 1e-3 : 1e-5;
      EXPECT_NEAR(w.run.impacts[i].begin, reference.run.impacts[i].begin, near) << method;
      EXPECT_NEAR(w.run.impacts[i].separation, reference.run.impacts[i].separation, 10 * near) << method;
    }
  }
}

// A profile of one arc is a clearance joint.
TEST(ProfileContact, ADiscInAHoleIsAClearanceJoint) {
  const std::string head =
      "gravity: [0, -9.81]\nbodies: {rod: {rigid: {mass: 1, inertia: 0.02}, points: {A: [-0.2, 0]}, profiles: {eye: {hole: A, radius: 10 "
      "mm}}}}\n"
      "ground: {profiles: {pin: {disc: [0, 0], radius: 9.5 mm}}}\n";
  const std::string law =
      "normal: {lankarani-nikravesh: {restitution: 0.7, stiffness: 5e9, approach speed: onset}}, friction: {ambrosio: {coefficient: 0.1}}";
  const std::string tail =
      "start: {rod: {angle: 0.3, x: 0.1910672978251212, y: 0.05910404133226791, vx: -0.05910404133226791, vy: 0.1910672978251212, speed: "
      "1}}\nrun: {until: 0.3 s, tolerance: 1e-10}\noutput: "
      "{every: 1 ms}\n";
  const Whole joint =
      run(head + "joints: {pivot: {revolute: [ground, rod.A], clearance: {radial: 0.5 mm, bearing radius: 10 mm, bearing: rod, " + law +
          "}}}\nstart: {rod: {angle: 0.3, speed: 1}}\n" + tail.substr(tail.find("run:")));
  const Whole profiles = run(head + "contacts: {pivot: {between: [ground.pin, rod.eye], " + law + "}}\n" + tail);
  expect_sound(joint);
  expect_sound(profiles);
  for (const char* column : {"rod.x [m]", "rod.y [m]", "rod.angle [rad]"}) {
    const auto a = joint.column(column), b = profiles.column(column);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-10) << column << " row " << i;
  }
  ASSERT_EQ(joint.run.impacts.size(), profiles.run.impacts.size());
  EXPECT_NEAR(joint.ledger("pivot.lost to hysteresis [J]"), profiles.ledger("pivot.lost to hysteresis [J]"), 1e-10);
  EXPECT_NEAR(joint.ledger("pivot.lost to friction [J]"), profiles.ledger("pivot.lost to friction [J]"), 1e-10);
}

// Corners of a box at rest carry half its weight each; k δ^1.5 = m g/2.
std::string box(double above) {
  return "gravity: [0, -9.81]\nbodies: {box: {rigid: {mass: 2, inertia: 0.01}, profiles: {outline: {path: [[-0.1, -0.05], [0.1, -0.05], "
         "[0.1, "
         "0.05], [-0.1, 0.05]], closed: true}}}}\nground: {profiles: {floor: {path: [[1, 0], [-1, 0]]}}}\n"
         "contacts: {floor: {between: [box.outline, ground.floor], normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e8}}}}\n"
         "start: {box: {y: " +
         std::to_string(0.05 + above) + "}}\nrun: {until: 0.5 s, tolerance: 1e-8}\noutput: {every: 5 ms}\n";
}
const double resting = std::pow(2 * g / 2 / 1e8, 2.0 / 3);

// Dropped, or laid down without any speed: damping that were scaled by an onset of next to none would hold it up.
TEST(ProfileContact, ABoxRestsOnItsTwoCorners) {
  for (const double above : {1e-3, 0.0}) {
    const Whole w = run(box(above));
    expect_sound(w);
    EXPECT_NEAR(w.last("floor.normal [N]"), 2 * g, 0.05 * 2 * g) << above;
    EXPECT_NEAR(w.last("floor.depth [m]"), resting, 0.05 * resting) << above;
    EXPECT_NEAR(w.last("box.angle [rad]"), 0, 1e-9) << above;
  }
}

// Piled so that they touch just so, and fall as one at first: no gap opens or closes until the floor has pushed.
TEST(ProfileContact, BoxesThatTouchSettleInAPyramid) {
  const std::string laws =
      ", normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e7 N/m^1.5}}, friction: {coulomb: {coefficient: 0.4}}}\n";
  const Whole w = run(
      "gravity: [0, -9.81]\nground: {profiles: {floor: {path: [[-1, 0], [2, 0]], material: right}}}\nbodies:\n"
      "  block: {repeat: 3, rigid: {mass: 0.5, inertia: 4.2e-4}, points: {A: [-(6 - index)*1 cm, -3 cm], B: [(6 - index)*1 cm, -3 cm], "
      "C: [(6 - index)*1 cm, 3 cm], D: [-(6 - index)*1 cm, 3 cm]}, profiles: {outline: {path: [A, B, C, D], closed: true, round: 2 mm}}, "
      "pose: {at: [0, (index - 0.5)*6 cm]}}\ncontacts:\n  base: {between: [block 1.outline, ground.floor]" +
      laws + "  mid: {repeat: 2, between: [\"block {index}.outline\", \"block {index + 1}.outline\"]" + laws + "run: {until: 1 s}\n");
  expect_sound(w);
  EXPECT_NEAR(w.last("base.normal [N]"), 1.5 * g, 0.05 * g);
  EXPECT_NEAR(w.last("mid 2.normal [N]"), 0.5 * g, 0.05 * g);
  EXPECT_NEAR(w.last("block 3.x [m]"), 0, 1e-3);
}

TEST(ProfileContact, StaticsFindsTheDepthAtWhichABoxRests) {
  Scene s = scene(box(0));
  s.start_bodies[0].y = 0.05 - resting / 2;
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model));
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.state.y[1], 0.05 - resting, 1e-6 * resting);
}

// A disc rolls over a floor of lines and arcs: one contact from beginning to end, whatever pieces it passes.
TEST(ProfileContact, GoesOnFromPieceToPiece) {
  const Whole w = run(
      "gravity: [0, -9.81]\nbodies: {wheel: {rigid: {mass: 1, inertia: 5e-3}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}}\n"
      "ground: {profiles: {track: {path: [[-1, 0], [0, 0], {arc: 2}, [0.5, 0.06350832689629156], [0.9, 0.1667876]], material: right}}}\n"
      "contacts: {track: {between: [wheel.rim, ground.track], normal: {hertz: {stiffness: 1e9}}}}\n"
      "start: {wheel: {x: -0.5, y: 0.09999954, vx: 3}}\nrun: {until: 0.4 s, tolerance: 1e-9}\noutput: {every: 1 ms}\n");
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_LT(std::abs(w.run.unexplained), 1e-6 * w.run.energy_in_play);
  EXPECT_EQ(w.run.impacts.size(), 1u);
  EXPECT_TRUE(std::isnan(w.run.impacts[0].end));
  EXPECT_GT(w.last("wheel.x [m]"), 0.55);
}

// A cam that is an eccentric disc under a flat follower: it lifts by e sin ωt, and contact is lost where e ω² > g.
std::string cam(double omega) {
  return "gravity: [0, -9.81]\nbodies:\n"
         "  cam: {rigid: {mass: 1, inertia: 1e-3}, points: {middle: [5 mm, 0]}, profiles: {rim: {disc: middle, radius: 30 mm}}}\n"
         "  follower: {rigid: {mass: 0.4, inertia: 1e-3}, profiles: {face: {path: [[-0.1, 0], [0.1, 0]]}}}\n"
         "ground: {points: {up: {at: [0, 0], angle: 90 deg}}}\n"
         "joints: {shaft: {revolute: [ground, cam]}, guide: {prismatic: [ground.up, follower], angle: -90 deg}}\n"
         "drivers: {motor: {angle: [ground, cam], law: " +
         std::to_string(omega) +
         "*t}}\n"
         "contacts: {face: {between: [cam.rim, follower.face], normal: {spring-damper: {stiffness: 1e7, damping: 2000}}}}\n"
         "start: {follower: {y: 0.03, vy: " +
         std::to_string(0.005 * omega) + "}}\nrun: {until: " + std::to_string(4 * std::numbers::pi / omega) +
         " s, tolerance: 1e-9}\noutput: {every: " + std::to_string(std::numbers::pi / omega / 50) + " s}\n";
}

TEST(ProfileContact, AFlatFollowerIsLiftedAsTheCamSays) {
  const double omega = 30;  // e ω² = 4.5 m/s²
  const Whole w = run(cam(omega));
  expect_sound(w);
  const auto t = w.column("t [s]"), y = w.column("follower.y [m]"), N = w.column("face.normal [N]");
  const double mg = 0.4 * g, settled = 0.1;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < settled) continue;
    const double force = mg - 0.4 * 0.005 * omega * omega * std::sin(omega * t[i]);
    EXPECT_NEAR(N[i], force, 0.02 * mg);
    EXPECT_NEAR(y[i], 0.03 + 0.005 * std::sin(omega * t[i]) - force / 1e7, 2e-8);
  }
  for (const Impact& i : w.run.impacts) EXPECT_LT(i.begin, settled);
}

TEST(ProfileContact, AFollowerLeavesACamThatIsTooFast) {
  const double fast = 60;  // e ω² = 18 m/s²: it leaves where sin ωt = g/(e ω²)
  const Whole w = run(cam(fast));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 2u);
  const auto left = std::find_if(w.run.impacts.begin(), w.run.impacts.end(), [](const Impact& i) { return i.end > 1e-3; });
  ASSERT_NE(left, w.run.impacts.end());
  EXPECT_NEAR(left->end, std::asin(g / (0.005 * fast * fast)) / fast, 2e-4);
}

// Free flight takes one long step; the wall in it is thinner than a hundredth of that.
TEST(ProfileContact, NoSpeedTunnels) {
  for (const double v : {1.0, 100.0, 1e4}) {
    Scene s = scene(
        "bodies: {ball: {rigid: {mass: 1e-3, inertia: 1e-8}, profiles: {skin: {disc: [0, 0], radius: 2 mm}}}}\n"
        "ground: {profiles: {plate: {path: [[1, -0.5 mm], [1, 0.5 mm], [-1, 0.5 mm], [-1, -0.5 mm]], closed: true}}}\n"
        "contacts: {hit: {between: [ball.skin, ground.plate], normal: {hertz: {stiffness: 1e16}}}}\n"
        "start: {ball: {x: 0, y: 1, vx: 0, vy: -1}}\nrun: {until: 1 s}\n");
    s.start_bodies[0].vy = -v;
    s.run.until = 3 / v;
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    ASSERT_EQ(w.run.impacts.size(), 1u) << v;
    EXPECT_NEAR(w.run.impacts[0].begin, (1 - 2.5e-3) / v, 1e-9 / v);
    EXPECT_GT(w.last("ball.y [m]"), 0.5) << v;
  }
}

// Two discs meet however far a step takes them, and part again; also by the implicit method.
TEST(ProfileContact, DiscsMeetHeadOnAtAnySpeed) {
  Scene s = scene(
      "bodies:\n  a: {rigid: {mass: 1, inertia: 2e-4}, profiles: {rim: {disc: [0, 0], radius: 20 mm}}}\n"
      "  b: {rigid: {mass: 2, inertia: 4e-4}, profiles: {rim: {disc: [0, 0], radius: 20 mm}}}\n"
      "contacts: {hit: {between: [a.rim, b.rim], normal: {exact: {restitution: 0.7, stiffness: 1e9}}}}\n"
      "start: {a: {x: 0, y: 0, vx: 1}, b: {x: 0.1, y: 0, vx: -1}}\nrun: {until: 0.1 s, tolerance: 1e-7}\n");
  for (const char* method : {"auto", "dopri5", "verner87", "rkf45", "generalized-alpha"})
    for (double v = 0.3; v < 4.3; v += 0.17) {
      s.run.method = method;
      s.start_bodies[1].vx = -v;
      const Whole w = run(s);
      ASSERT_EQ(w.run.status, Status::finished) << method << " at " << v << ": " << w.run.reason;
      ASSERT_EQ(w.run.impacts.size(), 1u) << method << " at " << v;
      EXPECT_NEAR(w.run.impacts[0].begin, 0.06 / (1 + v), 1e-8) << method << " at " << v;
      EXPECT_NEAR(w.run.impacts[0].separation, 0.7 * (1 + v), 1e-3 * (1 + v)) << method << " at " << v;
      EXPECT_NEAR(w.last("a.vx [m/s]") + 2 * w.last("b.vx [m/s]"), 1 - 2 * v, 1e-10) << method << " at " << v;  // momentum
    }
}

// A pin in a slot whose ends are arcs that do not quite meet its sides smoothly, as rounded coordinates make them: no force in mid-air.
TEST(ProfileContact, SmallKinksHoldNoContactInTheAir) {
  for (const double radius : {6.00001, 6.001, 6.01, 6.03, 6.2}) {
    const std::string arc = "{arc: " + std::to_string(radius) + " mm}";
    const Whole w =
        run("gravity: [0, -9.81]\nbodies: {pin: {rigid: {mass: 0.5, inertia: 1e-5}, profiles: {rim: {disc: [0, 0], radius: 4 mm}}}}\n"
            "ground: {profiles: {slot: {path: [[-20 mm, -6 mm], [20 mm, -6 mm], " +
            arc + ", [20 mm, 6 mm], [-20 mm, 6 mm], " + arc +
            "], closed: true, material: outside}}}\n"
            "contacts: {c: {between: [pin.rim, ground.slot], normal: {flores: {restitution: 0.6, stiffness: 1e9}}}}\n"
            "start: {pin: {x: 0, y: 0, vx: 0.9}}\nrun: {until: 0.5 s, tolerance: 1e-8}\noutput: {every: 2 ms}\n");
    ASSERT_EQ(w.run.status, Status::finished) << radius << w.run.reason;
    EXPECT_LT(std::abs(w.run.unexplained), 1e-3 * w.run.energy_in_play) << radius;  // a kink of half a degree is passed as if it were none
    EXPECT_LT(w.last("pin.vx [m/s]") * w.last("pin.vx [m/s]"), 0.9 * 0.9) << radius;
    for (const double x : w.column("pin.x [m]")) EXPECT_LT(std::abs(x), 0.0222) << radius;
  }
}

// A pendulum that starts beyond a wall does not rest on the other side of it.
TEST(ProfileContact, StaticsDoesNotPassThroughAWall) {
  for (const double degrees : {-30.0, -60.0}) {
    Scene s = scene(
        "gravity: [0, -9.81]\nbodies: {arm: {rigid: {mass: 0.5, inertia: 4e-3, center: [0.15, 0]}, points: {O: [0, 0]}, profiles: {tip: "
        "{disc: [0.3, 0], "
        "radius: 20 mm}}}}\nground: {profiles: {wall: {path: [[0.1, 0.5], [0.1, -0.5]], material: right}}}\n"
        "joints: {hinge: {revolute: [ground, arm.O]}}\n"
        "contacts: {stop: {between: [arm.tip, ground.wall], normal: {flores: {restitution: 0.5, stiffness: 1e8}}}}\nstart: {arm: {angle: "
        "0}}\nrun: {until: 1}\n");
    s.start_bodies[0].angle = degrees * std::numbers::pi / 180;
    const Model model = build(s);
    const Equilibrium rest = find_equilibrium(s, model, assemble(s, model));
    ASSERT_TRUE(rest.found) << rest.reason;
    EXPECT_NEAR(0.3 * std::cos(rest.state.y[2]) - 0.02, 0.1, 1e-4) << degrees;
  }
}

// Over the edge of a table: from the line to its corner and into the fall; the books close.
TEST(ProfileContact, ADiscLeavesATableOverItsEdge) {
  const Whole w =
      run("gravity: [0, -9.81]\nbodies: {disc: {rigid: {mass: 1, inertia: 5e-3}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}}\n"
          "ground: {profiles: {table: {path: [[0, -1], [0, 0], [-1, 0]]}}}\n"
          "contacts: {table: {between: [disc.rim, ground.table], normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e8}}}}\n"
          "start: {disc: {x: -0.1, y: 0.1, vx: 0.2}}\nrun: {until: 1.2 s, tolerance: 1e-9}\noutput: {every: 5 ms}\n");
  expect_sound(w);
  EXPECT_GT(w.last("disc.x [m]"), 0.1);
  EXPECT_LT(w.last("disc.y [m]"), -0.5);
}

// A box tumbles down a ramp, from corner to corner, in flights of one step or of many: each method finds the same impacts.
TEST(ProfileContact, EveryMethodTumblesTheSameBox) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/box_and_ramp.yaml");
  s.output.frames = 0;
  s.run.method = "verner87", s.run.tolerance = 1e-10;
  const Whole reference = run(s);
  expect_sound(reference);
  ASSERT_GE(reference.run.impacts.size(), 15u);
  for (const char* method : {"rkf45", "dopri5", "generalized-alpha"}) {
    s.run.method = method, s.run.tolerance = 1e-8;
    const Whole w = run(s);
    expect_sound(w);
    ASSERT_EQ(w.run.impacts.size(), reference.run.impacts.size()) << method;
    const double near = method[0] == 'g' ? 1e-2 : 1e-4;  // 19 impacts make an error some 1e4 times as large
    for (std::size_t i = 0; i < w.run.impacts.size(); ++i)
      EXPECT_NEAR(w.run.impacts[i].begin, reference.run.impacts[i].begin, near) << method << " impact " << i;
    EXPECT_NEAR(w.last("box.x [m]"), reference.last("box.x [m]"), near) << method;
  }
}

// ---- what cannot be ---------------------------------------------------------------------------

const std::string sound =
    "bodies:\n  a: {rigid: {mass: 1, inertia: 1}, points: {A: [0, 0]}, profiles: {skin: {disc: A, radius: 20 mm}}}\n"
    "  b: {rigid: {mass: 1, inertia: 1}, profiles: {skin: {path: [[-1, 0], [1, 0], [1, 1], [-1, 1]], closed: true, round: 1 cm}}, pose: "
    "{at: [0, 3]}}\n"
    "contacts:\n  c: {between: [a.skin, b.skin], normal: {flores: {restitution: 0.5, stiffness: 1e9}}}\nrun: {until: 1}\n";

std::string said(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return pintle_test::refusal_by<std::exception>([&] {
    const Scene s = scene(text);
    assemble(s, build(s));
  });
}

TEST(BadProfile, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    const char *from, *to, *key, *says;
  };
  const std::vector<Bad> all{
      {"radius: 20 mm", "radius: 0 mm", "scene.yaml:2: bodies.a.profiles.skin.radius", "greater than 0"},
      {", radius: 20 mm", "", "scene.yaml:2: bodies.a.profiles.skin", "add for example radius"},
      {"disc: A", "disc: B", "scene.yaml:2: bodies.a.profiles.skin.disc", "has no point \"B\""},
      {"disc: A", "disk: A", "scene.yaml:2: bodies.a.profiles.skin.disk", "Did you mean \"disc\""},
      {"[1, 1]", "[1, 0]", "scene.yaml:3: bodies.b.profiles.skin", "no length between point 2 and point 3"},
      {"[1, 1], [-1, 1]", "[-1, 1], [1, 1]", "scene.yaml:3: bodies.b.profiles.skin", "crosses itself"},
      {"[1, 1], [-1, 1]", "[1, 1], [-1, 1], [-1, 0]", "scene.yaml:3: bodies.b.profiles.skin", "no length between point 5 and point 1"},
      {"[1, 1]", "{arc: 1}, [1, 1], {arc: 0}", "scene.yaml:3: bodies.b.profiles.skin.path", "must not be 0"},
      {"[1, 1]", "{arc: 1}, {arc: 2}, [1, 1]", "scene.yaml:3: bodies.b.profiles.skin.path", "is an arc where a point is needed"},
      {"closed: true", "closed: true, material: left", "scene.yaml:3: bodies.b.profiles.skin.material", "inside or outside"},
      {"closed: true", "material: inside", "scene.yaml:3: bodies.b.profiles.skin.material", "of an open path must be left or right"},
      {"round: 1 cm", "round: 2 m", "scene.yaml:3: bodies.b.profiles.skin", "no room to round"},
      {"b.skin]", "b]", "scene.yaml:5: contacts.c.between", "names no profile. Known here: skin"},
      {"[a.skin, b.skin]", "[a.skin]", "scene.yaml:5: contacts.c.between", "two profiles, each as BODY.PROFILE"},
      {"b.skin]", "b.skim]", "scene.yaml:5: contacts.c.between", "Did you mean \"skin\""},
      {"b.skin]", "a.skin]", "scene.yaml:5: contacts.c", "two different bodies"},
      {"stiffness: 1e9", "young: 2e11, poisson: 0.3", "scene.yaml:5: contacts.c.normal.flores", "give `stiffness`"},
      {"flores", "floras", "scene.yaml:5: contacts.c.normal.floras", "Did you mean \"flores\""},
      {"stiffness: 1e9", "stiffness: 1e9, damping: 3", "scene.yaml:5: contacts.c.normal.flores.damping", "spring-damper"},
      {"contacts:", "joints: {w: {weld: [a, b]}}\ncontacts:", "scene.yaml:6: contacts.c", "the weld \"w\""},
      {"at: [0, 3]", "at: [0, -0.4]", "scene.yaml:5: contacts.c", "overlap by"},
      {"at: [0, 3]", "at: [0, 0.005]", "scene.yaml:5: contacts.c", "overlap by 0.01"},
  };
  ASSERT_EQ(said(sound, "mass: 1,", "mass: 1,"), "accepted");
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.to);
    pintle_test::expect_one_line(said(sound, bad.from, bad.to), bad.key, {bad.says});
  }
}

// Two squares of 40 mm, from corner to side, turned and apart: the distance of two convex shapes is that of a corner of one from a side of
// the other, by hand.
TEST(ProfileContact, DepthIsTheDistanceOfSharpShapesThatAreApart) {
  using Eigen::Vector2d;
  const auto corners = [](double x, double y, double turn) {
    std::vector<Vector2d> out;
    for (const Vector2d& c : {Vector2d(-0.02, -0.02), Vector2d(0.02, -0.02), Vector2d(0.02, 0.02), Vector2d(-0.02, 0.02)})
      out.emplace_back(x + std::cos(turn) * c.x() - std::sin(turn) * c.y(), y + std::sin(turn) * c.x() + std::cos(turn) * c.y());
    return out;
  };
  const auto from_sides = [](const Vector2d& p, const std::vector<Vector2d>& of) {
    double least = 1e9;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Vector2d a = of[i], along = of[(i + 1) % of.size()] - a;
      const double part = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - a - part * along).norm());
    }
    return least;
  };
  for (const auto& [x, y, turn] : {std::array{0.2, 0.0, 0.3}, std::array{0.06, 0.03, 0.0}, std::array{0.05, 0.055, 0.8},
                                   std::array{-0.1, 0.2, 2.0}, std::array{0.041, 0.0, 0.0}, std::array{0.0, -0.3, 1.2}}) {
    const auto one = corners(0, 0, 0), other = corners(x, y, turn);
    double distance = 1e9;
    for (const Vector2d& p : one) distance = std::min(distance, from_sides(p, other));
    for (const Vector2d& p : other) distance = std::min(distance, from_sides(p, one));
    const std::string box =
        "{rigid: {mass: 1 kg, inertia: 1e-4}, profiles: {o: {closed: true, path: [[-2 cm, -2 cm], [2 cm, -2 cm], [2 cm, 2 cm], "
        "[-2 cm, 2 cm]]}}}";
    const Whole w =
        run(scene("bodies: {a: " + box + ", b: " + box + "}\ncontacts: {c: {between: [a.o, b.o], model: impact, restitution: 0.5}}\n" +
                  "start: {b: {x: " + std::to_string(x) + ", y: " + std::to_string(y) + ", angle: " + std::to_string(turn) +
                  "}}\nrun: {until: 1 ms}\n"));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_NEAR(w.run.trajectory.column("c.depth [m]").front(), -distance, 1e-12) << x << " " << y << " " << turn;
  }
}

}  // namespace
}  // namespace pintle::profile_contact_test
