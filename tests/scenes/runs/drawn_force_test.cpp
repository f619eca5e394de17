// In examples, frames show the forces that results give: the same vectors on the same bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/scenes/runs/drawn_forces.h"
#include "tests/scenes/text_runs.h"

namespace pintle::drawn_force_test {
namespace {

namespace fs = std::filesystem;

TEST(DrawnForces, OfEveryExampleAreThoseOfItsResults) {
  long checked = 0, acting = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(PINTLE_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path().filename().string());
    Scene scene = read_scene(entry.path());
    const bool moved_only = std::ranges::any_of(scene.bodies, [](const SceneBody& b) { return !b.elastic && b.mass == 0; });
    if (!scene.has_run || moved_only) continue;
    scene.run.until *= 0.3;
    acting += pintle_scenes::expect_frames_hold_written_forces(std::move(scene));
    ++checked;
  }
  EXPECT_GT(checked, 40);
  EXPECT_GT(acting, 21 * checked);  // one force in each frame of each, or more
}

}  // namespace
}  // namespace pintle::drawn_force_test
