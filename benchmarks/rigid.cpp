// The rigid slider-crank against a hand-written minimal-coordinate model of the same mechanism
// (tests/oracles), both in this process, turn about: `ratio` is the median of ours over the median of its.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "framework/run/simulate.h"
#include "tests/oracles/slider_crank_clearance.h"

namespace {

using namespace pintle;
using Clock = std::chrono::steady_clock;

SceneBody bar(const char* name, double length, double mass, double inertia, const char* a, const char* b) {
  SceneBody body;
  body.name = name;
  body.mass = mass;
  body.inertia = inertia;
  ScenePoint p, q;
  p.name = a, p.at = {-length / 2, 0};
  q.name = b, q.at = {length / 2, 0};
  body.points = {p, q};
  return body;
}

SceneJoint joint(const char* name, JointKind kind, PointRef a, PointRef b) {
  SceneJoint j;
  j.name = name, j.kind = kind, j.a = std::move(a), j.b = std::move(b);
  return j;
}

/// The paper's mechanism, crank at 150 rad/s, e = 0.8, no friction; clearance 0: ideal.
Scene slider_crank(double clearance, double until, double tolerance, const char* method) {
  Scene s;
  s.gravity = {0, -9.81};
  SceneBody slider;
  slider.name = "slider", slider.mass = 0.14, slider.inertia = 1e-4;
  s.bodies = {bar("crank", 0.05, 0.3, 1e-4, "O", "A"), bar("coupler", 0.12, 0.21, 2.5e-4, "A", "B"), slider};
  s.joints = {joint("bearing", JointKind::revolute, {"ground", "", {}}, {"crank", "O", {}}),
              joint("pin", JointKind::revolute, {"crank", "A", {}}, {"coupler", "A", {}}),
              joint("gudgeon", JointKind::revolute, {"coupler", "B", {}}, {"slider", "", {}}),
              joint("guide", JointKind::prismatic, {"ground", "", {}}, {"slider", "", {}})};
  if (clearance > 0) {
    SceneClearance c;
    c.radial = clearance, c.bearing_radius = 0.01, c.bearing = "slider";
    c.normal.restitution = 0.8;
    c.normal.bearing = {207e9, 0.3};
    s.joints[2].clearance = c;
  }
  StartBody start;
  start.body = "crank", start.angle = 0, start.speed = 150;
  s.start_bodies = {start};
  s.run.until = until, s.run.tolerance = tolerance, s.run.method = method;
  s.output.every = until;
  return s;
}

pintle_oracle::Params oracle_case(double clearance) {
  pintle_oracle::Params p;
  p.clearance = clearance;
  p.stiffness = pintle_oracle::hertz_stiffness(p.bearing_radius - clearance, p.bearing_radius, 207e9, 0.3, true);
  p.chi = pintle_oracle::lankarani_nikravesh(0.8);
  return p;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

template <class F>
double seconds(F f) {
  const auto begin = Clock::now();
  f();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Building the terms and solving for a and λ, against the oracle's right-hand side; journal at rest
/// in the gap.
void Acceleration(benchmark::State& bench) {
  const Scene scene = slider_crank(1e-5, 1, 1e-8, "dopri5");
  const Model model = build(scene);
  State state = assemble(scene, model).start;
  Equations eq(model.system);
  Eigen::VectorXd dy(model.system.n_y());
  const pintle_oracle::Params params = oracle_case(1e-5);
  pintle_oracle::State theirs = pintle_oracle::start(params);
  pintle_oracle::Y their_dy{};
  constexpr int batch = 2000;
  std::vector<double> our_time, their_time;
  for (auto _ : bench) {
    our_time.push_back(seconds([&] {
      for (int i = 0; i < batch; ++i) {
        state.y[2] += 1e-9;
        evaluate(model.system, state, eq, dy);
        benchmark::DoNotOptimize(dy.data());
      }
    }));
    their_time.push_back(seconds([&] {
      for (int i = 0; i < batch; ++i) {
        theirs.y[0] += 1e-9;
        pintle_oracle::rhs(params, theirs, their_dy);
        benchmark::DoNotOptimize(their_dy.data());
      }
    }));
    bench.SetIterationTime(our_time.back() / batch);
  }
  bench.counters["ratio"] = median(our_time) / median(their_time);
}
BENCHMARK(Acceleration)->UseManualTime()->Iterations(300);

/// The paper's 0.01 mm case for one second, the same scheme and tolerance on both sides.
void ClearanceRun(benchmark::State& bench, const char* method) {
  const double tolerance = std::pow(10.0, -static_cast<double>(bench.range(0)));
  const Scene scene = slider_crank(1e-5, 1, tolerance, method);
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  const pintle_oracle::Params params = oracle_case(1e-5);
  pintle_oracle::Options options;
  options.tolerance = tolerance;
  options.method = std::string(method) == "rkf45" ? pintle_oracle::Method::rkf45 : pintle_oracle::Method::dopri54;
  Run run;
  pintle_oracle::State end;
  pintle_oracle::Stats stats;
  std::vector<double> our_time, their_time;
  for (auto _ : bench) {
    our_time.push_back(seconds([&] { run = simulate(scene, model, assembly); }));
    their_time.push_back(seconds([&] {
      end = pintle_oracle::start(params);
      stats = pintle_oracle::simulate(params, options, 1, end);
    }));
    bench.SetIterationTime(our_time.back());
  }
  bench.counters["ratio"] = median(our_time) / median(their_time);
  bench.counters["our_evaluations"] = static_cast<double>(run.counts.evaluations);
  bench.counters["their_evaluations"] = static_cast<double>(stats.evaluations);
  bench.counters["our_loss_J"] = run.last.lost;
  bench.counters["their_loss_J"] = end.y[6];
  bench.counters["our_unexplained_J"] = run.unexplained;
}
BENCHMARK_CAPTURE(ClearanceRun, dopri5, "dopri5")->Arg(8)->Arg(10)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ClearanceRun, rkf45, "rkf45")->Arg(8)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
