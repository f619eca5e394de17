#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

/// "name" → text, as `--set name=text` gave it. A parameter's text is parsed like its value; a name with a dot is the
/// path of any key, its text YAML: override.h.
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Reads a scene file (YAML, or JSON, which is YAML). Units are converted to SI, parameters filled
/// in. Judges form: keys, types, units, ranges of single values; names across the file are judged
/// by `build`.
/// @throws SceneError  with file, line, key, value and remedy
Scene read_scene(const std::filesystem::path& file, const Overrides& overrides = {});

/// The same from text; `name` stands in for the file in messages, tables are sought beside
/// `folder`.
Scene read_scene_text(const std::string& text, const std::string& name, const Overrides& overrides = {},
                      const std::filesystem::path& folder = ".");

/// What a run needs beside bodies. A scene without `run` is whole for modes, meshes and statics.
/// @throws SceneError  the scene has no `run`; shows one
void require_run(const Scene&);

}  // namespace pintle
