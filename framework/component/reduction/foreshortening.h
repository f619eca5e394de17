#pragma once

#include <array>
#include <vector>

#include "framework/component/reduction/modal_model.h"

/// What bending adds to displacement at second order, u = Φη + ½ Σ ψ_ij η_i η_j, and with it the
/// geometric stiffness of loads. Theory: docs/theory/foreshortening.md.
namespace pintle {

/// For each column f of `loads` the symmetric k × k matrix F(f), F_ij = fᵀψ_ij:
///   F(f) = −ΦᵀK_g(u_f)Φ,
/// u_f the static response to f: held by the tie (tangent, chord) or, under mean axes, of the body
/// that f accelerates. ½ηᵀFη is the work of f on what its points move at second order when the body
/// bends by Φη, so that −F is the geometric stiffness of f. Linear in f; units of f times m/kg.
/// A rigid rim is a rigid piece of the body and shortens with its turn; loads on its nodes count as
/// at its port. Not in it: the stress that bending itself causes; the tilt of beams' fibres.
/// @param loads  independent freedoms, n × count
/// @throws std::invalid_argument  as reference_condition_rows; `loads` has another number of rows
/// @throws std::runtime_error     parts of the body are not joined, or move without resistance
std::vector<Eigen::MatrixXd> foreshortening(const Component&, const ReferenceConditions&, const ModalModel&, const Eigen::MatrixXd& loads);
/// The same of loads whose static responses are known. @param u  independent freedoms, n × count
std::vector<Eigen::MatrixXd> foreshortening_of_response(const Component&, const ModalModel&, const Eigen::MatrixXd& u);

/// The same for the loads of inertia, about the origin of the body's axes: what FlexInertia holds.
/// Under mean axes S is zero: there the mass centre stays where it is.
/// @param M  nodal, N × N, as `flex_inertia` is given it
Foreshortening inertia_foreshortening(const Component&, const Sparse& M, const ReferenceConditions&, const ModalModel&);

/// The same for unit forces along x and y at each port [m/kg]: its displacement at second order.
std::vector<std::array<Eigen::MatrixXd, 2>> port_foreshortening(const Component&, const ReferenceConditions&, const ModalModel&);

}  // namespace pintle
