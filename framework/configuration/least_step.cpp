#include "framework/configuration/least_step.h"

#include <algorithm>
#include <new>

#include <Eigen/CholmodSupport>

namespace pintle {

using Eigen::VectorXd;

namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

thread_local bool out_of_memory;
// CHOLMOD may go on with another ordering, whose result differs in its last digits, and then forgets that it lacked memory.
void remember(int status, const char*, int, const char*) { out_of_memory = out_of_memory || status == CHOLMOD_OUT_OF_MEMORY; }
void require_memory() {
  if (out_of_memory) throw std::bad_alloc();
}

void factor(Eigen::CholmodDecomposition<Sparse>& solver, const Sparse& S) {
  solver.analyzePattern(S);
  require_memory();  // Eigen's factorize takes the analysis for granted
  solver.factorize(S);
  require_memory();
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
  Eigen::CholmodDecomposition<Sparse> solver;
  solver.cholmod().print = 0;
  solver.cholmod().error_handler = remember;
  out_of_memory = false;
  factor(solver, S);
  for (int i = 0; i < 10 && solver.info() != Eigen::Success; ++i) {  // rounding has eaten the shift
    S += 99 * shift * I;
    shift *= 100;
    factor(solver, S);
  }
  if (solver.info() != Eigen::Success) return VectorXd::Zero(J.cols());
  VectorXd y = VectorXd::Zero(r.size()), x = VectorXd::Zero(J.cols());
  for (int i = 0; i < sweeps; ++i) {
    y += solver.solve(r - J * x);
    require_memory();
    x = W.asDiagonal() * (J.transpose() * y);
  }
  return x;
}

}  // namespace pintle
