#pragma once

#include "framework/integration/step.h"

namespace pintle {

/// Dense output at from.t ≤ t ≤ to.t, not projected onto the constraints: q by the quintic that meets q, s and a at both ends, s by its
/// derivative, x and z by the cubic.
void interpolate_quintic(const System&, const Step&, double t, State& out);
/// For an implicit step, whose q, s and a agree to h² only: each by the cubic of itself and the next.
void interpolate_cubic(const System&, const Step&, double t, State& out);

}  // namespace pintle
