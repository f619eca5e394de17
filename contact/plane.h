#pragma once

#include <cmath>

#include <Eigen/Core>

#include "eigen_layout.h"

/// Vectors of the plane.
namespace pintle {

/// Turned counter-clockwise by the angle whose cosine and sine are c and s.
inline Eigen::Vector2d turned(double c, double s, const Eigen::Vector2d& v) { return {c * v.x() - s * v.y(), s * v.x() + c * v.y()}; }
/// … by an angle [rad].
inline Eigen::Vector2d turned(double angle, const Eigen::Vector2d& v) { return turned(std::cos(angle), std::sin(angle), v); }
/// Turned by a right angle counter-clockwise, Zv.
inline Eigen::Vector2d perp(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }
/// v × w = (Zv)·w
inline double cross(const Eigen::Vector2d& v, const Eigen::Vector2d& w) { return v.x() * w.y() - v.y() * w.x(); }

}  // namespace pintle
