#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/study.h"
#include "framework/study/sweep/communicator.h"
#include "framework/study/sweep/journal.h"
#include "framework/study/sweep/part.h"
#include "framework/study/sweep/sampling.h"

/// Many cases of one scene, distributed to worker threads and processes, safe against being killed. docs/studies.md
namespace pintle {

struct Sweep {
  Study study;
  Cases cases;
  CaseLimits limits;                   ///< of each case
  std::string text;                    ///< of the study file
  std::uint64_t print = 0;             ///< fingerprint of the study, its scene, the files they name, and the program
  std::vector<Measure> keep = {};      ///< quantities for which each case writes a curve, curves/case-N.csv
  std::optional<SweepPart> part = {};  ///< the part of the cases to run; none: all

  bool has(std::size_t k) const { return !part || part->has(k); }                           ///< whether case k, from 1, must be run
  std::size_t size() const { return part ? cases_in(*part, cases.size()) : cases.size(); }  ///< number of cases to be run
  /// Fingerprint in the headings of its journals: the study's, or the part's own.
  std::uint64_t journal_print() const;
};
/// Name of the table in its folder; a part's has another name than that of a whole sweep.
const char* table_name(const Sweep&);

/// Reads a study with a section `sweep`, and some of its cases, so that a study with no readable case is rejected at once. `set` applies to
/// all cases, after the study's own overrides.
/// @throws SceneError  naming file, line, key, value and remedy
Sweep read_sweep(const std::filesystem::path&, const Overrides& set = {});

/// Common to all studies of cases: the cases with the study's text and fingerprint, checked as in read_sweep.
/// @param set     the user's overrides, part of the fingerprint
/// @param common  further overrides, which are in the study's text
/// @throws SceneError  none of the cases can be read, or a name is unknown
Sweep cases_of(const StudyFile&, Cases, const std::filesystem::path&, const Overrides& set, const Overrides& common);
/// @param columns  of the table besides those of measures and of what is varied
/// @throws SceneError  a measured quantity does not exist, or is called like a column
void validate_measures(const Sweep&,
                       std::vector<std::string> columns = {"case", "status", "reason", "t_end", "steps", "impacts", "unexplained share"});
/// The override for `most steps` in a section.
Overrides step_limit(const Node& section);

/// Progress of a sweep. Cases of this process and, in process 0, of the others.
struct SweepCount {
  std::size_t cases = 0;    ///< to be run, in total
  std::size_t before = 0;   ///< finished in earlier sessions
  std::size_t done = 0;     ///< finished in this session
  std::size_t trouble = 0;  ///< of these, not "finished"
  double busy = 0;          ///< total time of all workers spent on cases [s]
  double seconds = 0;       ///< since the start of the session [s]
};

struct SweepSettings {
  int threads = 1;                                       ///< of this process
  Communicator* communicator = nullptr;                  ///< or nullptr
  std::function<bool(const SweepCount&)> progress = {};  ///< about ten times a second; false: stop, and keep finished cases
};

/// Result of a session of a sweep.
struct SweepEnd {
  bool whole = false;  ///< all cases to be run are finished
  SweepCount count;
  int workers = 1;                 ///< threads of all processes
  std::string shortage;            ///< why this process had fewer threads than requested; empty: it had them
  std::vector<std::string> notes;  ///< what was incomplete in journals, and how it was repaired
  std::vector<Row> rows;           ///< of all sessions, in the order of cases; in process 0
  double efficiency() const { return count.seconds > 0 ? count.busy / (workers * count.seconds) : 1; }
};

/// Runs the cases that are not finished, and writes into `folder` (created, or continued): sweep.csv, identical to the bit for any number
/// of workers and interruptions; warnings.csv, if a case has any; timings.csv; sweep.json; study.yaml and scene.yaml, as run; journal-N.txt. A stopped session writes
/// sweep-so-far.csv instead of the table. A part writes sweep-part.csv with its cases, and part.json. With several processes, all of them
/// call it with the same study and folder; only process 0 writes tables.
/// @throws SceneError          the folder holds something else, or another study
/// @throws std::runtime_error  a file cannot be written, or another process uses the folder
SweepEnd run_sweep(const Sweep&, const std::filesystem::path& folder, const SweepSettings&);

/// For a process that cannot call run_sweep. Process 0 tells the others that there is nothing to do; any other process receives this
/// message (returns true), or, if the sweep is running, leaves it, which stops all processes.
void reject_all(Communicator&);
bool rejected(Communicator&);
void stay_away(Communicator&);

/// sweep.csv: a row per case. @pre rows in the order of their numbers
std::string sweep_csv(const Sweep&, const std::vector<Row>& rows);
std::string timings_csv(const std::vector<Row>& rows);
/// warnings.csv: a row for each warning of each case. Empty if there is none.
std::string warnings_csv(const std::vector<Row>& rows);
/// How many cases have warnings, and the first one. Empty if there is none. @param file  that lists them; empty: there is none yet
std::string warnings_text(const std::vector<Row>& rows, const std::filesystem::path& file);
/// Number of cases with each status.
std::map<std::string, std::size_t> statuses(const std::vector<Row>& rows);
/// Extremes of a measure, and their cases (0: no case has a value).
struct MeasureRange {
  std::string header;  ///< with its unit
  double least, greatest;
  std::size_t least_in, greatest_in;
};
std::vector<MeasureRange> measure_ranges(const Sweep&, const std::vector<Row>& rows);
/// The contents of sweep.json, as text.
std::string sweep_json(const Sweep&, const SweepEnd&);

}  // namespace pintle
