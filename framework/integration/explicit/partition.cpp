#include "framework/integration/explicit/partition.h"

#include "framework/common/dense.h"
#include "framework/dynamics/equations/jacobian.h"

namespace pintle {

using Index = Eigen::Index;

void Partition::assemble(const System& system, const Equations& eq) {
  fill_jacobian(system, eq, Cq_);
  Cq_ = system.row_scale.asDiagonal() * Cq_;
  Cq_ *= system.scale.asDiagonal();
}

void Partition::choose(const System& system, const Equations& eq) {
  assemble(system, eq);
  Eigen::MatrixXd wanted = Cq_;  // shapes follow from the frame, not the frame from shapes
  wanted.rightCols(system.n() - system.n_rigid()) *= 1e-3;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(wanted.rows(), wanted.cols());
  qr.setThreshold(1e-7);
  qr.compute(wanted);
  step_.resize(qr.rank());
  dependent_.clear();
  for (Index i = 0; i < qr.rank(); ++i) dependent_.push_back(static_cast<int>(qr.colsPermutation().indices()[i]));
  factor();
  released_ = eq.released;
  chosen_quality_ = quality_;
  ++choices_;
}

bool Partition::fits(const System& system) const {
  std::vector<bool> taken(static_cast<std::size_t>(system.n()), false);
  for (const int i : dependent_) {
    if (i < 0 || i >= system.n() || taken[static_cast<std::size_t>(i)]) return false;
    taken[static_cast<std::size_t>(i)] = true;
  }
  return dependent_.size() <= static_cast<std::size_t>(system.n_rows());
}

void Partition::factor() {
  block_.resize(Cq_.rows(), static_cast<Index>(dependent_.size()));
  for (std::size_t i = 0; i < dependent_.size(); ++i) block_.col(static_cast<Index>(i)) = Cq_.col(dependent_[i]);
  if (block_.size() == 0) {
    quality_ = 1;
  } else if (block_.rows() == block_.cols()) {
    lu_.compute(block_);
    quality_ = lu_.matrixLU().diagonal().cwiseAbs().minCoeff();
  } else {
    qr_.compute(block_);
    quality_ = qr_.matrixQR().diagonal().cwiseAbs().minCoeff();
  }
}

// subtracts the scaled solution of block · x = violation from y, which points to q or s
double Partition::subtract(const System& system, const Eigen::VectorXd& violation, double* y) {
  if (block_.rows() == block_.cols())
    step_ = lu_.solve(violation.cwiseProduct(system.row_scale));
  else
    step_ = qr_.solve(violation.cwiseProduct(system.row_scale));
  for (std::size_t k = 0; k < dependent_.size(); ++k) y[dependent_[k]] -= step_[static_cast<Index>(k)] * system.scale[dependent_[k]];
  return step_.size() == 0 ? 0 : step_.lpNorm<Eigen::Infinity>();
}

bool Partition::correct(const System& system, double t, Eigen::VectorXd& y, Equations& eq) {
  const auto factored = [&] {
    assemble(system, eq);
    factor();
    return true;
  };
  const auto take = [&](const Eigen::VectorXd& violation, double* x) { return subtract(system, violation, x); };
  if (!onto_constraints(system, t, y, eq, factored, take)) return false;
  pintle::factor(system, y, eq);
  return eq.regular;
}

}  // namespace pintle
