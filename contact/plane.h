#pragma once

#include <cmath>

#include <Eigen/Core>

#include "eigen_layout.h"

/// Vectors in the plane.
namespace pintle {

/// Rotated counter-clockwise by the angle with cosine c and sine s.
inline Eigen::Vector2d turned(double c, double s, const Eigen::Vector2d& v) { return {c * v.x() - s * v.y(), s * v.x() + c * v.y()}; }
/// … by an angle [rad].
inline Eigen::Vector2d turned(double angle, const Eigen::Vector2d& v) { return turned(std::cos(angle), std::sin(angle), v); }
/// Rotated counter-clockwise by a right angle, Zv.
inline Eigen::Vector2d perp(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }
/// v × w = (Zv)·w
inline double cross(const Eigen::Vector2d& v, const Eigen::Vector2d& w) { return v.x() * w.y() - v.y() * w.x(); }

}  // namespace pintle
