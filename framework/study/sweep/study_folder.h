#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/study/sweep/sweep.h"

namespace pintle {

/// Creates the folder of a study, or continues with it, and stores what is run: study.yaml and scene.yaml.
/// @param notes  receives what was incomplete in the journal
/// @returns the journal of process 0
/// @throws SceneError          the folder holds something else, or another study
/// @throws std::runtime_error  a file cannot be written, or another process uses the folder
std::unique_ptr<Journal> open_study_folder(const Sweep&, const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace pintle
