#pragma once

#include <array>
#include <vector>

#include "framework/component/reduction/modal_model.h"

/// Second-order displacement due to bending, u = Φη + ½ Σ ψ_ij η_i η_j, and the resulting geometric stiffness of loads. Theory:
/// docs/theory/foreshortening.md.
namespace pintle {

/// For each column f of `loads`, the symmetric k × k matrix F(f), F_ij = fᵀψ_ij:
///   F(f) = −ΦᵀK_g(u_f)Φ,
/// where u_f is the static response to f: restrained by the reference conditions (tangent, chord) or, with mean axes, of the body
/// accelerated by f. ½ηᵀFη is the work of f on the second-order displacement of its points when the body bends by Φη, so −F is the
/// geometric stiffness of f. Linear in f; units of f times m/kg. A rigid rim is a rigid piece of the body and shortens as it rotates; loads
/// on its nodes count as acting at its port. Not included: the stress caused by bending itself; the inclination of beams' fibres.
/// @param loads  independent dofs, n × count
/// @throws std::invalid_argument  as reference_condition_rows; `loads` has another number of rows
/// @throws std::runtime_error     parts of the body are not joined, or move without resistance
std::vector<Eigen::MatrixXd> foreshortening(const Component&, const ReferenceConditions&, const ModalModel&, const Eigen::MatrixXd& loads);
/// The same for loads with known static responses. @param u  independent dofs, n × count
std::vector<Eigen::MatrixXd> foreshortening_of_response(const Component&, const ModalModel&, const Eigen::MatrixXd& u);

/// The same for inertia loads, about the origin of the body's axes: the data in FlexInertia. With mean axes S is zero: the mass centre does
/// not move.
/// @param M  nodal, N × N, as for `flex_inertia`
Foreshortening inertia_foreshortening(const Component&, const Sparse& M, const ReferenceConditions&, const ModalModel&);

/// The same for unit forces along x and y at each port [m/kg]: the port's second-order displacement.
std::vector<std::array<Eigen::MatrixXd, 2>> port_foreshortening(const Component&, const ReferenceConditions&, const ModalModel&);

}  // namespace pintle
