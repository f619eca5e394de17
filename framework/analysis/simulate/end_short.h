#pragma once

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// Did the run end because there was no room for what it writes, or no memory?
bool ended_short(const Run&);
/// Called where an exception is being handled: status and reason of a run that it ends. What is neither a FileError nor want
/// of memory is thrown on. @param t  reached [s]
void end_short(Run&, double t);

/// Ends a run in order where there is no room for what it writes, or no memory.
template <class Act>
void guarded(Run& run, const double& t, Act act) {
  try {
    act();
  } catch (...) {
    end_short(run, t);
  }
}

}  // namespace pintle
