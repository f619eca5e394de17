// What a flexible body costs does not depend on its mesh: counts of bytes and evaluations, no
// times.

#include <gtest/gtest.h>

#include <string>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/integration/integrator.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/heap.h"

namespace pintle::flexible_budget_test {
namespace {

/// A slider-crank whose coupler is a plate of cells × cells/8 quadrilaterals, with four shapes.
Scene slider_crank(int cells, const std::string& stiffening) {
  return read_scene_text(
      "gravity: [0, -9.81]\n"
      "bodies:\n"
      "  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [-25 mm, 0], A: [25 mm, 0]}}\n"
      "  coupler:\n"
      "    plate: {thickness: 10 mm, young: 70 GPa, poisson: 0.3, density: 2700, element: "
      "quadrilateral4,\n"
      "            grid: {corners: [[0, -0.01], [0.12, -0.01], [0.12, 0.01], [0, 0.01]],\n"
      "                   cells: [" +
          std::to_string(cells) + ", " + std::to_string(cells / 8) +
          "]}}\n"
          "    points: {A: [0, 0], B: [120 mm, 0]}\n"
          "    modes: {frame: chord, count: 4}\n"
          "    stiffening: " +
          stiffening +
          "\n"
          "  slider: {rigid: {mass: 0.14, inertia: 1e-4}, points: {P: [0, 0]}}\n"
          "joints:\n"
          "  bearing: {revolute: [ground, crank.O]}\n"
          "  crank pin: {revolute: [crank.A, coupler.A]}\n"
          "  gudgeon: {revolute: [coupler.B, slider.P]}\n"
          "  guide: {prismatic: [ground, slider.P]}\n"
          "start: {crank: {angle: 0, speed: 150}}\n"
          "run: {until: 1, method: dopri5}\n"
          "output: {points: [coupler.B], stress: [coupler.B]}\n",
      "plate.yaml");
}
constexpr int coarse = 16, fine = 192;  // 102 and 9650 dofs

/// A mechanism ready to run and all that runs it.
struct Ready {
  explicit Ready(const Scene& scene) : model(build(scene)), run(model.system, model.scheme, assemble(scene, model).start) {}
  Model model;
  Integrator run;
};

long bytes_kept(int cells, const std::string& stiffening) {
  const Scene scene = slider_crank(cells, stiffening);
  const long before = heap_in_use();
  const Ready ready(scene);
  return heap_in_use() - before;
}

// Had one vector of finite-element size stayed, the finer mesh would keep 76 kB more.
TEST(FlexibleBudget, NothingOfFiniteElementSizeOutlivesTheBuild) {
  if (heap_in_use() < 0) GTEST_SKIP() << "the heap of this platform does not tell";
  constexpr double spare = 1000;  // blocks come up to 16 bytes longer than asked for
  bytes_kept(fine, "axial");      // what libraries keep for themselves, once
  for (const char* stiffening : {"none", "axial"}) {
    const long with_coarse = bytes_kept(coarse, stiffening), with_fine = bytes_kept(fine, stiffening);
    EXPECT_NEAR(static_cast<double>(with_fine - with_coarse), 0, spare) << stiffening;
    EXPECT_GT(with_coarse, 10000);
  }
}

TEST(FlexibleBudget, EvaluationsDoNotDependOnTheMesh) {
  long evaluations[2] = {};
  int i = 0;
  for (const int cells : {coarse, fine}) {
    const Scene scene = slider_crank(cells, "none");
    Ready ready(scene);
    EXPECT_EQ(ready.model.system.n(), 13);
    for (int k = 0; k < 20; ++k) ASSERT_TRUE(ready.run.advance(1));  // finds its step
    const Counts before = ready.run.counts();
    for (int k = 0; k < 200; ++k) ASSERT_TRUE(ready.run.advance(1));
    const Counts after = ready.run.counts();
    evaluations[i] = after.evaluations - before.evaluations;
    EXPECT_EQ(evaluations[i++], 6 * (after.steps + after.rejected - before.steps - before.rejected));
  }
  // Rejected steps, a few in a hundred, fall where the frequencies of the mesh put them.
  EXPECT_NEAR(static_cast<double>(evaluations[0]) / static_cast<double>(evaluations[1]), 1, 0.1);
}

}  // namespace
}  // namespace pintle::flexible_budget_test
