#include "framework/configuration/row_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/SparseCore>

#include "framework/common/index.h"
#include "framework/configuration/row_qr.h"

namespace pintle {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

constexpr double weightless = 1e-6;  ///< relative to the largest weight of a dependence

/// diag(row_scale) Cq diag(scale)
Eigen::SparseMatrix<double> scaled_jacobian(const System& system, const Equations& eq) {
  std::vector<Eigen::Triplet<double>> entries;
  visit_jacobian(eq, [&](int row, int column, double value) {
    if (value != 0) entries.emplace_back(row, column, system.row_scale[row] * system.scale[column] * value);
  });
  Eigen::SparseMatrix<double> J(system.n_rows(), system.n());
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

void clean(Weights& w) {
  double largest = 0;
  for (const auto& [row, weight] : w) largest = std::max(largest, std::abs(weight));
  std::erase_if(w, [&](const auto& entry) { return std::abs(entry.second) <= weightless * largest; });
  std::sort(w.begin(), w.end());
}

/// Groups of dependences with common rows.
std::vector<std::vector<std::size_t>> groups(const std::vector<Weights>& all, int rows) {
  std::vector<std::size_t> parent(all.size()), owner(at(rows), all.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t d = 0; d < all.size(); ++d)
    for (const auto& [row, weight] : all[d]) {
      std::size_t& first = owner[at(row)];
      if (first == all.size()) first = d;
      parent[root(d)] = root(first);
    }
  std::vector<std::vector<std::size_t>> out(all.size());
  for (std::size_t d = 0; d < all.size(); ++d) out[root(d)].push_back(d);
  std::erase_if(out, [](const auto& g) { return g.empty(); });
  return out;
}

/// Combines the dependences of a group so that each ends with a row that no other has: the last rows count as redundant.
void to_echelon(const std::vector<std::size_t>& group, std::vector<Weights>& all) {
  std::vector<int> rows;
  for (std::size_t d : group)
    for (const auto& entry : all[d]) rows.push_back(entry.first);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const auto count = static_cast<Index>(group.size()), width = static_cast<Index>(rows.size());
  if (static_cast<double>(count) * static_cast<double>(count) * static_cast<double>(width) > 1e9) return;  // any basis is acceptable
  MatrixXd Z = MatrixXd::Zero(width, count);
  for (Index k = 0; k < count; ++k)
    for (const auto& [row, weight] : all[group[static_cast<std::size_t>(k)]])
      Z(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin(), k) = weight;
  Z.colwise().normalize();
  Index done = 0;
  for (Index r = width - 1; r >= 0 && done < count; --r) {
    Index best = 0;
    if (Z.row(r).tail(count - done).cwiseAbs().maxCoeff(&best) <= weightless) continue;
    Z.col(done).swap(Z.col(done + best));
    Z.col(done) /= Z(r, done);
    for (Index k = 0; k < count; ++k)
      if (k != done) Z.col(k) -= Z(r, k) * Z.col(done);
    ++done;
  }
  for (Index k = 0; k < count; ++k) {
    Weights& w = all[group[static_cast<std::size_t>(k)]];
    w.clear();
    for (Index r = 0; r < width; ++r)
      if (Z(r, k) != 0) w.emplace_back(rows[static_cast<std::size_t>(r)], Z(r, k));
    clean(w);
  }
}

}  // namespace

RowSpace row_space(const System& system, const Equations& eq, double tolerance) {
  RowSpace out;
  if (system.n_rows() == 0) return out;
  Eigen::SparseMatrix<double> A = scaled_jacobian(system, eq).transpose();
  VectorXd length(A.cols());
  for (Index c = 0; c < A.cols(); ++c) {
    length[c] = A.col(c).norm();
    if (length[c] <= 0) length[c] = 1;
    A.col(c) /= length[c];
  }
  std::vector<Weights> idle;
  out.rank = column_rank(A, tolerance, idle);
  for (Weights& w : idle) {
    for (auto& [row, weight] : w) weight /= length[row];
    clean(w);
  }
  std::erase_if(idle,
                [&](const Weights& w) { return w.size() == 1 && std::ranges::find(eq.released, w.front().first) != eq.released.end(); });
  for (const auto& group : groups(idle, system.n_rows())) to_echelon(group, idle);
  for (Weights& w : idle) {
    const double last = w.back().second;
    for (auto& entry : w) entry.second /= last;
    out.dependences.push_back({std::move(w)});
  }
  std::sort(out.dependences.begin(), out.dependences.end(),
            [](const Dependence& a, const Dependence& b) { return a.N.back().first < b.N.back().first; });
  return out;
}

}  // namespace pintle
