#include "framework/configuration/least_step.h"

#include <algorithm>

#include <Eigen/CholmodSupport>

#include "framework/common/suitesparse_memory.h"

namespace pintle {

using Eigen::VectorXd;

namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

void factor(Eigen::CholmodDecomposition<Sparse>& solver, const Sparse& S, const SuiteSparseMemory& memory) {
  solver.analyzePattern(S);
  memory.require();  // Eigen's factorize assumes that the analysis succeeded
  solver.factorize(S);
  memory.require();
}

}  // namespace

VectorXd least_step(const Sparse& J, const VectorXd& W, const VectorXd& r, double mu, int sweeps) {
  Sparse S = J * W.asDiagonal() * J.transpose();
  double trace = 0;
  for (Index i = 0; i < S.rows(); ++i) trace += S.coeff(i, i);
  double shift = std::max(mu * trace / static_cast<double>(std::max<Index>(S.rows(), 1)), 1e-300);
  Sparse I(S.rows(), S.cols());
  I.setIdentity();
  S += shift * I;
  const SuiteSparseMemory memory;
  Eigen::CholmodDecomposition<Sparse> solver;
  solver.cholmod().print = 0;
#ifdef PINTLE_WITHOUT_GPL
  solver.setMode(Eigen::CholmodSimplicialLLt);
#endif
  factor(solver, S, memory);
  for (int i = 0; i < 10 && solver.info() != Eigen::Success; ++i) {  // the shift was lost in rounding
    S += 99 * shift * I;
    shift *= 100;
    factor(solver, S, memory);
  }
  if (solver.info() != Eigen::Success) return VectorXd::Zero(J.cols());
  VectorXd y = VectorXd::Zero(r.size()), x = VectorXd::Zero(J.cols());
  for (int i = 0; i < sweeps; ++i) {
    y += solver.solve(r - J * x);
    memory.require();
    x = W.asDiagonal() * (J.transpose() * y);
  }
  return x;
}

}  // namespace pintle
