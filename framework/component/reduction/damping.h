#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// C = αM + βK gives a shape of frequency ω the ratio ζ = α/2ω + βω/2.
struct Rayleigh {
  double alpha = 0, beta = 0;
};  ///< [1/s], [s]

/// From the desired ratios at two frequencies [rad/s]; the paper's Eqs. (13), (14). Between the two the ratio is lower than desired,
/// outside it is higher; a coefficient may be negative if the ratios differ much, and then `ratios` is negative far enough outside.
/// @throws std::invalid_argument  a frequency is not positive, the two coincide, or a ratio is negative
Rayleigh rayleigh(double omega_1, double zeta_1, double omega_2, double zeta_2);
/// ζ at each ω > 0 [rad/s].
Eigen::VectorXd ratios(const Rayleigh&, const Eigen::VectorXd& omega);

}  // namespace pintle
