// Tables over two signals: how they are read, what they give, where they end.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/scene/units/signal_law.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle::signal_map_test {
namespace {

namespace fs = std::filesystem;

const std::string grid = "rpm\\throttle, 0, 0.5, 1\n500, -5, 20, 60\n1000, -10, 40, 80  # peak\n3000, -15, 45, 90\n";

struct Folder {
  explicit Folder(const std::string& table)
      : path(fs::temp_directory_path() / (std::string("pintle_map_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(path);
    std::ofstream(path / "map.csv") << table;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

std::string text(const std::string& table, const std::string& more = "until: 20 s") {
  return R"yaml(
parameters: {throttle: 0.5}
bodies: {rotor: {rigid: {mass: 1 kg, inertia: 0.2 kg m^2}, points: {O: [0, 0]}}}
joints: {bearing: {revolute: [ground, rotor.O]}}
forces:
  engine: {torque: )yaml" +
         table + R"yaml(, on: rotor}
  brake: {torque: -0.15 N m s*rotor.speed, on: rotor}
start: {rotor: {speed: 1000 rpm}}
run: {)yaml" +
         more + "}\n";
}
const std::string table = "{table: map.csv, over: [rotor.speed, throttle], over unit: [rpm, 1], value unit: N m}";

std::string refusal(const std::string& of_table, const std::string& file = grid) {
  const Folder folder(file);
  return pintle_test::refusal_by([&] { build(read_scene_text(text(of_table), (folder.path / "scene.yaml").string(), {}, folder.path)); });
}

class SignalMapRun : public testing::TestWithParam<const char*> {};

// From 1000 to 3000 rpm at half throttle it gives 40 N m and 5 N m more over 2000 rpm: J ω' = 37.5 + c ω − 0.15 ω.
TEST_P(SignalMapRun, AnEngineRunsUpExponentially) {
  const Folder folder(grid);
  Scene s = read_scene_text(text(table), (folder.path / "scene.yaml").string(), {}, folder.path);
  s.run.method = GetParam();
  s.run.tolerance = 1e-8;
  const pintle_scenes::Whole w = pintle_scenes::run(s);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const double rpm = std::numbers::pi / 30, c = 5 / (2000 * rpm), k = 0.15 - c, settled = 37.5 / k;
  const auto t = w.column("t [s]"), speed = w.column("rotor.speed [rad/s]");
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_NEAR(speed[i], settled + (1000 * rpm - settled) * std::exp(-k * t[i] / 0.2), 1e-5 * settled) << t[i];
}
INSTANTIATE_TEST_SUITE_P(Each, SignalMapRun, testing::Values("dopri5", "verner87", "generalized-alpha"),
                         [](const auto& p) { return p.param[0] == 'g' ? "GeneralizedAlpha" : std::string(p.param); });

// z = (1 + a)(2 − b) is bilinear: any grid meets it and its derivatives exactly. In the second law both axes see both signals.
TEST(SignalMap, MeetsABilinearFunctionAndItsDerivatives) {
  Grid samples{{-1, 0.5, 2, 3}, {0, 1, 4}, {}};
  for (const double a : samples.a)
    for (const double b : samples.b) samples.value.push_back((1 + a) * (2 - b));
  Formula of_a(Dimension{}), of_b(Dimension{});
  const int a0 = of_a.input("p", {}), a1 = of_a.input("q", {}), b0 = of_b.input("p", {}), b1 = of_b.input("q", {});
  const SignalMap map{
      Bilinear(samples),
      {SignalFormula(of_a.program(of_a.term(Op::add, a0, a1))), SignalFormula(of_b.program(of_b.term(Op::multiply, b0, b1)))}};
  for (const double p : {0.3, 0.7, 1.4})
    for (const double q : {0.4, 0.9, 1.3}) {
      const double in[] = {p, q}, a = p + q, b = p * q;
      double slope[2];
      EXPECT_NEAR(map(0, in, slope), (1 + a) * (2 - b), 1e-13);
      EXPECT_NEAR(slope[0], (2 - b) - (1 + a) * q, 1e-13);
      EXPECT_NEAR(slope[1], (2 - b) - (1 + a) * p, 1e-13);
    }
}

TEST(SignalMap, HoldsItsBorderWhereItIsToldTo) {
  const Bilinear table_of_four({{0, 1}, {0, 1}, {1, 2, 3, 5}});
  EXPECT_EQ(table_of_four(-5, 0.5).value, 1.5);
  EXPECT_EQ(table_of_four(-5, 0.5).by_a, 0);
  EXPECT_EQ(table_of_four(-5, 0.5).by_b, 1);
  EXPECT_EQ(table_of_four(7, 9).value, 5);
}

// What run.json holds of a scene reads as the scene does.
TEST(SignalMap, IsReadBackFromTheScenesOwnWords) {
  const Folder folder(grid);
  for (const std::string& of : {table, std::string("{table: map.csv, over: [rotor.speed, throttle*t/(1 s)], outside: hold}")}) {
    const Scene s = read_scene_text(text(of), (folder.path / "scene.yaml").string(), {}, folder.path);
    const Scene again = read_scene_text(s.filled_in, (folder.path / "scene.yaml").string(), {}, folder.path);
    EXPECT_EQ(again.filled_in, s.filled_in);
  }
}

TEST(SignalMap, EndsTheRunByNameWhereItIsLeft) {
  const Folder folder(grid);
  const auto ran = [&](const std::string& of_table) {
    return pintle_scenes::run(read_scene_text(text(of_table, "until: 20 s, method: dopri5") + "  \n", (folder.path / "scene.yaml").string(),
                                              {{"throttle", "0.9"}}, folder.path));
  };
  const auto left = ran(table);
  EXPECT_EQ(left.run.status, Status::failed);
  pintle_test::expect_says(left.run.reason, {"\"engine\"", "by the table map.csv", "rotor.speed = ", "314.159265", "outside: hold"});
  const auto held = ran("{table: map.csv, over: [rotor.speed, throttle], over unit: [rpm, 1], outside: hold}");
  ASSERT_EQ(held.run.status, Status::finished) << held.run.reason;
  EXPECT_NEAR(held.last("rotor.speed [rad/s]"), 81 / 0.15, 1e-3);  // -15 + (90 − 45) … at 0.9: 45 + 0.8·45
}

// Lines of both axes that are met together just where the run ends, at whatever times the clock has digits for.
TEST(SignalMap, LinesAreMetTogetherAtTheEndOfARun) {
  const Folder folder("a, 0, 1, 2\n0, 1, 2, 3\n1, 2, 4, 6\n2, 3, 6, 9\n");
  for (const char* method : {"dopri5", "verner87", "generalized-alpha"})
    for (const double until : {0.3, 0.7, 1.0, 1.7, 13.1, 100.3})
      for (const double speed : {0.3, 0.37, 0.61, 0.7}) {
        const auto number = [](double x) { return pintle_scenes::number(x); };
        const auto w = pintle_scenes::run(read_scene_text(
            "bodies: {b: {rigid: {mass: 1 kg, inertia: 1}}}\nparameters: {T: " + number(until) + " s, u: " + number(speed) +
                " m/s, w: 0.9 m/s}\nstart: {b: {x: 1 m - u*T, vx: u, y: 1 m - w*T, vy: w}}\n"
                "forces: {push: {force: [{table: map.csv, over: [b.x, b.y], value unit: 1e-12 N, outside: hold}, 0], at: b}}\n"
                "run: {until: T, method: " +
                method + "}\noutput: {every: T/4}\n",
            (folder.path / "scene.yaml").string(), {}, folder.path));
        EXPECT_EQ(w.run.status, Status::finished) << method << " " << until << " " << speed << ": " << w.run.reason;
        EXPECT_EQ(w.run.t_end, until);
      }
}

// A body that flies freely along a table that ends at 2 m, by whatever method, however long its steps.
class TableEnds : public testing::TestWithParam<const char*> {
 protected:
  pintle_scenes::Whole ran(const std::string& more, const std::string& until = "1 s") const {
    const Folder folder("0, 0\n1, 5\n2, 7\n");
    return pintle_scenes::run(
        read_scene_text("bodies: {b: {rigid: {mass: 1 kg, inertia: 1}}}\nstart: {b: {x: 0.1 m, vx: 10 m/s}}\n"
                        "forces: {push: {force: [{table: map.csv, over: b.x, over unit: m, value unit: 1e-9 N" +
                            more + "}, 0], at: b}}\nrun: {until: " + until + ", method: " + GetParam() + "}\n",
                        (folder.path / "scene.yaml").string(), {}, folder.path));
  }
};
INSTANTIATE_TEST_SUITE_P(Each, TableEnds, testing::Values("dopri5", "rkf45", "verner87", "generalized-alpha"),
                         [](const auto& p) { return p.param[0] == 'g' ? "GeneralizedAlpha" : std::string(p.param); });

TEST_P(TableEnds, EndTheRunByNameWhereTheyAreToldTo) {
  for (const char* shape : {"linear", "spline"}) {
    const auto w = ran(std::string(", outside: refuse, interpolation: ") + shape);
    EXPECT_EQ(w.run.status, Status::failed);
    EXPECT_TRUE(w.run.reason.starts_with("the law by the table map.csv of \"push\" (")) << w.run.reason;  // the cause first
    pintle_test::expect_says(w.run.reason, {"leaves its table at t = 0.19", "b.x = 2", "goes from 0 to 2 m", "outside: hold"});
    EXPECT_EQ(ran(std::string(", outside: refuse, interpolation: ") + shape, "0.18 s").run.status, Status::finished);
  }
}
TEST_P(TableEnds, AreWarnedOfOnceWhereNothingIsSaidOfThem) {
  const auto about = [](const auto& w) {
    std::vector<std::string> out;
    for (const std::string& one : w.run.warnings)
      if (one.find("map.csv") != std::string::npos) out.push_back(one);
    return out;
  };
  const auto left = ran("");
  ASSERT_EQ(left.run.status, Status::finished) << left.run.reason;
  ASSERT_EQ(about(left).size(), 1u);
  pintle_test::expect_says(about(left)[0], {"\"push\"", "scene.yaml:3", "b.x = 2", "from 0 to 2", "outside: hold", "outside: refuse"});
  EXPECT_EQ(about(ran(", outside: hold")).size(), 0u);
  EXPECT_EQ(about(ran("", "0.18 s")).size(), 0u);
}

// What is 5 x up to 1 m and 3 + 2 x beyond, along x = 0.1 m + (10 m/s) t, as the rate of a state, as an output, and in a condition.
TEST(SignalTable, IsARateAndAnOutputThatConditionsName) {
  const Folder folder("0, 0\n1, 5\n2, 7\n");
  const std::string held = "{table: map.csv, over: b.x, interpolation: linear, outside: hold, value unit: ";
  for (const char* method : {"dopri5", "verner87", "generalized-alpha"}) {
    const Scene s =
        read_scene_text("bodies: {b: {rigid: {mass: 1 kg, inertia: 1}}}\nstart: {b: {x: 0.1 m, vx: 10 m/s}}\nstates: {sum: {rate: " + held +
                            "N}, start: 0 N s}}\noutputs: {look: " + held +
                            "N}, twice: 2*look}\nevents: {e: {when: twice > 12 N, do: {row: true}}}\n"
                            "run: {until: 0.18 s, method: " +
                            method + "}\noutput: {every: 10 ms}\n",
                        (folder.path / "scene.yaml").string(), {}, folder.path);
    EXPECT_EQ(read_scene_text(s.filled_in, (folder.path / "scene.yaml").string(), {}, folder.path).filled_in, s.filled_in);
    const auto w = pintle_scenes::run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    const auto t = w.column("t [s]"), sum = w.column("sum [kg m/s]"), look = w.column("look [N]"), twice = w.column("twice [N]");
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double x = 0.1 + 10 * t[i], beyond = std::max(x - 1, 0.0);
      EXPECT_NEAR(look[i], 5 * x - 3 * beyond, 1e-12) << method << t[i];
      EXPECT_NEAR(twice[i], 2 * look[i], 1e-12);
      EXPECT_NEAR(sum[i], (2.5 * (x * x - 0.01) - 1.5 * beyond * beyond) / 10, 1e-6) << method << t[i];
    }
    ASSERT_EQ(w.run.happenings.size(), 1u);
    EXPECT_NEAR(w.run.happenings[0].t, 0.14, 1e-12);
  }
}

// What check can know: the start, and what a driver imposes.
TEST(SignalTable, IsKnownToBeLeftBeforehand) {
  const Folder folder("0, 0\n1, 5\n2, 7\n");
  const auto left = [&](const std::string& over, const std::string& outside, const std::string& more) {
    const Scene s = read_scene_text(
        "bodies: {b: {rigid: {mass: 1 kg, inertia: 1}, points: {P: [1 m, 0]}}}\njoints: {pin: {revolute: [ground, b]}}\n"
        "forces: {push: {torque: {table: map.csv, value unit: N m, over: " +
            over + outside + "}, on: b}}\nrun: {until: 1 s}\n" + more,
        (folder.path / "scene.yaml").string(), {}, folder.path);
    const Model model = build(s);
    return tables_left(s, model, assemble(s, model).start);
  };
  const std::string turned = "drivers: {motor: {angle: [ground, b], law: 3 rad/s*t}}\n";
  EXPECT_TRUE(left("b.angle", "", "start: {b: {angle: 1.5}}\n").empty());
  const auto at_start = left("b.angle", "", "start: {b: {angle: 2.5}}\n");
  ASSERT_EQ(at_start.size(), 1u);
  pintle_test::expect_says(at_start[0], {"map.csv of \"push\"", "scene.yaml:3", "leaves its table at the start", "b.angle = 2.5",
                                         "goes from 0 to 2 rad", "the value at the end of the table is used"});
  for (const char* over : {"b.angle", "motor.angle", "pin.angle", "b.speed - 0.5 rad/s"}) {
    const auto driven = left(over, ", outside: refuse", turned);
    ASSERT_EQ(driven.size(), 1u) << over;
    pintle_test::expect_says(
        driven[0], {"leaves its table", over[2] == 's' ? "at the start" : "by t = 0.667 s", "ends the run there", "outside: hold"});
  }
  EXPECT_TRUE(left("b.angle", ", outside: hold", turned).empty());
  EXPECT_TRUE(left("b.P.x", "", turned).empty()) << "a place is no driver's own";
}

TEST(BadSignalMap, IsRefusedWithPlaceAndRemedy) {
  using pintle_test::expect_says;
  expect_says(refusal("{table: map.csv, over: [rotor.speed, throttle, 1]}"),
              {"scene.yaml:6: forces.engine.torque.over: ", "[engine.speed, throttle]"});
  expect_says(refusal("{table: map.csv, over: [throttle, 0.2]}"), {"names no signal"});
  expect_says(refusal("{table: map.csv, over: [rotor.sped, throttle]}"), {"rotor.sped", "rotor.speed"});
  expect_says(refusal("{table: map.csv, over: [rotor.speed, throttle], over unit: rpm}"), {"over unit", "[rpm, 1]"});
  expect_says(refusal("{table: map.csv, over: [rotor.speed, throttle], over unit: [mm, 1]}"), {"over unit", "angular speed"});
  expect_says(refusal("{table: map.csv, over: [rotor.speed, throttle], value unit: N}"), {"value unit", "torque"});
  expect_says(refusal("{table: map.csv, over: [rotor.speed, throttle], periodic: true}"), {"periodic", "bilinear"});
  expect_says(refusal("{table: map.csv, over: [rotor.speed, throttle], outside: holds}"), {"outside", "hold"});
  const std::string over = "{table: map.csv, over: [rotor.speed, throttle]}";
  expect_says(refusal(over, "c, 0, 1\n0, 1, 2\n1, 2\n"), {"map.csv:3: ", "write 3: one of rotor.speed"});
  expect_says(refusal(over, "c, 0, 1\n0, 1, 2\n0, 2, 3\n"), {"map.csv:3: ", "rotor.speed 0 is not greater than", "increase"});
  expect_says(refusal(over, "c, 1, 0\n0, 1, 2\n1, 2, 3\n"), {"map.csv:1: ", "throttle 0 is not greater than"});
  expect_says(refusal(over, "c, 0, 1\n0, 1, 2\n"), {"map.csv: ", "a grid of 1 by 2"});
  expect_says(refusal(over, "c, 0, 1\n0, 1, 2\n1, 2, x\n"), {"map.csv:3: ", "\"x\" is not a number"});
  EXPECT_EQ(refusal(over, "0 0 1\n0 1 2\n1 2 3\n"), "accepted");  // a number in the corner
  EXPECT_EQ(refusal(over, ", 0, 1\n0, 1, 2\n1, 2, 3\n"), "accepted");
}

}  // namespace
}  // namespace pintle::signal_map_test
