#pragma once

#include <filesystem>
#include <vector>

#include "framework/study/sweep/sweep.h"

/// The parts of a sweep, joined to what the whole would have written. docs/studies.md
namespace pintle {

/// A whole sweep, as read from the folders of its parts. Of the study only what tables show is known.
struct Merged {
  Sweep sweep;
  SweepEnd end;                                ///< with the rows of all parts
  std::vector<std::filesystem::path> folders;  ///< of the parts, in their order
  bool keeps_curves = false;
};

/// Reads the folders of all parts, in any order.
/// @throws SceneError          one holds no part, one of another study or a damaged one; parts are missing, doubled or not finished
/// @throws std::runtime_error  a process still works on one
Merged read_parts(const std::vector<std::filesystem::path>& folders);

/// Fills an existing folder with the files of a whole sweep. A worker of process p of part i counts as one of process p plus the number of
/// processes in the parts before. @throws FileError
void write_merged(const Merged&, const std::filesystem::path& folder);

}  // namespace pintle
