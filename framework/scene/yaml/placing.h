#pragma once

#include <numbers>

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

/// Where an instance stands: a point p of the assembly is at `at` + R(angle) (x, ±y).
struct Placing {
  Pair at{0, 0};
  double angle = 0;
  bool mirrored = false;

  bool stays() const { return at == Pair{0, 0} && angle == 0 && !mirrored; }
  double sign() const { return mirrored ? -1 : 1; }
  double direction(double a) const { return angle + sign() * a; }
  Pair vector(const Pair&) const;
  Pair point(const Pair&) const;
  /// cos and sin of the angle, exact where it is a multiple of a right angle.
  Pair turn() const;
};
/// First the inner one.
Placing operator*(const Placing& outer, const Placing& inner);

/// Moves what is drawn in an assembly to where an instance has it: places and directions in the world, and of a mirrored one all that
/// turns the other way. The axes of a mirrored body are those whose y axis is drawn on the other side.
/// @param section  of the entry: "bodies"
/// @throws SceneError  what cannot be mirrored or turned, with the remedy
void place(Yaml& entry, const std::string& section, const std::string& path, const Placing&, const Source&);

}  // namespace pintle
