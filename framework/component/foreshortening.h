#pragma once

#include <vector>

#include "framework/component/modal_model.h"

/// Geometric stiffness as a displacement: docs/theory/motion.md.
namespace pintle {

/// For each load f (independent freedoms, n × k) the symmetric k_shapes × k_shapes matrix
///   F = −ΦᵀK_g(u_f)Φ,
/// u_f the static response under the tie: mean axes let the body accelerate freely under f. Then
/// ½ηᵀFη is the work of f on what the body's points move at second order when it bends by Φη.
/// @throws std::invalid_argument, std::runtime_error  as tie_rows and solve_static
std::vector<Eigen::MatrixXd> foreshortening(const Component&, const FrameTie&, const ModalModel&,
                                            const Eigen::MatrixXd& loads);

/// The same for the loads of inertia, about the origin of the body's axes: what FlexInertia holds.
Foreshortening inertia_foreshortening(const Component&, const FrameTie&, const ModalModel&);

/// The same for unit forces along x and y at a port.
std::array<Eigen::MatrixXd, 2> port_foreshortening(const Component&, const FrameTie&,
                                                   const ModalModel&, const Port&);

}  // namespace pintle
