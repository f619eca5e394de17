#pragma once

#include <functional>
#include <string_view>

#include "framework/integration/stepper.h"

namespace pintle {

/// Evaluations so far; a factorization of the matrix of Newton's method counts as four more. An explicit method factors in each evaluation.
inline long cost_of(const Equations& eq, bool implicit) { return eq.evaluations + (implicit ? 4 * eq.factorizations : 0); }

/// Steps of a method from a node, without events, to find how fast they go; nothing remains of them.
/// @param h      length of the first [s]
/// @param ahead  the time that a step from a state may last at most [s]; 0: the trial ends there
/// @param tries  how many steps are tried; the second half counts, when vibrations that the steps before have left have died away
/// @returns time passed per cost [s]; 0 if the steps fail or are too few
double trial_pace(std::string_view method, const System&, const Scheme&, const ErrorNorm&, const Equations&, const Instant& from, double h,
                  const std::function<double(const State&)>& ahead, long tries);

}  // namespace pintle
