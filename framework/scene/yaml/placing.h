#pragma once

#include <numbers>

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

/// Placement of an instance: a point p of the assembly is at `at` + R(angle) (x, ±y).
struct Placing {
  Pair at{0, 0};
  double angle = 0;
  bool mirrored = false;

  bool stays() const { return at == Pair{0, 0} && angle == 0 && !mirrored; }
  double sign() const { return mirrored ? -1 : 1; }
  double direction(double a) const { return angle + sign() * a; }
  Pair vector(const Pair&) const;
  Pair point(const Pair&) const;
  /// cos and sin of the angle, exact if it is a multiple of a right angle.
  Pair turn() const;
};
/// Applies the inner one first.
Placing operator*(const Placing& outer, const Placing& inner);

/// Moves the content of an assembly to the place of an instance: positions and directions in the world, and in a mirrored one everything
/// that then turns the other way. The axes of a mirrored body have a reversed y axis.
/// @param section  of the entry: "bodies"
/// @throws SceneError  what cannot be mirrored or rotated, with the remedy
void place(Yaml& entry, const std::string& section, const std::string& path, const Placing&, const Source&);

}  // namespace pintle
