#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace pintle {

/// Everything that determines mesh, elements, matrices and ports of a body, as bytes: its points, shape, material, lumps, and the contents
/// of the file that it names. Excluded: name, pose, damping, modes, and places in files. Nothing if the file cannot be read, or its drawing
/// depends on other data (a script that includes another, …).
std::optional<std::string> elements_key(const Scene&, const SceneBody&);

/// Everything that determines the reduction of given elements: the scene's settings for its modes, the ports in use, and the number of
/// modes chosen for `keep: auto`.
std::string reduction_key(const SceneElastic&, const std::vector<int>& ports, const std::vector<int>& massless,
                          const std::optional<int>& chosen);

}  // namespace pintle
