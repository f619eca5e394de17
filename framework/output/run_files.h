#pragma once

#include <filesystem>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/common/file.h"
#include "framework/integration/events/impact.h"
#include "framework/mechanism/trajectory.h"

namespace pintle {

/// trajectory.csv, ledger.csv and events.csv of a run, written while it goes on.
class RunFiles {
 public:
  /// @throws FileError
  RunFiles(const std::filesystem::path& directory, const Model&);
  /// All rows of the tables, and the impacts that have ended since. @throws FileError
  void add(const Table& trajectory, const Table& ledger, const std::vector<Impact>&);
  /// Puts what is in buffers on the disk. @throws FileError
  void flush();
  /// The impacts that go on, and what is in buffers. @throws FileError  the first of the three; all are closed
  void finish(const std::vector<Impact>&);

 private:
  void add_rows(const Table&, FileWriter&);
  void add_impact(const Impact&);

  const System& system_;
  FileWriter trajectory_, ledger_, events_;
  std::size_t impacts_ = 0;  ///< written
  std::string row_;
};

/// actions.csv: what the events of a scene have done, a row each; none of a scene without events. @throws FileError
void write_actions(const std::filesystem::path& directory, const Scene&, const Run&);

/// Room on the disk that is kept for later, as a file that goes when it is wanted.
class ReservedRoom {
 public:
  /// @throws FileError  there is not so much
  ReservedRoom(std::filesystem::path file, std::size_t bytes);
  ~ReservedRoom() { release(); }
  ReservedRoom(const ReservedRoom&) = delete;
  void release();

 private:
  std::filesystem::path file_;
};

}  // namespace pintle
