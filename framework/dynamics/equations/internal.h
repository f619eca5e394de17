#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// How an owner's wrenches and internal states respond to each other and to the motion. After apply_forces.
InternalTangent internal_tangent(const System&, const State&, const Equations&, const InternalStates&);

/// The two markers that an owner acts between.
std::array<int, 2> markers_of(const System&, const InternalStates&);

/// Solves x = base + weight g(p, ṗ, x, t) for the internal states of every owner by Newton's method, starting from the given x. With
/// internal_at_rest it solves g = 0, and base is null. After speed. Allocates nothing.
/// @param state  only its time and closed contacts are used   @param base, x  n_x numbers each
void follow_internal_states(const System&, Equations&, const State& state, double weight, const double* base, double* x);

/// Sets the internal states in y to their rest values in its configuration: g(p, 0, x, t) = 0; the scene's own states to their start
/// values.
void relax_internal_states(const System&, double t, Eigen::VectorXd& y);

/// v ← (1 − weight g_x)⁻¹ v: effect of a step of that weight on a change of stiff internal states. After apply_forces.
void filter_internal_states(const System&, const State&, Equations&, double weight, double* v);

/// Sets the bristles of a contact that has opened to zero; transfers the bristles to the pair of pieces that continues a contact.
void straighten_bristles(const System&, int contact, State&);
void exchange_bristles(const System&, int contact, int other, State&);

}  // namespace pintle
