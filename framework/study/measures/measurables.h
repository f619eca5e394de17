#pragma once

#include <string>

#include "framework/common/words.h"
#include "framework/scene/scene.h"

namespace pintle {

/// What a measure can be about in this scene.
struct Measurables {
  Names joints, contacts, drivers, loads, bodies, points;
  Names walls;    ///< where something may be touched: joints and contacts
  Names actors;   ///< what has a force
  Names written;  ///< outputs and states of the scene's own
};
Measurables measurables_of(const Scene&);
/// " The scene has the joints …; the bodies …." for messages.
std::string described(const Measurables&);

/// A point of the scene by "BODY.POINT", also if the body was cut into pieces since. Body empty: there is none.
PointRef point_named(const Scene&, const std::string& name);
/// nullptr if there is none.
const SceneBody* body_named(const Scene&, const std::string& name);
const SceneJoint* joint_named(const Scene&, const std::string& name);

}  // namespace pintle
