#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "framework/study/study.h"
#include "framework/study/sweep/communicator.h"
#include "framework/study/sweep/journal.h"
#include "framework/study/sweep/sampling.h"

/// Many cases of one scene, shared among threads and processes, safe against being killed. docs/studies.md
namespace pintle {

struct Sweep {
  Study study;
  Cases cases;
  CaseLimits limits;               ///< of each case
  std::string text;                ///< of the study file
  std::uint64_t print = 0;         ///< fingerprint of the study, its scene, the files that they name and the program
  std::vector<Measure> keep = {};  ///< of which each case leaves a curve, curves/case-N.csv
};

/// Reads a study with a section `sweep`, and some of its cases, so that a study none of whose cases can be read is refused
/// at once. `set` holds for all cases, after the study's own.
/// @throws SceneError  naming file, line, key, value and remedy
Sweep read_sweep(const std::filesystem::path&, const Overrides& set = {});

/// What every study of cases shares: the cases with the study's text and fingerprint, judged as read_sweep does.
/// @param set     the user's overrides, part of the fingerprint
/// @param common  further overrides, which the study's text says
/// @throws SceneError  none of the cases can be read, or a name is not known
Sweep cases_of(const StudyFile&, Cases, const std::filesystem::path&, const Overrides& set, const Overrides& common);
/// @throws SceneError  what the study measures is not there
void judge_measures(const Sweep&);
/// The override that `most steps` of a section means.
Overrides step_limit(const Node& section);

/// How far a sweep is. Cases of this process and, in process 0, of the others.
struct SweepCount {
  std::size_t cases = 0;    ///< of the study
  std::size_t before = 0;   ///< of them, ended in earlier sessions
  std::size_t done = 0;     ///< ended in this one
  std::size_t trouble = 0;  ///< of these, not "finished"
  double busy = 0;          ///< time that all workers spent on cases [s]
  double seconds = 0;       ///< since the session began
};

struct SweepSettings {
  int threads = 1;                                       ///< of this process
  Communicator* communicator = nullptr;                  ///< or none
  std::function<bool(const SweepCount&)> progress = {};  ///< some ten times a second; false: stop, keep what has ended
};

/// What a session of a sweep came to.
struct SweepEnd {
  bool whole = false;  ///< all cases have ended
  SweepCount count;
  int workers = 1;                 ///< threads of all processes
  std::string shortage;            ///< why this process had fewer threads than asked for; empty: it had them
  std::vector<std::string> notes;  ///< what was torn in journals, and what was done about it
  std::vector<Row> rows;           ///< of all sessions, in the order of cases; in process 0
  double efficiency() const { return count.seconds > 0 ? count.busy / (workers * count.seconds) : 1; }
};

/// Runs the cases that have not ended yet, and leaves in `folder` (made, or gone on with):
/// sweep.csv, the same to the bit whatever the number of workers and however often it was killed; timings.csv; sweep.json;
/// study.yaml and scene.yaml, what was run; journal-N.txt. A session that was stopped leaves sweep-so-far.csv instead of the table.
/// With several processes, all of them call it with the same study and folder; process 0 alone writes tables.
/// @throws SceneError          the folder holds something else, or another study
/// @throws std::runtime_error  a file cannot be written, or another process works there
SweepEnd run_sweep(const Sweep&, const std::filesystem::path& folder, const SweepSettings&);

/// For a process that cannot come to run_sweep. Process 0 tells the others that there is nothing to do; another hears
/// what process 0 has said (true: that), and if the sweep goes on, leaves it, which stops all.
void reject_all(Communicator&);
bool rejected(Communicator&);
void stay_away(Communicator&);

/// sweep.csv: a row per case. @pre rows in the order of their numbers
std::string sweep_csv(const Sweep&, const std::vector<Row>& rows);
std::string timings_csv(const std::vector<Row>& rows);
/// Number of cases with each status.
std::map<std::string, std::size_t> statuses(const std::vector<Row>& rows);
/// Extremes of a measure, and the cases that they are in (0: no case has it).
struct MeasureRange {
  std::string header;  ///< with its unit
  double least, greatest;
  std::size_t least_in, greatest_in;
};
std::vector<MeasureRange> measure_ranges(const Sweep&, const std::vector<Row>& rows);
/// What sweep.json holds, as text.
std::string sweep_json(const Sweep&, const SweepEnd&);

}  // namespace pintle
