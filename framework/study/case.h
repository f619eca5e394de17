#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/scene/yaml/reader.h"
#include "framework/study/measures/measure.h"

namespace pintle {

/// One of several conditions in which a case is examined, such as a load or a speed: overrides applied after the case's own.
struct Situation {
  std::string name;
  Overrides set;
};

/// The scene of a study, read from disk once: cases differ from it only by overrides.
struct CaseSource {
  std::filesystem::path file;  ///< tables and drawings are looked up next to it
  std::string text;
  Overrides common = {};                   ///< for all cases; a case's own come after
  Question question = {};                  ///< analysis of each case
  std::vector<Situation> situations = {};  ///< each case is examined in all of them; none: in the unchanged scene
};
/// @throws SceneError  there is no such file
CaseSource read_case_source(const std::filesystem::path& scene, Overrides common = {});
/// A case's scene, prepared for the analysis. @throws SceneError  it cannot be read, or lacks data that the analysis needs
Scene case_scene(const CaseSource&, const Overrides&);
/// The scene common to all cases. @throws SceneError
Scene common_scene(const CaseSource&);

class BodyStore;

/// Result of a case. Every case has one: an error that would stop a single run is the reason here.
struct Outcome {
  std::string
      status;  ///< "finished", "failed", "interrupted", "ledger over its bound", "refused" (scene), "not assembled", "over its limit"
  std::string reason;              ///< one line; empty when finished
  std::vector<double> values;      ///< one per measure; NaN if there is none
  std::vector<std::string> units;  ///< likewise; empty if the scene was refused
  double build_seconds = 0;        ///< processor time of reading, building, assembling [s]
  double run_seconds = 0;          ///< likewise of simulating [s]
  double t_end = 0;                ///< reached [s]
  Counts counts;
  long impacts = 0;              ///< of all clearances
  double unexplained_share = 0;  ///< largest energy-balance error over Run::energy_in_play
  std::map<std::string, std::string> curves =
      {};                                  ///< per situation ("" if there is none), a CSV file: time, and a column for each requested curve
  std::vector<std::string> warnings = {};  ///< of the run, one line each
  std::shared_ptr<const Run> run;          ///< kept if requested; none for modal analyses
};

struct CaseLimits {
  double seconds = 0;                            ///< limit of the computing time of the simulation [s]; 0: none
  bool keep_run = false;                         ///< Outcome::run
  const std::vector<Measure>* curves = nullptr;  ///< Outcome::curves; nullptr: none
  bool time_alone = false;           ///< only the first and last row: run_seconds is then the integration time, and measures are NaN
  BodyStore* bodies = nullptr;       ///< shared by the cases of a study; nullptr: each makes its own
  std::function<bool()> go_on = {};  ///< called now and then; false interrupts the run
};

/// Reads, builds, assembles and runs one case, or performs another analysis of it. Throws only for lack of memory. May be called from
/// several threads at once; the outcome (except times) does not depend on other threads or on the number of cores: from the first call on,
/// OpenBLAS (in the whole program) and OpenMP (in this thread) use only the calling thread.
Outcome run_case(const CaseSource&, const Overrides&, const std::vector<Measure>&, const CaseLimits& = {});

}  // namespace pintle
