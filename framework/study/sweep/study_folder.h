#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/study/sweep/sweep.h"

namespace pintle {

/// Makes the folder of a study, or goes on with it, and keeps there what runs: study.yaml and scene.yaml.
/// @param notes  takes what was torn in the journal
/// @returns the journal of process 0
/// @throws SceneError          the folder holds something else, or another study
/// @throws std::runtime_error  a file cannot be written, or another process works there
std::unique_ptr<Journal> open_study_folder(const Sweep&, const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace pintle
