#pragma once

#include "framework/integration/scheme.h"

namespace pintle {

/// Where a step from t must end for the sake of the laws of time: at a change of one, or at the end of the next piece. A method that
/// sees laws at the ends of its steps alone takes six steps at least through each bend: a polynomial of fifth degree may vanish at five of
/// these seven places, but not at all.
double law_end(const Scheme&, double t, bool sees_ends_alone = false);
/// The change at which t stands, before it is passed; nullptr if it stands at none.
const LawChange* change_at(const Scheme&, double t);

}  // namespace pintle
