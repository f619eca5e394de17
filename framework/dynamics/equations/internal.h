#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// How an owner's wrenches and internal states answer to each other and to the motion. After apply_forces.
InternalTangent internal_tangent(const System&, const State&, const Equations&, const InternalStates&);

/// The two markers that an owner acts between.
std::array<int, 2> markers_of(const System&, const InternalStates&);

/// x ← the solution of x = base + weight g(p, ṗ, x, t) for the internal states of every owner, by Newton's method from the x that is
/// there; internal_at_rest: of g = 0, and base is not read. After speed. Allocates nothing.
/// @param state  its time and which contacts are closed   @param base, x  n_x numbers each
void follow_internal_states(const System&, Equations&, const State& state, double weight, const double* base, double* x);

/// The internal states in y that have come to rest in its pose: g(p, 0, x, t) = 0; the scene's own as they start.
void relax_internal_states(const System&, double t, Eigen::VectorXd& y);

/// v ← (1 − weight g_x)⁻¹ v: how a step of that weight takes a change of internal states that are stiff. After apply_forces.
void filter_internal_states(const System&, const State&, Equations&, double weight, double* v);

/// Bristles of a contact that has parted are straight; of one that another pair of pieces has taken over, it has them.
void straighten_bristles(const System&, int contact, State&);
void exchange_bristles(const System&, int contact, int other, State&);

}  // namespace pintle
