#pragma once

#include <string>
#include <utility>

#include "framework/scene/scene.h"

/// Scenes of uniform rods, for tests that build them without text.
namespace pintle::rods {

/// Origin of its axes and point A at one end, B at the other; 2 kg/m.
inline SceneBody rod(const std::string& name, double length, Pair at, double angle) {
  SceneBody b;
  b.name = name;
  b.mass = 2 * length;
  b.inertia = b.mass * length * length / 12;
  b.center = {length / 2, 0};
  b.points = {{"A", {0, 0}, 0, {}}, {"B", {length, 0}, 0, {}}};
  b.at = at;
  b.angle = angle;
  return b;
}
inline SceneJoint joint(const std::string& name, JointKind kind, PointRef a, PointRef b) {
  SceneJoint j;
  j.name = name;
  j.kind = kind;
  j.a = std::move(a);
  j.b = std::move(b);
  return j;
}

}  // namespace pintle::rods
