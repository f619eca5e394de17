// A frame of one flexible plate of six-node triangles with 8 shapes: its fields alone, fields and
// files together, and the preparation before the first frame. The argument is about the number of
// nodes; `MB` is the size of the body's file.
//   bench_frames --benchmark_repetitions=5
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "framework/drawing/flexible_drawing.h"
#include "framework/scene/yaml/reader.h"

namespace {

using namespace pintle;
namespace fs = std::filesystem;

constexpr int shapes = 8;

struct Plate {
  Scene scene;
  ElasticBody body;
  ModalModel modes;
  explicit Plate(double nodes);
  FlexibleDrawing drawing() const { return {body, modes, Eigen::Vector2d(0.5, 0.05)}; }
};

/// 1 m × 0.1 m, ten times as many cells along as across.
Scene scene_of(double nodes) {
  // A cell of the grid is two triangles and adds four nodes.
  const int across = std::max(1, static_cast<int>(std::lround(std::sqrt(nodes / 40))));
  return read_scene_text(
      "bodies:\n  plate:\n    plate: {thickness: 10 mm, young: 200 GPa, poisson: 0.3, "
      "density: 7800, element: triangle6, grid: {corners: [[0, 0], [1, 0], [1, 0.1], [0, 0.1]], "
      "cells: [" +
          std::to_string(10 * across) + ", " + std::to_string(across) + "]}}\n",
      "frames.yaml");
}

Plate::Plate(double nodes) : scene(scene_of(nodes)), body(elastic_body(scene, scene.bodies[0])) {
  modes.shapes.resize(body.model.N(), shapes);
  for (int i = 0; i < body.mesh.x.cols(); ++i)  // transverse waves, with the rotation of the sections
    for (int k = 0; k < shapes; ++k) {
      const double wave = (k + 1) * std::numbers::pi, x = body.mesh.x(0, i), y = body.mesh.x(1, i);
      modes.shapes(2 * i, k) = -(y - 0.05) * wave * std::cos(wave * x);
      modes.shapes(2 * i + 1, k) = std::sin(wave * x);
    }
}

FlexiblePose pose_at(int frame) {
  FlexiblePose pose{{0.1, 0.2}, {3, -4}, 0.02 * frame, 150, Eigen::VectorXd(shapes), Eigen::VectorXd(shapes)};
  for (int k = 0; k < shapes; ++k) {
    pose.eta[k] = 1e-4 * std::sin(0.1 * (k + 1) * frame) / (k + 1);
    pose.speed[k] = 1e-2 * std::cos(0.1 * (k + 1) * frame);
  }
  return pose;
}

void fields(benchmark::State& state) {
  const Plate plate(static_cast<double>(state.range(0)));
  const FlexibleDrawing drawing = plate.drawing();
  int frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(drawing.at(pose_at(frame++), 20));
  state.counters["nodes"] = static_cast<double>(plate.body.mesh.x.cols());
}
BENCHMARK(fields)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

void frames(benchmark::State& state) {
  const Plate plate(static_cast<double>(state.range(0)));
  const FlexibleDrawing flexible = plate.drawing();
  const fs::path folder = fs::temp_directory_path() / ("pintle_bench_frames_" + std::to_string(getpid()));
  FrameWriter writer(folder);
  int frame = 0;
  std::uintmax_t bytes = 0;
  for (auto _ : state) {
    Drawing drawing;
    drawing.bodies.push_back(flexible.at(pose_at(frame++), 20));
    writer.add(drawing);
    state.PauseTiming();
    for (const auto& file : fs::directory_iterator(folder / "frames")) {
      if (file.path().filename().string().starts_with("plate")) bytes = file.file_size();
      fs::remove(file.path());
    }
    state.ResumeTiming();
  }
  fs::remove_all(folder);
  state.counters["nodes"] = static_cast<double>(plate.body.mesh.x.cols());
  state.counters["MB"] = 1e-6 * static_cast<double>(bytes);
}
BENCHMARK(frames)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

void make_ready(benchmark::State& state) {
  const Plate plate(static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(plate.drawing());
}
BENCHMARK(make_ready)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
