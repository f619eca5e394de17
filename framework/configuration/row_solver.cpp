#include "framework/configuration/row_solver.h"

#include "framework/common/dense.h"
#include "framework/configuration/least_step.h"

namespace pintle {

using Eigen::VectorXd;

namespace {
constexpr double damping = 1e-12;  // for least squares by normal equations; the sweeps remove its effect
constexpr int sweeps = 6;
}  // namespace

void RowSolver::factor(const System& system, const Equations& eq) {
  dense_ = system.n() <= dense_size;
  if (dense_) {
    D_.setZero(system.n_rows(), system.n());
    visit_jacobian(eq, [&](int row, int column, double value) { D_(row, column) += system.row_scale[row] * value * system.scale[column]; });
    cod_.setThreshold(singular);
    cod_.compute(D_);
    rank_ = cod_.rank();
    return;
  }
  std::vector<Eigen::Triplet<double>> entries;
  visit_jacobian(eq, [&](int row, int column, double value) {
    entries.emplace_back(row, column, system.row_scale[row] * value * system.scale[column]);
  });
  A_.resize(system.n_rows(), system.n());
  A_.setFromTriplets(entries.begin(), entries.end());
  At_ = A_.transpose();
}

VectorXd RowSolver::solve(const System& system, const VectorXd& r) const {
  const VectorXd b = system.row_scale.cwiseProduct(r);
  const VectorXd x = dense_ ? VectorXd(cod_.solve(b)) : least_step(A_, VectorXd::Ones(A_.cols()), b, damping, sweeps);
  return system.scale.cwiseProduct(x);
}

VectorXd RowSolver::reactions(const System& system, const VectorXd& g) const {
  const VectorXd b = system.scale.cwiseProduct(g);
  const VectorXd x = dense_ ? VectorXd(cod_.transpose().solve(b)) : least_step(At_, VectorXd::Ones(At_.cols()), b, damping, sweeps);
  return system.row_scale.cwiseProduct(x);
}

VectorXd RowSolver::times(const System& system, const VectorXd& x) const {
  const VectorXd scaled = x.cwiseQuotient(system.scale);
  return (dense_ ? VectorXd(D_ * scaled) : VectorXd(A_ * scaled)).cwiseQuotient(system.row_scale);
}

}  // namespace pintle
