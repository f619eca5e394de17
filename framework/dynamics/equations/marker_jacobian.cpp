#include "framework/dynamics/equations/marker_jacobian.h"

#include <algorithm>

namespace pintle {

using Eigen::Index;

MarkerJacobian::MarkerJacobian(const System& system) : J_theta(Eigen::Vector3d::Zero()), V_theta(J_theta) {
  Index most = 0;
  for (const Body& body : system.bodies) most = std::max<Index>(most, body.modes());
  J_eta.setZero(most, 3);
  V_eta.setZero(most, 3);
}

void move(const System& system, const State& state, const Equations& eq, int marker, MarkerJacobian& end) {
  const Marker& m = system.markers[at(marker)];
  end.n = 0;
  if (m.body == ground) return;
  const MarkerMotion& motion = eq.motion[at(marker)];
  const double* s = state.y.data() + system.n() + 3 * m.body;
  end.J_theta << -motion.d.y(), motion.d.x(), 1;
  end.V_theta << s[1] - motion.v.y(), motion.v.x() - s[0], 0;  // Z(v − ṙ)
  end.n = motion.flex.cols();
  if (end.n == 0) return;
  end.J_eta.topLeftCorner(end.n, 2) = motion.flex.transpose();
  end.J_eta.col(2).head(end.n) = m.slope.transpose();
  end.V_eta.col(0).head(end.n) = -s[2] * motion.flex.row(1).transpose();
  end.V_eta.col(1).head(end.n) = s[2] * motion.flex.row(0).transpose();
  if (m.second[0].size() == 0) return;
  const Eigen::Map<const Eigen::VectorXd> rate(state.y.data() + system.n() + system.eta_begin[at(m.body)], end.n);
  const double c = eq.cos_[m.body], sine = eq.sin_[m.body];
  for (Index i = 0; i < end.n; ++i) {
    const double x = m.second[0].col(i).dot(rate), y = m.second[1].col(i).dot(rate);
    end.V_eta(i, 0) += c * x - sine * y;
    end.V_eta(i, 1) += sine * x + c * y;
  }
}

}  // namespace pintle
