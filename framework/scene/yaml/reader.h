#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

/// "name" → text, from `--set name=text`. A parameter's text is parsed like its value; a name with a dot is the path of any key, with YAML
/// text: override.h.
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Reads a scene file (YAML, or JSON, which is YAML). Converts units to SI and substitutes parameters. Checks the form: keys, types, units,
/// ranges of single values; `build` checks references between names.
/// @throws SceneError  with file, line, key, value and remedy
Scene read_scene(const std::filesystem::path& file, const Overrides& overrides = {});

/// The same from text; `name` replaces the file name in messages, and tables are looked up relative to `folder`.
Scene read_scene_text(const std::string& text, const std::string& name, const Overrides& overrides = {},
                      const std::filesystem::path& folder = ".");

/// Checks that a scene has what a run needs besides bodies. A scene without `run` is complete for modes, meshes and statics.
/// @throws SceneError  the scene has no `run`; shows one
void require_run(const Scene&);

}  // namespace pintle
