#pragma once

#include <optional>
#include <span>

#include "contact/complementarity.h"

namespace pintle {

/// Forces, or impulses, of rigid contacts as `unilateral_forces` has them, for each set apart of contacts that move each other. Where
/// all contacts of a set are at rest, and can stay closed and stick, they do: a heap may be able to stand, and to roll apart as well.
/// @param slipping  tangents of contacts that slip already
/// @returns nothing where none are found
std::optional<Eigen::VectorXd> contact_forces(std::span<const UnilateralContact>, const Eigen::MatrixXd& W, const Eigen::VectorXd& c,
                                              std::span<const int> slipping = {});

}  // namespace pintle
