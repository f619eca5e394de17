#pragma once

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// Share of the energy in play that a sound run by generalised-α may leave unexplained at this tolerance.
double left_by_scheme(const Scheme&);

/// Holds what the ledger leaves unexplained against its bound, and warns of losses and works too small to be known beside it.
/// Fills run.ledger_bound, run.ledger_floor, warnings, status and reason.
/// @param implicit  generalised-α made the run, or the end of it
/// @param floor     what rounding alone may leave [J]
void check_energy_balance(const Scene&, const Model&, bool implicit, double floor, Run&);

}  // namespace pintle
