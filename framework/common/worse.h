#pragma once

#include <cmath>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// The larger of two errors, and NaN if either is NaN: std::max drops or keeps a NaN depending on the order of its operands, so that
/// invalid numbers would count as no error.
inline double worse(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

/// Largest magnitude; NaN if any component is NaN.
template <class Derived>
double largest(const Eigen::MatrixBase<Derived>& v) {
  return v.size() == 0 ? 0 : v.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace pintle
