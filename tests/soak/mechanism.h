#pragma once

#include <cstdint>
#include <string>

namespace soak {

/// A random mechanism as a scene file, one thing a line; its first line says what was drawn. It is a tree of bodies on the ground
/// with loops closed in it, or a row of parallelograms, or a slider-crank: drawn in a pose in which all joints close, which is exactly
/// straight or folded in a quarter of all. Bodies are rigid or beams that bend. Some are overconstrained, locked, or driven twice.
/// Methods are those of the scene language. The same seed gives the same text.
std::string random_scene(std::uint64_t seed);

}  // namespace soak
