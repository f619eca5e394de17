#pragma once

#include <functional>

#include "framework/analysis/simulate/saved_state.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/integration/counts.h"
#include "framework/integration/events/event.h"
#include "framework/integration/events/impact.h"
#include "framework/mechanism/drawing.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

enum class Status { finished, failed, interrupted, ledger_over_bound, not_written, out_of_memory };
const char* status_text(Status);

/// Complete results of a run, up to the time it reached.
struct Run {
  Status status = Status::finished;
  std::string reason;                 ///< in words, when not finished
  std::string switched = {};          ///< when and why the scheme changed from explicit to implicit; otherwise empty
  std::vector<std::string> warnings;  ///< what makes the numbers doubtful, in words
  double t_end = 0;                   ///< reached [s]
  Table trajectory, ledger;           ///< without rows if a listener takes them
  std::vector<double> integrals;      ///< of the energy balance, at the last row; empty if there is no row
  struct LinkForce {
    double least = 0, greatest = 0;  ///< of the rows [N]
    long pushing = 0, rows = 0;      ///< rows with a negative force; all rows
  };
  std::vector<double> greatest_integrals;  ///< of the energy balance, in magnitude, at any output [J]
  std::vector<LinkForce> links;            ///< for each contact that is a massless link; for others empty
  std::vector<Impact> impacts;
  std::vector<Happening> happenings = {};  ///< record of the events of the scene
  Energies first, last;                    ///< energy balance at the start and at the end
  double unexplained = 0;                  ///< at the end [J]
  double worst_unexplained = 0;            ///< largest in magnitude at any output [J]
  double energy_in_play = 0;               ///< scale of `unexplained` [J]
  double ledger_bound = 0;                 ///< share of it that may stay unexplained, from the scene or the method
  double ledger_floor = 0;                 ///< additional allowance for rounding [J]
  Counts counts;
  double worst_position = 0, worst_velocity = 0;  ///< scaled constraint violations
  double seconds = 0;                             ///< processor time of computing, without frames and files [s]
};

/// Callbacks during a run; each may be empty. A FileError thrown by one ends the run properly.
struct Listeners {
  std::function<bool(double t)> progress;                     ///< false stops the run
  std::function<void(const State&, const Equations&)> frame;  ///< at each animation frame
  /// Takes the new rows of both tables, which are then cleared, and all impacts and happenings so far.
  std::function<void(const Table& trajectory, const Table& ledger, const std::vector<Impact>&, const std::vector<Happening>&)> rows;
  std::function<void(const SavedState&)> state;  ///< at the end of the first step past each `output.states`, and of the last step
};

/// Runs a model from its assembled start to `run.until`, or continues from a saved state: then the tables hold the rows after it, identical
/// bit for bit to those of the whole run, and impacts are those of the whole run. Never throws for numerical reasons or lack of memory.
Run simulate(const Scene&, const Model&, const Assembly&, const Listeners& = {}, const SavedState* from = nullptr);

}  // namespace pintle
