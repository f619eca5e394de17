#pragma once

#include "framework/integration/step.h"

namespace pintle {

/// Dense output at from.t ≤ t ≤ to.t, not projected onto the constraints: q by the quintic that matches q, s and a at both ends, s by its
/// derivative, x and z by cubics.
void interpolate_quintic(const System&, const Step&, double t, State& out);
/// For an implicit step, where q, s and a agree only to h²: each by the cubic of its values and its derivative's values.
void interpolate_cubic(const System&, const Step&, double t, State& out);

}  // namespace pintle
