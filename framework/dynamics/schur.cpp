#include "framework/dynamics/schur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "framework/dynamics/dependent_rows.h"
#include "framework/dynamics/sparse_ldl.h"

namespace pintle {

using Eigen::VectorXd;

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
}  // namespace

struct Schur::Data {
  explicit Data(const VectorXd& row_scale)
      : unit(row_scale), shift(VectorXd::Zero(row_scale.size())), S_ii(shift), refine(row_scale, 0) {}

  VectorXd unit, shift, S_ii;
  std::vector<double> whole;  ///< S without the shift, not factored
  dependent_rows::Refinement refine;
  std::optional<SparseLdl> sparse;
};

Schur::~Schur() = default;
Schur::Schur(Schur&&) noexcept = default;

Schur::Schur(const System& system) : n_(system.n_rows()), data_(std::make_unique<Data>(system.row_scale)) {
  // Sides of joints on each body.
  std::vector<std::vector<int>> sides(system.bodies.size());
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const std::array<int, 2> markers{marker_a(system.joints[k]), marker_b(system.joints[k])};
    for (int side = 0; side < 2; ++side) {
      const int body = system.markers[at(markers[at(side)])].body;
      if (body != ground) sides[at(body)].push_back(2 * static_cast<int>(k) + side);
    }
  }
  const auto first_row = [&](int side) { return system.row_begin[at(side / 2)]; };
  const auto height = [&](int side) { return rows(system.joints[at(side / 2)]); };

  std::vector<Pattern::Place> places;
  for (std::size_t b = 0; b < sides.size(); ++b) {
    const Body& body = system.bodies[b];
    for (std::size_t p = 0; p < sides[b].size(); ++p)
      for (std::size_t q = 0; q <= p; ++q) {
        const int i = sides[b][p], j = sides[b][q];
        const Eigen::Vector3d w = body.modes() > 0 ? Eigen::Vector3d(1, 1, 1) : Eigen::Vector3d(1 / body.m, 1 / body.m, 1 / body.J);
        pairs_.push_back({i, j, height(i), height(j), w, body.modes() > 0, i == j});
        for (int r = 0; r < height(i); ++r)
          for (int c = 0; c < (i == j ? r + 1 : height(j)); ++c) places.push_back({first_row(i) + r, first_row(j) + c});
      }
  }

  if (n_ <= dense_rows) {
    where_.reserve(places.size());
    for (const Pattern::Place& p : places) where_.push_back(p.row * n_ + p.column);
    values_.resize(at(n_ * n_));
    data_->whole = values_;
    diagonal_.resize(at(n_));
    return;
  }
  for (int i = 0; i < n_; ++i) places.push_back({i, i});
  data_->sparse.emplace(n_, places, where_);
  where_.resize(places.size() - at(n_));
  values_.resize(at(data_->sparse->entries()));
}

double Schur::inconsistency() const { return dependent() ? data_->refine.left_over() : 0; }
bool Schur::sparse() const { return data_->sparse.has_value(); }

const char* Schur::solver() const {
  if (n_ == 0) return "none";
  return !sparse() ? "dense" : data_->sparse->thin() ? "sparse (LDL)" : "sparse (CHOLMOD)";
}

double Schur::nonzeros() const { return sparse() ? data_->sparse->nonzeros() : 0.5 * n_ * (n_ + 1); }

void Schur::sum(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta) {
  std::fill(values_.begin(), values_.end(), 0.0);
  const int* to = where_.data();
  for (const Pair& p : pairs_) {
    const Block& Bi = B[at(p.i)];
    const Block& Bj = B[at(p.j)];
    for (int r = 0; r < p.mi; ++r) {
      const double x = Bi(r, 0) * p.w[0], y = Bi(r, 1) * p.w[1], z = Bi(r, 2) * p.w[2];
      const int columns = p.same ? r + 1 : p.mj;
      for (int c = 0; c < columns; ++c) {
        double entry = x * Bj(c, 0) + y * Bj(c, 1) + z * Bj(c, 2);
        if (p.flexible) entry += B_eta[at(p.i)].row(r).dot(B_eta[at(p.j)].row(c));
        values_[at(*to++)] += entry;
      }
    }
  }
}

bool Schur::factor(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta) {
  sum(B, B_eta);
  lost_ = 0;
  if (sparse()) least_ = data_->sparse->factor(values_);
  if (sparse() ? least_ > dependent_rows::lost : factor_dense(dependent_rows::lost)) return true;
  if (!sparse()) sum(B, B_eta);  // the factor took its place
  return factor_shifted();
}

bool Schur::factor_shifted() {
  Data& d = *data_;
  const auto entry = [&](int i) -> double& { return values_[at(d.sparse ? d.sparse->diagonal()[at(i)] : i * n_ + i)]; };
  d.whole = values_;
  for (int i = 0; i < n_; ++i) d.S_ii[i] = entry(i);
  if (!(d.S_ii.array() > 0).all()) return false;
  dependent_rows::shifts(d.S_ii, d.unit, d.shift);
  for (int i = 0; i < n_; ++i) entry(i) += d.shift[i];
  if (!(d.sparse ? d.sparse->factor(values_) > 0 : factor_dense(0))) return false;
  if (d.sparse) {
    lost_ = d.sparse->below(values_, dependent_rows::held_up);
  } else {
    for (int i = 0; i < n_; ++i) lost_ += diagonal_[at(i)] * d.S_ii[i] > 1 / dependent_rows::held_up ? 1 : 0;
  }
  lost_ = std::max(lost_, 1);
  least_ = 0;
  return true;
}

// S = L D Lᵀ in place, row by row. @returns false if cancellation leaves `least` of a pivot, or less
bool Schur::factor_dense(double least) {
  double* S = values_.data();
  least_ = 1;
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
      const double l = Si[j] * diagonal_[at(j)];
      pivot -= l * Si[j];
      Si[j] = l;
    }
    if (pivot < least_ * before) least_ = pivot / before;
    if (!(pivot > least * before)) return false;
    diagonal_[at(i)] = 1 / pivot;
  }
  return true;
}

void Schur::solve_dense(VectorXd& mu) const {
  const double* S = values_.data();
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < i; ++j) mu[i] -= S[i * n_ + j] * mu[j];
  for (int i = 0; i < n_; ++i) mu[i] *= diagonal_[at(i)];
  for (int i = n_ - 1; i >= 0; --i)
    for (int j = i + 1; j < n_; ++j) mu[i] -= S[j * n_ + i] * mu[j];
}

void Schur::solve_factored(VectorXd& mu) {
  if (sparse())
    data_->sparse->solve(mu.data());
  else
    solve_dense(mu);
}

// out −= S x, of dependent rows
void Schur::subtract_product(const VectorXd& x, VectorXd& out) const {
  if (sparse()) {
    data_->sparse->subtract_product(data_->whole, x.data(), out.data());
    return;
  }
  const double* S = data_->whole.data();
  for (int i = 0; i < n_; ++i) {
    for (int j = 0; j < i; ++j) {
      out[i] -= S[i * n_ + j] * x[j];
      out[j] -= S[i * n_ + j] * x[i];
    }
    out[i] -= S[i * n_ + i] * x[i];
  }
}

void Schur::solve(VectorXd& mu) {
  if (!dependent())
    solve_factored(mu);
  else
    data_->refine(mu, [&](VectorXd& v) { solve_factored(v); }, [&](const VectorXd& x, VectorXd& out) { subtract_product(x, out); });
}

}  // namespace pintle
