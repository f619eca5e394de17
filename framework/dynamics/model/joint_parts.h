#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/joint_properties.h"

/// Parts shared by several joints. `row` is the row of a part; L[0] is the block of a, L[1] that of b, d = r_b − r_a.
namespace pintle::joint_parts {

// C = w·d with w fixed relative to a's direction, ẇ = w_a Zw;  Ċ = w·ḋ + w_a (Zw)·d
inline void project(const MarkerMotion& a, const MarkerMotion& b, const Eigen::Vector2d& w, int row, ConstraintRows& out,
                    ConstraintRows::Block* L) {
  const Eigen::Vector2d d = b.r - a.r;
  out.C[row] = w.dot(d);
  L[0].row(row) << -w.x(), -w.y(), perp(w).dot(d);
  L[1].row(row) << w.x(), w.y(), 0;
}
inline double project_kappa(const MarkerMotion& a, const MarkerMotion& b, const Eigen::Vector2d& w) {
  return 2 * a.w * perp(w).dot(b.v - a.v) - a.w * a.w * w.dot(b.r - a.r);
}
// Minus the Hessian of λ w·d. @param i, j  indices of a and b among the ends
inline void project_tangent(const MarkerMotion& a, const MarkerMotion& b, const Eigen::Vector2d& w, double lambda, WrenchTangent& out,
                            int i = 0, int j = 1) {
  const Eigen::Vector2d along = lambda * perp(w);
  const Eigen::Index turns = angle_of(i);
  out.pose.block<2, 1>(place_of(i), turns) += along;
  out.pose.block<1, 2>(turns, place_of(i)) += along.transpose();
  out.pose.block<2, 1>(place_of(j), turns) -= along;
  out.pose.block<1, 2>(turns, place_of(j)) -= along.transpose();
  out.pose(turns, turns) += lambda * w.dot(b.r - a.r);
}

// C = |d| − length;  Ċ = e·ḋ;  C̈ = e·d̈ + (|ḋ|² − (e·ḋ)²)/|d|
inline Eigen::Vector2d direction(const MarkerMotion& a, const MarkerMotion& b) {
  const Eigen::Vector2d d = b.r - a.r;
  const double length = d.norm();
  return length > 0 ? Eigen::Vector2d(d / length) : Eigen::Vector2d(1, 0);
}
inline void keep_length(const MarkerMotion& a, const MarkerMotion& b, double length, int row, ConstraintRows& out,
                        ConstraintRows::Block* L) {
  const Eigen::Vector2d e = direction(a, b);
  out.C[row] = (b.r - a.r).norm() - length;
  L[0].row(row) << -e.x(), -e.y(), 0;
  L[1].row(row) << e.x(), e.y(), 0;
}
inline double keep_length_kappa(const MarkerMotion& a, const MarkerMotion& b) {
  const double across = cross(direction(a, b), b.v - a.v), length = (b.r - a.r).norm();
  return length > 0 ? across * across / length : 0;
}
// The Hessian of |d| with respect to d.
inline Eigen::Matrix2d length_curvature(const MarkerMotion& a, const MarkerMotion& b) {
  const double length = (b.r - a.r).norm();
  if (length == 0) return Eigen::Matrix2d::Zero();
  const Eigen::Vector2d across = perp(direction(a, b));
  return across * across.transpose() / length;
}

}  // namespace pintle::joint_parts
