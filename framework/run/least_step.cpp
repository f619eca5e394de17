#include "framework/run/least_step.h"

#include <algorithm>

#include <Eigen/CholmodSupport>

namespace pintle {

using Eigen::VectorXd;
using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

VectorXd least_step(const Sparse& J, const VectorXd& W, const VectorXd& r, double mu, int sweeps) {
  Sparse S = J * W.asDiagonal() * J.transpose();
  double trace = 0;
  for (Index i = 0; i < S.rows(); ++i) trace += S.coeff(i, i);
  double shift = std::max(mu * trace / static_cast<double>(std::max<Index>(S.rows(), 1)), 1e-300);
  Sparse I(S.rows(), S.cols());
  I.setIdentity();
  S += shift * I;
  Eigen::CholmodDecomposition<Sparse> solver;
  solver.cholmod().print = 0;
  solver.compute(S);
  for (int i = 0; i < 10 && solver.info() != Eigen::Success; ++i) {  // rounding has eaten the shift
    S += 99 * shift * I;
    shift *= 100;
    solver.compute(S);
  }
  if (solver.info() != Eigen::Success) return VectorXd::Zero(J.cols());
  VectorXd y = VectorXd::Zero(r.size()), x = VectorXd::Zero(J.cols());
  for (int i = 0; i < sweeps; ++i) {
    y += solver.solve(r - J * x);
    x = W.asDiagonal() * (J.transpose() * y);
  }
  return x;
}

}  // namespace pintle
