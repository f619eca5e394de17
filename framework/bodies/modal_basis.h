#pragma once

#include <optional>
#include <set>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/component/reduction/modal_model.h"

namespace pintle {

/// Matrices in independent dofs; G is nodal.
Component component_of(const ElasticBody&);
Sparse skew_mass_of(const ElasticBody&);
/// Index of the named port, without a name the one at the origin; −1: there is none.
int port_of(const ElasticBody&, const std::string& point);
/// The reference conditions requested by the body's `modes`. @pre it has them
/// @throws SceneError  a point does not exist, has no rotation (tangent), or two coincide (chord)
ReferenceConditions reference_conditions_of(const Scene&, const ElasticBody&);
/// "Craig-Bampton, chord frame"
std::string title_of(const SceneModes&);

/// Ports at which joints, contacts, drivers and forces act.
std::set<int> loaded_ports(const Scene&, const ElasticBody&);
/// The same in the body's order; all ports if there are none.
std::vector<int> interface_of(const Scene&, const ElasticBody&);
/// Those of them whose boundary the body's `modes` declare massless: at clearance joints with a contact law.
std::vector<int> massless_ports(const Scene&, const ElasticBody&);
/// The others: the interface of the static shapes.
std::vector<int> shaped_ports(const Scene&, const ElasticBody&);
/// The first `count` shapes.
ModalModel lowest_of(const ModalModel&, Eigen::Index count);

/// The basis requested by the scene's `modes`, with `chosen` as the number of modes for `keep: auto`. @pre the body has them
/// @throws SceneError  an error in the modes, at the scene's `modes`
ModalModel reduce(const Scene&, const ElasticBody&, std::optional<int> chosen = {});
/// Damping ratios at frequencies `omega` from the scene's `damping`, zero without. Rayleigh damping given by ratios is determined at two of
/// the frequencies `basis`, those of the shapes that a mechanism keeps.
/// @throws SceneError  one of the two does not exist, or a ratio is negative
Eigen::VectorXd damping_of(const Scene&, const SceneBody&, const Eigen::VectorXd& omega, const Eigen::VectorXd& basis);

}  // namespace pintle
