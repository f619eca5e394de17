// Many rigid contacts at once, of which there are more than the bodies can tell apart: heaps, dominoes, and a lock in its hollow.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "framework/build/build.h"
#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_heap_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81;

// Pushed at the first, each falls onto the next; at rest the floor bears them all, whatever part of it each corner has.
TEST(RigidHeap, DominoesFallAndRestOnEachOther) {
  std::string bodies = "bodies:\n", contacts = "contacts:\n";
  for (int i = 0; i < 5; ++i) {
    const std::string n = std::to_string(i), friction = ", model: impact, restitution: 0, friction: {coulomb: {coefficient: ";
    bodies += "  d" + n +
              ": {rigid: {mass: 0.02, inertia: 4e-6}, profiles: {o: {path: [[-0.004, -0.024], [0.004, -0.024], [0.004, 0.024], " +
              "[-0.004, 0.024]], closed: true}}, pose: {at: [" + number(0.022 * i) + ", 0.024]}}\n";
    contacts += "  f" + n + ": {between: [d" + n + ".o, ground.floor]" + friction + "0.5}}}\n";
    if (i > 0) contacts += "  c" + n + ": {between: [d" + n + ".o, d" + std::to_string(i - 1) + ".o]" + friction + "0.2}}}\n";
  }
  const Whole w = run(floor_under() + bodies + contacts +
                      "forces: {push: {force: [\"if(t < 0.05, 0.3, 0)\", 0], at: d0}}\nrun: {until: 0.8}\noutput: {frames: 0}\n");
  expect_sound(w);
  double pressed = 0;
  for (int i = 0; i < 5; ++i) {
    const std::string n = std::to_string(i);
    pressed += w.last("f" + n + ".normal [N]");
    EXPECT_LT(w.last("d" + n + ".angle [rad]"), -1.1) << i;
    EXPECT_NEAR(w.last("d" + n + ".speed [rad/s]"), 0, 1e-6) << i;
  }
  EXPECT_NEAR(pressed, 0.1 * g, 1e-9);
  EXPECT_NEAR(w.last("d4.angle [rad]"), -std::acos(0.0), 1e-9);
  EXPECT_NEAR(w.last("d4.y [m]"), 0.004, 1e-12);
}

struct Heap {
  int discs;
  double restitution, friction, until, wider = 1e-3;
};
void PrintTo(const Heap& h, std::ostream* out) {
  *out << h.discs << " discs, restitution " << h.restitution << ", friction " << h.friction << ", bin wider by " << h.wider << " m";
}

std::string laws(double restitution, double friction) {
  return ", model: impact, restitution: " + number(restitution) +
         (friction > 0 ? ", friction: {coulomb: {coefficient: " + number(friction) + "}}}\n" : "}\n");
}

// The bin is as wide as four discs, or a little wider.
std::string in_a_bin(const Heap& h) {
  std::string bodies = "bodies:\n", contacts = "contacts:\n";
  for (int i = 0; i < h.discs; ++i) {
    const std::string n = std::to_string(i);
    bodies += "  b" + n + ": {rigid: {mass: 1, inertia: 1e-3}, profiles: {o: {disc: [0, 0], radius: 0.05}}, pose: {at: [" +
              number(-0.12 + 0.12 * (i % 3) + 0.01 * (i / 3 % 3)) + ", " + number(0.07 + 0.11 * (i / 3)) + "]}}\n";
    contacts += "  w" + n + ": {between: [b" + n + ".o, ground.bin]" + laws(h.restitution, h.friction);
    for (int j = 0; j < i; ++j)
      contacts += "  c" + n + "_" + std::to_string(j) + ": {between: [b" + n + ".o, b" + std::to_string(j) + ".o]" +
                  laws(h.restitution, h.friction);
  }
  const std::string right = number(0.2 + h.wider / 2), left = "-" + right;
  return "gravity: [0, -9.81]\nground: {profiles: {bin: {path: [[" + left + ", 3], [" + left + ", 0], [" + right + ", 0], [" + right +
         ", 3]], material: right}}}\n" + bodies + contacts + "run: {until: " + number(h.until) + "}\noutput: {every: 5 ms, frames: 0}\n";
}

class RigidHeaps : public testing::TestWithParam<Heap> {};
INSTANTIATE_TEST_SUITE_P(All, RigidHeaps,
                         testing::Values(Heap{3, 0.3, 0.3, 1.5}, Heap{4, 0.3, 0.3, 1.5}, Heap{5, 0.3, 0.3, 1.5}, Heap{6, 0.3, 0.3, 1.5},
                                         Heap{7, 0.3, 0.3, 0.8}, Heap{8, 0.3, 0.3, 0.5}, Heap{12, 0.3, 0.3, 0.3}, Heap{15, 0, 0.3, 0.25},
                                         Heap{4, 0.3, 0, 1.5}, Heap{6, 0.3, 0, 0.8}, Heap{4, 0, 0.3, 1.5}, Heap{9, 0, 0.3, 0.4},
                                         Heap{4, 0.3, 0, 1.5, 0}, Heap{4, 0, 0, 1, 0}, Heap{9, 0, 0, 1, 0}));

// None goes into another, nor through a wall, and nothing is gained.
TEST_P(RigidHeaps, OfDiscsFillABin) {
  const double r = 0.05;
  const int discs = GetParam().discs;
  const Whole w = run(in_a_bin(GetParam()));
  expect_sound(w);
  for (int i = 0; i < discs; ++i) {
    const auto x = w.column("b" + std::to_string(i) + ".x [m]"), y = w.column("b" + std::to_string(i) + ".y [m]");
    for (std::size_t row = 0; row < x.size(); ++row) {
      EXPECT_GT(y[row], r - 1e-9) << i;
      EXPECT_LT(std::abs(x[row]), 0.2 + GetParam().wider / 2 - r + 1e-9) << i;
    }
    for (int j = 0; j < i; ++j) {
      const auto x_j = w.column("b" + std::to_string(j) + ".x [m]"), y_j = w.column("b" + std::to_string(j) + ".y [m]");
      for (std::size_t row = 0; row < x.size(); ++row)
        EXPECT_GT(std::hypot(x[row] - x_j[row], y[row] - y_j[row]), 2 * r - 1e-9) << i << " " << j;
    }
  }
}

struct Boxes {
  int high, wide;
  double apart;
};
void PrintTo(const Boxes& b, std::ostream* out) { *out << b.high << " high, " << b.wide << " wide, " << b.apart << " m apart"; }

class RigidBoxes : public testing::TestWithParam<Boxes> {};
INSTANTIATE_TEST_SUITE_P(All, RigidBoxes,
                         testing::Values(Boxes{1, 2, 0.01}, Boxes{1, 2, 0}, Boxes{1, 3, 0}, Boxes{2, 1, 0}, Boxes{3, 1, 0}, Boxes{5, 1, 0},
                                         Boxes{10, 1, 0}, Boxes{2, 2, 0.01}, Boxes{2, 2, 0}));

// Corner on corner and side on side: they stand for ever as they are put, and the floor bears them all.
TEST_P(RigidBoxes, StandInRowsAndColumns) {
  const double w = 0.1, h = 0.05, m = 1;
  const auto [high, wide, apart] = GetParam();
  for (const double friction : {0.0, 0.5}) {
    SCOPED_TRACE(friction);
    std::string bodies = "bodies:\n", contacts = "contacts:\n";
    for (int i = 0; i < high * wide; ++i) {
      const std::string n = std::to_string(i);
      bodies += "  b" + n + ": {rigid: {mass: 1, inertia: " + number(m * (w * w + h * h) / 12) +
                "}, profiles: {o: {path: [[-0.05, -0.025], [0.05, -0.025], [0.05, 0.025], [-0.05, 0.025]], closed: true}}, pose: {at: [" +
                number((w + apart) * (i / high)) + ", " + number(h / 2 + h * (i % high)) + "]}}\n";
      contacts += "  w" + n + ": {between: [b" + n + ".o, ground.floor]" + laws(0, friction);
      for (int j = 0; j < i; ++j)
        contacts += "  c" + n + "_" + std::to_string(j) + ": {between: [b" + n + ".o, b" + std::to_string(j) + ".o]" + laws(0, friction);
    }
    const Whole run_of = run(floor_under() + bodies + contacts + "run: {until: 1}\noutput: {every: 0.1, frames: 0}\n");
    expect_sound(run_of, 1e-9);
    double borne = 0;
    for (int i = 0; i < high * wide; ++i) {
      const std::string n = std::to_string(i);
      EXPECT_NEAR(run_of.last("b" + n + ".x [m]"), (w + apart) * (i / high), 1e-9) << i;
      EXPECT_NEAR(run_of.last("b" + n + ".y [m]"), h / 2 + h * (i % high), 1e-9) << i;
      borne += run_of.last("w" + n + ".normal [N]");
    }
    EXPECT_NEAR(borne, high * wide * m * g, 1e-8);
  }
}

// Rows of discs, each in the hollows of the row below. One disc on two: these hold only by friction of tan 15° or more at it and at the
// floor, for the force through both points of contact goes along the line between them.
std::string triangle(int rows, double friction) {
  const double r = 0.05;
  std::string bodies = "bodies:\n", contacts = "contacts:\n";
  int k = 0;
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i, ++k) {
      const std::string n = std::to_string(k);
      bodies += "  b" + n + ": {rigid: {mass: 1, inertia: 1.25e-3}, profiles: {o: {disc: [0, 0], radius: 0.05}}, pose: {at: [" +
                number(r * (2 * i + row)) + ", " + number(r + std::sqrt(3.0) * r * row) + "]}}\n";
      contacts += "  w" + n + ": {between: [b" + n + ".o, ground.floor]" + laws(0, friction);
      for (int j = 0; j < k; ++j)
        contacts += "  c" + n + "_" + std::to_string(j) + ": {between: [b" + n + ".o, b" + std::to_string(j) + ".o]" + laws(0, friction);
    }
  return floor_under() + bodies + contacts + "run: {until: 0.3}\noutput: {every: 0.1, frames: 0}\n";
}

TEST(RigidHeap, ATriangleOfDiscsStandsWhereFrictionHoldsIt) {
  for (const int rows : {2, 3, 4}) {
    SCOPED_TRACE(rows);
    const Whole w = run(triangle(rows, 0.5));
    expect_sound(w, 1e-9);
    double borne = 0;
    for (int k = 0; k < rows * (rows + 1) / 2; ++k) borne += w.last("w" + std::to_string(k) + ".normal [N]");
    EXPECT_NEAR(borne, rows * (rows + 1) / 2 * g, 1e-8);
    EXPECT_NEAR(w.last("b" + std::to_string(rows * (rows + 1) / 2 - 1) + ".y [m]"), 0.05 + std::sqrt(3.0) * 0.05 * (rows - 1), 1e-10);
  }
  for (const double part : {0.99, 1.01}) {
    SCOPED_TRACE(part);
    const Whole w = run(triangle(2, part * std::tan(std::acos(-1.0) / 12)));
    expect_sound(w, 1e-9);
    const double fallen = 0.05 + std::sqrt(3.0) * 0.05 - w.last("b2.y [m]");
    EXPECT_EQ(fallen > 1e-6, part < 1) << fallen;
  }
}

// A turn of the pin turns the wheel by a quarter; then the locking disc holds it, 0.05 mm of play at 55 mm from its own centre.
TEST(RigidHeap, AGenevaWheelIsLockedByEvents) {
  std::ifstream file(PINTLE_SOURCE_DIR "/examples/geneva.yaml");
  std::ostringstream text;
  text << file.rdbuf();
  std::string scene = text.str();
  const std::size_t line = scene.find("run: {until: 3 s");
  ASSERT_NE(line, std::string::npos);
  scene.replace(line, scene.find('\n', line) - line, "run: {until: 0.9 s, method: dopri5}");
  const Whole w = run(scene);
  expect_sound(w);
  EXPECT_NEAR(std::abs(w.last("wheel.angle [rad]")), std::acos(0.0), 5e-3);
  EXPECT_NEAR(w.last("wheel.speed [rad/s]"), 0, 1e-2);
}

TEST(RigidHeap, AStartDeepInsideATooth) {
  const auto start = [](double x, double y) {
    const Scene s = read_scene_text(
        "parameters: {o: 50 mm, i: 40 mm, u: o*sqrt(0.5), v: i*sqrt(0.5)}\nbodies:\n  wheel: {rigid: {mass: 1, inertia: 1e-3}, profiles: "
        "{teeth: {path: [[i, 0], [o, 0], [v, v], [u, u], [0, i], [0, o], [-v, v], [-u, u], [-i, 0], [-o, 0], [-v, -v], [-u, -u], [0, -i], "
        "[0, -o], [v, -v], [u, -u]], closed: true}}}\n  nose: {rigid: {mass: 0.02, inertia: 4e-6}, profiles: {n: {disc: [0, 0], radius: "
        "1.5 mm}}, pose: {at: [" +
            number(x) + ", " + number(y) + "]}}\ncontacts:\n  c: {between: [nose.n, wheel.teeth], model: impact, restitution: 0}\n" +
            "run: {until: 0.01}\n",
        "scene.yaml");
    assemble(s, build(s));
  };
  EXPECT_NO_THROW(start(0.0412, -0.0061));
  for (const auto& at : {std::pair(0.038, -0.0061), std::pair(0.045, 0.003), std::pair(0.03, -0.006), std::pair(0.0, 0.0)})
    pintle_test::expect_one_line(
        pintle_test::refusal_by<std::exception>([&] { start(at.first, at.second); }), "scene.yaml:6: contacts.c",
        {"the two surfaces overlap by", "which is impossible for rigid bodies; move a body with `start` or `pose`"});
}

}  // namespace
}  // namespace pintle::rigid_heap_test
