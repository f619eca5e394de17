#include "framework/study/nonlinear/differences.h"

#include <limits>

namespace pintle {

namespace {

using Eigen::MatrixXd;

constexpr double noise_part = 0.1, curvature_part = 0.01;
constexpr double safety = 3;  // noise is random: a change shows it smaller than it is in about a quarter of all cases, a third of it rarely

}  // namespace

BoundedDerivative best_of_distances(const std::vector<MatrixXd>& all, double floor) {
  const std::size_t n = all.size();
  if (n == 1) return {all[0], MatrixXd::Constant(all[0].rows(), all[0].cols(), std::numeric_limits<double>::quiet_NaN())};
  std::vector<MatrixXd> errors(n, MatrixXd::Constant(all[0].rows(), all[0].cols(), floor));
  // The noise at the shortest distance is the whole first change; at each longer one it is a tenth of that before, or of a greater change.
  MatrixXd noise = (all[1] - all[0]).cwiseAbs(), noise_before = noise;
  errors[0] += safety * noise;
  for (std::size_t k = 1; k < n; ++k) {
    noise_before = noise;
    noise = noise_part * noise.cwiseMax((all[k] - all[k - 1]).cwiseAbs());
    errors[k] += safety * noise;
  }
  // The curvature error at the longest distance is the whole last change, plus the noise that may hide part of it.
  MatrixXd curvature = (all[n - 1] - all[n - 2]).cwiseAbs() + noise_before;
  errors[n - 1] += curvature;
  for (std::size_t k = n - 1; k-- > 0;) {
    curvature = curvature_part * curvature.cwiseMax((all[k + 1] - all[k]).cwiseAbs());
    errors[k] += curvature;
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (errors[k].norm() < errors[best].norm()) best = k;
  return {all[best], errors[best]};
}

}  // namespace pintle
