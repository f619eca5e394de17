#pragma once

#include <span>
#include <vector>

#include "framework/scene/scene.h"

/// A table of the joints that a scene can have: their keywords, the keys allowed with them, and what they fix of a body.
namespace pintle {

/// A number given with a joint's points.
struct JointNumber {
  enum Of { angle, length, ratio } of;  ///< a new kind: `dimension_of` in yaml/reader_joints.cpp
  const char* key;
  double SceneJoint::*value;
  const char* required = nullptr;  ///< example for a message if it is missing: "length: 120 mm"; the number must then be positive
  bool present = false;            ///< may be `present`, the distance of the two points as the scene is assembled
};

struct JointWord {
  JointKind kind;
  const char* word;        ///< its key in a scene, for its list of points
  bool third = false;      ///< may have a third point, otherwise the ground is used
  bool turns = false;      ///< constrains angles of its bodies, whatever their points
  bool pins = false;       ///< holds its two points together
  bool guides = false;     ///< guides along the direction of its first point
  bool clamps = false;     ///< fixes the directions of its points relative to each other
  bool clearance = false;  ///< clearance allowed
  bool friction = false;   ///< friction allowed
  std::vector<JointNumber> numbers = {};
  std::vector<const char*> couples = {};               ///< keys of SceneCoupling allowed with it
  std::vector<const char*> efforts = {};               ///< of `efforts_of`, unless it relates only angles
  bool has_couple() const { return turns || clamps; }  ///< its reaction has a couple
};

std::span<const JointWord> joint_words();
const JointWord& word_of(const SceneJoint&);

/// Columns of its forces besides the reaction at its point: none if it relates only angles.
std::vector<const char*> efforts_of(const SceneJoint&);
/// The points that a joint connects, in the order of its ends; for a relation of terms, one of each body.
std::vector<const PointRef*> points_of(const SceneJoint&);
/// Whether it has clearance in a complete bearing and presses with a contact law.
bool presses_elastically(const SceneJoint&);
/// The point that carries a profile, BODY.PROFILE; for a rigid body and the ground the origin.
/// @throws SceneError  a flexible body's profile without a carrying point
PointRef carrier_of(const Scene&, const PointRef& profile);

}  // namespace pintle
