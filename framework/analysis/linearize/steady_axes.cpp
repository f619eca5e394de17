#include "framework/analysis/linearize/steady_axes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "framework/common/dense.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SmallMotion sizes(const FreeMotion& f, const MotionAt& at) {
  constexpr double differenced = 100;  // derivatives along the motion are less accurate than the terms that they are added to
  const MatrixXd Z = f.X.leftCols(f.m()).cwiseAbs(), Z1 = f.X1.leftCols(f.m()).cwiseAbs() * differenced,
                 Z2 = f.X2.leftCols(f.m()).cwiseAbs() * differenced;
  const MatrixXd M = at.M.cwiseAbs(), D = at.D.cwiseAbs(), K = at.K.cwiseAbs();
  return {Z.transpose() * M * Z, Z.transpose() * (2 * M * Z1 + D * Z), Z.transpose() * (M * Z2 + D * Z1 + K * Z)};
}

namespace {

/// Largest difference of coefficients relative to their size, in coordinates with unit mass matrix; terms slower than the motion's own rate
/// are compared with that rate.
double difference(const SmallMotion& a, const SmallMotion& b, double rate) {
  if (a.M.rows() == 0) return 0;
  const Eigen::LLT<MatrixXd> llt(a.M);
  const auto mass_normalised = [&](const MatrixXd& A) -> MatrixXd {
    const MatrixXd half = llt.matrixL().solve(A);
    return llt.matrixL().solve(half.transpose()).transpose();
  };
  const auto worst = [&](const MatrixXd& from, const MatrixXd& to, double floor) {
    const MatrixXd A = mass_normalised(from), change = (mass_normalised(to) - A).cwiseAbs();
    const VectorXd size = A.diagonal().cwiseAbs().cwiseSqrt();
    const double noise = 1e-9 * A.cwiseAbs().maxCoeff();
    return change.cwiseQuotient(((size * size.transpose()).array() + floor + noise).matrix()).maxCoeff();
  };
  return std::max({worst(a.M, b.M, 0), worst(a.D, b.D, rate), worst(a.K, b.K, rate * rate)});
}

/// The motion a little earlier or later, to fifth order in the time; nothing where it cannot be computed.
class NearBy {
 public:
  NearBy(const System& system, const MotionAt& here, double window) : system_(system), here_(here) {
    jerk_ = snap_ = VectorXd::Zero(system.n());
    const auto before = at(-window / 2), after = at(window / 2);
    if (!before || !after) return;
    snap_ = (after->eq.a - 2 * here.eq.a + before->eq.a) / (window * window / 4);
    jerk_ = (after->eq.a - before->eq.a) / window;
    next_ = at(window);
  }
  const MotionAt* next() const { return next_.get(); }

 private:
  std::unique_ptr<MotionAt> at(double t) const {
    State to = here_.state;
    const Index n = system_.n();
    const VectorXd &a = here_.eq.a, s = here_.state.y.segment(n, n);
    to.t += t;
    to.y.head(n) += t * (s + t / 2 * (a + t / 3 * (jerk_ + t / 4 * snap_)));
    to.y.segment(n, n) += t * (a + t / 2 * (jerk_ + t / 3 * snap_));
    Equations eq(system_);
    if (!to.y.allFinite() || !project(system_, to.t, to.y, eq)) return nullptr;
    auto out = std::make_unique<MotionAt>(system_, to);
    return out->regular ? std::move(out) : nullptr;
  }

  const System& system_;
  const MotionAt& here_;
  VectorXd jerk_, snap_;
  std::unique_ptr<MotionAt> next_;
};

/// Spins present in the mechanism, those of more bodies first; at most four.
std::vector<double> spins(const System& system, const State& state, double rate) {
  std::vector<std::pair<int, double>> found;
  for (Index b = 0; b < static_cast<Index>(system.bodies.size()); ++b) {
    const double w = state.y[system.n() + 3 * b + 2];
    if (std::abs(w) < 1e-6 * rate) continue;
    const auto same = std::ranges::find_if(found, [&](const auto& f) { return std::abs(f.second - w) < 1e-9 * rate; });
    if (same == found.end())
      found.emplace_back(1, w);
    else
      ++same->first;
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<double> out;
  for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 4); ++i) out.push_back(found[i].second);
  return out;
}

}  // namespace

FreeMotion in_steady_axes(const System& system, const MotionAt& here, const std::vector<int>& offsets, Linearization& out) {
  constexpr double reach = 2e-2;   // relative to a scale; the error of the path is then 1e-11 of it
  constexpr double steady = 1e-8;  // a change is of the order of reach, or reach²/2 at an extremum
  FreeMotion world(system, here, {}, offsets);
  const double rate = here.rate(system);
  const SmallMotion now = world.project(here);
  double stiffest = system.gravity.norm() / system.length;
  for (Index i = 0; i < now.M.rows(); ++i) stiffest = std::max(stiffest, std::abs(now.K(i, i) / now.M(i, i)));
  if (rate * rate <= 1e-12 * stiffest) return world;
  out.window = reach / rate;
  const NearBy motion(system, here, out.window);
  const MotionAt* next = motion.next();
  const auto drift_in = [&](const Axes& axes, const FreeMotion& free) {
    if (!next) return 1.0;
    const FreeMotion then(system, *next, {axes.rate, axes.rate * out.window}, offsets, &free.independent);
    return difference(free.project(here), then.project(*next), rate);
  };
  out.drift = drift_in({}, world);
  if (out.drift <= steady) return world;
  for (const double w : spins(system, here.state, rate)) {
    FreeMotion turning(system, here, {w, 0}, offsets);
    const double drift = drift_in({w, 0}, turning);
    if (drift > steady) continue;
    out.coefficients = Coefficients::turning, out.turn = w, out.drift = drift;
    return turning;
  }
  out.coefficients = Coefficients::frozen;
  return world;
}

}  // namespace pintle
