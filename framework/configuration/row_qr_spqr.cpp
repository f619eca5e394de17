#include "framework/configuration/row_qr.h"

#include <SuiteSparseQR_C.h>

#include <cstddef>
#include <new>

#include "framework/common/suitesparse_memory.h"

namespace pintle {

namespace {

using Index = Eigen::Index;

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
    SuiteSparseQR_C(SPQR_ORDERING_COLAMD, tolerance, 0, 0, matrix, nullptr, nullptr, nullptr, nullptr, &R_, &order_, nullptr, nullptr,
                    nullptr, &common_);
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

}  // namespace

int sparse_column_rank(const Eigen::SparseMatrix<double>& A, double tolerance, std::vector<Weights>& idle) {
  return QR(A, tolerance).rank(idle);
}

}  // namespace pintle
