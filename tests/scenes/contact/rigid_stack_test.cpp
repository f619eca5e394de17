// What lies on each other at rest, by events and by time-stepping alike: forces are those of statics, and nothing creeps or falls through.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_stack_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81, step = 1e-3;

class RigidStack : public testing::TestWithParam<std::string> {
 protected:
  std::string run_for(double until, double every) const {
    return "run: {until: " + number(until) + ", method: " + GetParam() + "}\noutput: {every: " + number(every) + ", frames: 0}\n";
  }
  bool by_steps() const { return GetParam() != "auto"; }
};
INSTANTIATE_TEST_SUITE_P(All, RigidStack, testing::Values("auto", "{moreau: {step: 1 ms}}"),
                         [](const auto& each) { return std::string(each.index == 0 ? "events" : "moreau"); });

std::string laws(double restitution, double friction) {
  return ", model: impact, restitution: " + number(restitution) +
         (friction > 0 ? ", friction: {coulomb: {coefficient: " + number(friction) + "}}}\n" : "}\n");
}

// Each of them with all before it and with the ground's profile, in b0, b1 …; contacts w0 … with the ground, c1_0 … between them.
struct Pile {
  std::string bodies = "bodies:\n", contacts = "contacts:\n";
  int count = 0;
  void add(const std::string& profile, double inertia, double x, double y, const std::string& ground, const std::string& law) {
    const std::string n = std::to_string(count);
    bodies += "  b" + n + ": {rigid: {mass: 1, inertia: " + number(inertia) + "}, profiles: {o: {" + profile + "}}, pose: {at: [" +
              number(x) + ", " + number(y) + "]}}\n";
    contacts += "  w" + n + ": {between: [b" + n + ".o, ground." + ground + "]" + law;
    for (int j = 0; j < count; ++j)
      contacts += "  c" + n + "_" + std::to_string(j) + ": {between: [b" + n + ".o, b" + std::to_string(j) + ".o]" + law;
    ++count;
  }
  std::string text() const { return bodies + contacts; }
};

constexpr double w = 0.1, h = 0.05;
void add_box(Pile& pile, double x, double y, const std::string& law) {
  pile.add("path: [[-0.05, -0.025], [0.05, -0.025], [0.05, 0.025], [-0.05, 0.025]], closed: true", (w * w + h * h) / 12, x, y, "floor",
           law);
}

// Between the n-th box and the one below it the weight of all from it on. Edges are flush, or apart by less than a step overlaps.
TEST_P(RigidStack, AlignedBoxesStand) {
  for (const int boxes : {2, 5})
    for (const double apart : {0.0, 1e-6})
      for (const double friction : {0.0, 0.5}) {
        SCOPED_TRACE(std::to_string(boxes) + " boxes, " + number(apart) + " m apart, friction " + number(friction));
        Pile pile;
        for (int i = 0; i < boxes; ++i) add_box(pile, apart * i, h / 2 + h * i, laws(0, friction));
        const Whole run_of = run(floor_under() + pile.text() + run_for(by_steps() ? 2 : 10, 0.5));
        expect_sound(run_of, 1e-9);
        for (int i = 0; i < boxes; ++i) {
          const std::string n = std::to_string(i);
          EXPECT_NEAR(run_of.last("b" + n + ".x [m]"), apart * i, 1e-10) << i;
          EXPECT_NEAR(run_of.last("b" + n + ".y [m]"), h / 2 + h * i, 1e-10) << i;
          EXPECT_NEAR(run_of.last(i == 0 ? "w0.normal [N]" : "c" + n + "_" + std::to_string(i - 1) + ".normal [N]"), (boxes - i) * g, 1e-8);
        }
      }
}

TEST_P(RigidStack, TwoAlignedBoxesStandForTenSeconds) {
  Pile pile;
  for (int i = 0; i < 2; ++i) add_box(pile, 0, h / 2 + h * i, laws(0, 0.5));
  const Whole run_of = run(floor_under() + pile.text() + run_for(10, 0.5));
  expect_sound(run_of, 1e-9);
  for (const double borne : run_of.column("w0.normal [N]")) EXPECT_TRUE(borne == 0 || std::abs(borne - 2 * g) < 1e-8) << borne;
  EXPECT_NEAR(run_of.last("b1.y [m]"), 1.5 * h, 1e-10);
}

// Time-stepping stops each where it overlaps by what half a step moves it, and all that are above it may have overlapped as well.
TEST_P(RigidStack, BoxesThatFallOnEachOtherStayThere) {
  Pile pile;
  const double drop = 0.02;
  for (int i = 0; i < 3; ++i) add_box(pile, 0, h / 2 + h * i + drop * (i + 1), laws(0, 0.5));
  const Whole run_of = run(floor_under() + pile.text() + run_for(1, 0.1));
  expect_sound(run_of, 1e-9);
  for (int i = 0; i < 3; ++i) {
    const double sinks = by_steps() ? (i + 1) * std::sqrt(2 * g * 3 * drop) * step : 1e-10;
    EXPECT_NEAR(run_of.last("b" + std::to_string(i) + ".y [m]"), h / 2 + h * i, sinks) << i;
    EXPECT_NEAR(run_of.last("b" + std::to_string(i) + ".angle [rad]"), 0, 1e-9) << i;
  }
  EXPECT_NEAR(run_of.last("w0.normal [N]"), 3 * g, 1e-8);
  EXPECT_NEAR(run_of.last("c2_1.normal [N]"), g, 1e-8);
}

// Pushed 10 mm to the side a square on its corner would fall; on a corner, point to point, it stands.
TEST_P(RigidStack, ACornerStandsOnACorner) {
  const Whole run_of = run(
      "gravity: [0, -9.81]\nground: {profiles: {tip: {path: [[-0.3, -0.3], [0.3, -0.3], [0, 0]], closed: true}}}\nbodies:\n  b: {rigid: "
      "{mass: 1, inertia: 1e-3}, profiles: {o: {path: [[-0.05, 0], [0, -0.05], [0.05, 0], [0, 0.05]], closed: true}}, pose: {at: [0, "
      "0.1]}}\ncontacts:\n  c: {between: [b.o, ground.tip]" +
      laws(0.3, 0.3) + run_for(1, 0.1));
  expect_sound(run_of, 1e-9);
  EXPECT_NEAR(run_of.last("b.y [m]"), 0.05, by_steps() ? std::sqrt(2 * g * 0.05) * step : 1e-10);
  EXPECT_TRUE(run_of.model.warnings.empty());
}

void add_disc(Pile& pile, double x, double y, const std::string& ground, const std::string& law) {
  pile.add("disc: [0, 0], radius: 0.05", 1.25e-3, x, y, ground, law);
}
void add_triangle(Pile& pile, int rows, double friction) {
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i)
      add_disc(pile, 0.05 * (2 * i + row), 0.05 * (1 + std::sqrt(3.0) * row), "floor", laws(0, friction));
}

// Of rows of discs that friction holds, or that could roll apart as well: what is at rest stays so, whatever happens beside it.
TEST_P(RigidStack, ATriangleOfDiscsStandsWhateverABallDoesBesideIt) {
  for (const int rows : {3, 4}) {
    SCOPED_TRACE(rows);
    Pile pile;
    add_triangle(pile, rows, 0.5);
    const int discs = pile.count;
    add_disc(pile, 3, 0.15, "floor", laws(0.5, 0.5));
    const Whole run_of =
        run(floor_under() + pile.text() + "start: {b" + std::to_string(discs) + ": {velocity: [1, 0]}}\n" + run_for(0.5, 0.1));
    expect_sound(run_of, 1e-9);
    double borne = 0;
    for (int i = 0; i < discs; ++i) borne += run_of.last("w" + std::to_string(i) + ".normal [N]");
    EXPECT_NEAR(borne, discs * g, 1e-8);
    EXPECT_NEAR(run_of.last("b0.x [m]"), 0, 1e-10);
    EXPECT_NEAR(run_of.last("b" + std::to_string(discs - 1) + ".y [m]"), 0.05 * (1 + std::sqrt(3.0) * (rows - 1)), 1e-10);
  }
}

// A disc on two that lean on walls, all without friction; its two forces are at the angle whose cosine is 55 mm over 100.
TEST_P(RigidStack, DiscsBetweenWallsHaveTheForcesOfStatics) {
  const double apart = 0.055, up = std::sqrt(0.01 - apart * apart);
  Pile pile;
  for (const double x : {-apart, apart}) add_disc(pile, x, 0.05, "bin", laws(0, 0));
  add_disc(pile, 0, 0.05 + up, "bin", laws(0, 0));
  const Whole run_of =
      run("gravity: [0, -9.81]\nground: {profiles: {bin: {path: [[-0.105, 1], [-0.105, 0], [0.105, 0], [0.105, 1]], material: right}}}\n" +
          pile.text() + run_for(3, 0.1));
  expect_sound(run_of, 1e-9);
  const double on_each = g / 2 / (up / 0.1), wall = on_each * apart / 0.1;
  for (const char* n : {"0", "1"}) {
    EXPECT_NEAR(run_of.last(std::string("c2_") + n + ".normal [N]"), on_each, 1e-8);
    EXPECT_NEAR(run_of.last(std::string("w") + n + ".normal [N]"), 1.5 * g + wall, 1e-8);  // of the floor and of a wall
  }
  EXPECT_NEAR(run_of.last("b2.y [m]"), 0.05 + up, 1e-10);
}

// In a step of 10 ms at 5 m/s a ball is behind a plate of 10 mm that it should have hit.
TEST(RigidStackSteps, AreRefusedWhereBodiesWouldGoThroughEachOther) {
  const auto shot = [](double shot_step) {
    return run(
        "gravity: [0, 0]\nground: {profiles: {plate: {path: [[0, -1], [0.01, -1], [0.01, 1], [0, 1]], closed: true}}}\nbodies:\n  ball: "
        "{rigid: {mass: 1, inertia: 1e-3}, profiles: {o: {disc: [0, 0], radius: 0.001}}}\ncontacts:\n  c: {between: [ball.o, "
        "ground.plate]" +
        laws(0.5, 0) + "start: {ball: {at: [-0.1, 0.2], velocity: [5, 0]}}\nrun: {until: 0.1, method: {moreau: {step: " +
        number(shot_step) + "}}}\noutput: {every: 0.01, frames: 0}\n");
  };
  EXPECT_NE(shot(1e-2).run.reason.find("bodies pass through each other within one step at \"c\"; use a shorter step"), std::string::npos);
  const Whole fine = shot(1e-3);
  expect_sound(fine);
  EXPECT_NEAR(fine.last("ball.vx [m/s]"), -2.5, 1e-12);
}

}  // namespace
}  // namespace pintle::rigid_stack_test
