#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fmi/contents.h"

namespace pintle::app {

struct FmuOrder {
  std::filesystem::path scene, out;  ///< out empty: SCENE.fmu in the current folder
  Overrides set;
  std::vector<std::string> inputs, outputs;
};

struct ExportedFmu {
  std::filesystem::path file;
  fmi::FmuContents contents;
  std::vector<std::string> files;  ///< of the scene, its own file first
  std::vector<std::string> warnings;
};

/// Writes a scene as an FMU for co-simulation.
/// @throws SceneError, AssemblyError, FileError
ExportedFmu export_fmu(const FmuOrder&);

}  // namespace pintle::app
