#include "framework/dynamics/newton/kkt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "framework/common/archive.h"
#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/dynamics/newton/elimination.h"
#include "framework/dynamics/solvers/dependent_rows.h"
#include "framework/dynamics/solvers/sparse_lu.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int retry = 16;  // factorizations with the shift before trying one without it
}  // namespace

struct Kkt::Data {
  Index n, m, size;
  std::vector<int> where_J, where_C, where_D;  ///< entry of each summand; two for each entry of Cq; of the rows' diagonal
  Pattern full_pattern;                        ///< when dense
  std::vector<double> values, shifted_values;  ///< scaled, without and with the shift
  VectorXd T, E;                               ///< x, y = T ẑ, T = [D; R]; the shift is −E
  VectorXd z, work, unit, ones;
  dependent_rows::Refinement refine;
  std::optional<SparseLu> sparse;
  std::optional<Eigen::PartialPivLU<MatrixXd>> dense;
  bool factored = false, shifted = false;
  int since = 0;

  /// The data that determine the next factors and solutions.
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(factored, shifted, since, values, T, E));
  }

  const Pattern& pattern() const { return sparse ? sparse->pattern() : full_pattern; }
  Eigen::Map<const MatrixXd> full(const std::vector<double>& v) const { return {v.data(), size, size}; }

  // f(row, column, value) for each entry of `values` in the columns from `begin` to `end` while `goes(row)`
  template <class Goes, class F>
  void each(Index begin, Index end, Goes goes, F f) {
    const Pattern& p = pattern();
    for (Index c = begin; c < end; ++c)
      for (int k = p.column_begin[at(c)]; k < p.column_begin[at(c) + 1] && goes(p.row[at(k)]); ++k)
        f(static_cast<Index>(p.row[at(k)]), c, values[at(k)]);
  }
  template <class F>
  void each(F f) {
    each(
        0, size, [](int) { return true; }, f);
  }

  void assemble(const Equations& eq, const std::vector<double>& J) {
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = 0; i < J.size(); ++i) values[at(where_J[i])] += J[i];
    const int* to = where_C.data();
    visit_jacobian(eq, [&](int, int, double value) {
      values[at(*to++)] += value;
      values[at(*to++)] += value;
    });
    for (const int row : eq.released) values[at(where_D[at(row)])] = -1;
  }

  // D scales the largest entry of each row and column of D J D to one, R that of each row of R Cq D.
  void equilibrate(const System& system) {
    T.setZero();
    each(
        0, n, [&](int r) { return r < n; }, [&](Index r, Index c, double v) {  // the rows of J come first
          const double g = std::abs(v) * system.scale[r] * system.scale[c];
          T[r] = std::max(T[r], g);
          T[c] = std::max(T[c], g);
        });
    const double largest = n > 0 ? T.head(n).maxCoeff() : 0;
    for (Index i = 0; i < n; ++i) {
      const double g = T[i] > 1e-16 * largest ? T[i] : largest > 0 ? largest : 1;
      T[i] = system.scale[i] / std::sqrt(g);
    }
    each(
        n, size, [&](int r) { return r < n; }, [&](Index r, Index c, double v) { T[c] = std::max(T[c], std::abs(v) * T[r]); });
    for (Index i = n; i < size; ++i) T[i] = T[i] > 0 ? 1 / T[i] : 1;
    each([&](Index r, Index c, double& v) { v *= T[r] * T[c]; });
    unit = system.row_scale.cwiseQuotient(T.tail(m));
    dependent_rows::shifts(ones, unit, E);
  }

  bool factor_as(const std::vector<double>& v, double least) {
    if (sparse) {
      if (sparse->factor(v) && sparse->pivot_ratio() > least) return true;
      sparse->forget();  // do not reuse the pivots of a singular matrix
      return false;
    }
    if (size == 0) return true;
    dense->compute(full(v));
    const auto pivots = dense->matrixLU().diagonal().cwiseAbs();
    return (pivots.array() > least * pivots.maxCoeff()).all();  // false for NaN too
  }
  void solve_in_place(VectorXd& v) {
    if (sparse)
      sparse->solve(v.data());
    else
      work = dense->solve(v), v.swap(work);
  }
  bool factor_plain() { return factor_as(values, dependent_rows::lost); }
  void shift_rows() {
    shifted_values = values;
    for (Index i = 0; i < m; ++i) shifted_values[at(where_D[at(i)])] -= E[i];
  }
  bool factor_shifted() {
    shift_rows();
    return factor_as(shifted_values, 1e-3 * dependent_rows::lost);
  }
  bool factor() {
    if (shifted && ++since % retry != 0) return factor_shifted();
    shifted = !factor_plain();
    since = 0;
    return !shifted || (m > 0 && factor_shifted());
  }

  // out −= K z, K without the shift
  void subtract_product(const VectorXd& v, VectorXd& out) {
    if (sparse)
      each([&](Index r, Index c, double value) { out[r] -= value * v[c]; });
    else
      out.noalias() -= full(values) * v;
  }
};

Kkt::Kkt(const System& system, const Equations& eq, const Tangent& tangent) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.n = system.n();
  d.m = system.n_rows();
  d.size = d.n + d.m;
  const auto n = static_cast<int>(d.n), size = static_cast<int>(d.size);
  std::vector<Pattern::Place> places;
  for (const Tangent::Place& p : tangent.places()) places.push_back({p.row, p.column});
  const std::vector<Pattern::Place> J = places;
  visit_jacobian(eq, [&](int row, int column, double) {
    places.push_back({n + row, column});
    places.push_back({column, n + row});
  });
  for (int i = 0; i < size; ++i) places.push_back({i, i});
  std::vector<int> where;
  Pattern pattern = compress(size, places, where);
  constexpr int full_enough = 3;  // measured: KLU is faster for a dozen unknowns or more, unless a third of the entries are nonzero
  if (size > dense_size || full_enough * pattern.entries() < size * size) {
    d.sparse.emplace(std::move(pattern), elimination_order(system, eq, J));
  } else {
    for (int c = 0; c <= size; ++c) d.full_pattern.column_begin.push_back(c * size);
    for (int i = 0; i < size * size; ++i) d.full_pattern.row.push_back(i % size);
    for (std::size_t i = 0; i < places.size(); ++i) where[i] = places[i].column * size + places[i].row;
    d.dense.emplace(d.size);
  }
  const auto J_end = where.begin() + static_cast<long>(tangent.places().size());
  d.where_J.assign(where.begin(), J_end);
  d.where_C.assign(J_end, where.end() - size);
  d.where_D.assign(where.end() - d.m, where.end());
  d.values.resize(at(d.pattern().entries()));
  if (d.dense) d.shifted_values = d.values;  // sparse: allocated at the first dependent rows
  d.T.setZero(d.size);
  d.E.setZero(d.m);
  d.ones.setOnes(d.m);
  d.unit = d.ones;
  d.z.setZero(d.size);
  d.work = d.z;
  d.refine = dependent_rows::Refinement(VectorXd::Ones(d.size), d.n);
}

Kkt::~Kkt() = default;
Kkt::Kkt(Kkt&&) noexcept = default;

bool Kkt::factor(const System& system, const Equations& eq, const std::vector<double>& J) {
  data_->assemble(eq, J);
  data_->equilibrate(system);
  return data_->factored = data_->factor();
}

void Kkt::solve(VectorXd& x, VectorXd& y) {
  Data& d = *data_;
  if (d.size == 0) return;
  d.z << x, y;
  d.z.array() *= d.T.array();
  if (d.shifted)
    d.refine(
        d.z, [&](VectorXd& v) { d.solve_in_place(v); }, [&](const VectorXd& v, VectorXd& out) { d.subtract_product(v, out); });
  else
    d.solve_in_place(d.z);
  d.z.array() *= d.T.array();
  x = d.z.head(d.n);
  y = d.z.tail(d.m);
}

void Kkt::forget() {
  data_->factored = data_->shifted = false;
  data_->since = 0;
  if (data_->sparse) data_->sparse->forget();
}

bool Kkt::dependent() const { return data_->shifted; }
double Kkt::inconsistency() const { return data_->shifted ? data_->refine.left_over() : 0; }
bool Kkt::sparse() const { return data_->sparse.has_value(); }
const char* Kkt::solver() const { return sparse() ? "sparse LU (KLU)" : "dense LU"; }
long Kkt::nonzeros() const { return data_->sparse ? data_->sparse->nonzeros() : static_cast<long>(data_->size * data_->size); }

void Kkt::save(Writer& out) const {
  out.whole(*data_);
  if (data_->sparse) data_->sparse->save(out);
}

bool Kkt::load(Reader& in) {
  Data& d = *data_;
  const auto sizes = [&d] { return std::array{static_cast<Index>(d.values.size()), d.T.size(), d.E.size()}; };
  const auto expected = sizes();
  in.whole(d);
  if (sizes() != expected) in.fail();
  if (in.good() && d.shifted) d.shift_rows();
  if (in.good() && d.sparse) d.sparse->load(in, d.shifted ? d.shifted_values : d.values);
  bool whole = in.good() && d.factored;
  if (whole && d.sparse) whole = d.sparse->nonzeros() > 0;
  if (whole && !d.sparse) whole = d.shifted ? d.factor_shifted() : d.factor_plain();
  if (!whole) forget();
  return whole;
}

}  // namespace pintle
