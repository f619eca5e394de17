#pragma once

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

/// Reads the files named under `include`, of the scene and of its assemblies, into the tree, and theirs: docs/scene.md, "Include".
/// @throws SceneError  a file that is not there or not allowed, that includes itself, or a name that two files give
void include_files(Yaml& scene, Source&);

}  // namespace pintle
