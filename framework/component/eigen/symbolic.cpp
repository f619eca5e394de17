#include "framework/component/eigen/symbolic.h"

#include <algorithm>
#include <cstddef>

#include "framework/common/index.h"

namespace pintle {

namespace {

using Columns = std::vector<std::vector<int>>;

/// Rows below the diagonal of each column of A in elimination order, unsorted.
Columns below_diagonal(const Eigen::SparseMatrix<double>& A, const int* order) {
  const int n = static_cast<int>(A.rows());
  std::vector<int> position(at(n));
  for (int k = 0; k < n; ++k) position[at(order[k])] = k;
  Columns out(at(n));
  for (int j = 0; j < n; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator a(A, j); a; ++a) {
      const int i = static_cast<int>(a.row());
      if (i > j) out[at(std::min(position[at(i)], position[at(j)]))].push_back(std::max(position[at(i)], position[at(j)]));
    }
  return out;
}

/// The same for L, sorted: a column of L has the rows of that column of A, and those of its children in the elimination tree. A column's
/// parent is its first row below the diagonal.
Columns fill_in(Columns columns) {
  Columns children(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<int>& rows = columns[c];
    for (const int child : children[c]) rows.insert(rows.end(), columns[at(child)].begin() + 1, columns[at(child)].end());
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    if (!rows.empty()) children[at(rows.front())].push_back(static_cast<int>(c));
  }
  return columns;
}

}  // namespace

Symbolic::Symbolic(const Eigen::SparseMatrix<double>& A, const int* order) : n_(static_cast<int>(A.rows())), order_(order) {
  const Columns L = fill_in(below_diagonal(A, order));
  const auto goes_on = [&](int c) {  // the column before has the same pattern, with this column's own row in addition
    const std::vector<int>&before = L[at(c - 1)], &here = L[at(c)];
    return !before.empty() && before.front() == c && before.size() == here.size() + 1;
  };
  row_begin_.push_back(0);
  for (int c = 0, begin = 0; c < n_; ++c) {
    if (c + 1 < n_ && goes_on(c + 1)) continue;
    first_.push_back(begin);
    for (int own = begin; own <= c; ++own) row_.push_back(own);
    row_.insert(row_.end(), L[at(c)].begin(), L[at(c)].end());
    row_begin_.push_back(static_cast<int>(row_.size()));
    begin = c + 1;
  }
  first_.push_back(n_);
}

Supernodes Symbolic::supernodes() const {
  return {n_, static_cast<int>(first_.size()) - 1, first_.data(), row_begin_.data(), row_.data(), order_};
}

}  // namespace pintle
