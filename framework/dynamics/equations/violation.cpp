#include <cmath>

#include "framework/common/worse.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

using Eigen::VectorXd;
using Index = Eigen::Index;

double position_violation(const System& system, const Equations& eq) { return largest(eq.C.cwiseProduct(system.row_scale)); }

double velocity_violation(const System& system, const VectorXd& y, const Equations& eq) {
  if (eq.Cdot.size() == 0) return 0;
  return largest(eq.Cdot.cwiseProduct(system.row_scale)) / fastest_rate(system, y);
}

// Coordinates far from the origin, as in a chain of thousands of links, lose digits as angles of many turns do.
double angle_rounding(const System& system, const VectorXd& y) {
  double most = 0;
  for (Index b = 0; b < system.n_rigid(); b += 3)
    most = worse(most, worse(std::abs(y[b + 2]), y.segment<2>(b).lpNorm<Eigen::Infinity>() / system.length));
  return 1.1e-16 * most;
}

double fastest_rate(const System& system, const VectorXd& y) {
  double fastest = 1e-9;  // slower counts as rest
  const Index n = system.n();
  for (Index i = 0; i < n; ++i) fastest = worse(fastest, std::abs(y[n + i]) / system.scale[i]);
  return fastest;
}

}  // namespace pintle
