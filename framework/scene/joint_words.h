#pragma once

#include <span>
#include <vector>

#include "framework/scene/scene.h"

/// The joints that a scene can have, in one table: their words, what stands beside them, and what they hold of a body.
namespace pintle {

/// A number that stands beside a joint's points.
struct JointNumber {
  enum Of { angle, length, ratio } of;
  const char* key;
  double SceneJoint::*value;
  const char* required = nullptr;  ///< what to write where it is missing: "length: 120 mm"; it is above 0 then
};

struct JointWord {
  JointKind kind;
  const char* word;        ///< its key in a scene, of its list of points
  bool third = false;      ///< may have a third point, else the ground
  bool turns = false;      ///< holds angles of its bodies, whatever their points
  bool guides = false;     ///< along the direction of its first point
  bool clamps = false;     ///< holds the directions of its points to each other
  bool clearance = false;  ///< takes one
  bool friction = false;   ///< likewise
  std::vector<JointNumber> numbers = {};
  std::vector<const char*> couples = {};  ///< keys of SceneCoupling that stand beside it
};

std::span<const JointWord> joint_words();
const JointWord& word_of(const SceneJoint&);

/// The points that a joint joins, in the order of its ends; of a relation of terms one of each body.
std::vector<const PointRef*> points_of(const SceneJoint&);
/// The point that carries a profile, BODY.PROFILE; of a rigid body and the ground the origin.
/// @throws SceneError  a flexible body's profile that no point carries
PointRef carrier_of(const Scene&, const PointRef& profile);

}  // namespace pintle
