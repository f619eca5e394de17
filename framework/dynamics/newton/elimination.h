#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

/// An order in which the unknowns of [J Cqᵀ; Cq 0] can be eliminated with pivots on the diagonal and little fill: coordinates before the
/// rows that depend on them. order[k] is eliminated k-th; rows are numbered from n on. Where J couples no two bodies: all coordinates, then
/// the rows in the best order for eliminating S = Cq J⁻¹ Cqᵀ. Otherwise body by body, each followed by at most as many rows as it has
/// coordinates.
/// @param J  places of J's entries
std::vector<int> elimination_order(const System&, const Equations&, const std::vector<Pattern::Place>& J);

}  // namespace pintle
