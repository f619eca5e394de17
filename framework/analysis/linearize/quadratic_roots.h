#pragma once

#include <complex>
#include <vector>

#include "framework/analysis/linearize/small_motion.h"

namespace pintle {

/// A root of (λ² M + λ D + K) x = 0, yᴴ (λ² M + λ D + K) = 0; with internal states, the vectors include their part.
struct QuadraticRoot {
  std::complex<double> lambda;  ///< [1/s]
  Eigen::VectorXcd right, left;
  double uncertainty = 0;  ///< of lambda, from rounding of the coefficients [1/s]
  bool zero = false;       ///< zero to rounding
};

/// All 2m + n_x roots, by magnitude. If D is zero and K symmetric, they are those of a symmetric problem, exactly on an axis; otherwise
/// those of the balanced companion matrix by LAPACK. Each is then improved by the quotient of its own quadratic yᴴ(λ² M + λ D + K)x, which
/// keeps slow roots accurate in the presence of fast ones. With internal states they are those computed by LAPACK.
/// @param size  terms summed for the coefficients, without cancellation: defines what counts as rounding
/// @pre M is symmetric positive definite
/// @throws std::runtime_error  M is not, or the iteration for roots does not converge
std::vector<QuadraticRoot> roots_of(const SmallMotion&, const SmallMotion& size);

}  // namespace pintle
