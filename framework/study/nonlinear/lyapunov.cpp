#include "framework/study/nonlinear/lyapunov.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/QR>

#include "framework/common/text.h"
#include "framework/study/nonlinear/follower.h"
#include "framework/study/sweep/sampling.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_running = 200;   // running values kept
constexpr double dependent = 1e-6;  // of the largest: a smaller distance is linearly dependent

/// Gram–Schmidt, D = Q R with a positive diagonal.
void orthonormalise(const MatrixXd& D, MatrixXd& Q, MatrixXd& R) {
  const Index k = D.cols();
  Q = D;
  R.setZero(k, k);
  for (Index j = 0; j < k; ++j) {
    for (int twice = 0; twice < 2; ++twice)
      for (Index i = 0; i < j; ++i) {
        const double part = Q.col(i).dot(Q.col(j));
        R(i, j) += part;
        Q.col(j) -= part * Q.col(i);
      }
    R(j, j) = Q.col(j).norm();
    if (R(j, j) > 0) Q.col(j) /= R(j, j);
  }
}

class Neighbours {
 public:
  Neighbours(const Model& model, Integrator& integrator, const LyapunovRun& run, const std::function<bool()>& go_on)
      : main_(integrator), run_(run), go_on_(go_on), scales_(phase_scales(model.system, run.interval)) {
    const Index n = scales_.size();
    const auto k = static_cast<Index>(run.count);
    if (k > n) too_many(n);
    Q_.resize(n, k);
    for (Index j = 0; j < k; ++j) {
      Stream stream(1, "neighbour " + std::to_string(j));
      for (Index i = 0; i < n; ++i) Q_(i, j) = 2 * stream.uniform() - 1;
      Q_.col(j).normalize();
      apart_.push_back(std::make_unique<Integrator>(model.system, model.scheme, integrator.state()));
    }
  }

  /// Why exponents are in doubt; empty if they are not.
  const std::string& doubt() const { return doubt_; }

  /// Integrates one interval. @returns the logarithm of each growth
  VectorXd grow(double until) {
    const MatrixXd before = set_apart();
    orthonormalise(before, Q_, R_);
    for (Index j = 1; j < R_.cols(); ++j)
      if (!(R_(j, j) > dependent * R_(0, 0))) too_many(j);
    go_to(main_, until, go_on_);
    MatrixXd after(before.rows(), before.cols());
    for (Index j = 0; j < before.cols(); ++j) {
      go_to(*apart_[static_cast<std::size_t>(j)], until, go_on_);
      after.col(j) = distance(*apart_[static_cast<std::size_t>(j)]);
    }
    // The images of unit vectors along the columns of Q.
    const MatrixXd grown = R_.triangularView<Eigen::Upper>().transpose().solve(after.transpose()).transpose();
    orthonormalise(grown, Q_, R_);
    require_distinct(until);
    return R_.diagonal().array().log();
  }

 private:
  [[noreturn]] static void too_many(Index dimensions) {
    throw OrbitTrouble{"failed", "the phase space has " + counted(static_cast<std::size_t>(dimensions), "dimension") +
                                     " here: constraints and closed contacts take the others; ask for at most as many exponents"};
  }

  /// @throws OrbitTrouble  a neighbour is where the motion is
  void require_distinct(double t) {
    constexpr double least = 1000;  // times rounding: three digits of the distance are left
    const double rounding = std::numeric_limits<double>::epsilon() * main_.state().y.head(scales_.size()).cwiseQuotient(scales_).norm();
    for (Index j = 0; j < R_.cols(); ++j) {
      const std::string lost = "t = " + number_text(t, 6) + " s: the neighbour of exponent " + std::to_string(j + 1) +
                               " can no longer be distinguished from the motion";
      const std::string remedy =
          "shorten lyapunov.every" + (j > 0 ? ", or ask for at most " + counted(static_cast<std::size_t>(j), "exponent") : "");
      if (!(R_(j, j) > 0) || !std::isfinite(R_(j, j))) throw OrbitTrouble{"failed", lost + "; " + remedy};
      if (doubt_.empty() && !(R_(j, j) * run_.distance > least * rounding))
        doubt_ = lost + ", so the exponents from this one on are those of rounding; " + remedy;
    }
  }

  VectorXd distance(const Integrator& neighbour) const {
    return (neighbour.state().y - main_.state().y).head(scales_.size()).cwiseQuotient(scales_);
  }

  /// Moves each neighbour beside the motion, on the constraints, with the modes of the motion. @returns the scaled distances
  MatrixXd set_apart() {
    const std::string here = main_.save();
    MatrixXd out(scales_.size(), Q_.cols());
    for (Index j = 0; j < Q_.cols(); ++j) {
      Integrator& one = *apart_[static_cast<std::size_t>(j)];
      one.load(here);
      const VectorXd step = run_.distance * Q_.col(j).cwiseProduct(scales_);
      if (!one.change([&](State& state) { state.y.head(step.size()) += step; })) throw OrbitTrouble{"failed", one.failure()};
      out.col(j) = distance(one);
    }
    return out;
  }

  Integrator& main_;
  const LyapunovRun& run_;
  const std::function<bool()>& go_on_;
  VectorXd scales_;
  MatrixXd Q_, R_;
  std::string doubt_;
  std::vector<std::unique_ptr<Integrator>> apart_;
};

/// Standard error from the scatter of means over batches of intervals, which are nearly independent [1/s].
double scatter_of_batches(const std::vector<VectorXd>& logs, Index j, double interval, double value) {
  const std::size_t n = logs.size(), size = n / exponent_batches;
  double squares = 0;
  for (std::size_t b = 0; b < exponent_batches; ++b) {
    double mean = 0;
    for (std::size_t k = 0; k < size; ++k) mean += logs[n - (b + 1) * size + k][j] / (static_cast<double>(size) * interval);
    squares += (mean - value) * (mean - value);
  }
  return std::sqrt(squares / (exponent_batches * (exponent_batches - 1.0)));
}

/// Error from the ends of the time [1/s]: the range of the logarithm of the distance about its mean growth, over the time. Periodic growth
/// has no other error; batches do not show this one, which falls as 1/time.
double offset_of_ends(const std::vector<VectorXd>& logs, Index j, double interval, double value) {
  double at = 0, least = 0, most = 0;
  for (const VectorXd& one : logs) {
    at += one[j] - value * interval;
    least = std::min(least, at), most = std::max(most, at);
  }
  return (most - least) / (static_cast<double>(logs.size()) * interval);
}

/// Mean of rates, and its error.
Exponent mean_of(const std::vector<VectorXd>& logs, Index j, double interval) {
  const std::size_t n = logs.size();
  Exponent out;
  for (const VectorXd& one : logs) out.value += one[j] / (static_cast<double>(n) * interval);
  out.error = n < exponent_batches
                  ? std::numeric_limits<double>::quiet_NaN()
                  : std::max(scatter_of_batches(logs, j, interval, out.value), offset_of_ends(logs, j, interval, out.value));
  return out;
}

}  // namespace

std::string lyapunov_exponents(const Model& model, Integrator& integrator, const LyapunovRun& run, const std::function<bool()>& go_on,
                               Orbit& out) {
  const double begin = integrator.state().t, from = begin + static_cast<double>(run.transient) * run.interval;
  const long intervals = run.intervals, every = (intervals + most_running - 1) / most_running;
  Neighbours neighbours(model, integrator, run, go_on);
  for (long k = 1; k <= run.transient; ++k) neighbours.grow(begin + static_cast<double>(k) * run.interval);
  std::vector<VectorXd> logs;
  VectorXd sum = VectorXd::Zero(run.count);
  for (long k = 1; k <= intervals; ++k) {
    logs.push_back(neighbours.grow(from + static_cast<double>(k) * run.interval));
    sum += logs.back();
    if (k % every != 0 && k != intervals) continue;
    const VectorXd now = sum / (static_cast<double>(k) * run.interval);
    out.running_t.push_back(static_cast<double>(k) * run.interval);
    out.running.emplace_back(now.data(), now.data() + now.size());
  }
  for (Index j = 0; j < sum.size(); ++j) out.exponents.push_back(mean_of(logs, j, run.interval));
  return neighbours.doubt();
}

}  // namespace pintle
