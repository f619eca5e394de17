#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/body_reduction.h"
#include "framework/component/reduction/modal_model.h"
#include "framework/dynamics/model/system.h"

namespace pintle {

/// A body of elements as used in a mechanism: reduced to a few shapes if the scene has `modes`, otherwise rigid. It is as large as the
/// finite-element model, and is discarded once the mechanism is built, unless the body is drawn.
struct MechanismBody {
  ElasticBody elastic;
  ReferenceConditions conditions;
  ModalModel modes;                                    ///< without shapes: rigid
  Body body;                                           ///< mass, inertia, invariants about the mass centre
  Eigen::Vector2d centre;                              ///< mass centre, undeformed, body axes [m]
  std::vector<std::array<Eigen::MatrixXd, 2>> second;  ///< of each port, for a body with geometric stiffness
  CoveredCompliance compliance;
  std::vector<FreeCompliance> when_free;  ///< of each port
  CoveredInertia inertia_covered;
  std::vector<Eigen::MatrixXd> by_load;  ///< foreshortening for each of `loads_on`, on the lowest shapes
  std::vector<std::string> warnings;
};

/// @throws SceneError  the body has no moment of inertia about its mass centre
void validate_inertia(const Scene&, const ElasticBody&);

/// @throws SceneError  as damping_of; no moment of inertia; shapes that leave no inertia to the frame
MechanismBody mechanism_body(const Scene&, ElasticBody, Reduction);
/// The same, computing its reduction. @throws SceneError  also as reduction_of
MechanismBody mechanism_body(const Scene&, ElasticBody, std::optional<int> chosen = {});

/// The marker of a named point; without a name, of the point at the origin.
/// @param turns  whether a direction is needed there
/// @throws SceneError  no such point; no point at the origin; a point of a plate, which has no direction
Marker marker_of(const Scene&, const MechanismBody&, int body, const PointRef&, bool turns);

/// Modal coordinates of a body that starts deformed: as given, or those of least strain energy for the given displacements.
/// @throws SceneError  more coordinates than shapes; a displacement that the shapes cannot represent (the message gives the nearest one)
Eigen::VectorXd bent_start(const Scene&, const MechanismBody&, const StartBody&);

}  // namespace pintle
