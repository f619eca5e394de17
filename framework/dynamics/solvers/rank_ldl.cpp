#include "framework/dynamics/solvers/rank_ldl.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pintle {

using Eigen::Index;

bool RankLdl::factor(int n, const double* S, double least) {
  n_ = n;
  if (L_.rows() < n) L_.resize(n, n), root_.resize(n), x_.resize(n), order_.resize(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) root_[i] = 1 / std::sqrt(S[i * n + i]);
  if (!root_.head(n).allFinite()) return false;
  std::iota(order_.begin(), order_.begin() + n, 0);
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) L_(i, j) = L_(j, i) = S[i * n + j] * root_[i] * root_[j];
  if (!L_.topLeftCorner(n, n).allFinite()) return false;
  rank_ = 0, kept_ = 1;
  for (Index k = 0; k < n; ++k) {
    Index largest = k;
    for (Index i = k + 1; i < n; ++i)
      if (L_(i, i) > L_(largest, largest)) largest = i;
    if (!(L_(largest, largest) > least)) break;
    if (largest != k) {  // both triangles are kept filled, so that whole rows and columns can be swapped
      std::swap(order_[static_cast<std::size_t>(k)], order_[static_cast<std::size_t>(largest)]);
      L_.row(k).head(n).swap(L_.row(largest).head(n));
      L_.col(k).head(n).swap(L_.col(largest).head(n));
    }
    kept_ = L_(k, k);
    ++rank_;
    const Index rest = n - k - 1;
    L_.row(k).segment(k + 1, rest) = L_.col(k).segment(k + 1, rest).transpose() / kept_;  // a row of Lᵀ
    L_.block(k + 1, k + 1, rest, rest).noalias() -= L_.col(k).segment(k + 1, rest) * L_.row(k).segment(k + 1, rest);
  }
  for (Index k = 0; k < rank_; ++k) L_.col(k).segment(k + 1, n - k - 1) = L_.row(k).segment(k + 1, n - k - 1).transpose();
  return true;
}

void RankLdl::substitute_back() {
  for (Index k = rank_ - 1; k >= 0; --k) x_[k] -= L_.col(k).segment(k + 1, rank_ - k - 1).dot(x_.segment(k + 1, rank_ - k - 1));
}

void RankLdl::solve(const int* rows, double* x) {
  for (Index k = 0; k < rank_; ++k) {
    const int i = order_[static_cast<std::size_t>(k)];
    x_[k] = root_[i] * x[rows[i]];
  }
  for (Index k = 0; k < rank_; ++k) x_.segment(k + 1, rank_ - k - 1) -= x_[k] * L_.col(k).segment(k + 1, rank_ - k - 1);
  x_.head(rank_).array() /= L_.diagonal().head(rank_).array();
  substitute_back();
  for (Index k = 0; k < n_; ++k) {
    const int i = order_[static_cast<std::size_t>(k)];
    x[rows[i]] = k < rank_ ? root_[i] * x_[k] : 0;
  }
}

void RankLdl::null_vector(int i, const int* rows, double* out) {
  x_.head(rank_) = -L_.row(rank_ + i).head(rank_).transpose();
  substitute_back();
  for (Index k = 0; k < n_; ++k) {
    const int row = order_[static_cast<std::size_t>(k)];
    out[rows[row]] = k < rank_ ? root_[row] * x_[k] : k == rank_ + i ? root_[row] : 0;
  }
}

}  // namespace pintle
