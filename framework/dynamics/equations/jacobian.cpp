#include "framework/dynamics/equations/jacobian.h"

namespace pintle {

void fill_jacobian(const System& system, const Equations& eq, Eigen::MatrixXd& Cq) {
  Cq.setZero(system.n_rows(), system.n());
  visit_jacobian(eq, [&](int row, int column, double value) { Cq(row, column) = value; });
}

Eigen::MatrixXd dense_jacobian(const System& system, const Equations& eq) {
  Eigen::MatrixXd Cq;
  fill_jacobian(system, eq, Cq);
  return Cq;
}

}  // namespace pintle
