#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pintle {

/// A directory filled next to its final place, as DIR.part-XXXXXX with unique letters, and renamed as a whole by `commit`. Without `commit`
/// the results stay there, and an empty directory is removed.
class ResultsDirectory {
 public:
  /// @throws FileError  `directory` exists or cannot be created
  explicit ResultsDirectory(const std::filesystem::path& directory);
  ~ResultsDirectory();
  ResultsDirectory(const ResultsDirectory&) = delete;
  const std::filesystem::path& path() const { return staging_; }  ///< where to write before `commit`
  bool holds_files() const;
  /// Syncs everything to disk, then renames it. @throws FileError  naming where the results are
  void commit();

 private:
  std::filesystem::path final_, staging_, frames_;
  int lock_ = -1;  ///< lock on the staging folder, which the system releases if the program is killed
  bool committed_ = false;
};

/// Whether a program that still runs fills this folder. False where the file system cannot lock.
bool is_being_filled(const std::filesystem::path& folder);

/// The path without a slash at its end.
std::filesystem::path without_slash(const std::filesystem::path&);

/// Leftovers of aborted or unfinished runs next to a results directory.
std::vector<std::filesystem::path> leftovers(const std::filesystem::path& directory);

/// For a message about a folder that does not exist: "there is no such folder; " and what to name instead, or its leftovers.
std::string no_such_folder(const std::filesystem::path& directory);

/// The time of the last complete row of its trajectory.csv: how far a killed run had come, to within about a second of computing.
std::optional<double> time_of_last_row(const std::filesystem::path& folder);

/// Explains why a folder lacks what a command needs, and the remedy: "its run was killed …; run its scene again". Empty if it holds a
/// finished run, or nothing known.
/// @param lacking  "rows", "frames"
std::string why_without(const std::string& lacking, const std::filesystem::path& folder);

/// The folder in which it will be created, or the nearest existing one above.
std::filesystem::path nearest_that_exists(const std::filesystem::path& directory);

/// Checks, before anything is computed, whether results can be written there. @throws FileError
void require_writable(const std::filesystem::path& directory);

}  // namespace pintle
