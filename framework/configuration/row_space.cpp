#include "framework/configuration/row_space.h"

#include <SuiteSparseQR.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include <Eigen/SparseCore>

#include "framework/common/index.h"
#include "framework/common/suitesparse_memory.h"

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

using Weights = std::vector<std::pair<int, double>>;

/// R of A = Q R with the columns of A in the order `column`, from SPQR.
class QR {
 public:
  QR(const Eigen::SparseMatrix<double>& A, double tolerance) {
    const SuiteSparseMemory memory;
    cholmod_l_start(&common_);
    common_.print = 0;
    cholmod_sparse* matrix = cholmod_l_allocate_sparse(static_cast<std::size_t>(A.rows()), static_cast<std::size_t>(A.cols()),
                                                       static_cast<std::size_t>(A.nonZeros()), 1, 1, 0, CHOLMOD_REAL, &common_);
    if (!matrix) fail();
    auto* begin = static_cast<SuiteSparse_long*>(matrix->p);
    auto* row = static_cast<SuiteSparse_long*>(matrix->i);
    auto* value = static_cast<double*>(matrix->x);
    SuiteSparse_long k = 0;
    for (Index c = 0; c < A.cols(); ++c) {
      begin[c] = k;
      for (Eigen::SparseMatrix<double>::InnerIterator it(A, c); it; ++it, ++k) row[k] = it.row(), value[k] = it.value();
    }
    begin[A.cols()] = k;
    SuiteSparseQR<double>(SPQR_ORDERING_COLAMD, tolerance, 0, matrix, &R_, &order_, &common_);
    cholmod_l_free_sparse(&matrix, &common_);
    columns_ = static_cast<int>(A.cols());
    if (!R_ || memory.lacked()) fail();
  }
  ~QR() { free(); }
  QR(const QR&) = delete;
  QR& operator=(const QR&) = delete;

  /// Rank, and for each dependent column of A the weights with which it and the others cancel.
  int rank(std::vector<Weights>& idle) const {
    const auto* begin = static_cast<const SuiteSparse_long*>(R_->p);
    const auto* row = static_cast<const SuiteSparse_long*>(R_->i);
    const auto* value = static_cast<const double*>(R_->x);
    std::vector<SuiteSparse_long> live;  // column of R with the pivot of each row
    std::vector<double> x;
    for (SuiteSparse_long c = 0; c < columns_; ++c) {
      const auto pivot_row = static_cast<SuiteSparse_long>(live.size());
      bool has_pivot = false;
      for (auto k = begin[c]; k < begin[c + 1]; ++k) has_pivot = has_pivot || (row[k] == pivot_row && value[k] != 0);
      if (has_pivot) {
        live.push_back(c);
        continue;
      }
      x.assign(live.size(), 0.0);
      for (auto k = begin[c]; k < begin[c + 1]; ++k) x[static_cast<std::size_t>(row[k])] = value[k];
      Weights weights{{original(c), 1.0}};
      for (std::size_t r = live.size(); r-- > 0;) {
        if (x[r] == 0) continue;
        const auto pivot = live[r];
        double diagonal = 0;
        for (auto k = begin[pivot]; k < begin[pivot + 1]; ++k)
          if (row[k] == static_cast<SuiteSparse_long>(r)) diagonal = value[k];
        x[r] /= diagonal;
        for (auto k = begin[pivot]; k < begin[pivot + 1]; ++k)
          if (row[k] < static_cast<SuiteSparse_long>(r)) x[static_cast<std::size_t>(row[k])] -= value[k] * x[r];
        weights.emplace_back(original(pivot), -x[r]);
      }
      idle.push_back(std::move(weights));
    }
    return static_cast<int>(live.size());
  }

 private:
  void free() {
    cholmod_l_free_sparse(&R_, &common_);
    cholmod_l_free(static_cast<std::size_t>(columns_), sizeof(SuiteSparse_long), order_, &common_);
    cholmod_l_finish(&common_);
  }
  [[noreturn]] void fail() {
    free();
    throw std::bad_alloc();
  }
  int original(SuiteSparse_long c) const { return static_cast<int>(order_ ? order_[c] : c); }

  cholmod_common common_;
  cholmod_sparse* R_ = nullptr;
  SuiteSparse_long* order_ = nullptr;
  int columns_ = 0;
};

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
  out.rank = QR(A, tolerance).rank(idle);
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
