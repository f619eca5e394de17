#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// z ≥ 0, M z + q ≥ 0, zᵀ(M z + q) = 0, by Lemke's method [CottlePangStone1992, 4.4].
/// @returns nothing if it ends on a ray: there is no solution, or the method does not find one
std::optional<Eigen::VectorXd> solve_complementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q);

/// A rigid contact among others: its normal force N ≥ 0 and its friction T, |T| ≤ μ(N + preload), as indices of the unknowns.
struct UnilateralContact {
  int normal;            ///< –
  int tangent = -1;      ///< −1: no friction, or it slides
  double mu = 0;         ///< –
  double preload = 0;    ///< part of the normal force outside the unknowns; affects only friction
  int sliding = -1;      ///< for a contact that slides, the column of its friction, which is −direction μN …
  double direction = 0;  ///< … −1 or 1
};

/// Forces, or impulses, x of contacts for which their opening g = W x + c satisfies 0 ≤ N ⊥ g ≥ 0, and their slip, the rows of `tangent`,
/// is 0 where |T| is less than μN and otherwise opposes T. All entries of x have the same unit, as do all of W x: docs/theory/impact.md.
/// @param W  responses, symmetric positive semidefinite   @param c  opening and slip without the forces
/// @returns nothing if none is found, as in Painlevé's paradox
std::optional<Eigen::VectorXd> unilateral_forces(std::span<const UnilateralContact>, const Eigen::MatrixXd& W, const Eigen::VectorXd& c);

/// Among forces x + Z y of holding contacts, which all have the same effect on the motion, those with N ≥ 0, |T| ≤ μN and the least |y|;
/// if none satisfies this, those that violate it least. Continuous in x and Z. @param Z  independent columns
Eigen::VectorXd admissible_forces(std::span<const UnilateralContact>, const Eigen::VectorXd& x, const Eigen::MatrixXd& Z);

}  // namespace pintle
