#pragma once

#include <filesystem>
#include <string>

#include "framework/study/case.h"

namespace pintle {

/// The text of a study's scene with overrides applied, ready to run: its tables and drawings are found from `directory`.
/// @param comment  stands at its head
std::string changed_scene(const CaseSource&, const Overrides&, const std::filesystem::path& directory, const std::string& comment);

}  // namespace pintle
