#pragma once

#include "framework/integration/step.h"

namespace pintle {

/// Dense output at from.t ≤ t ≤ to.t, not projected onto the constraints: q by the quintic that matches q, s and a at both ends, s by its
/// derivative, x and z by cubics.
void interpolate_quintic(const System&, const Step&, double t, Eigen::VectorXd& y);
/// For an implicit step, where q, s and a agree only to h²: each by the cubic of its values and its derivative's values.
void interpolate_cubic(const System&, const Step&, double t, Eigen::VectorXd& y);

/// Sets the time of a state inside a step, and the modes of its contacts and friction, which are those of the step's start. Forces that are
/// held vary linearly.
void begin_inside(const Step&, double t, State& out);
/// The linear interpolation of a friction's forces at t = from.t + x h.
inline void interpolate_friction(const DryFriction& from, const DryFriction& to, double x, DryFriction& out) {
  out.force = from.force + x * (to.force - from.force);
  out.load = from.load + x * (to.load - from.load);
}

}  // namespace pintle
