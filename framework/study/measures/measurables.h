#pragma once

#include <string>

#include "framework/common/words.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Names that a measure may refer to in this scene.
struct Measurables {
  Names joints, contacts, drivers, loads, bodies, points;
  Names walls;    ///< elements with contact: joints and contacts
  Names actors;   ///< elements with a force
  Names written;  ///< outputs, and states of the scene's own
};
Measurables measurables_of(const Scene&);
/// " The scene has the joints …; the bodies …." for messages.
std::string described(const Measurables&);

/// A point of the scene by "BODY.POINT", even if the body has been divided into pieces. Empty body: there is none.
PointRef point_named(const Scene&, const std::string& name);
/// nullptr if there is none.
const SceneBody* body_named(const Scene&, const std::string& name);
const SceneJoint* joint_named(const Scene&, const std::string& name);

}  // namespace pintle
