#include "framework/configuration/least_step.h"

#include <algorithm>
#include <vector>

#include "framework/common/index.h"
#include "framework/dynamics/solvers/sparse_ldl.h"

namespace pintle {

using Eigen::VectorXd;

VectorXd least_step(const Eigen::SparseMatrix<double>& J, const VectorXd& W, const VectorXd& r, double mu, int sweeps) {
  const Eigen::SparseMatrix<double> S = J * W.asDiagonal() * J.transpose();
  const int n = static_cast<int>(S.rows());
  std::vector<Pattern::Place> places;
  std::vector<double> entries;
  double trace = 0;
  for (int c = 0; c < n; ++c) {
    places.push_back({c, c});  // so that it is there where S has none
    entries.push_back(0);
    for (Eigen::SparseMatrix<double>::InnerIterator e(S, c); e; ++e) {
      if (e.row() < c) continue;
      places.push_back({static_cast<int>(e.row()), c});
      entries.push_back(e.value());
      if (e.row() == c) trace += e.value();
    }
  }
  std::vector<int> where;
  SparseLdl solver(n, places, where);
  std::vector<double> values(at(solver.entries()));
  for (std::size_t k = 0; k < entries.size(); ++k) values[at(where[k])] += entries[k];
  const auto add_to_diagonal = [&](double shift) {
    for (int d : solver.diagonal()) values[at(d)] += shift;
  };
  double shift = std::max(mu * trace / std::max(n, 1), 1e-300);
  add_to_diagonal(shift);
  bool positive = solver.factor(values) > 0;
  for (int i = 0; i < 10 && !positive; ++i) {  // the shift was lost in rounding
    add_to_diagonal(99 * shift);
    shift *= 100;
    positive = solver.factor(values) > 0;
  }
  if (!positive) return VectorXd::Zero(J.cols());
  VectorXd y = VectorXd::Zero(r.size()), x = VectorXd::Zero(J.cols()), step;
  for (int i = 0; i < sweeps; ++i) {
    step = r - J * x;
    solver.solve(step.data());
    y += step;
    x = W.asDiagonal() * (J.transpose() * y);
  }
  return x;
}

}  // namespace pintle
