#include "framework/dynamics/solvers/schur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "framework/common/index.h"
#include "framework/dynamics/solvers/rank_ldl.h"
#include "framework/dynamics/solvers/sparse_ldl.h"

namespace pintle {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// f(n), with small n as compile-time constants.
template <class F>
auto with_size(int n, F f) {
  using std::integral_constant;
  switch (n) {
    case 1: return f(integral_constant<int, 1>{});
    case 2: return f(integral_constant<int, 2>{});
    case 3: return f(integral_constant<int, 3>{});
    case 4: return f(integral_constant<int, 4>{});
    case 5: return f(integral_constant<int, 5>{});
    case 6: return f(integral_constant<int, 6>{});
    case 7: return f(integral_constant<int, 7>{});
    case 8: return f(integral_constant<int, 8>{});
    case 9: return f(integral_constant<int, 9>{});
    case 10: return f(integral_constant<int, 10>{});
    default: return f(n);
  }
}

// S = L D Lᵀ in place, n × n by rows, lower half; D⁻¹ separately. @returns false if cancellation reduces a pivot to `least` of its original
// entry or less; `smallest` is the smallest such ratio
template <class N>
bool factor_ldl(N n, double* S, double* inverse, double least, double& smallest) {
  std::array<double, Schur::dense_rows> before, column;
  for (int i = 0; i < n; ++i) before[at(i)] = S[i * n + i];
  for (int j = 0; j < n; ++j) {
    const double pivot = S[j * n + j];
    if (pivot < smallest * before[at(j)]) smallest = pivot / before[at(j)];
    if (!(pivot > least * before[at(j)])) return false;
    inverse[j] = 1 / pivot;
    for (int i = j + 1; i < n; ++i) column[at(i)] = S[i * n + j];
    for (int i = j + 1; i < n; ++i) {
      double* Si = S + i * n;
      const double l = Si[j] = column[at(i)] * inverse[j];
      for (int k = j + 1; k <= i; ++k) Si[k] -= l * column[at(k)];
    }
  }
  return true;
}

// Of x[rows[0]], … x[rows[n − 1]]
template <class N>
void solve_ldl(N n, const double* S, const double* inverse, const int* rows, double* of) {
  std::array<double, Schur::dense_rows> x;
  for (int i = 0; i < n; ++i) x[at(i)] = of[rows[i]];
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i) x[at(i)] -= S[i * n + j] * x[at(j)];
  for (int i = 0; i < n; ++i) x[at(i)] *= inverse[i];
  for (int i = n - 1; i > 0; --i)
    for (int k = 0; k < i; ++k) x[at(k)] -= S[i * n + k] * x[at(i)];
  for (int i = 0; i < n; ++i) of[rows[i]] = x[at(i)];
}

}  // namespace

struct Schur::Data {
  explicit Data(const VectorXd& row_scale)
      : unit(row_scale), shift(VectorXd::Zero(row_scale.size())), S_ii(shift), refine(row_scale, 0), given(shift) {}

  /// Projects r onto what dependent rows can satisfy, by least squares. @returns the part removed, relative to r, by largest entries
  double make_consistent(VectorXd& r) {
    r.array() *= unit.array();
    const double size = largest(r);
    given = r;
    take_null_vectors(r);
    given -= r;
    const double left = largest(given);
    r.array() /= unit.array();
    return size > 0 ? left / size : 0;
  }
  /// μ ← the multipliers of least norm
  void take_null_part(VectorXd& mu) {
    mu.array() /= unit.array();
    take_null_vectors(mu);
    mu.array() *= unit.array();
  }

  VectorXd unit;

  // sparse: the shift
  VectorXd shift, S_ii;
  std::vector<double> whole;  ///< S without the shift, not factored
  dependent_rows::Refinement refine;
  std::optional<SparseLdl> sparse;

  // dense: the rank
  std::vector<RankLdl> parts;
  MatrixXd N;  ///< null vectors over the units, orthonormal, a column each
  VectorXd work, given;
  double left_over = 0;

  void orthonormalize(Eigen::Index k) {
    auto v = N.col(k);
    v.array() /= unit.array();
    for (int twice = 0; twice < 2; ++twice)
      for (Eigen::Index j = 0; j < k; ++j) v -= N.col(j).dot(v) * N.col(j);
    v.normalize();
  }

 private:
  static double largest(const VectorXd& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; }
  void take_null_vectors(VectorXd& v) {
    for (int twice = 0; twice < 2; ++twice) {
      work.noalias() = N.transpose() * v;
      v.noalias() -= N * work;
    }
  }
};

Schur::~Schur() = default;
Schur::Schur(Schur&&) noexcept = default;

Schur::Schur(const System& system) : n_(system.n_rows()), data_(std::make_unique<Data>(system.row_scale)) {
  std::vector<std::vector<int>> ends(system.bodies.size());  // of joints on each body
  std::vector<int> joint_of;                                 // of each end
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    for (int end = system.end_begin[k]; end < system.end_begin[k + 1]; ++end) {
      joint_of.push_back(static_cast<int>(k));
      if (const int body = system.markers[at(system.end_marker[at(end)])].body; body != ground) ends[at(body)].push_back(end);
    }
  const auto first_row = [&](int end) { return system.row_begin[at(joint_of[at(end)])]; };
  const auto height = [&](int end) { return rows(system.joints[at(joint_of[at(end)])]); };

  std::vector<Pattern::Place> places;
  for (std::size_t b = 0; b < ends.size(); ++b) {
    const Body& body = system.bodies[b];
    const int w = static_cast<int>(weights_.size());
    const bool flexible = body.modes() > 0;
    const auto bends = [&](int end) {
      return flexible && feels_shapes(system, system.joints[at(joint_of[at(end)])], system.end_marker[at(end)]);
    };
    weights_.insert(weights_.end(), {flexible ? 1 : 1 / body.m, flexible ? 1 : 1 / body.m, flexible ? 1 : 1 / body.J});
    for (std::size_t p = 0; p < ends[b].size(); ++p)
      for (std::size_t q = 0; q <= p; ++q) {
        const int i = ends[b][p], j = ends[b][q];
        const bool both_bend = bends(i) && bends(j);
        for (int r = 0; r < height(i); ++r)
          for (int c = 0; c < (i == j ? r + 1 : height(j)); ++c) {
            terms_.push_back({0, 9 * i + 3 * r, 9 * j + 3 * c, w});
            modal_terms_.push_back({both_bend ? 0 : -1, i, r, j, c});
            places.push_back({first_row(i) + r, first_row(j) + c});
          }
      }
  }

  std::vector<int> where;
  if (n_ <= dense_rows) {
    where = divide(places);
    data_->parts.resize(parts_.size());
  } else {
    for (int i = 0; i < n_; ++i) places.push_back({i, i});
    data_->sparse.emplace(n_, places, where);
    values_.resize(at(data_->sparse->entries()));
    diagonal_ = data_->sparse->diagonal();
  }
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    terms_[k].to = where[k];
    if (modal_terms_[k].to == 0) modal_terms_[k].to = where[k];
  }
  std::erase_if(modal_terms_, [](const ModalTerm& t) { return t.to < 0; });
  std::vector<bool> begun(values_.size(), false);
  const auto later = std::stable_partition(terms_.begin(), terms_.end(), [&](const Term& t) {
    const bool first = !begun[at(t.to)];
    begun[at(t.to)] = true;
    return first;
  });
  first_terms_ = static_cast<std::size_t>(later - terms_.begin());
  for (std::size_t i = 0; i < begun.size(); ++i)
    if (!begun[i]) zeros_.push_back(static_cast<int>(i));
}

// Divides the rows into parts connected by `places`. @returns the index of the value for each place
std::vector<int> Schur::divide(const std::vector<Pattern::Place>& places) {
  std::vector<int> part(at(n_)), row_in_part(at(n_)), where;
  std::iota(part.begin(), part.end(), 0);
  for (const auto& [row, column] : places) {
    const auto [kept, merged] = std::minmax({part[at(row)], part[at(column)]});
    std::ranges::replace(part, int{merged}, int{kept});
  }
  int values = 0;
  std::vector<Part> of(at(n_));
  for (int first = 0; first < n_; ++first) {
    if (part[at(first)] != first) continue;
    Part made{0, static_cast<int>(order_.size()), values};
    for (int row = first; row < n_; ++row)
      if (part[at(row)] == first) row_in_part[at(row)] = made.n++, order_.push_back(row);
    values += made.n * made.n;
    of[at(first)] = made;
    parts_.push_back(made);
  }
  const auto value = [&](int row, int column) {
    const Part& p = of[at(part[at(row)])];
    return p.at + row_in_part[at(row)] * p.n + row_in_part[at(column)];
  };
  for (const Pattern::Place& p : places) where.push_back(value(p.row, p.column));
  for (int i = 0; i < n_; ++i) diagonal_.push_back(value(i, i));
  values_.resize(at(values));
  inverse_.resize(at(n_));
  return where;
}

double Schur::inconsistency() const {
  if (!dependent()) return 0;
  return sparse() ? data_->refine.left_over() : data_->left_over;
}
bool Schur::sparse() const { return data_->sparse.has_value(); }

const char* Schur::solver() const {
  if (n_ == 0) return "none";
  return !sparse() ? "dense" : data_->sparse->thin() ? "sparse (LDL)" : "sparse (CHOLMOD)";
}

double Schur::nonzeros() const {
  if (sparse()) return data_->sparse->nonzeros();
  double sum = 0;
  for (const Part& p : parts_) sum += 0.5 * p.n * (p.n + 1);
  return sum;
}

void Schur::sum(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta, std::span<const int> released) {
  for (const int i : zeros_) values_[at(i)] = 0;
  if (terms_.empty()) return;
  const double* entries = B.front().data();
  const auto product = [&](const Term& t) {
    const double *a = entries + t.a, *b = entries + t.b, *w = weights_.data() + t.w;
    return a[0] * w[0] * b[0] + a[1] * w[1] * b[1] + a[2] * w[2] * b[2];
  };
  for (std::size_t k = 0; k < first_terms_; ++k) values_[at(terms_[k].to)] = product(terms_[k]);
  for (std::size_t k = first_terms_; k < terms_.size(); ++k) values_[at(terms_[k].to)] += product(terms_[k]);
  for (const ModalTerm& t : modal_terms_) values_[at(t.to)] += B_eta[at(t.i)].row(t.r).dot(B_eta[at(t.j)].row(t.c));
  for (const int row : released) values_[at(diagonal_[at(row)])] = 1;
}

bool Schur::factor(const std::vector<Block>& B, const std::vector<RowBlock>& B_eta, double least, std::span<const int> released) {
  sum(B, B_eta, released);
  lost_ = 0;
  if (sparse()) least_ = data_->sparse->factor(values_);
  const bool independent = sparse() ? least_ > least : factor_dense(least);
  if (independent && (least_ > few || smallest_quotient() > bound(least))) {
    kept_ = least_;
    return true;
  }
  if (sparse()) return factor_shifted();
  sum(B, B_eta, released);  // the factor has overwritten S
  return factor_by_rank(independent ? bound(least) : least);
}

// The quotient that rounding leaves for dependent rows; larger if some bodies are 1e12 times as heavy as others.
double Schur::bound(double least) const {
  const int width = sparse() ? data_->sparse->width() : n_;
  return least > dependent_rows::lost ? least : 4 * width * std::numeric_limits<double>::epsilon();
}

// Relative size vᵀSv / Σ S_ii v_i² of the combination of rows that the smallest pivot belongs to. If a row is only a small part of the
// combination, rounding may affect its pivot far more than this quotient.
double Schur::smallest_quotient() const {
  if (sparse()) return data_->sparse->smallest_quotient(values_);
  std::array<double, dense_rows> v, diagonal;
  double smallest = 1;
  for (const Part& p : parts_) {
    const double *L = values_.data() + p.at, *inverse = inverse_.data() + p.begin;
    for (int j = 0; j < p.n; ++j) {
      double& S_jj = diagonal[at(j)] = 1 / inverse[j];
      for (int k = 0; k < j; ++k) S_jj += L[j * p.n + k] * L[j * p.n + k] / inverse[k];
      if (1 > few * S_jj * inverse[j]) continue;
      double weight = S_jj;
      for (int k = j - 1; k >= 0; --k) {  // Lᵀ v = e_j
        v[at(k)] = -L[j * p.n + k];
        for (int i = k + 1; i < j; ++i) v[at(k)] -= L[i * p.n + k] * v[at(i)];
        weight += diagonal[at(k)] * v[at(k)] * v[at(k)];
      }
      smallest = std::min(smallest, 1 / (inverse[j] * weight));
    }
  }
  return smallest;
}

// A set of independent rows is solved for; the null vectors then convert the result to the least norm.
bool Schur::factor_by_rank(double least) {
  Data& d = *data_;
  kept_ = 1;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& p = parts_[k];
    if (!d.parts[k].factor(p.n, &values_[at(p.at)], least)) return false;
    lost_ += d.parts[k].lost();
    kept_ = std::min(kept_, d.parts[k].kept());
  }
  if (d.N.cols() != lost_) d.N.resize(n_, lost_), d.work.resize(lost_);
  d.N.setZero();
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    for (int i = 0; i < d.parts[k].lost(); ++i) {
      d.parts[k].null_vector(i, &order_[at(parts_[k].begin)], d.N.col(column).data());
      d.orthonormalize(column++);
    }
  least_ = lost_ > 0 ? 0 : kept_;
  return true;
}

bool Schur::factor_shifted() {
  Data& d = *data_;
  const auto entry = [&](int i) -> double& { return values_[at(diagonal_[at(i)])]; };
  d.whole = values_;
  for (int i = 0; i < n_; ++i) d.S_ii[i] = entry(i);
  if (!(d.S_ii.array() > 0).all()) return false;
  dependent_rows::shifts(d.S_ii, d.unit, d.shift);
  for (int i = 0; i < n_; ++i) entry(i) += d.shift[i];
  if (!(d.sparse->factor(values_) > 0)) return false;
  kept_ = 1;
  lost_ = std::max(d.sparse->below(values_, dependent_rows::held_up, kept_), 1);
  least_ = 0;
  return true;
}

bool Schur::factor_dense(double least) {
  least_ = 1;
  for (const Part& p : parts_)
    if (!with_size(p.n, [&](auto n) { return factor_ldl(n, &values_[at(p.at)], &inverse_[at(p.begin)], least, least_); })) return false;
  return true;
}

void Schur::solve_dense(double* mu) const {
  for (const Part& p : parts_)
    with_size(p.n, [&](auto n) { solve_ldl(n, &values_[at(p.at)], &inverse_[at(p.begin)], &order_[at(p.begin)], mu); });
}

void Schur::solve_factored(VectorXd& mu) {
  if (sparse())
    data_->sparse->solve(mu.data());
  else
    solve_dense(mu.data());
}

void Schur::solve_by_rank(VectorXd& mu) {
  Data& d = *data_;
  d.left_over = d.make_consistent(mu);
  for (std::size_t k = 0; k < parts_.size(); ++k) d.parts[k].solve(&order_[at(parts_[k].begin)], mu.data());
  d.take_null_part(mu);
}

void Schur::solve(VectorXd& mu) {
  Data& d = *data_;
  if (!dependent())
    solve_factored(mu);
  else if (!sparse())
    solve_by_rank(mu);
  else
    d.refine(
        mu, [&](VectorXd& v) { solve_factored(v); },
        [&](const VectorXd& x, VectorXd& out) { d.sparse->subtract_product(d.whole, x.data(), out.data()); }, &d.shift);
}

void Schur::take_null_part(VectorXd& mu) {
  if (!dependent()) return;
  if (sparse())
    data_->refine.take_null_part(
        mu, [&](VectorXd& v) { solve_factored(v); }, data_->shift);
  else
    data_->take_null_part(mu);
}

}  // namespace pintle
