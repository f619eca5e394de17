#pragma once

#include <optional>
#include <span>

#include "contact/complementarity.h"

namespace pintle {

/// Forces, or impulses, of rigid contacts as by `unilateral_forces`, solved separately for each set of contacts that affect each other.
/// If all contacts of a set are at rest and can stay closed and stick, they do: for a heap of bodies, both rest and motion may be
/// solutions.
/// @param slipping  tangents of contacts that already slip
/// @returns nothing if no forces are found
std::optional<Eigen::VectorXd> contact_forces(std::span<const UnilateralContact>, const Eigen::MatrixXd& W, const Eigen::VectorXd& c,
                                              std::span<const int> slipping = {});

}  // namespace pintle
