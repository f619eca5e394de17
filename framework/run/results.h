#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/run/price.h"
#include "framework/run/simulate.h"

namespace pintle {

/// A directory that is filled beside its final place and moved there whole by `commit`; discarded if
/// that never happens.
class ResultsDirectory {
 public:
  /// @throws std::runtime_error  `directory` exists or cannot be made
  explicit ResultsDirectory(const std::filesystem::path& directory);
  ~ResultsDirectory();
  ResultsDirectory(const ResultsDirectory&) = delete;
  const std::filesystem::path& path() const { return staging_; }  ///< where to write meanwhile
  void commit();

 private:
  std::filesystem::path final_, staging_;
  bool committed_ = false;
};

/// trajectory.csv, ledger.csv, events.csv and run.json in `directory`.
/// @throws std::runtime_error  naming the path that cannot be written
void write_results(const std::filesystem::path& directory, const Scene&, const Model&, const Assembly&, const Run&);

/// A table as the text of a .csv file.
std::string csv(const Table&);
/// What run.json holds, as text.
std::string run_json(const Scene&, const Model&, const Assembly&, const Run&);
/// What `pintle check --json` prints.
std::string check_json(const Scene&, const Model&, const Assembly&, const Price&);

}  // namespace pintle
