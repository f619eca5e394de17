#pragma once

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

/// Reads the files named under `include`, by the scene and by its assemblies, into the tree, recursively: docs/scene.md, "Include".
/// @throws SceneError  a file that does not exist or is not allowed, that includes itself, or a name defined in two files
void include_files(Yaml& scene, Source&);

}  // namespace pintle
