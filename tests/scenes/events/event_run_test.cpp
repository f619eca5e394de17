// Events of a scene: restarts, what is written out, and what is refused, by name.

#include <gtest/gtest.h>

#include <cmath>

#include "framework/analysis/simulate/run_warnings.h"
#include "framework/build/build.h"
#include "tests/refusal.h"
#include "tests/scenes/runs/restart_runs.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::event_run_test {
namespace {

using namespace pintle;

// A swinging arm that a latch lets go, a spring catches, and a clutch ties to a disc now and then.
const char* busy = R"(
gravity: [0, -9.81]
bodies:
  arm: {rigid: {mass: 2 kg, inertia: 0.1 kg m^2}, points: {O: [-0.3, 0]}}
  disc: {rigid: {mass: 1 kg, inertia: 0.05 kg m^2}}
joints:
  hinge: {revolute: [ground, arm.O], friction: {coulomb: {coefficient: 0.1}, radius: 10 mm}}
  axle: {revolute: [ground, disc]}
  clutch: {differential: [arm, disc], ratio: -1, engaged: false}
drivers: {latch: {angle: [ground, arm], law: 0 rad}}
forces:
  engine: {torque: "1 N m - 0.1 N m s*disc.speed", on: disc}
  catch: {torsion spring: [ground, arm], stiffness: 200 N m/rad, damping: 1 N m s/rad, free angle: -1 rad, engaged: false}
states: {passed: {rate: 0/(1 s), start: 0}}
start: {arm: {angle: 0}}
events:
  go: {when: t > 50 ms, once: true, do: {release: latch}}
  low: {when: arm.angle < -1 rad, do: {engage: catch, set: {passed: passed + 1}}, else: {release: catch}}
  tie: {when: arm.speed < -2 rad/s, do: {engage: clutch}, else: {release: clutch, row: true}}
run: {until: 1 s}
)";

Scene by(const Method& method) {
  Scene s = read_scene_text(busy, "scene.yaml");
  s.run.method = method.words;
  s.run.tolerance = method.tolerance;
  s.run.constraints = method.name == std::string("partitioning") ? "partitioning" : "projection";
  return s;
}

const Method methods[] = {{"dopri5", "dopri5", 1e-6, 0},
                          {"partitioning", "rkf45", 1e-6, 0},
                          {"verner87", "verner87", 1e-6, 0},
                          {"implicit", "generalized-alpha", 1e-5, 0}};
class EventRun : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, EventRun, testing::ValuesIn(methods), name_of);

TEST_P(EventRun, GoesOnFromAnyStepToTheLastBit) { expect_same_end_from_steps(by(GetParam()), 37, 6); }

TEST_P(EventRun, MovesTheSameWhateverIsWrittenOut) {
  Scene s = by(GetParam());
  const Whole few = run(s);
  expect_sound(few);
  s.output.every = 0.0011;
  const Whole many = run(s);
  ASSERT_EQ(few.run.happenings.size(), many.run.happenings.size());
  for (std::size_t k = 0; k < few.run.happenings.size(); ++k) EXPECT_EQ(few.run.happenings[k].t, many.run.happenings[k].t);
  for (const char* column : {"arm.angle [rad]", "disc.speed [rad/s]", "passed [1]"})
    EXPECT_EQ(few.run.trajectory.column(column).back(), many.run.trajectory.column(column).back()) << column;
}

std::string disc(const std::string& more) {
  return R"(
gravity: [0, -9.81]
bodies: {ball: {rigid: {mass: 1 kg, inertia: 0.01 kg m^2}, points: {C: [0, 0]}, profiles: {rim: {disc: C, radius: 0.1}}}}
ground: {points: {G: [0, 0]}, profiles: {floor: {path: [[5, 0], [-5, 0]]}}}
contacts: {rest: {between: [ball.rim, ground.floor], normal: {spring-damper: {stiffness: 1e4 N/m, damping: 50 N s/m}}}}
start: {ball: {x: 0, y: 0.099019}}
run: {until: 0.5 s}
)" + more;
}

TEST(EventContact, ThatIsReleasedLetsThrough) {
  const Whole w = run(disc("events: {open: {when: t > 0.3 s, do: {release: rest}}}"));
  expect_sound(w);
  EXPECT_NEAR(w.run.trajectory.column("ball.y [m]").back(), 0.1 - 9.81 / 1e4 - 9.81 / 2 * 0.2 * 0.2, 1e-6);
  EXPECT_FALSE(w.run.impacts.empty());
}
TEST(EventContact, IsNotEngagedDeepInside) {
  const Whole w = run(disc("events: {open: {when: t > 0.1 s, do: {release: rest}}, close: {when: ball.y < 5 cm, do: {engage: rest}}}"));
  EXPECT_EQ(w.run.status, Status::failed);
  EXPECT_NE(w.run.reason.find("the event \"close\": \"rest\" cannot be engaged: its surfaces overlap"), std::string::npos) << w.run.reason;
}

// Falling from 0.1 m, 1 mm deep when it is engaged: k δ^(5/2) 2/5 come with it.
TEST(EventContact, ThatIsEngagedWhereItOverlapsBooksWhatItHoldsInStore) {
  const double stored = 0.4 * 1e7 * std::pow(1e-3, 2.5);
  for (const char* method : {"dopri5", "rkf45", "verner87", "generalized-alpha"}) {
    const Whole w = run(R"(
gravity: [0, -9.81]
ground: {profiles: {floor: {path: [[1 m, 0], [-1 m, 0]]}}}
bodies: {ball: {rigid: {mass: 1 kg, inertia: 4e-4}, points: {C: [0, 0]}, profiles: {rim: {disc: C, radius: 20 mm}}, pose: {at: [0, 0.1 m]}}}
contacts: {floor: {between: [ball.rim, ground.floor], normal: {hertz: {stiffness: 1e7 N/m^1.5}}, engaged: false}}
events: {e: {when: ball.y < 19 mm, do: {engage: floor}}}
run: {until: 0.3 s}
)",
                        {method, method, 1e-9, 0});
    expect_sound(w);
    EXPECT_NEAR(w.ledger("floor.lost to switching [J]"), -stored, 1e-6 * stored) << method;
    EXPECT_LT(std::abs(w.run.unexplained), 1e-4 * stored) << method;
  }
}

// An impact of the scheme is an impulse; told as a force it is that over a whole step, however short an event leaves the step: at most of the
// fall from 0.48 m, and as much as a step falls farther.
TEST(EventContact, ThatCutsAStepOfTimeSteppingLeavesItsForce) {
  const double step = 5e-4, e = 0.5, v = std::sqrt(2 * 9.81 * 0.48), most = (1 + e) * (v + 2 * 9.81 * step) / step;
  const Whole w = run(R"(
gravity: [0, -9.81]
ground: {profiles: {floor: {path: [[1 m, 0], [-1 m, 0]]}}}
bodies:
  ball: {rigid: {mass: 1 kg, inertia: 4e-4}, points: {C: [0, 0]}, profiles: {rim: {disc: C, radius: 20 mm}}, pose: {at: [0, 0.5 m]}}
contacts: {floor: {between: [ball.rim, ground.floor], model: impact, restitution: 0.5}}
states: {n: {rate: 0/s}}
events:
  hit: {when: floor.normal > 0 N, do: {set: {n: n + 1}, row: true}}
  up: {when: ball.vy > 0 m/s, do: {set: {n: n + 1}, row: true}}
run: {until: 1 s, method: {moreau: {step: 0.5 ms}}}
)");
  expect_sound(w);
  ASSERT_FALSE(w.run.impacts.empty());
  EXPECT_GT(w.last("n [1]"), 2);
  EXPECT_NEAR(w.run.impacts[0].impulse, (1 + e) * v, 2e-2 * v);
  for (const Impact& impact : w.run.impacts) EXPECT_LE(impact.peak_force, most);
  EXPECT_GT(w.run.impacts[0].peak_force, 0.98 * (1 + e) * v / step);
  for (const double normal : w.column("floor.normal [N]")) EXPECT_LE(normal, most);
}

TEST(EventRefusal, OfADivisionByZeroNamesSignalTimeAndState) {
  const auto ends = [](const std::string& events) {
    return run(disc("states: {k: {rate: 0/(1 s), start: 0.5}}\nevents: {" + events + "}")).run;
  };
  for (const char* from : {"", "from start: false, "}) {
    const auto at_start = ends("e: {when: 1/ball.x > 3/m, " + std::string(from) + "do: {row: true}}");
    EXPECT_EQ(at_start.status, Status::failed) << from;
    pintle_test::expect_says(at_start.reason, {"the event \"e\"", "not a finite number at t = 0 s", "1/ball.x > 3/m", "ball.x = 0"});
  }
  const auto set = ends("e: {when: t > 0.1 s, do: {set: {k: k/(k - 0.5)}}}");
  EXPECT_EQ(set.status, Status::failed);
  pintle_test::expect_says(set.reason, {"the event \"e\" sets k", "not finite at t = 0.1 s", "k/(k - 0.5)", "k = 0.5"});
  const auto of_a_row = ends("e: {when: t > 0.1 s, do: {set: {k: rest.normal/(1 N)/(k - 0.5)}}}");
  EXPECT_EQ(of_a_row.status, Status::failed);
  pintle_test::expect_says(of_a_row.reason, {"the event \"e\" sets k", "rest.normal = ", "k = 0.5"});
}

TEST(EventRefusal, OfAJointThatDoesNotMeet) {
  const Whole w =
      run(disc("joints: {pin: {revolute: [ground.G, ball.C], engaged: false}}\nevents: {shut: {when: t > 0.1 s, do: {engage: pin}}}"));
  EXPECT_EQ(w.run.status, Status::failed);
  EXPECT_NE(w.run.reason.find("\"pin\" cannot be engaged: its points are"), std::string::npos) << w.run.reason;
}
TEST(EventRefusal, OfALoopThatTakesNoTime) {
  const Whole w =
      run(disc("states: {k: {rate: 0/(1 s), start: 0.5}}\n"
               "events: {flip: {when: k < 1, do: {set: {k: 2}}, else: {set: {k: 0}}}}"));
  EXPECT_EQ(w.run.status, Status::failed);
  EXPECT_NE(w.run.reason.find("repeat without time passing"), std::string::npos) << w.run.reason;
}

struct Bad {
  const char *events, *said;
};
TEST(EventRefusal, NamesWhatIsWrongInTheScene) {
  for (const auto& [events, said] : {
           Bad{"e: {when: t > 1 s, do: {release: rets}}", "Did you mean \"rest\"?"},
           Bad{"e: {when: t > 1 s, do: {release: rest, engage: rest}}", "released and engaged by one event"},
           Bad{"e: {when: \" ball.y \", do: {release: rest}}", "a number in m; write a comparison such as ball.y > 1 m"},
           Bad{"e: {when: ball.y, do: {release: rest}}", "is a number in m; write a comparison such as ball.y > 1 m"},
           Bad{"e: {when: ball.y == 1 m, do: {release: rest}}", "passes a value"},
           Bad{"e: {when: \"t > 1 s || t < 0.1 s\", do: {release: rest}}", "write two"},
           Bad{"e: {when: bal.y > 1, do: {release: rest}}", "ball.y"},
           Bad{"e: {when: ball.y > 1 s, do: {release: rest}}", "length"},
           Bad{"e: {when: t > 1 s, do: {set: {k: 1}}}", "there is no state \"k\""},
           Bad{"e: {when: t > 1 s, do: {}}", "has no effect"},
           Bad{"e: {when: t > 1 s, do: {relaese: rest}}", "Did you mean \"release\"?"},
           Bad{"e: {when: t > 1 s, once: true, do: {release: rest}, else: {engage: rest}}", "never happens"},
       })
    pintle_test::expect_refused([&, text = std::string(events)] { build(read_scene_text(disc("events: {" + text + "}"), "scene.yaml")); },
                                {said});
}

struct Foreseen {
  const char *when, *said;
};
TEST(EventWarning, SaysWhatCanNeverOrMustAlwaysBe) {
  for (const auto& [when, said] : {
           Foreseen{"ball.y > 2 m && ball.y < 1 m", "never occurs"},
           Foreseen{"ball.y > 1 m && ball.x > 0 m && ball.y <= 1 m", "never occurs"},
           Foreseen{"abs(ball.y) < 0 m", "never occurs"},
           Foreseen{"t > 2 s", "never occurs"},
           Foreseen{"t < 0 s", "never occurs"},
           Foreseen{"sin(ball.angle) > 1.5", "never occurs"},
           Foreseen{"t >= 0 s", "occurs at the start and never again"},
           Foreseen{"abs(ball.y) >= 0 m", "occurs at the start and never again"},
           Foreseen{"min(ball.y, 1 m) > 2 m", "never occurs"},
           Foreseen{"ball.y > 1 m && ball.y < 2 m", ""},
           Foreseen{"ball.y >= 1 m && ball.y <= 1 m", ""},
           Foreseen{"t > 0.1 s && t < 0.2 s", ""},
       }) {
    const Model model = build(read_scene_text(disc("events: {e: {when: \"" + std::string(when) + "\", do: {row: true}}}"), "scene.yaml"));
    std::string all;
    for (const std::string& warning : model.warnings) all += warning + "\n";
    const std::string expected = "the event \"e\" " + std::string(said);
    EXPECT_EQ(all.find(*said ? expected : "the event") != std::string::npos, *said != 0) << when << ": " << all;
  }
}

TEST(EventWarning, SaysWhatNeverComesAndWhatNeverActs) {
  const Whole w =
      run(disc("joints: {pin: {revolute: [ground.G, ball.C], engaged: false}}\nevents: {never: {when: 1 > 2, do: {stop: so}}}"));
  std::string all;
  for (const std::string& warning : w.run.warnings) all += warning + "\n";
  EXPECT_NE(all.find("the event \"never\" never occurs"), std::string::npos) << all;
  EXPECT_NE(all.find("\"pin\" starts released, and no event engages it"), std::string::npos) << all;
}

TEST(EventWarning, NamesTheEventsThatNeverCame) {
  const Scene s =
      read_scene_text(disc("events: {late: {when: ball.y > 5 m, do: {row: true}}, first: {when: t > 0.1 s, once: true, do: {row: true}}, "
                           "far: {when: ball.x > 1 m, do: {row: true}}}"),
                      "scene.yaml");
  EXPECT_EQ(never_came(s, run(s).run), (std::vector<std::string>{"late", "far"}));
}

// A weld that holds for ever makes a contact of its two bodies pointless; one that an event releases does not.
TEST(EventRun, ABallThatAWeldLetsGoLandsOnItsFloor) {
  const auto scene = [](const std::string& events) {
    return "gravity: [0, -9.81]\nground: {points: {L: [0, 1]}, profiles: {floor: {path: [[-1, 0], [1, 0]], material: right}}}\n"
           "bodies: {ball: {rigid: {mass: 1, inertia: 0.01}, points: {P: [0, 0]}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}}\n"
           "joints: {latch: {weld: [ground.L, ball.P]}}\n"
           "contacts: {foot: {between: [ball.rim, ground.floor], model: impact, restitution: 0}}\n" +
           events + "start: {ball: {at: [0, 1]}}\nrun: {until: 2 s}\n";
  };
  const Whole w = run(scene("events: {go: {when: t > 0.5 s, once: true, do: {release: latch}}}\n"));
  expect_sound(w);
  EXPECT_NEAR(w.last("ball.y [m]"), 0.1, 1e-9);
  ASSERT_EQ(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, 0.5 + std::sqrt(2 * 0.9 / 9.81), 1e-9);
  pintle_test::expect_one_line(pintle_test::refusal_by<std::exception>([&] { build(read_scene_text(scene(""), "scene.yaml")); }),
                               "scene.yaml:5: contacts.foot", {"the weld \"latch\" joins these two bodies rigidly"});
}

}  // namespace
}  // namespace pintle_scenes::event_run_test
