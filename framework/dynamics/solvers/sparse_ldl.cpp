#include "framework/dynamics/solvers/sparse_ldl.h"

#include <amd.h>
#include <cholmod.h>
extern "C" {  // this header has no C++ guards
#include <ldl.h>
}

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>

#include "framework/common/index.h"
#include "framework/common/suitesparse_memory.h"

namespace pintle {

namespace {

cholmod_sparse upper(Pattern& p, double* values) {
  cholmod_sparse A{};
  A.nrow = A.ncol = at(p.size());
  A.nzmax = p.row.size();
  A.p = p.column_begin.data();
  A.i = p.row.data();
  A.x = values;
  A.stype = 1;
  A.itype = CHOLMOD_INT;
  A.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

// Places of the upper triangle after row and column i have been renumbered to new_index[i].
std::vector<Pattern::Place> permuted(const std::vector<Pattern::Place>& places, const std::vector<int>& new_index) {
  std::vector<Pattern::Place> out;
  out.reserve(places.size());
  for (const Pattern::Place& p : places) {
    const auto [row, column] = std::minmax(new_index[at(p.row)], new_index[at(p.column)]);
    out.push_back({row, column});
  }
  return out;
}

struct Order {
  std::vector<int> order;  ///< order[k]: eliminated k-th
  double nonzeros;         ///< of L
  bool thick;
};

/// For few unknowns, so that CHOLMOD is not loaded for them.
Order order_by_amd(const Pattern& p) {
  Order out{std::vector<int>(at(p.size())), 0, false};
  double info[AMD_INFO];
  if (amd_order(p.size(), p.column_begin.data(), p.row.data(), out.order.data(), nullptr, info) < AMD_OK) throw std::bad_alloc();
  out.nonzeros = info[AMD_LNZ] + p.size();
  return out;
}

Order order_by_cholmod(Pattern p) {
  struct Common : cholmod_common {
    Common() { cholmod_start(this); }
    ~Common() { cholmod_finish(this); }
  } common;
  common.print = 0;
#ifdef PINTLE_WITHOUT_GPL
  common.supernodal = CHOLMOD_SIMPLICIAL;
#else
  common.supernodal_switch = SparseLdl::thick;
#endif
  cholmod_sparse A = upper(p, nullptr);
  const SuiteSparseMemory memory;
  cholmod_factor* found = cholmod_analyze(&A, &common);
  if (!found) throw std::bad_alloc();
  const int* perm = static_cast<const int*>(found->Perm);
  Order out{{perm, perm + p.size()}, common.lnz, found->is_super != 0};
  cholmod_free_factor(&found, &common);
  memory.require();
  return out;
}

Order find_order(const Pattern& p) { return p.size() <= SparseLdl::few ? order_by_amd(p) : order_by_cholmod(p); }

}  // namespace

struct SparseLdl::Data {
  explicit Data(int size) : n(size), x(at(size)) {}
  ~Data() {
    if (!started) return;
    cholmod_free_factor(&blocks, &common);
    cholmod_free_dense(&result, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_finish(&common);
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;

  void analyse_blocks() {
    cholmod_start(&common);
    started = true;
    common.print = 0;
    common.quick_return_if_not_posdef = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    cholmod_sparse A = upper(pattern, nullptr);
    blocks = cholmod_analyze(&A, &common);
    if (!blocks) throw std::bad_alloc();
  }

  void analyse_thin() {
    parent.resize(at(n));
    flag.resize(at(n));
    count.resize(at(n));
    begin.resize(at(n) + 1);
    ldl_symbolic(n, pattern.column_begin.data(), pattern.row.data(), begin.data(), parent.data(), count.data(), flag.data(), nullptr,
                 nullptr);
    row.resize(at(begin.back()));
    L.resize(row.size());
    D.resize(at(n));
    work.resize(at(n));
    stack.resize(at(n));
  }

  double diagonal_entry(const double* values, int k) const { return values[pattern.column_begin[at(k) + 1] - 1]; }

  bool factor_thin(double* values) {
    return n == ldl_numeric(n, pattern.column_begin.data(), pattern.row.data(), values, begin.data(), parent.data(), count.data(),
                            row.data(), L.data(), D.data(), work.data(), stack.data(), flag.data(), nullptr, nullptr);
  }

  bool factor_blocks(double* values) {
    cholmod_sparse A = upper(pattern, values);
    cholmod_factorize(&A, blocks, &common);
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    return common.status == CHOLMOD_OK;
  }

  // f(k, pivot) in the order of elimination
  template <class F>
  void each_pivot(F f) const {
    if (!blocks) {
      for (int k = 0; k < n; ++k) f(k, D[at(k)]);
      return;
    }
    const int *first = static_cast<const int*>(blocks->super), *rows = static_cast<const int*>(blocks->pi),
              *from = static_cast<const int*>(blocks->px);
    const double* l = static_cast<const double*>(blocks->x);
    for (std::size_t s = 0; s < blocks->nsuper; ++s)
      for (int k = first[s]; k < first[s + 1]; ++k) {
        const double root = l[from[s] + static_cast<std::ptrdiff_t>(k - first[s]) * (rows[s + 1] - rows[s] + 1)];
        f(k, root * root);
      }
  }

  // f(k, i) for each entry of L in column k, below the diagonal
  template <class F>
  void each_entry(F f) const {
    if (!blocks) {
      for (int k = 0; k < n; ++k)
        for (int at_k = 0; at_k < count[at(k)]; ++at_k) f(k, row[at(begin[at(k)] + at_k)]);
      return;
    }
    const int *first = static_cast<const int*>(blocks->super), *rows = static_cast<const int*>(blocks->pi),
              *index = static_cast<const int*>(blocks->s);
    for (std::size_t s = 0; s < blocks->nsuper; ++s)
      for (int k = first[s]; k < first[s + 1]; ++k)
        for (int i = rows[s] + (k - first[s]) + 1; i < rows[s + 1]; ++i) f(k, index[i]);
  }

  void solve_blocks() {
    cholmod_dense b{};
    b.nrow = b.d = b.nzmax = at(n);
    b.ncol = 1;
    b.x = x.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, blocks, &b, nullptr, &result, nullptr, &y, &e, &common);
    std::copy_n(static_cast<const double*>(result->x), n, x.data());
  }

  // x, in the order of elimination
  void solve() {
    if (blocks) {
      solve_blocks();
      return;
    }
    ldl_lsolve(n, x.data(), begin.data(), row.data(), L.data());
    ldl_dsolve(n, x.data(), D.data());
    ldl_ltsolve(n, x.data(), begin.data(), row.data(), L.data());
  }

  int n;
  Pattern pattern;                   ///< upper triangle, permuted
  std::vector<int> order, diagonal;  ///< order[k]: row eliminated k-th
  std::vector<double> x;
  double lnz = 0;
  int width = 0;  ///< 0: not counted yet
  // thin
  std::vector<int> parent, flag, count, begin, row, stack;
  std::vector<double> L, D, work;
  // thick
  cholmod_common common;
  bool started = false;  ///< common
  cholmod_factor* blocks = nullptr;
  cholmod_dense *result = nullptr, *y = nullptr, *e = nullptr;
};

std::vector<int> fill_reducing_order(int size, std::vector<Pattern::Place> places) {
  for (Pattern::Place& p : places) p = {std::min(p.row, p.column), std::max(p.row, p.column)};
  for (int i = 0; i < size; ++i) places.push_back({i, i});
  std::vector<int> where;
  return find_order(compress(size, places, where)).order;
}

SparseLdl::SparseLdl(int size, const std::vector<Pattern::Place>& places, std::vector<int>& where) : data_(std::make_unique<Data>(size)) {
  Data& d = *data_;
  std::vector<int> new_index(at(size));
  for (int i = 0; i < size; ++i) new_index[at(i)] = i;
  const Order order = find_order(compress(size, permuted(places, new_index), where));
  d.order = order.order;
  d.lnz = order.nonzeros;
  for (int k = 0; k < size; ++k) new_index[at(d.order[at(k)])] = k;
  d.pattern = compress(size, permuted(places, new_index), where);
  d.diagonal.resize(at(size));
  for (int i = 0; i < size; ++i) d.diagonal[at(i)] = d.pattern.column_begin[at(new_index[at(i)]) + 1] - 1;
  if (order.thick)
    d.analyse_blocks();
  else
    d.analyse_thin();
}

SparseLdl::~SparseLdl() = default;
SparseLdl::SparseLdl(SparseLdl&&) noexcept = default;

int SparseLdl::entries() const { return data_->pattern.entries(); }
const std::vector<int>& SparseLdl::diagonal() const { return data_->diagonal; }
bool SparseLdl::thin() const { return !data_->blocks; }
double SparseLdl::nonzeros() const { return data_->lnz; }

double SparseLdl::factor(const std::vector<double>& values) {
  Data& d = *data_;
  double* v = const_cast<double*>(values.data());  // both are only read
  if (!(d.blocks ? d.factor_blocks(v) : d.factor_thin(v))) return 0;
  double least = std::numeric_limits<double>::infinity();
  bool positive = true;
  d.each_pivot([&](int k, double pivot) {
    const double ratio = pivot / d.diagonal_entry(values.data(), k);
    positive = positive && ratio > 0;  // false for NaN
    least = std::min(least, ratio);
  });
  return positive ? least : 0;
}

int SparseLdl::below(const std::vector<double>& values, double ratio, double& least) const {
  int count = 0;
  data_->each_pivot([&](int k, double pivot) {
    const double left = pivot / data_->diagonal_entry(values.data(), k);
    if (left < ratio)
      ++count;
    else
      least = std::min(least, left);
  });
  return count;
}

double SparseLdl::smallest_quotient(const std::vector<double>& values) {
  Data& d = *data_;
  int weakest = 0;
  double least = std::numeric_limits<double>::infinity();
  d.each_pivot([&](int k, double pivot) {
    const double ratio = pivot / d.diagonal_entry(values.data(), k);
    if (ratio < least) least = ratio, weakest = k;
  });
  std::fill(d.x.begin(), d.x.end(), 0.0);
  d.x[at(weakest)] = 1;
  d.solve();
  double weight = 0;
  for (int k = 0; k < d.n; ++k) weight += d.diagonal_entry(values.data(), k) * d.x[at(k)] * d.x[at(k)];
  return d.x[at(weakest)] / weight;
}

int SparseLdl::width() {
  Data& d = *data_;
  if (d.width > 0) return d.width;
  std::vector<int> entries(at(d.n), 1);
  d.each_entry([&](int k, int i) { ++entries[at(k)], ++entries[at(i)]; });
  return d.width = *std::ranges::max_element(entries);
}

void SparseLdl::solve(double* x) {
  Data& d = *data_;
  for (int k = 0; k < d.n; ++k) d.x[at(k)] = x[d.order[at(k)]];
  d.solve();
  for (int k = 0; k < d.n; ++k) x[d.order[at(k)]] = d.x[at(k)];
}

void SparseLdl::subtract_product(const std::vector<double>& values, const double* x, double* out) const {
  const Data& d = *data_;
  for (int c = 0; c < d.n; ++c) {
    const int column = d.order[at(c)];
    for (int k = d.pattern.column_begin[at(c)]; k < d.pattern.column_begin[at(c) + 1]; ++k) {
      const int row = d.order[at(d.pattern.row[at(k)])];
      out[row] -= values[at(k)] * x[column];
      if (row != column) out[column] -= values[at(k)] * x[row];
    }
  }
}

}  // namespace pintle
