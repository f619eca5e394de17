// Basins of attraction in closed form, and what a study of them says.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/scene/error.h"
#include "framework/study/nonlinear/nonlinear.h"
#include "tests/scenes/studies/nonlinear_study.h"

namespace pintle {
namespace {

/// A block on a hilltop, x'' = x - 2 x' where |x| < 1 m, with a well about 1.5 m on either side. What goes down into a well comes back to its
/// edge too slowly to leave it. So the basins meet in the stable direction of the hilltop, v = -(1 + sqrt(2)) x.
constexpr const char* hilltop =
    "parameters: {x0: 0.1 m, v0: 0 m/s}\n"
    "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}}}\n"
    "joints: {guide: {prismatic: [ground, block]}}\n"
    "forces:\n"
    "  hill: {force: [\"1 N/m*block.x - 2 N s/m*block.vx\", 0], at: block}\n"
    "  wells: {force: [\"3 N/m*(max(-1 m - block.x, 0 m) - max(block.x - 1 m, 0 m))\", 0], at: block}\n"
    "start: {block: {x: x0, vx: v0}}\n"
    "run: {until: 100 s, tolerance: 1e-8, method: dopri5}\n";
constexpr const char* section = "section: {every: 1 s, record: {x: block.x}, transient: 60, returns: 3}\n";

TEST(Basins, OfTwoWellsMeetInTheStableDirectionOfTheHilltop) {
  const SweepFolder folder;
  const Followed done = follow_study(
      folder, hilltop,
      std::string(section) + "basins: {grid: {x0: {from: -0.9 m, to: 0.9 m, count: 10}, v0: {from: -2 m/s, to: 2 m/s, count: 10}}}\n", 2);
  ASSERT_EQ(done.values.size(), 100u);
  const std::size_t left = done.values.front().attractor;
  for (const FollowedValue& value : done.values) {
    EXPECT_EQ(value.attractor == left, value.at.at(1) + (1 + std::sqrt(2)) * value.at.at(0) < 0) << place_words(done.study, value);
    EXPECT_NEAR(std::abs(value.orbit.signals.back().at(0)), 1.5, 1e-6);
  }
  const std::vector<Basin> found = basins(done.values);
  ASSERT_EQ(found.size(), 2u);
  for (const Basin& basin : found) EXPECT_EQ(basin.share, 0.5);
}

// By symmetry half of all starts; the bounds of 95 % of a sample of 60 hold it, or the numbers would be an odd sample.
TEST(Basins, OfARandomSampleHaveSharesWithBounds) {
  const SweepFolder folder;
  const Followed done = follow_study(folder, hilltop,
                                     std::string(section) +
                                         "basins: {random: {count: 60, seed: 3, x0: {from: -0.9 m, to: 0.9 m}, v0: "
                                         "{from: -2 m/s, to: 2 m/s}}, tolerance: 0.02}\n");
  const std::string table = contents(folder / "out/attractors.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "attractor,starts,share,least share,greatest share,period,K,dimension,least x [m],mean x [m],greatest x [m],x0 [m],v0 [m/s]");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_NEAR(basins(done.values).at(0).share, 0.5, 1.96 * std::sqrt(0.25 / 60));
}

TEST(Basins, AreRefusedWhereTheyCannotBe) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"lyapunov: {every: 1 s, over: 10 s}\nbasins: {grid: {x0: [0.1 m, 0.2 m]}}\n", "a section"},
      {std::string(section) + "basins: {grid: {x0: [0.1 m, 0.2 m]}}\nover: {v0: [0, 1]}\n", "does not go with basins"},
      {std::string(section) + "basins: {grid: {x0: [0.1 m, 0.2 m]}}\ndirection: both\n", "studies over a parameter"},
      {std::string(section) + "basins: {grid: {x1: [0.1 m, 0.2 m]}}\n", "x1"},
      {std::string(section) + "basins: {tolerance: 0.1}\n", "which cases it has"},
      {std::string(section) + "basins: {grid: {x0: [0.1 m, 0.2 m]}, tolerance: 2}\n", "tolerance"},
      {std::string(section) + "basins: {grids: {x0: [0.1 m, 0.2 m]}}\n", "grids"}};
  for (const auto& [study, said] : cases) {
    const SweepFolder folder;
    folder.write("scene.yaml", hilltop);
    folder.write("study.yaml", "scene: scene.yaml\n" + study);
    try {
      read_nonlinear(folder / "study.yaml");
      ADD_FAILURE() << study;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("study.yaml:"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace pintle
