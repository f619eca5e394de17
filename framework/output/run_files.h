#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/common/file.h"
#include "framework/integration/events/impact.h"
#include "framework/mechanism/trajectory.h"

namespace pintle {

/// trajectory.csv, ledger.csv and events.csv of a run, written during the run.
class RunFiles {
 public:
  /// @throws FileError
  RunFiles(const std::filesystem::path& directory, const Model&);
  /// Adds all rows of the tables, and the impacts that have ended since. @throws FileError
  void add(const Table& trajectory, const Table& ledger, const std::vector<Impact>&);
  /// Writes buffers to disk. @throws FileError
  void flush();
  /// Writes the impacts still going on and the buffers. @throws FileError  the first of the three; all are closed
  void finish(const std::vector<Impact>&);

 private:
  void add_rows(const Table&, FileWriter&);
  void add_impact(const Impact&);
  void flush_impacts();

  const System& system_;
  FileWriter trajectory_, ledger_, events_;
  std::size_t impacts_ = 0, on_disk_ = 0;  ///< number written; of these, flushed
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
  std::string row_;
};

/// actions.csv: the actions of the events of a scene, one row each; not written for a scene without events. @throws FileError
void write_actions(const std::filesystem::path& directory, const Scene&, const Run&);

/// Disk space reserved for later, as a file that is deleted when the space is needed.
class ReservedRoom {
 public:
  /// @throws FileError  there is not enough space
  ReservedRoom(std::filesystem::path file, std::size_t bytes);
  ~ReservedRoom() { release(); }
  ReservedRoom(const ReservedRoom&) = delete;
  void release();

 private:
  std::filesystem::path file_;
};

}  // namespace pintle
