#include "framework/configuration/branching.h"

#include <utility>

#include "framework/common/index.h"
#include "framework/configuration/least_step.h"
#include "framework/configuration/row_space.h"

namespace pintle {

using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

void close_in(Closure& closure, const System& system, const VectorXd& W, VectorXd& y, VectorXd& C, Sparse& J) {
  constexpr double near = 1e-4, rounding = 4e-16, far = 1e-3;
  Equations eq(system);
  for (int i = 0; i < 20 && C.size() > 0 && C.lpNorm<Eigen::Infinity>() > rounding; ++i) {
    pose(system, 0, y, eq);
    if (i == 0 && row_space(system, eq, near).dependences.empty()) return;
    const VectorXd step = least_step(J, W, -C, 1e-18, 2), from = y.head(system.n());
    if (!step.allFinite() || step.cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>() > far) return;
    bool better = false;
    for (const double times : {2.0, 1.0}) {
      y.head(system.n()) = from + times * step;
      const VectorXd C_trial = closure.violation(y);
      better = C_trial.norm() < 0.7 * C.norm();
      if (better) break;
    }
    if (!better) y.head(system.n()) = from;
    C = closure.violation(y, &J);
    if (!better) return;
  }
}

bool choose_branch(Closure& closure, const System& system, const Sparse& J, const std::vector<Dependence>& singular, const VectorXd& W,
                   VectorXd& y) {
  const Eigen::Index n = system.n(), count = static_cast<Eigen::Index>(singular.size());
  const auto bend = [&](Sparse& G, VectorXd& g) {
    const VectorXd s = y.segment(n, n);
    const double rate = s.cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>();
    if (rate == 0) return 0.0;
    const double step = 1e-4 / rate;
    Equations eq(system);
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd change = VectorXd::Zero(system.n_rows());
    std::vector<std::vector<std::pair<Eigen::Index, double>>> of_row(at(system.n_rows()));
    for (Eigen::Index d = 0; d < count; ++d)
      for (const auto& [row, weight] : singular[static_cast<std::size_t>(d)].N)
        of_row[at(row)].emplace_back(d, weight * system.row_scale[row]);
    for (double sign : {-1.0, 1.0}) {
      VectorXd to = y;
      to.head(n) += sign * step * s;
      pose(system, sign * step, to, eq);
      speed(system, sign * step, to, eq);
      change += sign / (2 * step) * eq.Cdot;
      visit_jacobian(eq, [&](int row, int column, double value) {
        for (const auto& [d, weight] : of_row[at(row)])
          entries.emplace_back(static_cast<int>(J.rows() + d), column, sign * weight * value / (step * rate));
      });
    }
    for (Eigen::Index c = 0; c < J.outerSize(); ++c)
      for (Sparse::InnerIterator it(J, c); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(it.col()), it.value());
    G.resize(J.rows() + count, n);
    G.setFromTriplets(entries.begin(), entries.end());
    g.setZero(J.rows() + count);
    g.head(J.rows()) = closure.drift(y);
    for (std::size_t row = 0; row < of_row.size(); ++row)
      for (const auto& [d, weight] : of_row[row]) g[J.rows() + d] += weight * change[static_cast<Eigen::Index>(row)] / rate;
    return rate;
  };
  Sparse G;
  VectorXd g;
  for (int i = 0; i < 60; ++i) {
    const double rate = bend(G, g);
    if (g.size() == 0 || g.lpNorm<Eigen::Infinity>() <= 1e-7 * rate) return true;
    const double before = g.norm();
    const VectorXd step = least_step(G, W, -g, i == 0 ? 1e-6 : 1e-12, i == 0 ? 1 : 4), from = y.segment(n, n);
    double part = 1;
    for (; part > 1e-3; part /= 2) {
      y.segment(n, n) = from + part * step;
      bend(G, g);
      if (g.norm() < before) break;
    }
  }
  return false;
}

}  // namespace pintle
