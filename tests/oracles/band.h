#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <utility>
#include <vector>

namespace pintle_oracle {

/// LU with row exchanges of an n × n matrix with `width` diagonals on either side of the main one.
/// Entry (i, j) stands at (2 width + i − j, j) of `entry`; the first `width` rows are for fill.
/// A singular matrix gives a solution that is not finite.
struct Band {
  int n, width;
  Eigen::MatrixXd entry;
  std::vector<int> pivot = {};

  Band(int size, int diagonals) : n(size), width(std::min(diagonals, size - 1)), entry(Eigen::MatrixXd::Zero(3 * width + 1, size)) {}
  double& operator()(int i, int j) { return entry(2 * width + i - j, j); }

  void factor() {
    pivot.assign(static_cast<std::size_t>(n), 0);
    for (int k = 0; k < n; ++k) {
      const int below = std::min(width, n - 1 - k), right = std::min(2 * width, n - 1 - k);
      Eigen::Index at = 0;
      entry.col(k).segment(2 * width, below + 1).cwiseAbs().maxCoeff(&at);
      const int p = k + static_cast<int>(at);
      pivot[static_cast<std::size_t>(k)] = p;
      for (int j = k; j <= k + right && p != k; ++j) std::swap((*this)(k, j), (*this)(p, j));
      auto multiplier = entry.col(k).segment(2 * width + 1, below);
      multiplier /= (*this)(k, k);
      for (int j = k + 1; j <= k + right; ++j) entry.col(j).segment(2 * width + k + 1 - j, below) -= (*this)(k, j) * multiplier;
    }
  }

  /// After `factor`.
  Eigen::VectorXd solve(Eigen::VectorXd b) const {
    for (int k = 0; k < n; ++k) {
      const int below = std::min(width, n - 1 - k);
      std::swap(b[k], b[pivot[static_cast<std::size_t>(k)]]);
      b.segment(k + 1, below) -= b[k] * entry.col(k).segment(2 * width + 1, below);
    }
    for (int k = n - 1; k >= 0; --k) {
      const int above = std::min(2 * width, k);
      b[k] /= entry(2 * width, k);
      b.segment(k - above, above) -= b[k] * entry.col(k).segment(2 * width - above, above);
    }
    return b;
  }
};

}  // namespace pintle_oracle
