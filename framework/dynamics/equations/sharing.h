#pragma once

#include <span>

#include "contact/complementarity.h"

namespace pintle {

/// Relative singular values of W, scaled to unit slips, below which slips count as dependent.
inline constexpr double one_give = 1e-4;    ///< if feet differ in height by 1 %, their compliance decides, not their lever arm
inline constexpr double one_gap = 1e-8;     ///< gaps are closed to rounding, regardless of how far the bodies can move
inline constexpr double one_force = 1e-10;  ///< of rigid contacts: a thousand times the accuracy of W

/// Solution x of W x = rhs with the least Σ x²/capacity: if several forces can hold together, each bears a share according to its capacity.
/// @param W  responses, symmetric positive semidefinite   @param contacts  rigid contacts, by their indices in x: among solutions x with
/// the same effect on the motion, one is chosen, if it exists, under which these neither pull nor exceed their friction limit
Eigen::VectorXd share_out(const Eigen::MatrixXd& W, const Eigen::VectorXd& rhs, const Eigen::VectorXd& capacity, double one,
                          std::span<const UnilateralContact> contacts = {});

}  // namespace pintle
