#include "framework/dynamics/solvers/sparse_lu.h"

#include <klu.h>

#include <cmath>
#include <cstddef>
#include <new>
#include <utility>

#include "framework/common/archive.h"

namespace pintle {

struct SparseLu::Data {
  Data(Pattern p, std::vector<int> order) : pattern(std::move(p)) {
    klu_defaults(&common);
    common.btf = 0;     // otherwise only the pattern would match rows to columns
    common.scale = -1;  // scaled by the caller; this also skips checking the pattern each time
    symbolic = klu_analyze_given(pattern.size(), pattern.column_begin.data(), pattern.row.data(), order.data(), order.data(), &common);
    if (!symbolic) throw std::bad_alloc();
    seed.resize(pattern.row.size());
  }
  ~Data() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;

  bool choose_pivots(const std::vector<double>& v) {
    klu_free_numeric(&numeric, &common);
    seed = v;
    numeric = klu_factor(pattern.column_begin.data(), pattern.row.data(), seed.data(), symbolic, &common);
    if (!numeric && common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
    if (!numeric) return false;
    growth = measure(seed);
    pivots = std::vector<double>(diagonal(), diagonal() + pattern.size());
    return true;
  }

  const double* diagonal() const { return static_cast<const double*>(numeric->Udiag); }

  // Multipliers, and thus entries, can have grown only where a pivot has become smaller.
  bool shrunk() const {
    constexpr double much = 0.1;
    bool any = false;
    for (int i = 0; i < pattern.size(); ++i) any = any || !(std::abs(diagonal()[i]) > much * std::abs(pivots[static_cast<std::size_t>(i)]));
    return any;
  }

  // Largest entry of a column of A over that of U, for the worst column: small if the pivots let entries grow.
  double measure(const std::vector<double>& v) {
    klu_rgrowth(pattern.column_begin.data(), pattern.row.data(), const_cast<double*>(v.data()), symbolic, numeric, &common);
    return common.rgrowth;
  }

  bool factor(const std::vector<double>& v) {
    if (!numeric) return choose_pivots(v);
    constexpr double worn = 1e-3;
    double* values = const_cast<double*>(v.data());  // KLU only reads them
    if (klu_refactor(pattern.column_begin.data(), pattern.row.data(), values, symbolic, numeric, &common) &&
        (!shrunk() || measure(v) > worn * growth))
      return true;
    return choose_pivots(v);
  }

  Pattern pattern;
  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  std::vector<double> seed;    ///< the matrix from which the pivots were chosen
  std::vector<double> pivots;  ///< its U_ii
  double growth = 1;
};

SparseLu::SparseLu(Pattern pattern, std::vector<int> order) : data_(std::make_unique<Data>(std::move(pattern), std::move(order))) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;

bool SparseLu::factor(const std::vector<double>& values) { return data_->factor(values); }

double SparseLu::pivot_ratio() const {
  if (!data_->numeric) return 0;
  klu_rcond(data_->symbolic, data_->numeric, &data_->common);
  return data_->common.rcond;
}

void SparseLu::forget() { klu_free_numeric(&data_->numeric, &data_->common); }

void SparseLu::solve(double* x) { klu_solve(data_->symbolic, data_->numeric, data_->pattern.size(), 1, x, &data_->common); }

const Pattern& SparseLu::pattern() const { return data_->pattern; }
long SparseLu::nonzeros() const { return data_->numeric ? static_cast<long>(data_->numeric->lnz) + data_->numeric->unz : 0; }

void SparseLu::save(Writer& out) const {
  const bool factored = data_->numeric != nullptr;
  const std::vector<double>& seed = data_->seed;
  out(PINTLE_MEMBERS(factored, seed));
}

void SparseLu::load(Reader& in, const std::vector<double>& values) {
  bool factored = false;
  std::vector<double> seed;
  in(PINTLE_MEMBERS(factored, seed));
  if (seed.size() != data_->seed.size()) in.fail();
  klu_free_numeric(&data_->numeric, &data_->common);
  if (!in.good()) return;
  data_->seed = seed;
  if (factored && !(data_->choose_pivots(seed) && data_->factor(values))) in.fail();
}

}  // namespace pintle
