#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pintle {

/// A directory that is filled beside its final place, as DIR.part-XXXXXX with letters that no other has, and moved there whole
/// by `commit`. What was written stays where it is if that never happens; an empty one goes.
class ResultsDirectory {
 public:
  /// @throws FileError  `directory` exists or cannot be made
  explicit ResultsDirectory(const std::filesystem::path& directory);
  ~ResultsDirectory();
  ResultsDirectory(const ResultsDirectory&) = delete;
  const std::filesystem::path& path() const { return staging_; }  ///< where to write meanwhile
  bool holds_files() const;
  /// Puts all on the disk, then moves it. @throws FileError  naming where the results are
  void commit();

 private:
  std::filesystem::path final_, staging_, frames_;
  bool committed_ = false;
};

/// The path without a slash at its end.
std::filesystem::path without_slash(const std::filesystem::path&);

/// What runs that were ended, or still go, left beside a results directory.
std::vector<std::filesystem::path> leftovers(const std::filesystem::path& directory);

/// The time of the last whole row of its trajectory.csv: how far a run that was killed had come, to about a second of its work.
std::optional<double> time_of_last_row(const std::filesystem::path& folder);

/// The folder in which it will be made, or the nearest one above.
std::filesystem::path nearest_that_exists(const std::filesystem::path& directory);

/// Whether results can be written there, tried before anything is computed. @throws FileError
void require_writable(const std::filesystem::path& directory);

}  // namespace pintle
