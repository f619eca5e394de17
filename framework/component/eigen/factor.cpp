#include "framework/component/eigen/factor.h"

#include <cholmod.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "framework/common/stop_point.h"
#include "framework/common/suitesparse_memory.h"
#include "framework/component/eigen/symbolic.h"

namespace pintle {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr Eigen::Index panel_columns = 64;  // right-hand sides solved at a time: limits the memory of CHOLMOD's copies
#ifdef PINTLE_WITHOUT_GPL
constexpr int kind_of_factor = CHOLMOD_SIMPLICIAL;
#else
constexpr int kind_of_factor = CHOLMOD_SUPERNODAL;
#endif

// CHOLMOD's view of our matrix, read only.
cholmod_sparse view(const Sparse& A) {
  cholmod_sparse v{};
  v.nrow = static_cast<std::size_t>(A.rows());
  v.ncol = static_cast<std::size_t>(A.cols());
  v.nzmax = static_cast<std::size_t>(A.nonZeros());
  v.p = const_cast<int*>(A.outerIndexPtr());
  v.i = const_cast<int*>(A.innerIndexPtr());
  v.nz = const_cast<int*>(A.innerNonZeroPtr());
  v.x = const_cast<double*>(A.valuePtr());
  v.stype = -1;
  v.itype = CHOLMOD_INT;
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  v.sorted = 1;
  v.packed = A.isCompressed() ? 1 : 0;
  return v;
}

cholmod_dense view(double* x, Eigen::Index rows, Eigen::Index columns) {
  cholmod_dense v{};
  v.nrow = v.d = static_cast<std::size_t>(rows);
  v.ncol = static_cast<std::size_t>(columns);
  v.nzmax = v.nrow * v.ncol;
  v.x = x;
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  return v;
}

}  // namespace

struct Factor::Data {
  // The positions of a matrix's entries, column by column.
  class Places {
   public:
    Places() = default;
    explicit Places(const Sparse& A) {
      row_.reserve(static_cast<std::size_t>(A.nonZeros()));
      begin_.reserve(static_cast<std::size_t>(A.outerSize()));
      for (int j = 0; j < A.outerSize(); ++j) {
        begin_.push_back(row_.size());
        for (Sparse::InnerIterator a(A, j); a; ++a) row_.push_back(static_cast<int>(a.row()));
      }
    }
    bool operator==(const Places&) const = default;

   private:
    std::vector<std::size_t> begin_;
    std::vector<int> row_;
  };

  cholmod_common common;
  cholmod_factor* L = nullptr;
  cholmod_dense *Y = nullptr, *E = nullptr;  // workspace of solves
  Places places;                             // of the matrix that L was analysed for
  std::optional<Symbolic> symbolic;          // if L has no supernodes itself
  int pivot = -1;

  Data() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = kind_of_factor;
    common.final_ll = 1;
  }
  ~Data() {
    cholmod_free_factor(&L, &common);
    cholmod_free_dense(&Y, &common);
    cholmod_free_dense(&E, &common);
    cholmod_finish(&common);
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;

  void validate(const Sparse& A) const {
    if (L && common.status >= 0) return;
    throw std::runtime_error("a matrix of " + std::to_string(A.rows()) +
                             " degrees of freedom could not be factored: the status of CHOLMOD is " + std::to_string(common.status) +
                             (common.status == CHOLMOD_OUT_OF_MEMORY ? ", out of memory" : ""));
  }

  // First column (in elimination order) whose pivot is lost in the rounding of A's diagonal; −1: none.
  int lost_pivot(const Sparse& A) const { return L->is_super ? lost_in_supernodes(A) : lost_in_columns(A); }

  int lost_in_columns(const Sparse& A) const {
    const int* begin = static_cast<const int*>(L->p);
    const int* order = static_cast<const int*>(L->Perm);
    const double* x = static_cast<const double*>(L->x);
    const Eigen::VectorXd diagonal = A.diagonal();
    for (int j = 0; j < static_cast<int>(L->n); ++j)
      if (const double l = x[begin[j]]; !(l * l > nothing * diagonal[order[j]])) return j;
    return -1;
  }

  int lost_in_supernodes(const Sparse& A) const {
    const int* first = static_cast<const int*>(L->super);
    const int* row_begin = static_cast<const int*>(L->pi);
    const int* begin = static_cast<const int*>(L->px);
    const int* order = static_cast<const int*>(L->Perm);
    const double* x = static_cast<const double*>(L->x);
    const Eigen::VectorXd diagonal = A.diagonal();
    for (std::size_t s = 0; s < L->nsuper; ++s) {
      const std::ptrdiff_t rows = row_begin[s + 1] - row_begin[s];
      for (int j = first[s]; j < first[s + 1]; ++j) {
        const double l = x[begin[s] + (j - first[s]) * (rows + 1)];
        if (!(l * l > nothing * diagonal[order[j]])) return j;
      }
    }
    return -1;
  }
};

Factor::Factor() : data_(std::make_unique<Data>()) {}
Factor::~Factor() = default;
Factor::Factor(Factor&&) noexcept = default;
Factor& Factor::operator=(Factor&&) noexcept = default;

void Factor::analyse(const Sparse& A) {
  if (A.rows() != A.cols())
    throw std::invalid_argument("a matrix to factor is " + std::to_string(A.rows()) + " by " + std::to_string(A.cols()) +
                                ", must be square");
  Data& d = *data_;
  Data::Places places(A);
  if (d.L && places == d.places) return;
  cholmod_sparse a = view(A);
  cholmod_free_factor(&d.L, &d.common);
  const SuiteSparseMemory memory;
  d.L = cholmod_analyze(&a, &d.common);
  memory.require();
  d.places = std::move(places);
  d.validate(A);
  d.symbolic.reset();
  if (!d.L->is_super) d.symbolic.emplace(A, static_cast<const int*>(d.L->Perm));
}

bool Factor::compute(const Sparse& A) {
  stop_point();
  analyse(A);
  stop_point();
  Data& d = *data_;
  cholmod_sparse a = view(A);
  cholmod_factorize(&a, d.L, &d.common);
  d.validate(A);
  const int n = static_cast<int>(A.rows()), minor = static_cast<int>(d.L->minor);
  const int lost = minor < n ? minor : d.lost_pivot(A);
  d.pivot = lost < 0 ? -1 : static_cast<const int*>(d.L->Perm)[lost];
  return d.pivot < 0;
}

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& B) const {
  Eigen::MatrixXd X(B.rows(), B.cols());
  solve_into(B, X);
  return X;
}

void Factor::solve_into(const Eigen::MatrixXd& B, Eigen::MatrixXd& X) const {
  Data& d = *data_;
  X.resize(B.rows(), B.cols());
  for (Eigen::Index c = 0; c < B.cols(); c += panel_columns) {
    stop_point();
    const Eigen::Index columns = std::min(panel_columns, B.cols() - c);
    cholmod_dense b = view(const_cast<double*>(B.data() + c * B.rows()), B.rows(), columns);
    cholmod_dense x = view(X.data() + c * B.rows(), B.rows(), columns);
    cholmod_dense* into = &x;
    cholmod_solve2(CHOLMOD_A, d.L, &b, nullptr, &into, nullptr, &d.Y, &d.E, &d.common);
  }
}

int Factor::pivot() const { return data_->pivot; }
double Factor::nonzeros() const { return data_->common.lnz; }

Supernodes Factor::supernodes() const {
  if (data_->symbolic) return data_->symbolic->supernodes();
  const cholmod_factor& L = *data_->L;
  return {static_cast<int>(L.n),         static_cast<int>(L.nsuper),   static_cast<const int*>(L.super),
          static_cast<const int*>(L.pi), static_cast<const int*>(L.s), static_cast<const int*>(L.Perm)};
}

}  // namespace pintle
