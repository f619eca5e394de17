#include "framework/integration/constraints.h"

#include <Eigen/QR>

namespace pintle {

using Index = Eigen::Index;

namespace {

void fill_jacobian(const System& system, const Equations& eq, Eigen::MatrixXd& Cq) {
  Cq.setZero(system.n_rows(), system.n());
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const int row = system.row_begin[k], m = system.row_begin[k + 1] - row;
    const auto place = [&](int marker, std::size_t side) {
      const int body = system.markers[static_cast<std::size_t>(marker)].body;
      if (body != ground) Cq.block(row, 3 * body, m, 3) = eq.B[side].topRows(m);
    };
    place(marker_a(system.joints[k]), 2 * k);
    place(marker_b(system.joints[k]), 2 * k + 1);
  }
}

}  // namespace

Eigen::MatrixXd dense_jacobian(const System& system, const Equations& eq) {
  Eigen::MatrixXd Cq;
  fill_jacobian(system, eq, Cq);
  return Cq;
}

void Partition::assemble(const System& system, const Equations& eq) {
  fill_jacobian(system, eq, Cq_);
  Cq_ = system.row_scale.asDiagonal() * Cq_;
  for (Index i = 0; i < Cq_.cols(); ++i)
    if (i % 3 != 2) Cq_.col(i) *= system.length;
}

void Partition::choose(const System& system, const Equations& eq) {
  assemble(system, eq);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Cq_);
  block_.resize(system.n_rows(), system.n_rows());
  step_.resize(system.n_rows());
  dependent_.clear();
  for (Index i = 0; i < system.n_rows(); ++i)
    dependent_.push_back(static_cast<int>(qr.colsPermutation().indices()[i]));
  factor();
  chosen_quality_ = quality_;
  ++choices_;
}

void Partition::factor() {
  for (std::size_t i = 0; i < dependent_.size(); ++i)
    block_.col(static_cast<Index>(i)) = Cq_.col(dependent_[i]);
  lu_.compute(block_);
  quality_ = block_.size() == 0 ? 1 : lu_.matrixLU().diagonal().cwiseAbs().minCoeff();
}

// q or s, as `y` points to, −= scaled solution of block · x = violation
void Partition::subtract(const System& system, const Eigen::VectorXd& violation, double* y) {
  step_ = lu_.solve(violation.cwiseProduct(system.row_scale));
  for (std::size_t k = 0; k < dependent_.size(); ++k)
    y[dependent_[k]] -= step_[static_cast<Index>(k)] * (dependent_[k] % 3 == 2 ? 1 : system.length);
}

bool Partition::correct(const System& system, double t, Eigen::VectorXd& y, Equations& eq) {
  const auto factored = [&] {
    assemble(system, eq);
    factor();
    return true;
  };
  const auto take = [&](const Eigen::VectorXd& violation, double* x) { subtract(system, violation, x); };
  if (!onto_constraints(system, t, y, eq, factored, take)) return false;
  pintle::factor(system, eq);
  return eq.regular;
}

}  // namespace pintle
