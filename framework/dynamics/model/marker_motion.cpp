#include "framework/dynamics/model/marker_motion.h"

#include <cmath>

#include "framework/common/index.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Modal = Eigen::Map<const VectorXd>;

/// Displacement per modal coordinate i in the current configuration, body axes; subtracts from x the part that the square of η_i counts
/// twice.
Vector2d shape_at(const Marker& marker, Index i, const Modal& eta, Vector2d& x) {
  Vector2d f = marker.shape.col(i);
  for (int k = 0; k < 2; ++k) {
    const Eigen::MatrixXd& F = marker.second[at(k)];
    if (F.cols() == 0) continue;
    const double slope = F.col(i).dot(eta);
    f[k] += slope;
    x[k] -= 0.5 * slope * eta[i];
  }
  return f;
}

}  // namespace

void pose_on_flexible(const System& system, const Marker& marker, const VectorXd& y, double c, double s, MarkerMotion& m) {
  const double* q = y.data() + 3 * marker.body;
  const Modal eta(y.data() + system.eta_begin[at(marker.body)], m.flex.cols());
  Vector2d x = marker.x_BP;
  for (Index i = 0; i < m.flex.cols(); ++i) {
    const Vector2d f = shape_at(marker, i, eta, x);
    x += f * eta[i];
    m.flex.col(i) = turned(c, s, f);
  }
  m.d = turned(c, s, x);
  m.r = {q[0] + m.d.x(), q[1] + m.d.y()};
  m.angle = q[2] + marker.angle + marker.slope.dot(eta);
}

void move_on_flexible(const System& system, const Marker& marker, const VectorXd& y, double c, double s, MarkerMotion& m) {
  const Modal rate(y.data() + system.n() + system.eta_begin[at(marker.body)], m.flex.cols());
  Vector2d drift = Vector2d::Zero();
  for (Index i = 0; i < rate.size(); ++i) drift += m.flex.col(i) * rate[i];
  m.v += drift;
  m.a0 += 2 * m.w * perp(drift);
  if (marker.second[0].size() > 0) {
    Vector2d bend = Vector2d::Zero();
    for (int k = 0; k < 2; ++k)
      for (Index i = 0; i < rate.size(); ++i) bend[k] += marker.second[at(k)].col(i).dot(rate) * rate[i];
    m.a0 += turned(c, s, bend);
  }
  m.w += marker.slope.dot(rate);
}

// Same order of operations as in the two functions above and in `pose` and `speed`, so that both give a gap identical to the last bit.
MovingPoint moving_point(const System& system, int marker, const VectorXd& y) {
  const Marker& m = system.markers[at(marker)];
  if (m.body == ground) return {m.x_BP, Vector2d::Zero(), 0, m.angle};
  const double* q = y.data() + 3 * m.body;
  const double* s = q + system.n();
  const double c = std::cos(q[2]), d = std::sin(q[2]);
  Vector2d x = m.x_BP, drift = Vector2d::Zero();
  double w = s[2], angle = q[2] + m.angle;
  if (const Index n = m.shape.cols(); n > 0) {
    const int begin = system.eta_begin[at(m.body)];
    const Modal eta(y.data() + begin, n), rate(y.data() + system.n() + begin, n);
    for (Index i = 0; i < n; ++i) {
      const Vector2d f = shape_at(m, i, eta, x);
      x += f * eta[i];
      drift += turned(c, d, f) * rate[i];
    }
    w += m.slope.dot(rate);
    angle += m.slope.dot(eta);
  }
  const Vector2d arm = turned(c, d, x);
  return {Vector2d(q[0] + arm.x(), q[1] + arm.y()), Vector2d(s[0] - s[2] * arm.y(), s[1] + s[2] * arm.x()) + drift, w, angle};
}

}  // namespace pintle
