#include "framework/dynamics/schur.h"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace pintle {

struct Schur::Sparse {
  cholmod_common common;
  cholmod_sparse matrix{};
  std::vector<int> column_begin, row;
  cholmod_factor* factor = nullptr;
  cholmod_dense* x = nullptr;
  cholmod_dense *y = nullptr, *e = nullptr;

  Sparse() {
    cholmod_start(&common);
    common.print = 0;
  }
  ~Sparse() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_finish(&common);
  }
};

Schur::~Schur() = default;
Schur::Schur(Schur&&) noexcept = default;

Schur::Schur(const System& system) : n_(system.n_rows()) {
  // Sides of joints on each body.
  std::vector<std::vector<int>> sides(system.bodies.size());
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const std::array<int, 2> at{marker_a(system.joints[k]), marker_b(system.joints[k])};
    for (int side = 0; side < 2; ++side) {
      const int body = system.markers[static_cast<std::size_t>(at[static_cast<std::size_t>(side)])].body;
      if (body != ground)
        sides[static_cast<std::size_t>(body)].push_back(2 * static_cast<int>(k) + side);
    }
  }
  const auto first_row = [&](int side) { return system.row_begin[static_cast<std::size_t>(side / 2)]; };
  const auto height = [&](int side) { return rows(system.joints[static_cast<std::size_t>(side / 2)]); };

  std::vector<std::pair<int, int>> entries;  // (column, row) of each summand
  for (std::size_t b = 0; b < sides.size(); ++b) {
    const Body& body = system.bodies[b];
    for (std::size_t p = 0; p < sides[b].size(); ++p)
      for (std::size_t q = 0; q <= p; ++q) {
        const int i = sides[b][p], j = sides[b][q];
        const Eigen::Vector3d w = body.modes() > 0 ? Eigen::Vector3d(1, 1, 1) : Eigen::Vector3d(1 / body.m, 1 / body.m, 1 / body.J);
        pairs_.push_back({i, j, height(i), height(j), w, body.modes() > 0, i == j});
        for (int r = 0; r < height(i); ++r)
          for (int c = 0; c < (i == j ? r + 1 : height(j)); ++c)
            entries.emplace_back(first_row(j) + c, first_row(i) + r);
      }
  }

  where_.reserve(entries.size());
  diagonal_.resize(static_cast<std::size_t>(n_));
  if (n_ <= dense_rows) {
    values_.resize(static_cast<std::size_t>(n_ * n_));
    for (const auto& [column, row] : entries) where_.push_back(row * n_ + column);
    return;
  }

  std::map<std::pair<int, int>, int> index;
  for (int k = 0; k < n_; ++k) index[{k, k}] = 0;
  for (const auto& at : entries) index[at] = 0;
  sparse_ = std::make_unique<Sparse>();
  sparse_->column_begin.assign(static_cast<std::size_t>(n_) + 1, 0);
  int count = 0;
  for (auto& [at, k] : index) {
    k = count++;
    sparse_->row.push_back(at.second);
    ++sparse_->column_begin[static_cast<std::size_t>(at.first) + 1];
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(n_); ++c)
    sparse_->column_begin[c + 1] += sparse_->column_begin[c];
  for (const auto& at : entries) where_.push_back(index[at]);
  values_.resize(static_cast<std::size_t>(count));

  cholmod_sparse& A = sparse_->matrix;
  A.nrow = A.ncol = static_cast<std::size_t>(n_);
  A.nzmax = static_cast<std::size_t>(count);
  A.p = sparse_->column_begin.data();
  A.i = sparse_->row.data();
  A.x = values_.data();
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  sparse_->factor = cholmod_analyze(&A, &sparse_->common);
}

bool Schur::factor(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta) {
  std::fill(values_.begin(), values_.end(), 0.0);
  const int* at = where_.data();
  for (const Pair& p : pairs_) {
    const Block& Bi = B[static_cast<std::size_t>(p.i)];
    const Block& Bj = B[static_cast<std::size_t>(p.j)];
    for (int r = 0; r < p.mi; ++r) {
      const double x = Bi(r, 0) * p.w[0], y = Bi(r, 1) * p.w[1], z = Bi(r, 2) * p.w[2];
      const int columns = p.same ? r + 1 : p.mj;
      for (int c = 0; c < columns; ++c) {
        double sum = x * Bj(c, 0) + y * Bj(c, 1) + z * Bj(c, 2);
        if (p.flexible) sum += B_eta[static_cast<std::size_t>(p.i)].row(r).dot(B_eta[static_cast<std::size_t>(p.j)].row(c));
        values_[static_cast<std::size_t>(*at++)] += sum;
      }
    }
  }
  if (!sparse_) return factor_dense();
  cholmod_factorize(&sparse_->matrix, sparse_->factor, &sparse_->common);
  return sparse_->common.status == CHOLMOD_OK &&
         cholmod_rcond(sparse_->factor, &sparse_->common) > 1e-15;
}

// S = L D Lᵀ in place, row by row; a pivot that cancellation has left nothing of means dependent rows.
bool Schur::factor_dense() {
  double* S = values_.data();
  for (int i = 0; i < n_; ++i) {
    double* Si = S + i * n_;
    const double before = Si[i];
    for (int j = 0; j < i; ++j) {
      const double* Sj = S + j * n_;
      double sum = Si[j];
      for (int k = 0; k < j; ++k) sum -= Si[k] * Sj[k];
      Si[j] = sum;  // L_ij D_j for now
    }
    double pivot = before;
    for (int j = 0; j < i; ++j) {
      const double l = Si[j] * diagonal_[static_cast<std::size_t>(j)];
      pivot -= l * Si[j];
      Si[j] = l;
    }
    if (!(pivot > 1e-14 * before)) return false;
    diagonal_[static_cast<std::size_t>(i)] = 1 / pivot;
  }
  return true;
}

void Schur::solve(Eigen::VectorXd& mu) {
  if (sparse_) {
    cholmod_dense b{};
    b.nrow = b.d = b.nzmax = static_cast<std::size_t>(n_);
    b.ncol = 1;
    b.x = mu.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, sparse_->factor, &b, nullptr, &sparse_->x, nullptr, &sparse_->y,
                   &sparse_->e, &sparse_->common);
    std::copy_n(static_cast<const double*>(sparse_->x->x), n_, mu.data());
    return;
  }
  const double* S = values_.data();
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < i; ++j) mu[i] -= S[i * n_ + j] * mu[j];
  for (int i = 0; i < n_; ++i) mu[i] *= diagonal_[static_cast<std::size_t>(i)];
  for (int i = n_ - 1; i >= 0; --i)
    for (int j = i + 1; j < n_; ++j) mu[i] -= S[j * n_ + i] * mu[j];
}

}  // namespace pintle
