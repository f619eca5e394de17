#pragma once

#include <cmath>

#include <Eigen/Core>

/// Vectors of the plane.
namespace pintle {

/// Turned by an angle [rad] counter-clockwise.
inline Eigen::Vector2d turned(double angle, const Eigen::Vector2d& v) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}
/// Turned by a right angle counter-clockwise, Zv.
inline Eigen::Vector2d perp(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }
/// v × w = (Zv)·w
inline double cross(const Eigen::Vector2d& v, const Eigen::Vector2d& w) { return v.x() * w.y() - v.y() * w.x(); }

}  // namespace pintle
