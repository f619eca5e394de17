#include "framework/component/eigen/subspace.h"

#include <algorithm>
#include <cmath>

#include "framework/common/dense.h"
#include "framework/component/eigen/tall_products.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double nothing = 1e-13;   // relative to a vector: a remainder below this is rounding
constexpr double cancelled = 1e-4;  // relative to a squared length: below this, subtract once more
constexpr double even = 1e-2;       // relative to a length: one Gram matrix makes such a block orthonormal to 1e-12
constexpr double thin = 1e-6;       // relative to a squared length: a direction that a Gram matrix resolves

}  // namespace

Subspace::Subspace(const Factor& A, const Eigen::SparseMatrix<double>& M, Index capacity)
    : A_(A), M_(M), Q_(M.rows(), capacity), T_(MatrixXd::Zero(capacity, capacity)), C_(0, 0) {}

void Subspace::reserve(Index capacity) {
  if (capacity <= Q_.cols()) return;
  Q_.conservativeResize(Eigen::NoChange, capacity);
  T_.conservativeResizeLike(MatrixXd::Zero(capacity, capacity));
}

// Subtracts from Z its components in Q, E = QᵀMZ, until nothing remains to subtract. @returns ZᵀMZ of the remainder
MatrixXd Subspace::clear(MatrixXd& Z, MatrixXd& E) {
  MatrixXd G;
  E = MatrixXd::Zero(used_, Z.cols());
  for (int pass = 0; pass < 3; ++pass) {
    MZ_.resize(Z.rows(), Z.cols());
    product(M_, Z, MZ_, lanes_);
    const MatrixXd e = inner(Q_.leftCols(used_), MZ_);
    add(-1, Q_.leftCols(used_), e, Z);
    E += e;
    G = inner(Z, MZ_);
    G = (0.5 * (G + G.transpose())).eval();
    const Eigen::ArrayXd left = G.diagonal(), taken = e.colwise().squaredNorm().transpose();
    if ((left > cancelled * taken || left < nothing * nothing).all()) break;
  }
  return G;
}

// Appends Z V, made orthonormal, to Q, and M times it to MQ. @returns the factor U: Z V = Q_new U
MatrixXd Subspace::append(const MatrixXd& Z, const MatrixXd& V, const VectorXd& length) {
  const Index fresh = V.cols();
  auto added = Q_.middleCols(used_, fresh);
  added.setZero();
  add(1, Z, V * length.cwiseInverse().asDiagonal(), added);
  if (MQ_.cols() < filled_ + fresh) MQ_.conservativeResize(M_.rows(), filled_ + fresh);
  auto mass = MQ_.middleCols(filled_, fresh);
  product(M_, added, mass, lanes_);
  filled_ += fresh;
  used_ += fresh;
  if (length[0] > even * length[fresh - 1]) return MatrixXd(length.asDiagonal());
  const Eigen::LLT<MatrixXd> polish(inner(added, mass));
  const MatrixXd inverse = polish.matrixU().solve(MatrixXd::Identity(fresh, fresh));
  turn(added, inverse);
  turn(mass, inverse);
  return MatrixXd(polish.matrixU()) * length.asDiagonal();
}

// Appends to Q the new directions of Z, whose columns have a length of about one. @returns E with Z = Q E
MatrixXd Subspace::absorb(MatrixXd& Z) {
  MatrixXd E;
  const Spectrum gram = spectrum(clear(Z, E));
  const Index columns = Z.cols();
  const double largest = columns ? gram.values[columns - 1] : 0;
  Index rest = 0;
  if (!(largest > nothing * nothing)) return E;
  while (gram.values[rest] < thin * largest) ++rest;
  const Index fresh = std::min(columns - rest, Q_.cols() - used_), before = used_;
  if (fresh == 0) return E;
  const MatrixXd V = gram.vectors.rightCols(fresh);
  const MatrixXd U = append(Z, V, gram.values.tail(fresh).cwiseSqrt());
  E.conservativeResize(used_, Eigen::NoChange);
  E.bottomRows(used_ - before) = U * V.transpose();
  if (rest == 0) return E;

  // A Gram matrix is inaccurate for directions this much shorter than the longest: these are orthonormalised again, separately.
  const MatrixXd W = gram.vectors.leftCols(rest);
  MatrixXd left = MatrixXd::Zero(Z.rows(), rest);
  add(1, Z, W, left);
  const MatrixXd e = absorb(left);
  E.conservativeResizeLike(MatrixXd::Zero(used_, columns));
  E.topRows(e.rows()) += e * W.transpose();
  return E;
}

void Subspace::add_loads(const MatrixXd& R) {
  MatrixXd Z = A_.solve(R);
  solves_ += R.cols();
  const VectorXd length = Z.cwiseProduct(product(M_, Z)).colwise().sum().transpose().cwiseMax(0).cwiseSqrt();
  for (Index j = 0; j < Z.cols(); ++j)
    if (length[j] > 0) Z.col(j) /= length[j];
  absorb(Z);
  MQ_.conservativeResize(M_.rows(), filled_);
  const Index fresh = width() - C_.rows();
  C_.conservativeResize(width(), old_);
  C_.bottomRows(fresh).setZero();
}

void Subspace::step() {
  const Index b = width(), start = old_;
  A_.solve_into(MQ_, Z_);
  solves_ += b;
  // First removes what the recurrence predicts for Z; absorb then removes what rounding left.
  MatrixXd H = MatrixXd::Zero(used_, b);
  H.topRows(old_) = C_.transpose();
  H.bottomRows(b) = inner(MQ_, Z_);
  add(-1, Q_.middleCols(coupled_, used_ - coupled_), H.bottomRows(used_ - coupled_), Z_);
  const VectorXd length = H.colwise().norm();
  for (Index j = 0; j < b; ++j) Z_.col(j) /= length[j];

  const Index solved = used_;
  filled_ = 0;
  const MatrixXd E = absorb(Z_) * length.asDiagonal();
  if (filled_ < MQ_.cols()) MQ_.conservativeResize(Eigen::NoChange, filled_);
  H += E.topRows(solved);
  old_ = solved;
  T_.block(0, start, old_, b) = H;
  T_.block(start, 0, b, old_) = H.transpose();
  const MatrixXd own = T_.block(start, start, b, b);
  T_.block(start, start, b, b) = 0.5 * (own + own.transpose());
  C_ = MatrixXd::Zero(width(), old_);
  C_.rightCols(b) = E.bottomRows(width());
  coupled_ = start;
}

// Uses T⁻¹: if there are rigid motions, the wanted values are small in T and would be lost in its rounding.
void Subspace::project() {
  const MatrixXd T = T_.topLeftCorner(old_, old_);
  const Eigen::LLT<MatrixXd> factor(T);
  if (factor.info() == Eigen::Success) {
    const MatrixXd inverse = factor.matrixL().solve(MatrixXd::Identity(old_, old_));
    S_ = spectrum(inner(inverse, inverse)).vectors;
  } else {  // directions of massless degrees of freedom
    S_ = spectrum(T).vectors.rowwise().reverse();
  }
  theta_ = S_.cwiseProduct(T * S_).colwise().sum();
  const Index coupled = old_ - coupled_;
  defect_ = (C_.rightCols(coupled) * S_.bottomRows(coupled)).colwise().norm().transpose().cwiseQuotient(theta_.cwiseAbs());
}

void Subspace::restart(Index keep) {
  turn(Q_.leftCols(old_), S_.leftCols(keep));
  for (Index j = 0; j < width(); ++j) Q_.col(keep + j) = Q_.col(old_ + j);
  C_ = (C_ * S_.leftCols(keep)).eval();
  T_.setZero();
  T_.diagonal().head(keep) = theta_.head(keep);
  used_ += keep - old_;
  old_ = keep;
  coupled_ = 0;
}

MatrixXd Subspace::iterated(Index count) const {
  const MatrixXd S = S_.leftCols(count), turning = C_ * S * theta_.head(count).cwiseInverse().asDiagonal();
  MatrixXd Z = MatrixXd::Zero(Q_.rows(), count);
  add(1, Q_.leftCols(old_), S, Z);
  add(1, Q_.middleCols(old_, width()), turning, Z);
  return Z;
}

}  // namespace pintle
