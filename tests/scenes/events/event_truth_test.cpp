// Conditions of what stands exactly at its level for a while: true or false there as they are written, against closed forms.

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/scenes/runs/restart_runs.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::event_truth_test {
namespace {

using namespace pintle;

const Method methods[] = {{"dopri5", "dopri5", 1e-9, 1e-9},
                          {"rkf45", "rkf45", 1e-9, 1e-9},
                          {"verner87", "verner87", 1e-9, 1e-9},
                          {"implicit", "generalized-alpha", 1e-8, 1e-5}};
class Truth : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Events, Truth, testing::ValuesIn(methods), name_of);

std::vector<double> times_of(const Whole& w, const std::string& event) {
  std::vector<double> out;
  for (const Happening& h : w.run.happenings)
    if (h.event == event) out.push_back(h.t);
  return out;
}

struct Turns {
  const char* when;
  std::vector<double> at;  ///< by `do` and `else` in turn [s]
};

void expect_turns(const std::string& scene, const Turns& turns, const Method& method) {
  const Whole w = run(scene + "events: {e: {when: \"" + turns.when + "\", do: {row: true}, else: {row: true}}}\n", method);
  ASSERT_EQ(w.run.status, Status::finished) << turns.when << ": " << w.run.reason;
  const std::vector<double> found = times_of(w, "e");
  ASSERT_EQ(found.size(), turns.at.size()) << turns.when;
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], turns.at[k], method.near) << turns.when;
}

// y = 10 t − 5 t²: 3.75 m at 0.5 and 1.5 s.
const char* const thrown = R"yaml(
gravity: [0, -10]
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
start: {b: {y: 0 m, vy: 10 m/s}}
forces: {side: {force: ["saturate(9 N*b.y/(3.75 m), -9 N, 9 N)", 0], at: b}}
outputs: {part: "saturate(b.y/(3.75 m), -1, 1)", over: "max(b.y - 3.75 m, 0 m)"}
run: {until: 1.8 s}
)yaml";

TEST_P(Truth, OfWhatIsCutOffIsAsItIsWritten) {
  for (const Turns& turns : {
           Turns{"part >= 1", {0.5, 1.5}},
           Turns{"part > 1", {}},
           Turns{"part < 1", {0, 0.5, 1.5}},
           Turns{"part <= 1", {0}},
           Turns{"1 <= part && b.y > 0 m", {0.5, 1.5}},
           Turns{"side.fx >= 9 N", {0.5, 1.5}},
           Turns{"side.fx > 9 N", {}},
           Turns{"over > 0 m", {0.5, 1.5}},
           Turns{"over <= 0 m", {0, 0.5, 1.5}},
           Turns{"max(b.y - 3.75 m, 0 m) > 0 m", {0.5, 1.5}},
           Turns{"saturate(b.y, -1 m, 3.75 m) >= 3.75 m", {0.5, 1.5}},
           Turns{"step(t, 0.1 s, 0.2 s) >= 1", {0.2}},
           Turns{"min(t, 0.2 s) >= 0.2 s", {0.2}},
           Turns{"min(t, 0.2 s) < 0.2 s", {0, 0.2}},
       })
    expect_turns(thrown, turns, GetParam());
}

// 0.3 · 100 N · 20 mm brake 0.05 kg m² from 6 rad/s in 0.5 s.
TEST_P(Truth, OfASpeedThatIsBrakedToRestIsAsItIsWritten) {
  for (const Turns& turns : {
           Turns{"drum.speed <= 0 rad/s", {0.5}},
           Turns{"drum.speed > 0 rad/s", {0, 0.5}},
           Turns{"abs(axle.sliding) <= 0 m/s", {0.5}},
       })
    expect_turns(R"yaml(
bodies: {drum: {rigid: {mass: 8 kg, inertia: 0.05 kg m^2}, points: {O: [0, 0]}}}
joints: {axle: {revolute: [ground, drum.O], friction: {coulomb: {coefficient: 0.3}, radius: 20 mm, preload: 100 N}}}
start: {drum: {speed: 6 rad/s}}
run: {until: 1 s}
)yaml",
                 turns, GetParam());
}

const char* const bouncing = R"yaml(
gravity: [0, -9.81]
ground: {profiles: {floor: {path: [[1 m, 0], [-1 m, 0]]}}}
bodies: {ball: {rigid: {mass: 1 kg, inertia: 4e-4}, points: {C: [0, 0]}, profiles: {rim: {disc: C, radius: 20 mm}}, pose: {at: [0, 0.2 m]}}}
contacts: {floor: {between: [ball.rim, ground.floor], normal: {hunt-crossley: {restitution: 0.7, stiffness: 1e7 N/m^1.5}}}}
states: {n: {rate: 0/s}}
events:
  hit: {when: floor.normal > 0 N, do: {set: {n: n + 1}}}
  off: {when: floor.normal <= 0 N, from start: false, do: {row: true}}
run: {until: 1 s}
)yaml";

TEST_P(Truth, OfAContactsForceComesWithEachImpact) {
  const Whole w = run(bouncing, GetParam());
  expect_sound(w);
  const std::vector<double> hit = times_of(w, "hit"), off = times_of(w, "off");
  ASSERT_GT(w.run.impacts.size(), 3u);
  ASSERT_EQ(hit.size(), w.run.impacts.size());
  ASSERT_EQ(off.size(), w.run.impacts.size());
  for (std::size_t k = 0; k < hit.size(); ++k) {
    EXPECT_NEAR(hit[k], w.run.impacts[k].begin, 1e-6);
    EXPECT_NEAR(off[k], w.run.impacts[k].end, 1e-6);
  }
}

TEST_P(Truth, OfWhatStandsGoesOnFromAnyStepToTheLastBit) {
  Scene s = read_scene_text(bouncing, "scene.yaml");
  s.run.method = GetParam().words;
  s.run.tolerance = GetParam().name == std::string("implicit") ? 1e-5 : 1e-6;
  s.run.until = 0.5;
  expect_same_end_from_steps(s, 23, 6);
}

TEST_P(Truth, OfWhatStandsComesTheSameWhateverIsWrittenOut) {
  Scene s = read_scene_text(bouncing, "scene.yaml");
  const Whole few = run(s, GetParam());
  s.output.every = 0.0011;
  const Whole many = run(s, GetParam());
  EXPECT_EQ(times_of(few, "hit"), times_of(many, "hit"));
  EXPECT_EQ(times_of(few, "off"), times_of(many, "off"));
  EXPECT_EQ(few.last("ball.y [m]"), many.last("ball.y [m]"));
}

// Both spans of a belt go slack in turn, each for as long as the other pulls.
// By explicit methods: where damping makes the tension jump, generalised-alpha finds no step that ends there.
class BeltTruth : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Events, BeltTruth, testing::ValuesIn(methods, methods + 3), name_of);
TEST_P(BeltTruth, OfItsTensionComesAsItSlackens) {
  const Whole w = run(R"yaml(
bodies:
  a: {rigid: {mass: 1 kg, inertia: 1e-3}, points: {O: [0, 0]}}
  b: {rigid: {mass: 1 kg, inertia: 1e-3}, points: {O: [0, 0]}, pose: {at: [0.3 m, 0]}}
ground: {points: {B: [0.3 m, 0]}}
joints: {ja: {revolute: [ground, a.O]}, jb: {revolute: [ground.B, b.O]}}
forces: {belt: {belt: [a.O, b.O], radii: [40 mm, 40 mm], stiffness: 20 kN, damping: 2 N s, pretension: 20 N}}
start: {b: {speed: 20 rad/s}}
events:
  slack: {when: belt 1.tension <= 0 N, do: {row: true}, else: {row: true}}
  pulls: {when: belt 1.tension > 0 N, from start: false, do: {row: true}}
  nearly: {when: belt 1.tension < 1 mN, do: {row: true}, else: {row: true}}
run: {until: 30 ms}
)yaml",
                      GetParam());
  expect_sound(w);
  const std::vector<double> slack = times_of(w, "slack"), pulls = times_of(w, "pulls"), nearly = times_of(w, "nearly");
  ASSERT_EQ(nearly.size(), 4u);
  ASSERT_EQ(slack.size(), 4u);
  ASSERT_EQ(pulls.size(), 2u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(slack[k], nearly[k], 1e-5);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(pulls[k], slack[2 * k + 1], 1e-9);
}

}  // namespace
}  // namespace pintle_scenes::event_truth_test
