#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Accelerations where rows have become dependent. Let Nᵀ Cq = 0 and H = Σ N ∂²C/∂q². Permanently redundant rows need nothing more. In a
/// singular configuration, where motions branch, Cq a = γ does not determine how a bends. A motion that continues through it also satisfies
/// 3 sᵀH a + ∂²(Nᵀ Ċ)/∂τ² = 0  along q + τ s, the third derivative of Nᵀ C. eq.a gets the smallest correction in the metric of M that
/// satisfies this (docs/theory/constraints.md). The multipliers exclude that of this additional row: they are the finite part of forces
/// that grow without bound towards the singular configuration.
/// Call it after the accelerations are computed, before they are used. Allocates. Sets eq.permanent.
/// @returns false if the configuration is singular and neither the speeds nor, at rest, the accelerations lead out of it along a branch
bool follow_bifurcation_branch(const System&, const State&, Equations&);

}  // namespace pintle
