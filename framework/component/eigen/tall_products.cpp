#include "framework/component/eigen/tall_products.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "framework/common/lapack.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Sparse = Eigen::SparseMatrix<double>;
using Tall = Eigen::Ref<const MatrixXd>;

constexpr int lanes = 8;            // columns of a sparse product at a time
constexpr Index panel_rows = 2048;  // rows transformed at a time

int leading(Index stride, Index rows) { return static_cast<int>(std::max<Index>(1, std::max(stride, rows))); }

}  // namespace

void product(const Sparse& A, const Tall& B, Eigen::Ref<MatrixXd> out, MatrixXd& scratch) {
  using Lanes = Eigen::Matrix<double, lanes, 1>;
  const Index n = A.rows();
  scratch.resize(lanes, n);
  for (Index c = 0; c < B.cols(); c += lanes) {
    const Index width = std::min<Index>(lanes, B.cols() - c);
    if (width < lanes) scratch.setZero();
    for (Index j = 0; j < width; ++j) scratch.row(j) = B.col(c + j).transpose();
    const double* x = scratch.data();
    for (int i = 0; i < n; ++i) {
      Lanes sum = Lanes::Zero();
      for (Sparse::InnerIterator a(A, i); a; ++a) sum += a.value() * Eigen::Map<const Lanes>(x + lanes * a.row());
      for (Index j = 0; j < width; ++j) out(i, c + j) = sum[j];
    }
  }
}

MatrixXd product(const Sparse& A, const Tall& B) {
  MatrixXd out(B.rows(), B.cols()), scratch;
  product(A, B, out, scratch);
  return out;
}

MatrixXd inner(const Tall& A, const Tall& B) {
  MatrixXd C = MatrixXd::Zero(A.cols(), B.cols());
  if (A.cols() == 0 || B.cols() == 0) return C;
  const int m = static_cast<int>(A.cols()), k = static_cast<int>(B.cols()), n = static_cast<int>(A.rows());
  const int lda = leading(A.outerStride(), A.rows()), ldb = leading(B.outerStride(), B.rows());
  const double one = 1, zero = 0;
  dgemm_("T", "N", &m, &k, &n, &one, A.data(), &lda, B.data(), &ldb, &zero, C.data(), &m);
  return C;
}

void add(double factor, const Tall& A, const Tall& C, Eigen::Ref<MatrixXd> Y) {
  if (A.cols() == 0 || C.cols() == 0) return;
  const int n = static_cast<int>(A.rows()), m = static_cast<int>(A.cols()), k = static_cast<int>(C.cols());
  const int lda = leading(A.outerStride(), A.rows()), ldc = leading(C.outerStride(), C.rows()), ldy = leading(Y.outerStride(), Y.rows());
  const double one = 1;
  dgemm_("N", "N", &n, &k, &m, &factor, A.data(), &lda, C.data(), &ldc, &one, Y.data(), &ldy);
}

void turn(Eigen::Ref<MatrixXd> A, const Tall& C) {
  MatrixXd panel;
  for (Index r = 0; r < A.rows(); r += panel_rows) {
    const Index rows = std::min(panel_rows, A.rows() - r);
    panel = MatrixXd::Zero(rows, C.cols());
    add(1, A.middleRows(r, rows).leftCols(C.rows()), C, panel);
    A.middleRows(r, rows).leftCols(C.cols()) = panel;
  }
}

Spectrum spectrum(MatrixXd A) {
  const int n = static_cast<int>(A.rows());
  Spectrum s{Eigen::VectorXd(n), {}};
  if (n == 0) return s;
  const int lwork = 1 + 6 * n + 2 * n * n, liwork = 3 + 5 * n;
  std::vector<double> work(static_cast<std::size_t>(lwork));
  std::vector<int> iwork(static_cast<std::size_t>(liwork));
  int info = A.allFinite() ? 0 : 1;
  if (info == 0) dsyevd_("V", "L", &n, A.data(), &n, s.values.data(), work.data(), &lwork, iwork.data(), &liwork, &info);
  if (info != 0) throw std::runtime_error("the eigenvalues of a projected matrix were not found: an entry is not a number");
  s.vectors = std::move(A);
  return s;
}

}  // namespace pintle
