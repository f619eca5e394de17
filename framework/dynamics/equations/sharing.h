#pragma once

#include <span>

#include "contact/complementarity.h"

namespace pintle {

/// Singular values of W between unit slips, of its greatest, below which slips count as one.
inline constexpr double one_give = 1e-4;    ///< where feet differ in height by a hundredth, their give decides, not their lever
inline constexpr double one_gap = 1e-8;     ///< gaps are closed to their last digits, not by what these let bodies move
inline constexpr double one_force = 1e-10;  ///< of rigid contacts: a thousand times what W is known to

/// x of W x = rhs, of which Σ x²/capacity is least: where several could hold as well each bears a part after what it holds at most.
/// @param W  responses, symmetric positive semidefinite   @param contacts  rigid ones, by their indices of x: of x that do the same to the
/// motion, one under which these neither pull nor hold more than friction can, where there is one
Eigen::VectorXd share_out(const Eigen::MatrixXd& W, const Eigen::VectorXd& rhs, const Eigen::VectorXd& capacity, double one,
                          std::span<const UnilateralContact> contacts = {});

}  // namespace pintle
