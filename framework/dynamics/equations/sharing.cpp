#include "framework/dynamics/equations/sharing.h"

#include <cmath>
#include <limits>

#include "framework/common/dense.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Whether the ratio of the singular values of the 2 × 2 matrix W, scaled to unit slips, is above this: it is at least |det|/‖W‖².
bool are_independent(const MatrixXd& W, double one) {
  const double own = std::abs(W(0, 0) * W(1, 1)), det = W(0, 0) * W(1, 1) - W(0, 1) * W(1, 0);
  return own > 0 && std::abs(det) > one * (2 * own + W(0, 1) * W(0, 1) + W(1, 0) * W(1, 0));
}

VectorXd solution(const MatrixXd& W, const VectorXd& rhs) {
  const double det = W(0, 0) * W(1, 1) - W(0, 1) * W(1, 0);
  return Eigen::Vector2d(W(1, 1) * rhs[0] - W(0, 1) * rhs[1], W(0, 0) * rhs[1] - W(1, 0) * rhs[0]) / det;
}

// Whether all singular values of a matrix with this factorization are surely above `one` of the largest. The condition is estimated to a
// small factor, and not at all for a pivot that is exactly 0; norms differ by up to the size.
bool is_regular(const Eigen::PartialPivLU<MatrixXd>& lu, double one) {
  constexpr double doubt = 100;
  const double least = doubt * static_cast<double>(lu.rows()) * one;
  return lu.matrixLU().diagonal().cwiseAbs().minCoeff() > least && lu.rcond() > least;
}

}  // namespace

VectorXd share_out(const MatrixXd& W, const VectorXd& rhs, const VectorXd& capacity, double one,
                   std::span<const UnilateralContact> contacts) {
  constexpr double least = 1e-9;
  const Index m = rhs.size();
  if (m == 0) return rhs;
  if (m == 1) return W(0, 0) == 0 ? VectorXd(VectorXd::Zero(1)) : VectorXd(rhs / W(0, 0));  // negative where friction jams
  if (m == 2 && are_independent(W, one)) return solution(W, rhs);
  const double most = capacity.maxCoeff();
  const VectorXd weight = most > 0 ? VectorXd(capacity.cwiseMax(least * most).cwiseSqrt()) : VectorXd(VectorXd::Ones(m));
  // The rank is that of W scaled to unit slips; of its solutions, the one of least norm is taken.
  const VectorXd unit = W.diagonal().cwiseAbs().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  const MatrixXd A = unit.asDiagonal() * W * unit.asDiagonal();
  if (const Eigen::PartialPivLU<MatrixXd> lu(A); is_regular(lu, one)) return unit.cwiseProduct(lu.solve(unit.cwiseProduct(rhs)));
  const Eigen::BDCSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Index rank = (svd.singularValues().array() > one * svd.singularValues()[0]).count();
  const MatrixXd rows = svd.singularValues().head(rank).asDiagonal() * svd.matrixV().leftCols(rank).transpose() *
                        unit.cwiseInverse().cwiseProduct(weight).asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> least_norm(rank, m);
  least_norm.compute(rows);
  VectorXd x = weight.cwiseProduct(least_norm.solve(svd.matrixU().leftCols(rank).transpose() * unit.cwiseProduct(rhs)));
  if (contacts.empty() || rank == m) return x;
  // Orthonormal basis, in x/weight, of the forces that change no rate.
  Eigen::HouseholderQR<MatrixXd> basis(m, m - rank);
  basis.compute(unit.cwiseQuotient(weight).asDiagonal() * svd.matrixV().rightCols(m - rank));
  return admissible_forces(contacts, x, weight.asDiagonal() * (basis.householderQ() * MatrixXd::Identity(m, m - rank)));
}

}  // namespace pintle
