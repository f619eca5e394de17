#include "framework/dynamics/marker_motion.h"

#include <cmath>

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Modal = Eigen::Map<const VectorXd>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void pose_on_flexible(const System& system, const Marker& marker, const VectorXd& y, double c, double s, MarkerMotion& m) {
  const double* q = y.data() + 3 * marker.body;
  const Modal eta(y.data() + system.eta_begin[at(marker.body)], m.flex.cols());
  Vector2d x = marker.x_BP;
  m.flex = marker.shape;
  for (int k = 0; k < 2; ++k) {
    const Eigen::MatrixXd& F = marker.second[at(k)];
    for (Index i = 0; i < F.cols(); ++i) {
      const double slope = F.col(i).dot(eta);
      m.flex(k, i) += slope;
      x[k] -= 0.5 * slope * eta[i];
    }
  }
  for (Index i = 0; i < m.flex.cols(); ++i) {
    const double along = m.flex(0, i), across = m.flex(1, i);
    x += m.flex.col(i) * eta[i];
    m.flex.col(i) << c * along - s * across, s * along + c * across;
  }
  m.d = {c * x.x() - s * x.y(), s * x.x() + c * x.y()};
  m.r = {q[0] + m.d.x(), q[1] + m.d.y()};
  m.angle = q[2] + marker.angle + marker.slope.dot(eta);
}

void move_on_flexible(const System& system, const Marker& marker, const VectorXd& y, double c, double s, MarkerMotion& m) {
  const Modal rate(y.data() + system.n() + system.eta_begin[at(marker.body)], m.flex.cols());
  const Vector2d drift(m.flex.row(0).dot(rate), m.flex.row(1).dot(rate));
  m.v += drift;
  m.a0 += 2 * m.w * perp(drift);
  if (marker.second[0].size() > 0) {
    Vector2d bend = Vector2d::Zero();
    for (int k = 0; k < 2; ++k)
      for (Index i = 0; i < rate.size(); ++i) bend[k] += marker.second[at(k)].col(i).dot(rate) * rate[i];
    m.a0 += Vector2d(c * bend.x() - s * bend.y(), s * bend.x() + c * bend.y());
  }
  m.w += marker.slope.dot(rate);
}

MovingPoint moving_point(const System& system, int marker, const VectorXd& y) {
  const Marker& m = system.markers[at(marker)];
  if (m.body == ground) return {m.x_BP, Vector2d::Zero(), 0};
  const double* q = y.data() + 3 * m.body;
  const double* s = q + system.n();
  const double c = std::cos(q[2]), d = std::sin(q[2]);
  Vector2d x = m.x_BP, drift = Vector2d::Zero();
  double w = s[2];
  if (const Index n = m.shape.cols(); n > 0) {
    const int begin = system.eta_begin[at(m.body)];
    const Modal eta(y.data() + begin, n), rate(y.data() + system.n() + begin, n);
    for (int k = 0; k < 2; ++k) {
      x[k] += m.shape.row(k).dot(eta);
      drift[k] = m.shape.row(k).dot(rate);
      const Eigen::MatrixXd& F = m.second[at(k)];
      for (Index i = 0; i < F.cols(); ++i) {
        x[k] += 0.5 * F.col(i).dot(eta) * eta[i];
        drift[k] += F.col(i).dot(eta) * rate[i];
      }
    }
    w += m.slope.dot(rate);
  }
  const Vector2d arm(c * x.x() - d * x.y(), d * x.x() + c * x.y());
  return {Vector2d(q[0], q[1]) + arm,
          Vector2d(s[0], s[1]) + s[2] * perp(arm) + Vector2d(c * drift.x() - d * drift.y(), d * drift.x() + c * drift.y()), w};
}

}  // namespace pintle
