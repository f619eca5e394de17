#pragma once

#include <string>
#include <vector>

#include "framework/configuration/assemble.h"

/// What a run will cost, told by running a part of it.
namespace pintle {

/// A run, or a simpler one, tried out from its start. Counts are the same each time unless `by_clock`.
struct Trial {
  long steps = 0, rejected = 0, evaluations = 0, impacts = 0;
  double reached = 0;     ///< [s] of the run
  bool whole = false;     ///< it reached the run's end: nothing is left to guess
  bool by_clock = false;  ///< it ended because it took too long
  double seconds = 0;     ///< of computing, without outputs
  std::string trouble;    ///< why it could not go on; in words
};

/// A number that is known within a range.
struct Estimate {
  double low = 0, likely = 0, high = 0;
};

/// Steps of a whole run, told from a part: steps so far, and for the rest the rate at which they came in the part's second
/// half; at least and at most the rates of its quarters but the first, in which a run starts up.
/// @param ends  times at which the steps ended, ascending, of a run from 0 [s]
Estimate steps_of_run(const std::vector<double>& ends, double until);

struct RunCost {
  Trial trial;
  Estimate steps;
  double step = 0;   ///< mean of the whole run, as likely [s]
  Estimate seconds;  ///< of computing, without outputs: where steps take as long as in the trial
};

/// What leaving something out would save.
struct Saving {
  std::string what;
  RunCost cost;
  bool of_outputs = false;  ///< less is written; `cost` is the run's own
  double saved = 0;         ///< part of the run's likely time, computing and outputs; below 0: it costs
};

/// What is written.
struct OutputCost {
  long rows = 0;            ///< of trajectory.csv and ledger.csv
  double row_seconds = 0;   ///< to find, record and write one row
  double row_bytes = 0;     ///< of both files, as text
  std::size_t columns = 0;  ///< of both
  int frames = 0;
  double frame_seconds = 0, frame_bytes = 0;
  double seconds() const { return static_cast<double>(rows) * row_seconds + frames * frame_seconds; }
  double bytes() const { return static_cast<double>(rows) * row_bytes + frames * frame_bytes; }
};

struct CostEstimate {
  int coordinates = 0, rows = 0, integrals = 0;
  std::vector<std::string> terms;  ///< what an evaluation of the equations runs, in words
  double largest_rate = 0;         ///< of springs and modes, as oscillations [rad/s]; 0: there are none
  std::string largest_rate_of;
  double contact_rate = 0;  ///< of a contact at a hundredth of the motion's speed [rad/s]; 0: none
  double until = 0;         ///< [s]
  RunCost run;
  OutputCost output;
  Estimate seconds;             ///< the whole: computing and outputs
  double memory = 0;            ///< at the end: what the program holds now, and impacts, as likely; rows are written as they come [bytes]
  std::vector<Saving> simpler;  ///< the largest first
  std::vector<std::string> untried;  ///< simplifications for which there was no time
};

/// Tries out the run and simpler ones, each for its share of the time; those that end before it, as a whole. Meshes nothing
/// and writes nothing but, if the scene has frames, a few in a temporary folder.
/// @param seconds  of computing that the trials may take together; their lengths follow from it by counts, not by the clock
/// @throws std::runtime_error  a frame cannot be written
CostEstimate estimate_cost(const Scene&, const Model&, const Assembly&, double seconds = 1);

/// How sure the estimate of the run is, in words.
std::string certainty(const CostEstimate&);
/// All of it, as JSON text.
std::string cost_json(const CostEstimate&);

}  // namespace pintle
