#pragma once

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

/// Whether the scene has anything to expand: `repeat`, `assemblies` or `instances`.
bool has_copies(const Yaml& scene);

/// Expands repeated and instantiated entries, so that afterwards each body, joint and so on is a separate entry: docs/scene.md,
/// "Assemblies, instances, repeat". Values keep their expressions; the scope of a value has its parameters and the meaning of names.
/// @pre the scene's parameters are read
/// @throws SceneError  also if the result exceeds the limits
void expand(Yaml& scene, Source&);

}  // namespace pintle
