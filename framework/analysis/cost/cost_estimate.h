#pragma once

#include <string>
#include <vector>

#include "framework/configuration/assemble.h"

/// Cost estimate of a run, from running a part of it.
namespace pintle {

/// A trial of a run, or of a simpler one, from its start. Counts are reproducible unless `by_clock`.
struct Trial {
  long steps = 0, rejected = 0, evaluations = 0, impacts = 0;
  double reached = 0;     ///< [s] of the run
  bool whole = false;     ///< it reached the run's end: nothing needs to be estimated
  bool by_clock = false;  ///< stopped because it took too long
  double seconds = 0;     ///< computing time, without outputs [s]
  std::string trouble;    ///< why it could not continue, in words
};

/// A number known within a range.
struct Estimate {
  double low = 0, likely = 0, high = 0;
};

/// Estimates the steps of a whole run from a part of it: the steps so far, plus the rest at the step rate of the part's second half. The
/// bounds use the rates of its quarters, except the first, which contains the start-up.
/// @param ends  times at which the steps ended, ascending, of a run from 0 [s]
Estimate steps_of_run(const std::vector<double>& ends, double until);

struct RunCost {
  Trial trial;
  Estimate steps;
  double step = 0;   ///< mean of the whole run, most likely value [s]
  Estimate seconds;  ///< computing time without outputs, if steps take as long as in the trial [s]
};

/// What leaving something out would save.
struct Saving {
  std::string what;
  RunCost cost;
  bool of_outputs = false;  ///< less output; `cost` is that of the unchanged run
  double saved = 0;         ///< share of the run's likely time, computing and outputs; negative: it takes longer
};

/// Cost of the output.
struct OutputCost {
  long rows = 0;            ///< of trajectory.csv and ledger.csv
  double row_seconds = 0;   ///< to compute, record and write one row [s]
  double row_bytes = 0;     ///< of both files, as text
  std::size_t columns = 0;  ///< of both
  int frames = 0;
  double frame_seconds = 0, frame_bytes = 0;
  double seconds() const { return static_cast<double>(rows) * row_seconds + frames * frame_seconds; }
  double bytes() const { return static_cast<double>(rows) * row_bytes + frames * frame_bytes; }
};

struct CostEstimate {
  int coordinates = 0, rows = 0, integrals = 0;
  std::vector<std::string> terms;  ///< terms in an evaluation of the equations, in words
  double largest_rate = 0;         ///< of springs and modes, as oscillations [rad/s]; 0: none
  std::string largest_rate_of;
  double contact_rate = 0;  ///< of a contact at a hundredth of the motion's speed [rad/s]; 0: none
  double until = 0;         ///< [s]
  RunCost run;
  OutputCost output;
  Estimate seconds;             ///< total: computing and outputs [s]
  double memory = 0;            ///< at the end: present memory of the program, plus likely impacts; rows are written as they come [bytes]
  std::vector<Saving> simpler;  ///< the largest first
  std::vector<std::string> untried;  ///< simplifications not tried for lack of time
};

/// Tries the run and simpler ones, each for its share of the time; runs that end earlier are complete. Meshes nothing, and writes nothing
/// except a few frames in a temporary folder if the scene has frames.
/// @param seconds  total computing time of the trials [s]; sets their lengths by numbers of steps, not by the clock
/// @throws std::runtime_error  a frame cannot be written
CostEstimate estimate_cost(const Scene&, const Model&, const Assembly&, double seconds = 1);

/// How certain the estimate of the run is, in words.
std::string certainty(const CostEstimate&);
/// The complete estimate as JSON text.
std::string cost_json(const CostEstimate&);

}  // namespace pintle
