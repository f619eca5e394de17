#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/component/reduction/modal_model.h"

/// Shared by the reductions; not for use elsewhere.
namespace pintle {

/// Sparse orthonormal basis of the motions that tangent or chord conditions permit, n × (n − 3): the dofs that remain free and, at port
/// b of a chord, the direction along it.
/// @pre the conditions are not mean_axes
Sparse permitted_motions(const Component&, const ReferenceConditions&);

/// V plus the rigid motion for each column that makes it satisfy the reference conditions: V − R (BR)⁻¹ B V.
Eigen::MatrixXd meeting_conditions(const Component&, const ReferenceConditions&, const Eigen::MatrixXd& V);

/// Degrees of freedom of ports, in their order.
/// @throws std::invalid_argument  a port does not exist or is named twice
std::vector<int> port_dofs(const FeModel&, const std::vector<int>& ports);

/// The modes selected by `keep`.
struct Modes {
  Eigen::MatrixXd shapes;  ///< n × k, ΦᵀMΦ = I
  Eigen::VectorXd lambda;  ///< > 0, ascending [rad²/s²]
  std::optional<int> sturm;
};
/// Modes of a supported body, whose displacements are u = V y; V has at most one entry per row.
/// @param whose  name in errors: "the body under its reference conditions"
Modes held_modes(const Component&, const Sparse& V, const Keep&, const std::string& whose);
/// Elastic modes of the free body.
Modes elastic_modes(const Component&, const Keep&);

/// Makes the columns of V M-orthonormal one after another; drops a column of which the earlier ones leave at most `share` (of its M-norm).
Eigen::MatrixXd orthonormal(const Sparse& M, const Eigen::MatrixXd& V, double share);
/// Part that a shape must add to the others, relative to its own M-norm: well above rounding, and if such a shape is dropped, a
/// displacement under load loses at most this part of itself.
inline constexpr double least_share = 1e-10;

/// The model of given modes: n × k, M-orthonormal, K-diagonal and satisfying the reference conditions.
ModalModel modal_model(const Component&, const ReferenceConditions&, const Modes&);
/// The model of the span of V, transformed to the reference conditions and made diagonal (Rayleigh and Ritz).
ModalModel diagonalised(const Component&, const ReferenceConditions&, const Eigen::MatrixXd& V, std::optional<int> sturm);

}  // namespace pintle
