#pragma once

#include "framework/integration/scheme.h"

namespace pintle {

/// Where a step from t must end for the sake of the laws of time: at a change of one, or at the end of the next piece.
double law_end(const Scheme&, double t);
/// The change at which t stands, before it is passed; nullptr if it stands at none.
const LawChange* change_at(const Scheme&, double t);

}  // namespace pintle
