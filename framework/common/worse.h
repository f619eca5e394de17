#pragma once

#include <cmath>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// The greater of two errors, and not a number if either is not: std::max drops a NaN or keeps it by the order of
/// its operands, so that numbers lost would pass as no error.
inline double worse(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

/// Largest magnitude; not a number if any component is not.
template <class Derived>
double largest(const Eigen::MatrixBase<Derived>& v) {
  return v.size() == 0 ? 0 : v.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace pintle
