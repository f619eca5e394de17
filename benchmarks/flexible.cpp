// The slider-crank of the paper with a coupler that bends: one second at 150 rad/s with ideal
// joints, 0.05 s with a clearance of 0.01 mm at the gudgeon pin. The coupler is a beam of 20 elements with a given number of shapes, or a
// bar meshed with a given number of dofs and 8 shapes.
//   run        until the end; `steps`, `evaluations` and the highest frequency [Hz], which sets the
//              steps of explicit integration; `build_s`: meshing, modes and assembly, once
//   evaluate   one evaluation of the equations of motion
//   bench_flexible --benchmark_repetitions=3
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"

namespace {

using namespace pintle;

std::string beam(long shapes) {
  const std::string points = "    points: {A: [0, 0], B: [120 mm, 0]}\n";
  if (shapes == 0) return "    rigid: {mass: 0.21, inertia: 2.5e-4, center: [60 mm, 0]}\n" + points;
  return "    beam: {from: A, to: B, section: {circle: 10 mm}, elements: 20, theory: euler,\n"
         "           rotary inertia: false, young: 207 GPa, poisson: 0.3, mass: 0.21 kg}\n" +
         points + "    modes: {frame: chord, count: " + std::to_string(shapes) + "}\n";
}

/// 120 mm × 10 mm of quadrilaterals, twelve times as many along as across; 150, 10 122 and 99 970
/// dofs. Held at the middles of its ends.
std::string bar(long dofs) {
  const long across = 2 * std::max(1L, std::lround(std::sqrt(static_cast<double>(dofs) / 24) / 2));
  return "    plate: {thickness: 7.9 mm, young: 207 GPa, poisson: 0.3, mass: 0.21 kg, element: "
         "quadrilateral4,\n"
         "            grid: {corners: [[0, -5 mm], [120 mm, -5 mm], [120 mm, 5 mm], [0, 5 mm]],\n"
         "                   cells: [" +
         std::to_string(12 * across) + ", " + std::to_string(across) +
         "]}}\n"
         "    points: {A: [0, 0], B: [120 mm, 0]}\n    modes: {frame: chord, count: 8}\n";
}

const char* clearance_keys =
    ", clearance: {radial: 0.01 mm, bearing radius: 10 mm, bearing: slider,\n"
    "             normal: {lankarani-nikravesh: {restitution: 0.9, young: 207 GPa, poisson: 0.3}}}";

Scene slider_crank(const std::string& coupler, bool clearance) {
  return read_scene_text(
      "gravity: [0, -9.81]\nbodies:\n"
      "  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [-25 mm, 0], A: [25 mm, 0]}}\n"
      "  coupler:\n" +
          coupler +
          "  slider: {rigid: {mass: 0.14, inertia: 1e-4}, points: {P: [0, 0]}}\n"
          "joints:\n"
          "  bearing: {revolute: [ground, crank.O]}\n"
          "  crank pin: {revolute: [crank.A, coupler.A]}\n"
          "  gudgeon pin: {revolute: [coupler.B, slider.P]" +
          (clearance ? clearance_keys : "") +
          "}\n"
          "  guide: {prismatic: [ground, slider.P]}\n"
          "start: {crank: {angle: 0, speed: 150}}\n"
          "run: {until: " +
          (clearance ? "0.05" : "1") + "}\noutput: {every: 1 ms}\n",
      "flexible.yaml");
}

/// Built once for all runs and repetitions.
struct Mechanism {
  explicit Mechanism(const Scene& s) : scene(s) {
    const auto begin = std::chrono::steady_clock::now();
    model = build(scene);
    assembly = assemble(scene, model);
    build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  Scene scene;
  Model model;
  Assembly assembly;
  double build_seconds = 0;
};
using Coupler = std::string (*)(long);
const Mechanism& mechanism(Coupler coupler, long size, bool clearance) {
  static std::map<std::string, Mechanism> built;
  const std::string text = coupler(size);
  return built.try_emplace(text + (clearance ? "+" : ""), slider_crank(text, clearance)).first->second;
}

void describe(benchmark::State& bench, const Mechanism& m) {
  const std::optional<FlexInertia>& flex = m.model.system.bodies[1].flex;
  bench.counters["highest_Hz"] = flex ? flex->omega.maxCoeff() / (2 * std::numbers::pi) : 0;
  bench.counters["build_s"] = m.build_seconds;
}

void run(benchmark::State& bench, Coupler coupler, bool clearance) {
  const Mechanism& m = mechanism(coupler, bench.range(0), clearance);
  Run run;
  for (auto _ : bench) run = simulate(m.scene, m.model, m.assembly);
  if (run.status != Status::finished) bench.SkipWithError(run.reason.c_str());
  describe(bench, m);
  bench.counters["steps"] = static_cast<double>(run.counts.steps);
  bench.counters["evaluations"] = static_cast<double>(run.counts.evaluations);
  bench.counters["unexplained_J"] = run.unexplained;
}

void evaluate(benchmark::State& bench, Coupler coupler, bool clearance) {
  const Mechanism& m = mechanism(coupler, bench.range(0), clearance);
  State state = m.assembly.start;
  Equations eq(m.model.system);
  Eigen::VectorXd dy(m.model.system.n_y());
  for (auto _ : bench) {
    state.y[2] += 1e-9;
    pintle::evaluate(m.model.system, state, eq, dy);
    benchmark::DoNotOptimize(dy.data());
  }
  describe(bench, m);
}

void shapes(benchmark::internal::Benchmark* b) {
  for (const long n : {0, 1, 2, 4, 8, 16}) b->Arg(n);
}
void dofs(benchmark::internal::Benchmark* b) {
  for (const long n : {100, 10000, 100000}) b->Arg(n);
}
BENCHMARK_CAPTURE(evaluate, beam, beam, false)->Apply(shapes);
BENCHMARK_CAPTURE(evaluate, bar, bar, false)->Apply(dofs);
BENCHMARK_CAPTURE(run, beam_ideal, beam, false)->Apply(shapes)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, beam_clearance, beam, true)->Apply(shapes)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, bar_ideal, bar, false)->Apply(dofs)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, bar_clearance, bar, true)->Apply(dofs)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
