// The lowest 20 modes of a free plane link (steel, 1 m × 0.1 m × 10 mm, 6-node triangles): our solver with its Sturm check against
// Spectra's shift-invert Lanczos iteration, without a check, on the same kind of factor of the same matrix. Both run alternately in this
// process; ratios are medians of our times over Spectra's, for all work from K and M to pairs. `*Alone` measure peak memory, so run each in
// a process of its own, with a filter.
//   bench_modes --benchmark_filter=Modes/200000
//   bench_modes --benchmark_filter=OursAlone/1000000
#include <Spectra/SymGEigsShiftSolver.h>
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "framework/component/eigen/eigen_lowest.h"
#include "framework/component/eigen/factor.h"
#include "framework/component/fe/assembly.h"
#include "framework/component/fe/from_mesh.h"
#include "meshes/generate.h"

namespace {

using namespace pintle;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Clock = std::chrono::steady_clock;

constexpr int pairs = 20;
// Spectra recommends at least twice the number of pairs for symmetric problems; of 41, 60 and 80, 41 needs the fewest solves.
constexpr int lanczos_vectors = 2 * pairs + 1;
constexpr double tolerance = 1e-9;

/// Elapsed and processor time of all threads [s].
struct Cost {
  double elapsed, cpu;
};
double cpu_now() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}
template <class F>
Cost cost_of(F f) {
  const auto begin = Clock::now();
  const double cpu = cpu_now();
  f();
  return {std::chrono::duration<double>(Clock::now() - begin).count(), cpu_now() - cpu};
}
double median(const std::vector<Cost>& costs, double Cost::*which) {
  std::vector<double> v;
  for (const Cost& c : costs) v.push_back(c.*which);
  std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
  return v[v.size() / 2];
}
/// Peak memory of this process [MiB].
double peak() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  return 0;
}

struct Link {
  Sparse K, M;
  Cost meshing, assembly;
};
/// A mesh with about `dofs` dofs, ten times as long as it is high.
Link link_of(double dofs) {
  Link link;
  const int high = static_cast<int>(std::lround(std::sqrt(dofs / 80)));
  const Eigen::Vector2d corners[] = {{0, -0.05}, {1, -0.05}, {1, 0.05}, {0, 0.05}};
  FeModel model;
  link.meshing = cost_of([&] {
    const Mesh mesh = grid_mesh(corners, 10 * high, high, CellShape::triangle6);
    const PlaneProperties steel{plane_material({Isotropic{207e9, 0.3}, 7850}, PlaneState::stress), 7850, 0.01};
    model = fe_model(mesh.x, plane_blocks(mesh, steel, ""));
  });
  link.assembly = cost_of([&] {
    const Assembler assembler(model);
    link.K = assembler.stiffness();
    link.M = assembler.mass();
  });
  return link;
}

/// A⁻¹ by our factor, for Spectra, which sets the shift when it is constructed.
class Inverse {
 public:
  using Scalar = double;
  explicit Inverse(const Factor& factor, Index n) : factor_(factor), b_(n, 1), x_(n, 1) {}
  Index rows() const { return b_.rows(); }
  Index cols() const { return b_.rows(); }
  void set_shift(double) {}
  void perform_op(const double* in, double* out) const {
    b_ = Eigen::Map<const VectorXd>(in, rows());
    factor_.solve_into(b_, x_);
    Eigen::Map<VectorXd>(out, rows()) = x_;
    ++solves;
  }
  mutable long solves = 0;

 private:
  const Factor& factor_;
  mutable MatrixXd b_, x_;
};
class Mass {
 public:
  using Scalar = double;
  explicit Mass(const Sparse& M) : M_(M) {}
  Index rows() const { return M_.rows(); }
  Index cols() const { return M_.rows(); }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<VectorXd>(out, rows()).noalias() = M_ * Eigen::Map<const VectorXd>(in, rows());
  }

 private:
  const Sparse& M_;
};

struct Found {
  VectorXd lambda;
  MatrixXd shapes;
  long solves;
};
Found by_spectra(const Link& link) {
  const double mu = -1e-10 * link.K.diagonal().sum() / link.M.diagonal().sum();
  Sparse A = link.K;
  A -= mu * link.M;
  Factor factor;
  factor.compute(A);
  Inverse inverse(factor, A.rows());
  Mass mass(link.M);
  Spectra::SymGEigsShiftSolver<Inverse, Mass, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, pairs, lanczos_vectors, mu);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, tolerance, Spectra::SortRule::SmallestAlge);
  return {solver.eigenvalues(), solver.eigenvectors(), inverse.solves};
}
EigenPairs by_us(const Link& link, bool check = true) {
  EigenOptions options;
  options.count = pairs;
  options.tolerance = tolerance;
  options.check = check;
  return eigen_lowest(link.K, link.M, options);
}

/// Largest ‖Kφ − λMφ‖/‖Kφ‖ of the elastic modes.
double worst_residual(const Link& link, const VectorXd& lambda, const MatrixXd& shapes) {
  double worst = 0;
  for (Index j = 3; j < lambda.size(); ++j) {
    const VectorXd force = link.K * shapes.col(j), load = link.M * shapes.col(j);
    worst = std::max(worst, (force - lambda[j] * load).norm() / force.norm());
  }
  return worst;
}

void Modes(benchmark::State& bench) {
  const Link link = link_of(static_cast<double>(bench.range(0)));
  EigenPairs ours;
  Found theirs;
  std::vector<Cost> our_cost, their_cost;
  for (auto _ : bench) {
    our_cost.push_back(cost_of([&] { ours = by_us(link); }));
    their_cost.push_back(cost_of([&] { theirs = by_spectra(link); }));
    bench.SetIterationTime(our_cost.back().elapsed);
  }
  const double elapsed = median(our_cost, &Cost::elapsed), cpu = median(our_cost, &Cost::cpu);
  bench.counters["freedoms"] = static_cast<double>(link.K.rows());
  bench.counters["ratio"] = elapsed / median(their_cost, &Cost::elapsed);
  bench.counters["cpu_ratio"] = cpu / median(their_cost, &Cost::cpu);
  bench.counters["our_cpu_s"] = cpu;
  bench.counters["their_cpu_s"] = median(their_cost, &Cost::cpu);
  bench.counters["our_solves"] = static_cast<double>(ours.solves);
  bench.counters["their_solves"] = static_cast<double>(theirs.solves);
  bench.counters["iterations"] = ours.iterations;
  bench.counters["our_residual"] = worst_residual(link, ours.lambda, ours.shapes);
  bench.counters["their_residual"] = worst_residual(link, theirs.lambda, theirs.shapes);
  bench.counters["difference"] = ((ours.lambda - theirs.lambda).array() / ours.lambda.array()).tail(pairs - 3).abs().maxCoeff();
  bench.counters["assembly_share"] = link.assembly.cpu / (link.assembly.cpu + cpu);
  bench.counters["missed"] = ours.missed + (ours.converged ? 0 : 1000);
}
BENCHMARK(Modes)->Arg(20'000)->UseManualTime()->Iterations(7)->Unit(benchmark::kMillisecond);
BENCHMARK(Modes)->Arg(200'000)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(Modes)->Arg(1'000'000)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

/// The parts of the work: a factorization, a Sturm count, solves by number of columns.
void Parts(benchmark::State& bench) {
  const Link link = link_of(static_cast<double>(bench.range(0)));
  const double scale = link.K.diagonal().sum() / link.M.diagonal().sum();
  const Sparse A = link.K + 1e-10 * scale * link.M, B = link.K - 1e-4 * scale * link.M;
  Factor factor;
  factor.compute(A);
  std::vector<Cost> again, count, one, eight;
  const MatrixXd b = MatrixXd::Random(A.rows(), 8);
  MatrixXd x;
  for (auto _ : bench) {
    again.push_back(cost_of([&] { factor.compute(A); }));
    count.push_back(cost_of([&] { benchmark::DoNotOptimize(negative_eigenvalues(B, factor.supernodes())); }));
    one.push_back(cost_of([&] { factor.solve_into(b.leftCols(1), x); }));
    eight.push_back(cost_of([&] { factor.solve_into(b, x); }));
    bench.SetIterationTime(again.back().elapsed);
  }
  bench.counters["factor_cpu_s"] = median(again, &Cost::cpu);
  bench.counters["count_over_factor"] = median(count, &Cost::cpu) / median(again, &Cost::cpu);
  bench.counters["solve_cpu_s"] = median(one, &Cost::cpu);
  bench.counters["eight_over_one"] = median(eight, &Cost::cpu) / median(one, &Cost::cpu);
  bench.counters["nonzeros"] = factor.nonzeros();
  bench.counters["assembly_cpu_s"] = link.assembly.cpu;
}
BENCHMARK(Parts)->Arg(20'000)->Arg(200'000)->Arg(1'000'000)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);

void OursAlone(benchmark::State& bench) {
  const Link link = link_of(static_cast<double>(bench.range(0)));
  bench.counters["assembled_MiB"] = peak();
  for (auto _ : bench) benchmark::DoNotOptimize(by_us(link).lambda.data());
  bench.counters["peak_MiB"] = peak();
}
BENCHMARK(OursAlone)->Arg(20'000)->Arg(200'000)->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kMillisecond);

void SpectraAlone(benchmark::State& bench) {
  const Link link = link_of(static_cast<double>(bench.range(0)));
  bench.counters["assembled_MiB"] = peak();
  for (auto _ : bench) benchmark::DoNotOptimize(by_spectra(link).lambda.data());
  bench.counters["peak_MiB"] = peak();
}
BENCHMARK(SpectraAlone)->Arg(20'000)->Arg(200'000)->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
