#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/error.h"
#include "framework/study/case.h"

/// What a sweep has done so far, kept so that nothing is lost when the process dies at any moment.
namespace pintle {

/// A case that has ended, as journals keep it.
struct Row {
  std::size_t number = 0;  ///< from 1
  std::string status, reason;
  std::vector<double> values;
  std::vector<std::string> units;
  double t_end = 0, unexplained_share = 0;
  long steps = 0, impacts = 0;
  std::string worker;  ///< "process.thread"; not in the table
  double build_seconds = 0, run_seconds = 0;
};

/// Its process lacked memory, which says nothing of the case: it is run again when the sweep goes on.
bool lacked_memory(const Row&);

/// One line: a checksum and the row; numbers come back to the bit.
std::string line_of(const Row&);
/// @returns nothing if the line is torn or changed, or does not hold what line_of writes
std::optional<Row> row_of(std::string_view line);

/// A journal holds cases of another study.
struct OtherStudy : SceneError {
  using SceneError::SceneError;
};

/// A file that only grows, a line for each case, written by one process: several threads may append. Each line goes to
/// the kernel in one piece before `append` returns, so a process that is killed loses none; the disk is asked to keep it
/// once a second. Held locked while it is open; a line torn by a kill is cut off when it is opened again.
class Journal {
 public:
  /// @param study  fingerprint of what the cases belong to
  /// @param notes  takes what was mended, if not null
  /// @throws OtherStudy          it holds cases of another study
  /// @throws SceneError          its heading is damaged
  /// @throws std::runtime_error  it cannot be made, or another process has it open
  Journal(const std::filesystem::path&, std::uint64_t study, std::vector<std::string>* notes = nullptr);
  ~Journal();
  Journal(const Journal&) = delete;
  /// @throws std::runtime_error  it cannot be written; the line is not there then
  void append(const Row&);

 private:
  void write(const std::string& line);
  std::filesystem::path path_;
  int file_ = -1;
  std::int64_t size_ = 0;
  double flushed_ = 0;  ///< when, on a steady clock [s]
  std::mutex one_at_a_time_;
};

/// The file of process `rank` in a sweep's folder.
std::filesystem::path journal_path(const std::filesystem::path& folder, int rank);

/// All journals in the folder, rows in the order of their numbers, each number once: the first, or that after one that lacked memory. A last line torn by a kill is left out.
/// @param cases  of the study  @param notes  takes what was left out, if not null
/// @throws OtherStudy          one belongs to another study
/// @throws SceneError          one is damaged otherwise, or holds a case that the study has not: naming file and line
std::vector<Row> read_journals(const std::filesystem::path& folder, std::uint64_t study, std::size_t cases,
                               std::vector<std::string>* notes = nullptr);

/// Waits until no process has a journal of the folder open but this one. @returns false: some still has after `seconds`
bool journals_are_free(const std::filesystem::path& folder, const std::filesystem::path& but, double seconds);

}  // namespace pintle
