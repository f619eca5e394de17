#include "framework/common/solver_libraries.h"

#ifdef PINTLE_WITHOUT_GPL
#include <cholmod.h>
#else
#include <SuiteSparseQR_C.h>
#endif

#include <dlfcn.h>

#include <atomic>
#include <stdexcept>
#include <string>

#include "framework/common/lapack.h"
#include "framework/common/library_threads.h"

namespace pintle {

namespace {

std::atomic<void*> loaded = nullptr;

/// SPQR, or without it CHOLMOD, and all that it loads.
void* libraries() {
  static void* const found = [] {
    void* const handle = dlopen(PINTLE_SOLVER_LIBRARY, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == nullptr)
      throw std::runtime_error(std::string("a library for sparse matrices cannot be loaded: ") + dlerror() +
                               "; install SuiteSparse and LAPACK, or name their folder in LD_LIBRARY_PATH");
    return loaded = handle;
  }();
  return found;
}

template <class Function>
Function* required(const char* name) {
  void* const found = solver_function(name, true);
  if (found == nullptr)
    throw std::runtime_error(std::string(PINTLE_SOLVER_LIBRARY) + " has no " + name +
                             "(); install SuiteSparse and LAPACK of the Debian release that pintle was built on");
  return reinterpret_cast<Function*>(found);
}

}  // namespace

void* solver_function(const char* name, bool load) {
  void* const handle = load ? libraries() : loaded.load();
  return handle != nullptr ? dlsym(handle, name) : nullptr;
}

}  // namespace pintle

// Defines a function that calls that of the same name in the libraries. It is hidden, so that these do not call it themselves.
// NOLINTBEGIN(readability-identifier-naming)
#define PINTLE_ON_DEMAND(RESULT, NAME, PARAMETERS, ARGUMENTS)               \
  extern "C" __attribute__((visibility("hidden"))) RESULT NAME PARAMETERS { \
    static auto* const function = pintle::required<decltype(NAME)>(#NAME);  \
    pintle::apply_library_threads();                                        \
    return function ARGUMENTS;                                              \
  }

PINTLE_ON_DEMAND(int, cholmod_start, (cholmod_common * c), (c))
PINTLE_ON_DEMAND(int, cholmod_finish, (cholmod_common * c), (c))
PINTLE_ON_DEMAND(cholmod_factor*, cholmod_analyze, (cholmod_sparse * A, cholmod_common* c), (A, c))
PINTLE_ON_DEMAND(int, cholmod_factorize, (cholmod_sparse * A, cholmod_factor* L, cholmod_common* c), (A, L, c))
PINTLE_ON_DEMAND(int, cholmod_solve2,
                 (int system, cholmod_factor* L, cholmod_dense* B, cholmod_sparse* B_set, cholmod_dense** X, cholmod_sparse** X_set,
                  cholmod_dense** Y, cholmod_dense** E, cholmod_common* c),
                 (system, L, B, B_set, X, X_set, Y, E, c))
PINTLE_ON_DEMAND(int, cholmod_free_factor, (cholmod_factor * *L, cholmod_common* c), (L, c))
PINTLE_ON_DEMAND(int, cholmod_free_dense, (cholmod_dense * *X, cholmod_common* c), (X, c))

#ifndef PINTLE_WITHOUT_GPL
PINTLE_ON_DEMAND(int, cholmod_l_start, (cholmod_common * c), (c))
PINTLE_ON_DEMAND(int, cholmod_l_finish, (cholmod_common * c), (c))
PINTLE_ON_DEMAND(cholmod_sparse*, cholmod_l_allocate_sparse,
                 (size_t rows, size_t columns, size_t entries, int sorted, int packed, int stype, int xtype, cholmod_common* c),
                 (rows, columns, entries, sorted, packed, stype, xtype, c))
PINTLE_ON_DEMAND(int, cholmod_l_free_sparse, (cholmod_sparse * *A, cholmod_common* c), (A, c))
PINTLE_ON_DEMAND(void*, cholmod_l_free, (size_t n, size_t size, void* p, cholmod_common* c), (n, size, p, c))
PINTLE_ON_DEMAND(SuiteSparse_long, SuiteSparseQR_C,
                 (int ordering, double tolerance, SuiteSparse_long econ, int context, cholmod_sparse* A, cholmod_sparse* B_sparse,
                  cholmod_dense* B_dense, cholmod_sparse** Z_sparse, cholmod_dense** Z_dense, cholmod_sparse** R, SuiteSparse_long** order,
                  cholmod_sparse** H, SuiteSparse_long** H_rows, cholmod_dense** H_tau, cholmod_common* c),
                 (ordering, tolerance, econ, context, A, B_sparse, B_dense, Z_sparse, Z_dense, R, order, H, H_rows, H_tau, c))
#endif

PINTLE_ON_DEMAND(void, dgemm_,
                 (const char* transa, const char* transb, const int* m, const int* n, const int* k, const double* alpha, const double* A,
                  const int* lda, const double* B, const int* ldb, const double* beta, double* C, const int* ldc),
                 (transa, transb, m, n, k, alpha, A, lda, B, ldb, beta, C, ldc))
PINTLE_ON_DEMAND(void, dsyrk_,
                 (const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* A, const int* lda,
                  const double* beta, double* C, const int* ldc),
                 (uplo, trans, n, k, alpha, A, lda, beta, C, ldc))
PINTLE_ON_DEMAND(void, dtrsm_,
                 (const char* side, const char* uplo, const char* transa, const char* diag, const int* m, const int* n, const double* alpha,
                  const double* A, const int* lda, double* B, const int* ldb),
                 (side, uplo, transa, diag, m, n, alpha, A, lda, B, ldb))
PINTLE_ON_DEMAND(void, dpotrf_, (const char* uplo, const int* n, double* A, const int* lda, int* info), (uplo, n, A, lda, info))
PINTLE_ON_DEMAND(void, dsytrf_,
                 (const char* uplo, const int* n, double* A, const int* lda, int* pivots, double* work, const int* lwork, int* info),
                 (uplo, n, A, lda, pivots, work, lwork, info))
PINTLE_ON_DEMAND(void, dsytrs_,
                 (const char* uplo, const int* n, const int* nrhs, const double* A, const int* lda, const int* pivots, double* B,
                  const int* ldb, int* info),
                 (uplo, n, nrhs, A, lda, pivots, B, ldb, info))
PINTLE_ON_DEMAND(void, dsyevd_,
                 (const char* job, const char* uplo, const int* n, double* A, const int* lda, double* w, double* work, const int* lwork,
                  int* iwork, const int* liwork, int* info),
                 (job, uplo, n, A, lda, w, work, lwork, iwork, liwork, info))
PINTLE_ON_DEMAND(void, dgeevx_,
                 (const char* balance, const char* job_left, const char* job_right, const char* sense, const int* n, double* A,
                  const int* lda, double* re, double* im, double* left, const int* ldl, double* right, const int* ldr, int* low, int* high,
                  double* scale, double* norm, double* sense_values, double* sense_vectors, double* work, const int* lwork, int* iwork,
                  int* info),
                 (balance, job_left, job_right, sense, n, A, lda, re, im, left, ldl, right, ldr, low, high, scale, norm, sense_values,
                  sense_vectors, work, lwork, iwork, info))
// NOLINTEND(readability-identifier-naming)
