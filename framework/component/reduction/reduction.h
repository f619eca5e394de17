#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/component/reduction/modal_model.h"

/// What the reductions share; not meant for others.
namespace pintle {

/// Sparse orthonormal basis of the motions that a tangent or chord tie permits, n × (n − 3): the
/// freedoms that stay free and, at port b of a chord, the direction along it.
/// @pre the tie is not mean_axes
Sparse permitted_motions(const Component&, const ReferenceConditions&);

/// V with the rigid motion added to each column that makes it meet the tie: V − R (BR)⁻¹ B V.
Eigen::MatrixXd meeting_conditions(const Component&, const ReferenceConditions&, const Eigen::MatrixXd& V);

/// Freedoms of ports, in their order.
/// @throws std::invalid_argument  a port does not exist or is named twice
std::vector<int> port_freedoms(const FeModel&, const std::vector<int>& ports);

/// Modes as `keep` wants them.
struct Modes {
  Eigen::MatrixXd shapes;  ///< n × k, ΦᵀMΦ = I
  Eigen::VectorXd lambda;  ///< > 0, ascending [rad²/s²]
  std::optional<int> sturm;
};
/// Of a held body, whose displacements are u = V y; V has no more than one entry in a row.
/// @param whose  as errors call it: "the body under its tie"
Modes held_modes(const Component&, const Sparse& V, const Keep&, const std::string& whose);
/// Elastic ones of the free body.
Modes elastic_modes(const Component&, const Keep&);

/// Columns of V made M-orthonormal one after another; one of which the earlier ones leave no more
/// than `share` (of its M-norm) is dropped.
Eigen::MatrixXd orthonormal(const Sparse& M, const Eigen::MatrixXd& V, double share);
/// What a shape must add beside the others, in its own M-norm: well above rounding, and with a
/// shape that is dropped a displacement under load loses no more than this part of itself.
inline constexpr double least_share = 1e-10;

/// The model of given modes: n × k, M-orthonormal, K-diagonal and tied.
ModalModel modal_model(const Component&, const ReferenceConditions&, const Modes&);
/// The model of all that V spans, brought to the tie and made diagonal (Rayleigh and Ritz).
ModalModel diagonalised(const Component&, const ReferenceConditions&, const Eigen::MatrixXd& V, std::optional<int> sturm);

}  // namespace pintle
