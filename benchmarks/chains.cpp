// Chains, ladders and grids of links of up to 10⁵ bodies: an acceleration, a Newton step of the implicit scheme
// (tangent, factorization, solution) and a solution alone; bytes per body; how the time grows with the bodies.
// At 1000 links, Newton's step alternates with the same step by Eigen's SparseLU on the same matrix: `ratio` is the median of our times
// over the median of those.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include "framework/dynamics/newton/kkt.h"

namespace {

using namespace pintle;
using Eigen::Vector2d;
using Eigen::VectorXd;

struct Mechanism {
  System system;
  State state;  ///< at rest
};

/// Rigid links between nodes in a plane; all links that meet at a node are pinned together.
class Truss {
 public:
  explicit Truss(std::vector<Vector2d> nodes) : nodes_(std::move(nodes)), pinned_(nodes_.size(), -1) {}

  void fix(std::size_t node) {
    pinned_[node] = static_cast<int>(system_.markers.size());
    system_.markers.push_back({ground, nodes_[node], 0, {}, {}, {}});
  }
  void link(std::size_t from, std::size_t to) {
    const Vector2d along = nodes_[to] - nodes_[from];
    const double length = along.norm(), m = 2 * length;
    const int body = static_cast<int>(system_.bodies.size());
    system_.bodies.push_back({"link", m, m * length * length / 12, {0, 0}, {}});
    for (double side : {-0.5, 0.5}) {
      const std::size_t node = side < 0 ? from : to;
      const int marker = static_cast<int>(system_.markers.size());
      system_.markers.push_back({body, {side * length, 0}, 0, {}, {}, {}});
      if (pinned_[node] < 0)
        pinned_[node] = marker;
      else
        system_.joints.emplace_back(Revolute{pinned_[node], marker});
    }
    const Vector2d middle = nodes_[from] + along / 2;
    q_.insert(q_.end(), {middle.x(), middle.y(), std::atan2(along.y(), along.x())});
  }
  Mechanism finish() {
    system_.gravity = {0.1, -9.81};
    system_.joint_names.assign(system_.joints.size(), "pin");
    system_.length = 0.1;
    number(system_);
    Mechanism out{std::move(system_), {}};
    out.state.y.setZero(out.system.n_y());
    out.state.y.head(out.system.n()) = Eigen::Map<const VectorXd>(q_.data(), static_cast<Eigen::Index>(q_.size()));
    return out;
  }

 private:
  std::vector<Vector2d> nodes_;
  std::vector<int> pinned_;  ///< a marker at each node
  std::vector<double> q_;
  System system_;
};

constexpr double size = 0.1;

Mechanism chain(long links) {
  std::vector<Vector2d> nodes(1, {0, 0});
  for (long i = 0; i < links; ++i) {
    const double angle = 1.2 * std::sin(0.7 * static_cast<double>(i));
    nodes.push_back(nodes.back() + size * Vector2d(std::cos(angle), std::sin(angle)));
  }
  Truss truss(nodes);
  truss.fix(0);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) truss.link(i, i + 1);
  return truss.finish();
}

Mechanism ladder(long links) {
  const auto bays = static_cast<std::size_t>(std::max(1L, links / 3));
  std::vector<Vector2d> nodes;
  for (std::size_t i = 0; i <= bays; ++i)
    for (int rail : {0, 1}) {
      const double x = static_cast<double>(i);
      nodes.push_back(size * Vector2d(x, rail + 0.2 * std::sin(0.9 * x)));
    }
  Truss truss(nodes);
  truss.fix(0);
  truss.fix(1);
  for (std::size_t i = 0; i < bays; ++i) {
    truss.link(2 * i, 2 * i + 2);
    truss.link(2 * i + 1, 2 * i + 3);
    truss.link(2 * i + 2, 2 * i + 3);
  }
  return truss.finish();
}

Mechanism grid(long links) {
  const auto side = static_cast<std::size_t>(std::max(2.0, std::round(std::sqrt(static_cast<double>(links) / 2))));
  std::vector<Vector2d> nodes;
  for (std::size_t i = 0; i <= side; ++i)
    for (std::size_t j = 0; j <= side; ++j) {
      const double x = static_cast<double>(j), y = static_cast<double>(i);
      nodes.push_back(size * Vector2d(x + 0.2 * std::sin(0.9 * y), -y + 0.2 * std::sin(0.8 * x)));
    }
  Truss truss(nodes);
  for (std::size_t j = 0; j <= side; ++j) truss.fix(j);  // suspended at its upper edge
  const std::size_t row = side + 1;
  for (std::size_t i = 1; i <= side; ++i)
    for (std::size_t j = 0; j <= side; ++j) {
      truss.link((i - 1) * row + j, i * row + j);
      if (j > 0) truss.link(i * row + j - 1, i * row + j);
    }
  return truss.finish();
}

Mechanism make(const std::string& kind, long links) {
  return kind == "chain" ? chain(links) : kind == "ladder" ? ladder(links) : grid(links);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Processor time of this thread, which other programs on the machine affect little [s].
template <class F>
double seconds(F f) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double begin = now();
  f();
  return now() - begin;
}

double in_use() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Medians by measurement, kind and number of bodies, for the summaries at the end.
std::map<std::string, std::vector<std::pair<double, double>>> measured;

void Acceleration(benchmark::State& bench, const std::string& kind) {
  Mechanism m = make(kind, bench.range(0));
  const double before = in_use();
  Equations eq(m.system);
  const double bytes = in_use() - before;
  VectorXd dy(m.system.n_y());
  std::vector<double> times;
  evaluate(m.system, m.state, eq, dy);
  for (auto _ : bench) {
    m.state.y[2] += 1e-12;
    times.push_back(seconds([&] {
      if (!evaluate(m.system, m.state, eq, dy)) bench.SkipWithError("singular");
    }));
    bench.SetIterationTime(times.back());
  }
  const auto bodies = static_cast<double>(m.system.bodies.size());
  measured["acceleration " + kind].emplace_back(bodies, median(times));
  bench.counters["median_per_body_ns"] = 1e9 * median(times) / bodies;
  bench.counters["bytes_per_body"] = bytes / bodies;
  bench.counters["factor_entries_per_row"] = eq.schur.nonzeros() / m.system.n_rows();
  bench.SetLabel(eq.schur.solver());
}

/// A Newton step of generalised-α at a state, h = 1 ms.
struct Newton {
  explicit Newton(Mechanism made)
      : m(std::move(made)), eq(m.system), tangent(m.system), kkt(m.system, eq, tangent), J(tangent.places().size()) {
    VectorXd dy(m.system.n_y());
    evaluate(m.system, m.state, eq, dy);
    x = eq.f;
    y = eq.C;
  }
  void take_tangent() { tangent.evaluate(m.system, m.state, eq, eq.a, eq.lambda, {1, 2e3, 4e6}, J); }
  void right_hand_side() {
    x = eq.f;
    y.setConstant(1e-6);
  }

  Mechanism m;
  Equations eq;
  Tangent tangent;
  Kkt kkt;
  std::vector<double> J;
  VectorXd x, y;
};

void NewtonStep(benchmark::State& bench, const std::string& kind) {
  Mechanism made = make(kind, bench.range(0));
  Equations alone(made.system);
  const double before = in_use();
  {
    Tangent tangent(made.system);
    Kkt kkt(made.system, alone, tangent);
    bench.counters["bytes_per_body_analysed"] = (in_use() - before) / static_cast<double>(made.system.bodies.size());
  }
  Newton newton(std::move(made));
  std::vector<double> whole, solution;
  newton.take_tangent();
  newton.kkt.factor(newton.m.system, newton.eq, newton.J);  // chooses the pivots, which the scheme keeps
  for (auto _ : bench) {
    newton.right_hand_side();
    whole.push_back(seconds([&] {
      newton.take_tangent();
      if (!newton.kkt.factor(newton.m.system, newton.eq, newton.J)) bench.SkipWithError("singular");
      newton.kkt.solve(newton.x, newton.y);
    }));
    newton.right_hand_side();
    solution.push_back(seconds([&] { newton.kkt.solve(newton.x, newton.y); }));
    bench.SetIterationTime(whole.back());
  }
  const auto bodies = static_cast<double>(newton.m.system.bodies.size());
  measured["Newton step " + kind].emplace_back(bodies, median(whole));
  measured["solution " + kind].emplace_back(bodies, median(solution));
  bench.counters["median_per_body_ns"] = 1e9 * median(whole) / bodies;
  bench.counters["solution_per_body_ns"] = 1e9 * median(solution) / bodies;
  bench.counters["factor_entries_per_unknown"] =
      static_cast<double>(newton.kkt.nonzeros()) / (newton.m.system.n() + newton.m.system.n_rows());
  bench.SetLabel(newton.kkt.solver());
}

/// The same matrix by Eigen's SparseLU: the pattern is analysed once; then values are inserted, factored and solved.
class Theirs {
 public:
  Theirs(const System& system, const Equations& eq, const Tangent& tangent) : n_(system.n()) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Tangent::Place& p : tangent.places()) entries.emplace_back(p.row, p.column, 1);
    visit_jacobian(eq, [&](int row, int column, double) {
      entries.emplace_back(n_ + row, column, 1);
      entries.emplace_back(column, n_ + row, 1);
    });
    K_.resize(n_ + system.n_rows(), n_ + system.n_rows());
    K_.setFromTriplets(entries.begin(), entries.end());
    K_.makeCompressed();
    for (const auto& e : entries) where_.push_back(&K_.coeffRef(e.row(), e.col()));
    lu_.analyzePattern(K_);
    r_.resize(K_.rows());
  }
  void step(const Equations& eq, const std::vector<double>& J, VectorXd& x, VectorXd& y) {
    std::fill(K_.valuePtr(), K_.valuePtr() + K_.nonZeros(), 0.0);
    auto to = where_.begin();
    for (double value : J) **to++ += value;
    visit_jacobian(eq, [&](int, int, double value) {
      **to++ += value;
      **to++ += value;
    });
    lu_.factorize(K_);
    r_ << x, y;
    r_ = lu_.solve(r_).eval();
    x = r_.head(x.size());
    y = r_.tail(y.size());
  }

 private:
  int n_;
  Eigen::SparseMatrix<double> K_;
  std::vector<double*> where_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
  VectorXd r_;
};

void AgainstSparseLu(benchmark::State& bench, const std::string& kind) {
  Newton newton(make(kind, bench.range(0)));
  Theirs theirs(newton.m.system, newton.eq, newton.tangent);
  std::vector<double> our_time, their_time;
  VectorXd x;
  double apart = 0;
  for (auto _ : bench) {
    newton.right_hand_side();
    our_time.push_back(seconds([&] {
      newton.take_tangent();
      newton.kkt.factor(newton.m.system, newton.eq, newton.J);
      newton.kkt.solve(newton.x, newton.y);
    }));
    x = newton.x;
    newton.right_hand_side();
    their_time.push_back(seconds([&] {
      newton.take_tangent();
      theirs.step(newton.eq, newton.J, newton.x, newton.y);
    }));
    apart = std::max(apart, (x - newton.x).norm() / x.norm());
    bench.SetIterationTime(our_time.back());
  }
  bench.counters["ratio"] = median(our_time) / median(their_time);
  bench.counters["apart"] = apart;
}

/// Slope of log time over log bodies, least squares, over the sizes measured above from 100 bodies on.
void Slope(benchmark::State& bench, const std::string& what) {
  for (auto _ : bench) bench.SetIterationTime(0);
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [bodies, time] : measured[what]) {
    if (bodies < 90) continue;
    const double u = std::log(bodies), v = std::log(time);
    ++n, sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  if (n < 2)
    bench.SkipWithError("needs the benchmarks of two sizes in the same run");
  else
    bench.counters["slope"] = (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

const bool registered = [] {
  const auto sizes = [](benchmark::internal::Benchmark* b) {
    for (long n : {10, 100, 1000, 10'000, 100'000}) b->Arg(n);
    b->UseManualTime()->Unit(benchmark::kMicrosecond)->MinTime(0.2);
  };
  const std::vector<std::string> kinds{"chain", "ladder", "grid"};
  for (const std::string& kind : kinds) {
    sizes(benchmark::RegisterBenchmark(("Acceleration/" + kind).c_str(), Acceleration, kind));
    sizes(benchmark::RegisterBenchmark(("NewtonStep/" + kind).c_str(), NewtonStep, kind));
    benchmark::RegisterBenchmark(("AgainstSparseLu/" + kind).c_str(), AgainstSparseLu, kind)
        ->Arg(1000)
        ->UseManualTime()
        ->Iterations(101)
        ->Unit(benchmark::kMicrosecond);
  }
  for (const std::string& kind : kinds)
    for (const char* what : {"acceleration ", "Newton step ", "solution "})
      benchmark::RegisterBenchmark(("Slope/" + (what + kind)).c_str(), Slope, what + kind)->UseManualTime()->Iterations(1);
  return true;
}();

}  // namespace

BENCHMARK_MAIN();
