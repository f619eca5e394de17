#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace pintle::app {

struct ConvertedTables {
  std::size_t tables = 0, rows = 0;
  bool whole = true;  ///< false: it was stopped, and there is no file
};

/// Called with the progress: "reading trajectory.csv, row 4096", and the share of the work done, 0 to 1. @returns false: stop
using ConversionStep = std::function<bool(const std::string&, double)>;

/// Writes the tables (.csv) and descriptions (.json) of a folder of results as one HDF5 file: docs/results.md. Memory does not depend on the
/// number of rows. @throws ResultsError, FileError
ConvertedTables convert_results(const std::filesystem::path& directory, const std::filesystem::path& file, const ConversionStep&);

}  // namespace pintle::app
