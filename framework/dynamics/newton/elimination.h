#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

/// An order in which the unknowns of [J Cqᵀ; Cq 0] can be eliminated with pivots on the diagonal, and little
/// fill: coordinates before the rows that rest on them. order[k] is eliminated k-th; rows count from n on.
/// Where J couples no two bodies: all coordinates, then the rows as S = Cq J⁻¹ Cqᵀ is best eliminated. Else
/// body by body, each followed by the rows that it can carry: as many as it has coordinates.
/// @param J  places of J's entries
std::vector<int> elimination_order(const System&, const Equations&, const std::vector<Pattern::Place>& J);

}  // namespace pintle
