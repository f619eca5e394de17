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

/// A load, a speed or whatever else a case is looked at in, beside others: overrides that come after the case's own.
struct Situation {
  std::string name;
  Overrides set;
};

/// The scene of a study, read from disk once: cases differ from it by overrides alone.
struct CaseSource {
  std::filesystem::path file;  ///< tables and drawings are sought beside it
  std::string text;
  Overrides common = {};                   ///< hold for all cases; a case's own come after
  Question question = {};                  ///< what is asked of each
  std::vector<Situation> situations = {};  ///< a case goes through all of them; none: through the scene as it is
};
/// @throws SceneError  there is no such file
CaseSource read_case_source(const std::filesystem::path& scene, Overrides common = {});
/// A case's scene, made ready for the question. @throws SceneError  it cannot be read, or has not what the question needs
Scene case_scene(const CaseSource&, const Overrides&);
/// What all cases begin from. @throws SceneError
Scene common_scene(const CaseSource&);

class BodyStore;

/// How a case ended. Every case ends: what would stop a single run is here a reason.
struct Outcome {
  std::string
      status;  ///< "finished", "failed", "interrupted", "ledger over its bound", "refused" (scene), "not assembled", "over its limit"
  std::string reason;              ///< one line; empty when finished
  std::vector<double> values;      ///< a measure each; NaN where there is none
  std::vector<std::string> units;  ///< likewise; empty if the scene was refused
  double build_seconds = 0;        ///< reading, building, assembling
  double run_seconds = 0;          ///< simulating
  double t_end = 0;                ///< reached [s]
  Counts counts;
  long impacts = 0;              ///< of all clearances
  double unexplained_share = 0;  ///< of the energy in play, at worst
  std::map<std::string, std::string> curves =
      {};                          ///< by situation, "" without any, a CSV file: time, and a column for each curve asked for
  std::shared_ptr<const Run> run;  ///< kept if asked for; none where modes are found
};

struct CaseLimits {
  double seconds = 0;                            ///< of simulating; 0: none
  bool keep_run = false;                         ///< Outcome::run
  const std::vector<Measure>* curves = nullptr;  ///< Outcome::curves; none: there are none
  bool time_alone = false;  ///< no rows but the first and the last: run_seconds is then what the integration takes, and measures are NaN
  BodyStore* bodies = nullptr;       ///< shared by the cases of a study; none: each makes its own
  std::function<bool()> go_on = {};  ///< asked now and then; false interrupts the run
};

/// Reads, builds, assembles and runs one case, or asks another question of it. Never throws but for want of memory. May be called from several threads at
/// once; the outcome (times aside) does not depend on what the others do, nor on the number of cores: from the first call
/// on, OpenBLAS (in the whole program) and OpenMP (in this thread) compute in the thread that asks.
Outcome run_case(const CaseSource&, const Overrides&, const std::vector<Measure>&, const CaseLimits& = {});

}  // namespace pintle
