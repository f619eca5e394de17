// A user's program may have set a locale with a comma and grouped thousands: files are written and read as ever.
#include <locale>

#include <gtest/gtest.h>

#include "framework/analysis/simulate/identity.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/mechanism/table.h"
#include "framework/output/room.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/program.h"

namespace pintle::locale_test {
namespace {

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {}
  ~CommaLocale() { std::locale::global(before_); }
  CommaLocale(const CommaLocale&) = delete;

 private:
  std::locale before_;
};

struct Written {
  std::string filled_in, trajectory, state, warning, rejected;
  double restarted = 0;
};

Written written(const std::filesystem::path& folder) {
  const std::string text =
      "title: x\nparameters: {mass: 12345.5 g, length: 0.125 m}\ngravity: [0, -9.81]\n"
      "bodies: {a: {rigid: {mass: mass, inertia: 0.15 kg*m^2}, points: {O: [-length, 0]}}}\n"
      "joints: {pin: {revolute: [ground, a.O]}}\n"
      "forces: {f: {torque: {table: law.csv, time unit: 1.25 ms, value unit: 1500 N m}, on: a}}\n"
      "run: {until: 0.25 s}\noutput: {every: 0.0625 s}\n";
  const Scene scene = read_scene_text(text, "scene.yaml", {}, folder);
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  Written out;
  Listeners listeners;
  listeners.state = [&](const SavedState& s) { out.state = state_text(identity(scene, model, assembly), s); };
  const Run run = simulate(scene, model, assembly, listeners);
  out.filled_in = scene.filled_in;
  out.trajectory = csv(run.trajectory);
  { std::ofstream(folder / "s.state", std::ios::binary) << out.state; }
  out.restarted = read_state(folder / "s.state", scene, model, assembly).t;
  out.warning = validate_room("out", {1, 5e9, 1, 1}, {1.5e9, 1e12}).at(0);
  try {
    read_scene_text(text, "scene.yaml", {{"run.until", "12345.5 m"}}, folder);
  } catch (const SceneError& e) {
    out.rejected = e.what();
  }
  return out;
}

TEST(Locale, NumbersAreWrittenAndReadWithAPointWhateverTheLocale) {
  const pintle_test::Folder folder;
  folder.write("law.csv", "t,v\n0,0\n100,1.5\n1000,2.5\n");
  const Written classic = written(folder.path());
  const CommaLocale comma;
  std::ostringstream sees;
  sees << 1234.5;
  ASSERT_EQ(sees.str(), "1.234,5") << "or this test sees nothing";
  const Written other = written(folder.path());
  EXPECT_EQ(other.filled_in, classic.filled_in);
  EXPECT_EQ(other.trajectory, classic.trajectory);
  EXPECT_EQ(other.state, classic.state);
  EXPECT_EQ(other.restarted, classic.restarted);
  EXPECT_EQ(other.warning, classic.warning);
  EXPECT_EQ(other.rejected, classic.rejected);
}

TEST(Room, WhatCannotFitIsRefusedAndWhatMayNotIsWarnedOf) {
  const double infinite = INFINITY;
  EXPECT_TRUE(validate_room("out", {1e6, 2e6, 1e6, 1e6}, {infinite, infinite}).empty());
  EXPECT_TRUE(validate_room("out", {1e6, 2e6, 1e6, 1e6}, {2e6, 1e6}).empty());
  EXPECT_EQ(validate_room("out", {1e6, 2e6, 1e6, 1e6}, {1.5e6, infinite}).size(), 1U);
  EXPECT_EQ(validate_room("out", {1e6, 2e6, 0.5e6, 1e6}, {infinite, 0.7e6}).size(), 1U);
  EXPECT_THROW(validate_room("out", {1e6, 2e6, 1e6, 1e6}, {0.9e6, infinite}), std::runtime_error);
  EXPECT_THROW(validate_room("out", {1e6, 2e6, 1e6, 1e6}, {infinite, 0.9e6}), std::runtime_error);
}

TEST(Room, SizesAreSaidInThreeDigitsAndTheirUnit) {
  const auto said = [](double needed, double there) { return validate_room("out", {0, needed, 0, 0}, {there, INFINITY}).at(0); };
  for (const auto& [needed, there, text] : {std::tuple(1234567.0, 200'100.0, "may need 1.24 MB, and the disk of out has 200 kB"),
                                            std::tuple(5e9, 123'456'789.0, "may need 5.00 GB, and the disk of out has 123 MB"),
                                            std::tuple(98'760.0, 0.0, "may need 98.8 kB, and the disk of out has 0 bytes")})
    EXPECT_NE(said(needed, there).find(text), std::string::npos) << said(needed, there);
}

// What is said to be needed at least is never more than what is written.
TEST(Room, TheLeastIsABoundFromBelow) {
  const Scene scene =
      read_scene(PINTLE_SOURCE_DIR "/examples/slider_crank_clearance.yaml", {{"run.until", "1 ms"}, {"output.frames", "0"}});
  const Model model = build(scene);
  const auto run = simulate(scene, model, assemble(scene, model));
  const RoomNeeded needed = room_needed(scene, model);
  const double wide = static_cast<double>(csv(run.trajectory).size()), both = wide + static_cast<double>(csv(run.ledger).size());
  EXPECT_LT(needed.file_least, wide);
  EXPECT_LT(needed.least, both);
  EXPECT_GT(needed.likely, needed.least);
}

}  // namespace
}  // namespace pintle::locale_test
