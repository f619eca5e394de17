#pragma once

#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "eigen_layout.h"
#include "framework/dynamics/model/wrench_tangent.h"

/// States of a law beyond the motion: the deflection of a damper or of a bristle, the output of a controller. Its owner defines the number
/// of states x and their rates, ẋ = g(p, ṗ, x, t); they are integrated with the motion, with their own error scale, and are not part of the
/// energy balance. Theory: docs/theory/internal_states.md.
namespace pintle {

inline constexpr int most_internal = 2;  ///< internal states of one owner

/// An internal state, named as in results.
struct InternalState {
  const char *name, *unit;
  double scale;  ///< scale of its errors; 0: that of lengths
};

using InternalVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_internal, 1>;
using InternalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_internal, most_internal>;

/// Derivatives of the wrenches with respect to x, and of g with respect to the poses, their rates and x.
struct InternalTangent {
  using Column = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3 * most_ends, most_internal>;
  using Row = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_internal, 3 * most_ends>;
  Column wrench;
  Row g_pose, g_rate;
  InternalMatrix g_x;
  InternalTangent(int markers, int states)
      : wrench(Column::Zero(3 * markers, states)),
        g_pose(Row::Zero(states, 3 * markers)),
        g_rate(g_pose),
        g_x(InternalMatrix::Zero(states, states)) {}
  Eigen::Index n() const { return g_x.rows(); }
};

/// The weight for internal states at rest: ẋ = 0.
inline constexpr double internal_at_rest = std::numeric_limits<double>::infinity();

/// (1/weight − g_x)⁻¹ r: the change of x in x = base + weight g when g changes by r. Zero where g at rest does not depend on x.
inline InternalVector internal_change(const InternalMatrix& g_x, double weight, const InternalVector& r) {
  const InternalMatrix inverse = (InternalMatrix::Identity(g_x.rows(), g_x.cols()) / weight - g_x).inverse();
  return inverse.allFinite() ? InternalVector(inverse * r) : InternalVector(InternalVector::Zero(g_x.rows()));
}

/// Adds the effect of x = base + weight g(p, ṗ, x) on the wrenches: their tangent with x following the motion instead of being held.
inline void condense(const InternalTangent& of, double weight, WrenchTangent& out) {
  for (Eigen::Index i = 0; i < of.g_pose.cols(); ++i) {
    out.pose.col(i) += of.wrench * internal_change(of.g_x, weight, of.g_pose.col(i));
    out.rate.col(i) += of.wrench * internal_change(of.g_x, weight, of.g_rate.col(i));
  }
}

}  // namespace pintle
