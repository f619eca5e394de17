#pragma once

#include <filesystem>
#include <vector>

#include "framework/study/sweep/sweep.h"

/// Joins the parts of a sweep to the files that the whole sweep would have written. docs/studies.md
namespace pintle {

/// A whole sweep, read from the folders of its parts. It has only the part of the study that tables show.
struct Merged {
  Sweep sweep;
  SweepEnd end;                                ///< with the rows of all parts
  std::vector<std::filesystem::path> folders;  ///< of the parts, in their order
  bool keeps_curves = false;
};

/// Reads the folders of all parts, in any order.
/// @throws SceneError          a folder holds no part, a damaged one or one of another study; parts are missing, duplicate or unfinished
/// @throws std::runtime_error  a process is still working on a part
Merged read_parts(const std::vector<std::filesystem::path>& folders);

/// Fills an existing folder with the files of a whole sweep. Process p of a part becomes process p plus the number of processes of the
/// parts before. @throws FileError
void write_merged(const Merged&, const std::filesystem::path& folder);

}  // namespace pintle
