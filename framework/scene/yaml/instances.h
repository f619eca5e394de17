#pragma once

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

/// Whether the scene has what expand writes out: `repeat`, `assemblies` or `instances`.
bool has_copies(const Yaml& scene);

/// Writes out what the scene says once for many, so that afterwards each body, joint and so on stands there by itself: docs/scene.md,
/// "Assemblies, instances, repeat". Values keep their expressions; the scope of a value knows its parameters and what names mean in it.
/// @pre the scene's parameters are read
/// @throws SceneError  also where more comes out than the limits allow
void expand(Yaml& scene, Source&);

}  // namespace pintle
