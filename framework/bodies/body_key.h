#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace pintle {

/// All that mesh, elements, matrices and ports of a body follow from, as bytes: its points, shape, material, lumps, and the
/// contents of the file that it names. Not in it: name, pose, damping, modes, and where anything was written. Nothing: the
/// file cannot be read, or what it draws depends on more than itself (a script that includes another, …).
std::optional<std::string> elements_key(const Scene&, const SceneBody&);

/// All that the reduction of given elements follows from: what the scene says of its modes, the ports in use, and how many
/// modes were chosen where it says `keep: auto`.
std::string reduction_key(const SceneElastic&, const std::vector<int>& ports, const std::optional<int>& chosen);

}  // namespace pintle
