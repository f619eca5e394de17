// What laws of signals and conditions of events do within one step is found, however short: against closed forms.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "tests/scenes/runs/restart_runs.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::law_switch_test {
namespace {

using namespace pintle;

const Method methods[] = {{"dopri5", "dopri5", 1e-9, 1e-8},
                          {"rkf45", "rkf45", 1e-9, 1e-8},
                          {"verner87", "verner87", 1e-9, 1e-8},
                          {"implicit", "generalized-alpha", 1e-8, 1e-4}};

// A body that flies at 10 m/s along x: no step has a reason of its own to be short.
std::string flight(const std::string& more) {
  return R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
start: {b: {x: 0, vx: 10 m/s}}
run: {until: 1 s}
)yaml" + more;
}

class Pulse : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(LawSwitch, Pulse, testing::ValuesIn(methods), name_of);

struct Spike {
  const char* force;
  double work;  // [J]
};

// A step that begins after a change of a law begins roundings behind the row that is due there; an event at once gives it no length.
TEST_P(Pulse, ThatEndsWhereAnEventActsLeavesTheRowThatIsDue) {
  for (const char* when : {"t > 0.3 s", "t >= 0.3 s", "t > 0.25 s", "push.fx > 2 N", "push.fx < 2 N"}) {
    const Whole w = run(R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
start: {b: {x: 0, vx: 0 m/s}}
forces: {push: {force: ["if(t > 0.25 s && t < 0.3 s, 20 N, 0 N)", 0], at: b}}
run: {until: 0.5 s}
events: {e: {when: ")yaml" + std::string(when) +
                            "\", from start: false, do: {row: true}}}\n",
                        GetParam());
    ASSERT_EQ(w.run.status, Status::finished) << when << ": " << w.run.reason;
    ASSERT_EQ(w.run.happenings.size(), 1u) << when;
    EXPECT_EQ(w.column("t [s]").size(), 1002u) << when << ": all that are due, and the event's";
    EXPECT_NEAR(w.last("b.vx [m/s]"), 1, GetParam().near) << when;
    EXPECT_NEAR(w.ledger("push.work in [J]"), 0.5, GetParam().near) << when;
  }
}

// Of 10 mm or less, which take a millisecond of the second.
TEST_P(Pulse, OfALawDoesItsWork) {
  for (const auto& [force, work] : {
           Spike{"if(b.x > 1 m && b.x < 1.01 m, 1000 N, 0 N)", 10},
           Spike{"if(b.x >= 1 m, if(b.x <= 1.01 m, 1000 N, 0 N), 0 N)", 10},
           Spike{"if(abs(b.x - 1 m) < 5 mm, 1000 N, 0 N)", 10},
           Spike{"1000 N*max(0, 1 - abs(b.x - 3 m)/(5 mm))", 5},
           Spike{"1000 N*min(saturate((b.x - 2 m)/(1 mm), 0, 1), saturate((2.005 m - b.x)/(1 mm), 0, 1))", 4},
           Spike{"1000 N*(step(b.x, 1 m, 1.001 m) - step(b.x, 1.009 m, 1.01 m))", 9},
           Spike{"500 N*(sign(b.x - 2 m) - sign(b.x - 2.01 m))", 10},
           Spike{"if(b.x > 1 m && b.x < 1.00001 m, 1e6 N, 0 N)", 10},
       }) {
    const Whole w = run(flight("forces: {spike: {force: [\"" + std::string(force) + "\", 0], at: b}}"), GetParam());
    ASSERT_EQ(w.run.status, Status::finished) << force << ": " << w.run.reason;
    const double speed = w.last("b.vx [m/s]");
    EXPECT_NEAR(0.5 * speed * speed - 50, work, GetParam().near * 50) << force;
    EXPECT_NEAR(w.ledger("spike.work in [J]"), work, GetParam().near * 50) << force;
  }
}

TEST_P(Pulse, OfAStatesRateAddsUp) {
  const Whole w = run(flight("states: {passed: {rate: \"if(b.x > 4 m && b.x < 4.01 m, 1, 0)/(1 s)\", start: 0}}"), GetParam());
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.last("passed [1]"), 1e-3, 10 * GetParam().near * 1e-3);
}

// Known beforehand, though the law names the motion too.
TEST_P(Pulse, OfTimeBesideSignalsDoesItsWork) {
  const Whole w = run(flight("forces: {hit: {force: [\"if(t > 0.5 s && t < 0.501 s && b.x > 0 m, 1000 N, 0 N)\", 0], at: b}}"), GetParam());
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.last("b.vx [m/s]"), 11, GetParam().near * 10);
}

struct Window {
  const char* when;
  double begin, end;  // [s]
};
const Window windows[] = {{"b.x > 1 m && b.x < 1.000002 m", 0.1, 0.1000002},
                          {"abs(b.x - 3 m) < 1 um", 0.2999999, 0.3000001},
                          {"if(b.x > 2 m, 1, 0) > 0.5", 0.2, 1},
                          {"if(b.x > 2 m && b.x < 2.001 m, 1, 0) > 0.5", 0.2, 0.2001},
                          {"max(0, 1 - abs(b.x - 4 m)/(1 mm)) > 0.5", 0.39995, 0.40005},
                          {"t > 0.5 s && t < 0.501 s && b.vx > 1 m/s", 0.5, 0.501},
                          {"t > 0.5 s && t < 0.501 s", 0.5, 0.501},
                          {"sin(1000*t) > 0.9999999 && b.x < 0.02 m", 1.570796e-3 - 4.472e-7, 1.570796e-3 + 4.472e-7},
                          {"b.x >= 5 m && t <= 0.5000001 s", 0.5, 0.5000001}};

TEST_P(Pulse, OfAConditionMakesItsEventCome) {
  for (const Window& one : windows) {
    const Whole w = run(flight("events: {e: {when: \"" + std::string(one.when) + "\", do: {row: true}, else: {row: true}}}"), GetParam());
    ASSERT_EQ(w.run.status, Status::finished) << one.when << ": " << w.run.reason;
    ASSERT_EQ(w.run.happenings.size(), one.end < 1 ? 2u : 1u) << one.when;
    EXPECT_NEAR(w.run.happenings[0].t, one.begin, 1e-9) << one.when;
    if (one.end < 1) {
      EXPECT_NEAR(w.run.happenings[1].t, one.end, 1e-9) << one.when;
    }
  }
}

// What a condition compares may jump where no law of the motion does: an output, or a column. Nothing else in the step is passed over.
TEST_P(Pulse, OfAnOutputThatJumpsIsLocatedToo) {
  for (const char* output :
       {"if(b.x > 1 m, 1, 0)", "sign(b.x - 1 m)", "if(b.x > 1 m, 2, 0) + b.x*0.1/(1 m)", "if(b.x > 1 m, 2, 0) - b.x*0.1/(1 m)"}) {
    const Whole w = run(flight("outputs: {q: \"" + std::string(output) + "\"}\nevents: {e: {when: q > 0.5, do: {row: true}}}"), GetParam());
    ASSERT_EQ(w.run.status, Status::finished) << output << ": " << w.run.reason;
    ASSERT_EQ(w.run.happenings.size(), 1u) << output;
    EXPECT_NEAR(w.run.happenings[0].t, 0.1, 1e-9) << output;
  }
}

TEST_P(Pulse, OfAForceThatJumpsIsLocatedToo) {
  const Whole w = run(flight("forces: {h: {force: [\"if(b.x > 1 m, 1 N, 0 N)\", 0], at: b}}\n"
                             "events: {e: {when: h.fx > 0.5 N, do: {row: true}}}"),
                      GetParam());
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_EQ(w.run.happenings.size(), 1u);
  EXPECT_NEAR(w.run.happenings[0].t, 0.1, 1e-9);
  EXPECT_NEAR(w.last("b.vx [m/s]"), std::sqrt(100 + 2 * (w.last("b.x [m]") - 1)), GetParam().near * 10);
}

TEST_P(Pulse, OfAnOutputLeavesNoContactOut) {
  const Whole w = run(R"yaml(
gravity: [0, -9.81]
ground: {profiles: {w: {path: [[-1 m, 0], [1 m, 0]], material: right}}}
bodies: {s: {rigid: {mass: 1 kg, inertia: 0.01}, pose: {at: [0, 1 m]}, profiles: {o: {disc: [0, 0], radius: 0.1 m}}}}
contacts: {c: {between: [s.o, ground.w], normal: {spring-damper: {stiffness: 1e6 N/m, damping: 10 N s/m}}}}
outputs: {near: "if(s.y < 0.6 m, 1, 0)"}
events: {e: {when: near > 0.5, do: {row: true}}}
run: {until: 0.5 s}
)yaml",
                      GetParam());
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_EQ(w.run.happenings.size(), 1u);
  EXPECT_NEAR(w.run.happenings[0].t, std::sqrt(0.8 / 9.81), 1e-9);
  ASSERT_EQ(w.run.impacts.size(), 1u);
  EXPECT_NEAR(w.run.impacts[0].begin, std::sqrt(1.8 / 9.81), 1e-8);
}

// A cart between springs that act on one side alone, with a pulse, a dead band and a state that counts.
const char* busy = R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
start: {b: {x: 0, vx: 3 m/s}}
states: {wear: {rate: "if(abs(b.x) < 2 mm, abs(b.vx), 0 m/s)/(1 m)", start: 0}}
forces:
  stops: {force: ["-4000 N/m*deadband(b.x, 50 mm)", 0], at: b}
  shock: {force: ["if(b.x > 20 mm && b.x < 21 mm && b.vx > 0 m/s, 300 N, 0 N)", 0], at: b}
  damper: {force: ["-if(b.vx > 0 m/s, 3, 1)*1 N s/m*b.vx", 0], at: b}
events: {pass: {when: "b.x > 20 mm && b.x < 20.01 mm", do: {row: true}}}
run: {until: 0.5 s}
)yaml";

class LawSwitchRun : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, LawSwitchRun, testing::ValuesIn(methods), name_of);

Scene busy_by(const Method& method) {
  Scene s = read_scene_text(busy, "scene.yaml");
  s.run.method = method.words;
  s.run.tolerance = 1e-6;
  return s;
}

TEST_P(LawSwitchRun, GoesOnFromAnyStepToTheLastBit) { expect_same_end_from_steps(busy_by(GetParam()), 7, 20); }

TEST_P(LawSwitchRun, MovesTheSameWhateverIsWrittenOut) {
  Scene s = busy_by(GetParam());
  const Whole few = run(s);
  ASSERT_EQ(few.run.status, Status::finished) << few.run.reason;
  s.output.every = 0.0011;
  const Whole many = run(s);
  for (const char* column : {"b.x [m]", "b.vx [m/s]", "wear [1]"}) EXPECT_EQ(few.last(column), many.last(column)) << column;
}

// Friction written by hand holds what rests by switching without end: it ends by name, and soon.
TEST_P(LawSwitchRun, OfTwoSidesThatDriveBackToEachOtherEndsByName) {
  const Whole w = run(flight("forces: {brake: {force: [\"-20 N*sign(b.vx)\", 0], at: b}}"), GetParam());
  EXPECT_EQ(w.run.status, Status::failed);
  for (const char* part : {"t = 0.5 s", "the law of \"brake\"", "repeat without time passing", "friction: coulomb"})
    EXPECT_NE(w.run.reason.find(part), std::string::npos) << w.run.reason;
  EXPECT_LT(w.run.counts.steps, 2000);
}

// A scene beside a file of its own.
Scene with_file(const std::string& text, const std::string& samples) {
  const auto folder = std::filesystem::temp_directory_path() / ("pintle_law_switch_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "table.csv") << samples;
  Scene out = read_scene_text(text, "scene.yaml", {}, folder);
  std::filesystem::remove_all(folder);
  return out;
}

std::string over_x(const std::string& more) {
  return flight("forces: {f: {force: [{table: table.csv, over: b.x, over unit: m, value unit: N" + more + "}, 0], at: b}}");
}

// A triangle of 20 mm: 10 J; beyond its ends a table holds what it has there.
TEST_P(Pulse, OfATableDoesItsWork) {
  const Whole w = run(with_file(over_x(", interpolation: linear"), "1 0\n2 0\n2.01 1000\n2.02 0\n3 0\n"), GetParam());
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.ledger("f.work in [J]"), 10, GetParam().near * 50);
  const Whole again = run(with_file(over_x(", interpolation: linear, periodic: true"), "1 0\n2 0\n2.01 1000\n2.02 0\n3 0\n"), GetParam());
  ASSERT_EQ(again.run.status, Status::finished) << again.run.reason;
  ASSERT_GT(again.last("b.x [m]"), 12.1);
  ASSERT_LT(again.last("b.x [m]"), 13.9);
  EXPECT_NEAR(again.ledger("f.work in [J]"), 70, 100 * GetParam().near * 50) << "at 0, 2, … 12 m";
}

// A step ends at the mark, where the window begins.
TEST_P(Pulse, OfAConditionAtAMarkOfATableIsFound) {
  for (const char* window : {"b.x > 2 m && b.x < 2.00001 m", "b.x > 2.01 m && b.x < 2.0100001 m", "b.x >= 2 m && b.x <= 2.000001 m"}) {
    const Whole w = run(with_file(over_x(", interpolation: linear, outside: hold") + "\nevents: {e: {when: \"" + std::string(window) +
                                      "\", do: {row: true}, else: {row: true}}}\n",
                                  "1 0\n2 0\n2.01 1\n2.02 0\n3 0\n"),
                        GetParam());
    ASSERT_EQ(w.run.status, Status::finished) << window << ": " << w.run.reason;
    EXPECT_EQ(w.run.happenings.size(), 2u) << window;
  }
}

TEST(SplineWarning, IsOfWhatSwingsBesideASuddenChangeAlone) {
  const auto warned = [](const std::string& samples, const std::string& more = "") {
    const Model model = build(with_file(over_x(more), samples));
    return std::ranges::any_of(model.warnings, [](const std::string& w) { return w.find("overshoots its samples") != std::string::npos; });
  };
  std::string sine, parabola;
  for (int i = 0; i <= 24; ++i) {
    sine += std::to_string(i) + " " + std::to_string(std::sin(std::numbers::pi * i / 12)) + "\n";
    parabola += std::to_string(i) + " " + std::to_string((i - 7) * (i - 7)) + "\n";
  }
  EXPECT_TRUE(warned("1 0\n2 0\n2.01 1000\n2.02 0\n3 0\n"));
  EXPECT_TRUE(warned("0 0\n1 0\n2 0\n3 1\n4 1\n5 1\n"));
  EXPECT_FALSE(warned("0 0\n1 0\n2 0\n3 1\n4 1\n5 1\n", ", interpolation: linear"));
  EXPECT_FALSE(warned(sine));
  EXPECT_FALSE(warned(parabola));
  EXPECT_FALSE(warned("0 0\n1 1\n2 4\n3 9\n"));
}

TEST(CamTable, ThatIsLeftIsNamed) {
  const Whole w = run(with_file(R"yaml(
bodies: {cam: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}, v: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
joints:
  axle: {revolute: [ground, cam]}
  guide: {prismatic: [ground, v]}
  lobe: {cam: [cam, v, ground], lift: {table: table.csv, angle unit: deg, value unit: mm}}
start: {cam: {angle: 10 deg, speed: 10 rad/s}}
run: {until: 1 s}
)yaml",
                                "0 0\n60 5\n120 10\n180 8\n"));
  EXPECT_EQ(w.run.status, Status::failed);
  for (const char* part : {"the cam \"lobe\" (scene.yaml:6)", "end of its table", "table.csv", "180 deg", "lengthen the table"})
    EXPECT_NE(w.run.reason.find(part), std::string::npos) << w.run.reason;
}

}  // namespace
}  // namespace pintle_scenes::law_switch_test
