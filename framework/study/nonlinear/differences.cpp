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
  std::vector<MatrixXd> noise(n), curvature(n);
  // The noise at the shortest distance is the whole first change; at each longer one it is a tenth of that before, or of a greater change.
  noise[0] = (all[1] - all[0]).cwiseAbs();
  for (std::size_t k = 1; k < n; ++k) noise[k] = noise_part * noise[k - 1].cwiseMax((all[k] - all[k - 1]).cwiseAbs());
  // The curvature error at the longest distance is the whole last change, plus the noise that may hide part of it.
  curvature[n - 1] = (all[n - 1] - all[n - 2]).cwiseAbs() + noise[n - 2];
  for (std::size_t k = n - 1; k-- > 0;) curvature[k] = curvature_part * curvature[k + 1].cwiseMax((all[k + 1] - all[k]).cwiseAbs());
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k)
    if ((noise[k] + curvature[k]).norm() < (noise[best] + curvature[best]).norm()) best = k;
  return {all[best], (safety * noise[best] + curvature[best]).array() + floor};
}

}  // namespace pintle
