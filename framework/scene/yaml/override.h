#pragma once

#include <string>

#include "framework/scene/yaml/reader.h"
#include "framework/scene/yaml/yaml_node.h"

/// `--set PATH=VALUE`: any key of a scene by its path, before the scene is read. docs/scene.md
namespace pintle {

/// A name with a dot is a path: the subtree there is replaced by `value`, read as YAML; `null` removes it; missing groups on the path are
/// created; entries of lists are counted from 1. A single top-level key is a path too, unless a parameter has this name. All other names
/// are parameters, handled by the reader.
bool is_path(const std::string& name, const Yaml& scene);

/// Applies the overrides that are paths, in their order. Inserted entries have no lines; messages about them say `--set`.
/// @returns the others: parameters
/// @throws SceneError  naming `--set PATH`: the path does not exist, or the value is not YAML
Overrides apply_paths(Yaml& scene, const std::string& file, const Overrides&);

/// Splits the overrides into those for the tree as written and those for entries that only expansion creates.
std::pair<Overrides, Overrides> written_and_made(const Yaml& scene, const Overrides&);

/// A value as an override's text: on one line, readable as the same tree.
std::string override_text(const Yaml&);

}  // namespace pintle
