#pragma once

#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "tests/soak/judge.h"

namespace soak {

/// A run against the same run by another method, and against itself from a start that is a little off, which tells how errors
/// grow. Good: they agree within what their tolerances allow, or cannot be compared, with the reason. Runs that cost
/// much are compared over as much of them as both methods can afford, those whose errors grow over a shorter part of them.
/// Of rigid bodies too: by two explicit pairs, which meet the same impacts, to their tolerances; Moreau's steps with events by the first
/// order of the step. Theory promises no more than that, and only where the motion depends on its start continuously: not where several
/// contacts strike at once and the least change lets one of them be first, nor at the end of a friction that several contacts share. Such
/// runs are told by starts a little off, whose motions go apart, and are not compared.
Verdict agreement(const pintle::Scene&, const pintle::Model&, const pintle::Assembly&, double seconds);

/// In six digits.
std::string number(double);

}  // namespace soak
