// The rigid slider-crank against a hand-written minimal-coordinate model of the same mechanism
// (tests/oracles), both run alternately in this process: `ratio` is the median of our times over the median of its.
//   Acceleration    one evaluation
//   ClearanceRun    a second at the same scheme and tolerance
//   EqualError      a second at the tolerances at which both leave the same error in the crank's angle at the end
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/integration/integrator.h"
#include "tests/oracles/runge_kutta.h"
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
/// Error against the run of tightest tolerance, and time, of runs at tolerances a decade apart.
struct WorkPrecision {
  static constexpr int first = 4, last = 10, tightest = 12;
  template <class Solve>  // angle at the end, from an exponent of the tolerance
  explicit WorkPrecision(Solve solve) {
    const double truth = solve(tightest);
    for (int exponent = first; exponent <= last; ++exponent) {
      std::vector<double> time;
      double angle = 0;
      for (int repeat = 0; repeat < 3; ++repeat) time.push_back(seconds([&] { angle = solve(exponent); }));
      const double error = std::abs(angle - truth);
      while (!points.empty() && points.back().error <= error) points.pop_back();  // its small error was chance
      points.push_back({error, median(time)});
    }
  }
  /// Time for an error, interpolated linearly in the logarithms between the two runs that enclose it. NaN outside.
  double time(double error) const {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto &a = points[i - 1], &b = points[i];
      if (error > a.error || error < b.error) continue;
      return a.time * std::pow(b.time / a.time, std::log(error / a.error) / std::log(b.error / a.error));
    }
    return std::nan("");
  }
  struct Point {
    double error, time;
  };
  std::vector<Point> points;
};

pintle_oracle::Vec<2> minimal(const pintle_oracle::Params& p, double tolerance) {
  const auto f = [&](const pintle_oracle::Vec<2>& y, pintle_oracle::Vec<2>& dy) {
    dy = {y[1], pintle_oracle::evaluate_ideal(p, y[0], y[1]).acceleration};
  };
  return pintle_oracle::integrate_tightly<2>(f, {p.start_angle, p.speed}, 1, tolerance, {1.0, p.speed});
}

void EqualError(benchmark::State& bench, double clearance, const char* method) {
  const Model model = build(slider_crank(clearance, 1, 1e-8, method));
  const Assembly assembly = assemble(slider_crank(clearance, 1, 1e-8, method), model);
  pintle_oracle::Params params = oracle_case(clearance > 0 ? clearance : 1e-5);
  for (auto _ : bench) {
    const WorkPrecision ours([&](int exponent) {
      const Scheme scheme{.tableau = find_tableau(method), .tolerance = std::pow(10.0, -exponent)};
      Integrator run(model.system, scheme, assembly.start);
      while (run.state().t < 1)
        if (!run.advance(1)) return std::nan("");
      return run.state().y[2];
    });
    const WorkPrecision theirs([&](int exponent) {
      const double tolerance = std::pow(10.0, -exponent);
      if (clearance == 0) return minimal(params, tolerance)[0];
      pintle_oracle::Options options;
      options.tolerance = tolerance;
      pintle_oracle::State end = pintle_oracle::start(params);
      pintle_oracle::simulate(params, options, 1, end);
      return end.y[0];
    });
    for (const int exponent : {5, 6, 7, 8}) {
      const double error = std::pow(10.0, -exponent);
      const std::string at = "_1e-" + std::to_string(exponent);
      bench.counters["ratio" + at] = ours.time(error) / theirs.time(error);
      bench.counters["our_ms" + at] = 1e3 * ours.time(error);
    }
  }
}
BENCHMARK_CAPTURE(EqualError, ideal_dopri5, 0, "dopri5")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EqualError, ideal_verner87, 0, "verner87")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EqualError, clearance_dopri5, 1e-5, "dopri5")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EqualError, clearance_verner87, 1e-5, "verner87")->Iterations(1)->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(ClearanceRun, rkf45, "rkf45")->Arg(8)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
