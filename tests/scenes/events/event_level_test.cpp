// Events at their level: which side a state is on that stands there, what undoes itself there, and what comes at the start.

#include <algorithm>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::event_level_test {
namespace {

using namespace pintle;

const Method methods[] = {{"dopri5", "dopri5", 1e-8, 0},
                          {"rkf45", "rkf45", 1e-8, 0},
                          {"verner87", "verner87", 1e-8, 0},
                          {"implicit", "generalized-alpha", 1e-6, 0}};
class Level : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Events, Level, testing::ValuesIn(methods), name_of);

std::string pushed(const std::string& events) {
  return R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
states: {F: {rate: 0/(1 s), start: 2}}
forces: {push: {force: ["F*1 N", 0], at: b}}
start: {b: {x: 0, vx: 0 m/s}}
run: {until: 3 s}
events: {)yaml" +
         events + "}\n";
}

void expect_failed(const Whole& w, std::initializer_list<const char*> parts) {
  EXPECT_EQ(w.run.status, Status::failed);
  for (const char* part : parts) EXPECT_NE(w.run.reason.find(part), std::string::npos) << w.run.reason;
  EXPECT_LT(w.run.happenings.size(), 1000u);
}

TEST_P(Level, OfTwoThatUndoEachOtherEndsByName) {
  const Whole w = run(pushed("up: {when: b.vx > 1 m/s, do: {set: {F: -2}}}, down: {when: b.vx < 1 m/s, do: {set: {F: 2}}}"), GetParam());
  expect_failed(w, {"t = 0.5 s", "up", "down", "repeat without time passing", "two different levels"});
}
TEST_P(Level, OfOneWithElseEndsByName) {
  const Whole w = run(pushed("up: {when: b.vx > 1 m/s, do: {set: {F: -2}}, else: {set: {F: 2}}}"), GetParam());
  expect_failed(w, {"t = 0.5 s", "up", "repeat without time passing", "two different levels"});
}
// What a state's jump makes false comes again at this instant, where the next makes it true.
TEST_P(Level, OfTwoThatSetBackWhatTheyWaitForEndsByName) {
  const Whole w = run(pushed("low: {when: F < 1, do: {set: {F: 3}}}, high: {when: F > 2.5, do: {set: {F: 0}}}, "
                             "first: {when: t > 1 s, once: true, do: {set: {F: 3}}}"),
                      GetParam());
  expect_failed(w, {"t = 1 s", "low", "high", "repeat without time passing"});
}
TEST_P(Level, WhereAStateIsSetToNoNumberEndsByName) {
  const Whole w = run(pushed("jump: {when: b.vx > 1 m/s, do: {set: {F: 1/(F - 2)}}}"), GetParam());
  expect_failed(w, {"t = 0.5 s", "\"jump\" sets F", "not finite"});
}
TEST_P(Level, OfTwoWithAHysteresisGoesOn) {
  const Whole w =
      run(pushed("up: {when: b.vx > 1 m/s, do: {set: {F: -2}}}, down: {when: b.vx < 0.93 m/s, from start: false, do: {set: {F: 2}}}"),
          GetParam());
  expect_sound(w);
  EXPECT_EQ(w.run.happenings.size(), 72u) << "the first after 0.5 s, then one each 0.035 s";
}
// What one does where another stops being true comes at the same instant, once.
TEST_P(Level, IsLeftByOneWhereAnotherComes) {
  const Whole w =
      run(pushed("up: {when: b.vx > 1 m/s, do: {row: true}}, low: {when: b.vx < 1 m/s, do: {row: true}, else: {set: {F: 0}}}"), GetParam());
  expect_sound(w);
  ASSERT_EQ(w.run.happenings.size(), 3u);
  EXPECT_EQ(w.run.happenings[1].t, w.run.happenings[2].t);
  EXPECT_NEAR(w.last("b.vx [m/s]"), 1, 1e-11);
}
// A bounce whose time dies out, by states alone: down to as much as rounding keeps up, a microsecond long, which is no shorter than an
// implicit step.
TEST_P(Level, ThatIsMetAfterShorterAndShorterTimesEndsByName) {
  const Whole w = run(R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
states: {v: {rate: -10/(1 s), start: 0}, h: {rate: v/(1 s), start: 1}}
run: {until: 10 s}
events: {bounce: {when: h < 0, do: {set: {v: -0.5*v, h: 0}}}}
)yaml",
                      GetParam());
  expect_failed(w, {"bounce", "repeat without time passing"});
}
// What is fast but moves goes on: ten thousand times a second, by as much as a ten millionth of what it compares.
TEST_P(Level, ThatIsMetAfterEqualShortTimesGoesOn) {
  const Whole w = run(R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
states: {phase: {rate: 1e-3/(1 s), start: 1}, n: {rate: 0/(1 s), start: 0}}
run: {until: 0.1 s}
events: {tick: {when: phase > 1.0000001, do: {set: {phase: 1, n: n + 1}}}}
)yaml",
                      GetParam());
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_NEAR(w.last("n [1]"), 1000, 1);
}

struct AtEqual {
  const char* when;
  bool from_start;
  double comes;  // [s]; below 0: never
};

// x = 0 and n = 2 at the start, where x rises and n stays.
TEST_P(Level, ThatIsTrueWhereBothAreEqualComesThere) {
  for (const auto& [when, from_start, comes] : {
           AtEqual{"n >= 2", true, 0},
           AtEqual{"n <= 2", true, 0},
           AtEqual{"n > 2", true, 0.4},
           AtEqual{"n < 2", true, -1},
           AtEqual{"n >= 2", false, -1},
           AtEqual{"n <= 2", false, -1},
           AtEqual{"n >= 3", true, 0.4},
           AtEqual{"n > 3", true, -1},
           AtEqual{"3 <= n", true, 0.4},
           AtEqual{"b.x > 0 m", true, 0},
           AtEqual{"b.x >= 0 m", true, 0},
           AtEqual{"b.x <= 0 m", true, 0},
           AtEqual{"b.x < 0 m", true, -1},
           AtEqual{"b.x > 0 m", false, -1},
           AtEqual{"b.x >= 0 m", false, -1},
           AtEqual{"b.x < 0 m", false, -1},
           AtEqual{"b.angle >= 30 deg && n >= 3", true, 0.4},
           AtEqual{"b.angle <= 30 deg", true, 0},
           AtEqual{"b.angle > 30 deg", true, -1},
       }) {
    const std::string from = from_start ? "" : "from start: false, ";
    const Whole w = run(R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
states: {n: {rate: 0/(1 s), start: 2}}
start: {b: {x: 0, vx: 10 m/s, angle: 30 deg}}
run: {until: 1 s}
events: {raise: {when: t > 0.4 s, once: true, do: {set: {n: 3}}}, e: {when: ")yaml" +
                            std::string(when) + "\", " + from + "do: {row: true}}}\n",
                        GetParam());
    ASSERT_EQ(w.run.status, Status::finished) << when << ": " << w.run.reason;
    const auto come = std::ranges::find(w.run.happenings, std::string("e"), &Happening::event);
    EXPECT_EQ(come == w.run.happenings.end(), comes < 0) << when << from;
    if (comes >= 0 && come != w.run.happenings.end()) {
      EXPECT_NEAR(come->t, comes, 1e-12) << when << from;
    }
    EXPECT_EQ(w.run.happenings.size(), comes < 0 ? 1u : 2u) << when << from;
  }
}

// Where the run ends no step follows in which what has just come would act.
TEST_P(Level, ThatIsReachedWhereTheRunEndsComesThere) {
  const auto ends = [&](const std::string& events) {
    return run(R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
states: {n: {rate: 0/(1 s), start: 2}, x: {rate: 1/(1 s), start: 0}}
start: {b: {x: 0, vx: 10 m/s}}
run: {until: 1 s}
events: {)yaml" + events +
                   "}\n",
               GetParam());
  };
  struct AtEnd {
    const char* event;
    bool comes;
  };
  for (const auto& [event, comes] : {
           AtEnd{"e: {when: t >= 1 s, do: {row: true}}", true},
           AtEnd{"e: {when: 1 s <= t, do: {row: true}}", true},
           AtEnd{"e: {when: t > 1 s, do: {row: true}}", false},
           AtEnd{"e: {when: x >= 1, do: {row: true}}", true},
           AtEnd{"e: {when: x > 1.000001, do: {row: true}}", false},
           AtEnd{"e: {when: b.x >= 10 m, do: {row: true}}", true},
           AtEnd{"e: {when: t < 1 s, from start: false, do: {row: true}, else: {row: true}}", true},
           AtEnd{"e: {when: t <= 1 s, from start: false, do: {row: true}, else: {row: true}}", false},
           AtEnd{"e: {when: t >= 1 s, once: true, do: {row: true}}", true},
           AtEnd{"first: {when: t >= 1 s, do: {set: {n: 3}}}, e: {when: n >= 3, do: {row: true}}", true},
           AtEnd{"e: {when: n > 2.5, do: {row: true}}, first: {when: t >= 1 s, do: {set: {n: 3}}}", true},
       }) {
    const Whole w = ends(event);
    ASSERT_EQ(w.run.status, Status::finished) << event << ": " << w.run.reason;
    EXPECT_EQ(std::ranges::count(w.run.happenings, std::string("e"), &Happening::event), comes) << event;
    for (const Happening& h : w.run.happenings) EXPECT_NEAR(h.t, 1, 1e-12) << event;
  }
  const Whole stopped = ends("e: {when: t >= 1 s, do: {stop: enough, row: true}}");
  EXPECT_EQ(stopped.run.status, Status::finished);
  EXPECT_EQ(stopped.run.reason, "enough");
  const Whole set = ends("e: {when: t >= 1 s, do: {set: {n: 7}, row: true}}");
  EXPECT_EQ(set.last("n [1]"), 7);
  expect_failed(
      ends("low: {when: n < 1, do: {set: {n: 3}}}, high: {when: n > 2.5, do: {set: {n: 0}}}, first: {when: t >= 1 s, do: {set: {n: 3}}}"),
      {"t = 1 s", "low", "high", "repeat without time passing"});
}

// A clock of 1705 s goes in steps of 2.3e-13 s, in which this speed changes by as many m/s. A start within 7.7e-13 m/s, three steps, is at
// the level itself, which was reached before the run, or is reached at its start.
TEST_P(Level, AtTheStartIsFoundAsWellAsTheClockTells) {
  for (const bool from_start : {true, false})
    for (const double speed : {0.0, 1e-17, -1e-17, 1e-14, -1e-14, 2e-13, -2e-13, 6e-13, -6e-13, 9e-13, -9e-13, 1e-11, -1e-11}) {
      Scene s = read_scene_text(R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
forces: {spring: {force: [-b.x*1 N/m, 0], at: b}}
start: {b: {x: 1 m}}
run: {until: 1725 s}
events: {top: {when: b.vx < 0, do: {row: true}, from start: )yaml" +
                                    std::string(from_start ? "true" : "false") + "}}\n",
                                "scene.yaml");
      s.run.method = GetParam().words, s.run.tolerance = GetParam().tolerance;
      const Model model = build(s);
      State start = assemble(s, model).start;
      start.t = 1705, start.y[model.system.n()] = speed;
      Integrator motion(model.system, model.scheme, start);
      while (motion.state().t < 1725) ASSERT_TRUE(motion.advance(1725)) << motion.failure();
      const int later = 3, at_once = from_start || speed > 7.7e-13;
      EXPECT_EQ(std::ssize(motion.happenings()), later + at_once) << from_start << " " << speed;
    }
}

TEST(EventLevel, SavesOneStateWhereTheRunEnds) {
  Scene s = read_scene_text(pushed("end: {when: t > 0.5 s, do: {save: true, stop: enough}}"), "scene.yaml");
  for (const int states : {0, 3}) {
    s.output.states = states > 0 ? 0.25 : 0;
    const Model model = build(s);
    std::vector<double> saved;
    Listeners listeners;
    listeners.state = [&](const SavedState& state) { saved.push_back(state.t); };
    simulate(s, model, assemble(s, model), listeners);
    std::ranges::sort(saved);
    EXPECT_EQ(std::ranges::adjacent_find(saved), saved.end()) << saved.size() << " states";
    EXPECT_EQ(saved.back(), 0.5);
  }
}

}  // namespace
}  // namespace pintle_scenes::event_level_test
