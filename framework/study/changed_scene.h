#pragma once

#include <filesystem>
#include <string>

#include "framework/study/case.h"

namespace pintle {

/// The text of a study's scene with overrides applied, ready to run, with paths of tables and drawings relative to `directory`.
/// @param comment  placed at the top
std::string changed_scene(const CaseSource&, const Overrides&, const std::filesystem::path& directory, const std::string& comment);

}  // namespace pintle
