#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Accelerations where rows have become dependent. Let Nᵀ Cq = 0 and H = Σ N ∂²C/∂q². What is permanently redundant asks
/// nothing more. In a singular pose, where motions branch, Cq a = γ leaves open how a bends; a motion that goes on through
/// the pose also meets  3 sᵀH a + ∂²(Nᵀ Ċ)/∂τ² = 0  along q + τ s, the third derivative of Nᵀ C, and eq.a is brought there by
/// the shortest way in the metric of M (docs/theory/constraints.md). The multipliers are those beside the one of this last
/// row, which is the finite part of forces that grow without bound towards the pose.
/// After the accelerations, before anything uses them; allocates. Sets eq.permanent.
/// @returns false if the pose is singular and neither speeds nor, at rest, accelerations lead out of it along a branch
bool follow_bifurcation_branch(const System&, const State&, Equations&);

}  // namespace pintle
