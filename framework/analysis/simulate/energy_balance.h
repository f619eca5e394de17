#pragma once

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// Share of the energy in play that a sound run with generalised-α may have as energy-balance error at this tolerance.
double left_by_scheme(const Scheme&);

/// Compares the energy-balance error with its bound, and warns of losses and works too small to be known given this error. Fills
/// run.ledger_bound, run.ledger_floor, warnings, status and reason.
/// @param implicit  generalised-α made the run, or its last part
/// @param floor     error that rounding alone may cause [J]
void check_energy_balance(const Scene&, const Model&, bool implicit, double floor, Run&);

}  // namespace pintle
