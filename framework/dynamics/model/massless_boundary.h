#pragma once

#include "framework/dynamics/model/contact_pair.h"

/// Contact of two centres that flexible bodies carry elastically and without mass. Theory: docs/theory/contact.md.
namespace pintle {

/// Its normal force, which acts along the normal of the displaced centres. `stored` includes the energy of the bodies' residual
/// flexibility; the derivatives are with respect to the approach of the two markers. @pre the pair has `massless`, the gap is closed
/// @param latched  approach speed at onset [m/s]
NormalForce massless_force(const ContactPair&, const MovingPoint& a, const MovingPoint& b, const Gap&, double latched);

/// Adds forces to an effect with its gap. @pre as above
void press_massless(const ContactPair&, const MovingPoint& a, const MovingPoint& b, double latched, ContactEffect&);

/// As wrench_tangent. @pre as above, and its force is not zero
WrenchTangent massless_tangent(const ContactPair&, const ContactEffect& now, const MovingPoint& a, const MovingPoint& b);

}  // namespace pintle
