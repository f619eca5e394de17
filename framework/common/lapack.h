#pragma once

// The BLAS and LAPACK routines used, by their Fortran names.

// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k, const double* alpha, const double* A,
            const int* lda, const double* B, const int* ldb, const double* beta, double* C, const int* ldc);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* A, const int* lda,
            const double* beta, double* C, const int* ldc);
void dtrsm_(const char* side, const char* uplo, const char* transa, const char* diag, const int* m, const int* n, const double* alpha,
            const double* A, const int* lda, double* B, const int* ldb);
void dpotrf_(const char* uplo, const int* n, double* A, const int* lda, int* info);
void dsytrf_(const char* uplo, const int* n, double* A, const int* lda, int* pivots, double* work, const int* lwork, int* info);
void dsytrs_(const char* uplo, const int* n, const int* nrhs, const double* A, const int* lda, const int* pivots, double* B, const int* ldb,
             int* info);
void dsyevd_(const char* job, const char* uplo, const int* n, double* A, const int* lda, double* w, double* work, const int* lwork,
             int* iwork, const int* liwork, int* info);
void dgeevx_(const char* balance, const char* job_left, const char* job_right, const char* sense, const int* n, double* A, const int* lda,
             double* re, double* im, double* left, const int* ldl, double* right, const int* ldr, int* low, int* high, double* scale,
             double* norm, double* sense_values, double* sense_vectors, double* work, const int* lwork, int* iwork, int* info);
}
// NOLINTEND(readability-identifier-naming)
