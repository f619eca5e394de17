#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/common/file.h"
#include "framework/integration/events/impact.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

/// trajectory.csv, ledger.csv, events.csv and, for a scene with events, actions.csv of a run, written during the run.
class RunFiles {
 public:
  /// @throws FileError
  RunFiles(const std::filesystem::path& directory, const Scene&, const Model&);
  /// Adds all rows of the tables, the impacts that have ended since, and what events did. @throws FileError
  void add(const Table& trajectory, const Table& ledger, const std::vector<Impact>&, const std::vector<Happening>&);
  /// Writes buffers to disk. @throws FileError
  void flush();
  /// Writes the impacts in progress and the buffers, and closes all files. @throws FileError  the first error
  void finish(const std::vector<Impact>&, const std::vector<Happening>&);

 private:
  void add_rows(const Table&, FileWriter&);
  void add_impact(const Impact&);
  void add_actions(const std::vector<Happening>&);

  const System& system_;
  FileWriter trajectory_, ledger_, events_;
  std::optional<FileWriter> actions_;
  std::size_t impacts_ = 0, did_ = 0;  ///< number written
  std::string row_;
};

/// Disk space reserved for a file, by an open file without a name, so that nothing remains if the program is killed.
class ReservedRoom {
 public:
  /// @param file  for which space is reserved, in its folder   @throws FileError  there is not enough space
  ReservedRoom(const std::filesystem::path& file, std::size_t bytes);
  ~ReservedRoom() { release(); }
  ReservedRoom(const ReservedRoom&) = delete;
  void release();

 private:
  int open_ = -1;
};

}  // namespace pintle
