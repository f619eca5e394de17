#pragma once

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// Whether the run ended for lack of disk space or memory.
bool ended_short(const Run&);
/// Called in an exception handler: sets status and reason of a run that the exception ends. Rethrows anything but a FileError or lack of
/// memory. @param t  reached [s]
void end_short(Run&, double t);

/// Ends a run properly if it runs out of disk space or memory.
template <class Act>
void guarded(Run& run, const double& t, Act act) {
  try {
    act();
  } catch (...) {
    end_short(run, t);
  }
}

}  // namespace pintle
