#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/error.h"
#include "framework/study/case.h"

/// Record of the finished cases of a sweep, so that nothing is lost if the process is killed at any time.
namespace pintle {

/// A finished case, as stored in journals.
struct Row {
  std::size_t number = 0;  ///< from 1
  std::string status, reason;
  std::vector<double> values;
  std::vector<std::string> units;
  double t_end = 0, unexplained_share = 0;
  long steps = 0, impacts = 0;
  std::string worker;  ///< "process.thread"; not in the table
  double build_seconds = 0, run_seconds = 0;
  std::map<std::string, std::string> curves = {};  ///< name of each kept curve and fingerprint of its text
  std::vector<std::string> warnings = {};          ///< of its run, one line each
};

/// Its process ran out of memory, for which the case may not be the cause: it is run again when the sweep continues.
bool lacked_memory(const Row&);

/// @param worker  as in Row
Row row_of(std::size_t number, const Outcome&, std::string worker);

/// One line: a checksum and the row; numbers are restored to the bit.
std::string line_of(const Row&);
/// @returns nothing if the line is incomplete or changed, or was not written by line_of
std::optional<Row> row_of(std::string_view line);

/// A journal holds cases of another study.
struct OtherStudy : SceneError {
  using SceneError::SceneError;
};

/// An append-only file with a line for each case, written by one process; several threads may append. Each line is passed to the kernel in
/// one piece before `append` returns, so a killed process loses none; it is synced to disk once a second. Locked while it is open; an
/// incomplete last line is removed when it is opened again.
class Journal {
 public:
  /// @param study  fingerprint of the study that the cases belong to
  /// @param notes  receives a note on any repair, if not null
  /// @throws OtherStudy          it holds cases of another study
  /// @throws SceneError          its heading is damaged
  /// @throws std::runtime_error  it cannot be created, or another process has it open
  Journal(const std::filesystem::path&, std::uint64_t study, std::vector<std::string>* notes = nullptr);
  ~Journal();
  Journal(const Journal&) = delete;
  /// @throws std::runtime_error  it cannot be written; then the line is not in the file
  void append(const Row&);

 private:
  void write(const std::string& line);
  std::filesystem::path path_;
  int file_ = -1;
  std::int64_t size_ = 0;
  double flushed_ = 0;  ///< time of the last sync, on a steady clock [s]
  std::mutex one_at_a_time_;
};

/// The journal of process `rank` in a sweep's folder.
std::filesystem::path journal_path(const std::filesystem::path& folder, int rank);

/// All journals in the folder, rows in the order of their numbers, each number once: the first row, or the one after a lack of memory. An
/// incomplete last line is ignored.
/// @param cases  of the study  @param notes  receives what was ignored, if not null
/// @param remedy  advice for a damaged journal; empty: continue or repeat the sweep
/// @throws OtherStudy          one belongs to another study
/// @throws SceneError          one is damaged otherwise, or holds a case that the study does not have: naming file and line
std::vector<Row> read_journals(const std::filesystem::path& folder, std::uint64_t study, std::size_t cases,
                               std::vector<std::string>* notes = nullptr, const std::string& remedy = {});

/// Waits until no other process has a journal of the folder open. @returns false: one still has after `seconds`
bool journals_are_free(const std::filesystem::path& folder, const std::filesystem::path& but, double seconds);

}  // namespace pintle
