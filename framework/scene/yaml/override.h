#pragma once

#include <string>

#include "framework/scene/yaml/reader.h"
#include "framework/scene/yaml/yaml_node.h"

/// `--set PATH=VALUE`: any key of a scene by its path, before the scene is read. docs/scene.md
namespace pintle {

/// A name with a dot is a path: the subtree there gives way to `value`, read as YAML; `null` takes it away; missing
/// groups on the way are made; entries of lists are counted from 1. A key of the top alone is a path too, unless a
/// parameter has that name. All other names are parameters, for the reader to look after.
bool is_path(const std::string& name, const Yaml& scene);

/// Applies those of the overrides that are paths, in their order. What is put in has no lines; messages about it say `--set`.
/// @returns the others: parameters
/// @throws SceneError  naming `--set PATH`: the path leads nowhere, or the value is not YAML
Overrides apply_paths(Yaml& scene, const std::string& file, const Overrides&);

/// The overrides for the tree as it is written, and those for what only comes of its instances and repeated entries.
std::pair<Overrides, Overrides> written_and_made(const Yaml& scene, const Overrides&);

/// A value as an override's text: on one line, read back to the same tree.
std::string override_text(const Yaml&);

}  // namespace pintle
