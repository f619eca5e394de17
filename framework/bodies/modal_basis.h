#pragma once

#include <optional>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/component/reduction/modal_model.h"

namespace pintle {

/// Matrices in independent freedoms; G is nodal.
Component component_of(const ElasticBody&);
Sparse skew_mass_of(const ElasticBody&);
/// Index of the named port, without a name of the one at the origin; −1: there is none.
int port_of(const ElasticBody&, const std::string& point);
/// The frame that the body's `modes` ask for. @pre it has them
/// @throws SceneError  a point is not there, cannot turn (tangent), or two coincide (chord)
ReferenceConditions reference_conditions_of(const Scene&, const ElasticBody&);
/// "Craig-Bampton, chord frame"
std::string title_of(const SceneModes&);

/// Ports that joints, drivers and forces take hold of, in the body's order; all where nothing does.
std::vector<int> interface_of(const Scene&, const ElasticBody&);
/// The first `count` shapes.
ModalModel lowest_of(const ModalModel&, Eigen::Index count);

/// The basis that the scene's `modes` ask for, with `chosen` of the modes they count where they say
/// `keep: auto`. @pre the body has them
/// @throws SceneError  what is wrong with the modes, at the scene's `modes`
ModalModel reduce(const Scene&, const ElasticBody&, std::optional<int> chosen = {});
/// Damping ratios at frequencies `omega` by the scene's `damping`, zero without. Rayleigh damping that is given by
/// ratios is set by two of the frequencies `basis`, those of the shapes that a mechanism keeps.
/// @throws SceneError  one of the two is not there, or a ratio comes out negative
Eigen::VectorXd damping_of(const Scene&, const SceneBody&, const Eigen::VectorXd& omega, const Eigen::VectorXd& basis);

}  // namespace pintle
