#pragma once

#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "tests/soak/judge.h"

namespace soak {

/// A run against the same run by another method, and against itself from a start that is a little off, which tells how errors
/// grow. Good: they agree within what their tolerances allow, or cannot be compared, with the reason. Runs that cost
/// much are compared over as much of them as both methods can afford, those whose errors grow over a shorter part of them.
Verdict agreement(const pintle::Scene&, const pintle::Model&, const pintle::Assembly&, double seconds);

/// In six digits.
std::string number(double);

}  // namespace soak
